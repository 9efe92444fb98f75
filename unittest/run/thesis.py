"""Inputs of the thesis' program for tests, in both forms, with changes by the places of their keys."""

import copy
import json

NESTED = {
    "comments": ["a small foam"],
    "bubbles": {"numStart": 100, "numEnd": 60, "radius": {"mean": 1.0, "std": 0.21}},
    "box": {"dimensionality": 2, "relativeDimensions": {"x": 1.0, "y": 1.0, "z": 1.0},
            "wall": {"drag": 0.1, "x": 0, "y": 0, "z": 0}},
    "flow": {"impose": 0, "velocity": {"x": 0.01, "y": 0.0, "z": 0.0}, "lbb": {"x": 0.0, "y": 0.4, "z": 0.0},
             "tfr": {"x": 0.5, "y": 0.6, "z": 0.0}},
    "constants": {"phi": {"value": 0.9}, "mu": {"value": 1.0}, "sigma": {"value": 1.0}, "kappa": {"value": 0.1},
                  "K": {"comment": "fast", "value": 0.01}},
    "errorTolerance": {"value": 1e-5},
    "rngSeed": {"value": 426},
    "stabilization": {"steps": 100, "maxDeltaEnergy": 1.0},
    "snapShot": {"filename": "bubbles", "frequency": 2.0},
}
FLAT = {
    "phiTargetExpl": "gas fraction", "phiTarget": 0.9, "kappa": 0.1, "numBubblesIn": 1e2, "minNumBubbles": 60,
    "kParameter": 0.01, "wallDragStrength": 0.1, "boxRelDim": {"x": 1.0, "y": 1.0, "z": 1.0},
    "flowLbb": {"x": 0.0, "y": 0.4, "z": 0.0}, "flowTfr": {"x": 0.5, "y": 0.6, "z": 0.0},
    "flowVel": {"x": 0.01, "y": 0.0, "z": 0.0}, "muZero": 1.0, "sigmaZero": 1.0, "avgRad": 1.0, "stdDevRad": 0.21,
    "errorTolerance": 1e-5, "timeStepIn": 1e-3, "rngSeed": 426, "numBubblesPerCell": 32, "numStepsToRelax": 1e2,
    "maxDeltaEnergy": 1.0, "snapshotFrequency": 2.0,
}
GONE = object()    # as a value: the key is taken out


def changed(data, changes=None):
    """A copy; changes = {"bubbles.numEnd": 3, ...}."""
    data = copy.deepcopy(data)
    for place, value in (changes or {}).items():
        *path, name = place.split(".")
        inner = data
        for step in path:
            inner = inner[step]
        if value is GONE:
            del inner[name]
        else:
            inner[name] = value
    return data


def written(path, data=None, changes=None):
    """As a file, one key a line."""
    path.write_text(json.dumps(changed(NESTED if data is None else data, changes), indent=2))
    return path
