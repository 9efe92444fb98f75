"""Read the input of the thesis' program (J. Lankinen, 2020), in both forms that were published, and judge it.

A JSON Schema for each form, beside this file, says which keys there are and which values are allowed. What one value
means for another is looked at here. All errors of a file are told at once, each with its place.
"""

from __future__ import annotations

import dataclasses
import difflib
import json
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from . import places

HERE = __name__.rpartition(".")[0]
FORMS = ("nested", "flat")


class Unusable(Exception):
    """Something that was given cannot be used; the text is for the user."""


@dataclass(frozen=True)
class Foam:
    """What an input means. Lengths, times and forces in the units of the input."""
    form: str                       # nested or flat
    bubbles: int                    # N at the start
    end: int                        # the run ends when no more are left
    mean: float                     # mean radius at the start
    std: float                      # standard deviation of the radii
    dimension: int
    sides: tuple[float, float, float]    # relative to each other
    walls: tuple[bool, bool, bool]       # at both faces across x, y, z
    wall_drag: float
    flow: bool
    flow_velocity: tuple[float, float, float]    # in units of sigma <R> / mu
    flow_lo: tuple[float, float, float]          # relative to the box
    flow_hi: tuple[float, float, float]
    phi: float
    mu: float
    sigma: float
    kappa: float
    K: float
    tolerance: float
    seed: int
    relax_steps: int                # per round of relaxation
    max_delta_energy: float         # relative change of the energy per unit of tau
    frequency: float                # snapshots per unit of tau
    filename: str                   # of the snapshots
    first_step: float
    notes: tuple[str, ...] = ()     # what has no meaning here, what was not said


@dataclass
class Trouble:
    """What is wrong with the key or the value at a path, and where that stands."""
    path: tuple[Any, ...]
    message: str
    span: places.Span


# ---- the forms ------------------------------------------------------------------------------------------------------

# where a value stands in either form; a name without a place in one is not said there
NESTED = {
    "bubbles": "bubbles.numStart", "end": "bubbles.numEnd", "mean": "bubbles.radius.mean", "std": "bubbles.radius.std",
    "dimension": "box.dimensionality", "sides": "box.relativeDimensions",
    "wall_x": "box.wall.x", "wall_y": "box.wall.y", "wall_z": "box.wall.z", "wall_drag": "box.wall.drag",
    "flow": "flow.impose", "flow_velocity": "flow.velocity", "flow_lo": "flow.lbb", "flow_hi": "flow.tfr",
    "phi": "constants.phi.value", "mu": "constants.mu.value", "sigma": "constants.sigma.value",
    "kappa": "constants.kappa.value", "K": "constants.K.value", "tolerance": "errorTolerance.value",
    "seed": "rngSeed.value", "relax_steps": "stabilization.steps", "max_delta_energy": "stabilization.maxDeltaEnergy",
    "frequency": "snapShot.frequency", "filename": "snapShot.filename",
}
FLAT = {
    "bubbles": "numBubblesIn", "end": "minNumBubbles", "mean": "avgRad", "std": "stdDevRad",
    "dimension": "dimensionality", "sides": "boxRelDim",
    "wall_x": "xWall", "wall_y": "yWall", "wall_z": "zWall", "wall_drag": "wallDragStrength",
    "flow": "addFlow", "flow_velocity": "flowVel", "flow_lo": "flowLbb", "flow_hi": "flowTfr",
    "phi": "phiTarget", "mu": "muZero", "sigma": "sigmaZero", "kappa": "kappa", "K": "kParameter",
    "tolerance": "errorTolerance", "seed": "rngSeed", "relax_steps": "numStepsToRelax",
    "max_delta_energy": "maxDeltaEnergy", "frequency": "snapshotFrequency", "filename": "snapshotFilename",
    "first_step": "timeStepIn",
}
PLACES = {"nested": NESTED, "flat": FLAT}

COMMENT = re.compile(r"Expl$|^comments?$")

IGNORED = {
    "numBubblesPerCell": "LAMMPS chooses its cells itself",
    "skinRadius": "the input for LAMMPS has a skin of its own, which does not change results",
    "dataFilename": "tables are series.csv and results.csv",
}


def schema(form: str) -> dict[str, Any]:
    text = resources.files(HERE).joinpath(f"schema-{form}.json").read_text(encoding="utf-8")
    read: dict[str, Any] = json.loads(text)
    return read


def form_of(data: dict[str, Any]) -> str:
    """That with more of the keys, large letters or small."""
    known = {form: {name.lower() for name in schema(form)["properties"]} for form in FORMS}
    counts = {form: sum(key.lower() in known[form] for key in data) for form in FORMS}
    return max(FORMS, key=lambda form: counts[form])


# ---- reading --------------------------------------------------------------------------------------------------------

def read(path: Path, dimension: int | None = None, walls: str | None = None,
         flow: bool | None = None) -> Foam:
    """The foam that a file describes.

    dimension, walls (some of the letters xyz) and flow are for the flat form, in its versions without the keys: there
    these were options of the compiler. Raises Unusable with all that is wrong.
    """
    text = _text(path)
    root = _tree(path, text)
    if not isinstance(root.value, dict):
        trouble = Trouble((), f"a JSON object is wanted, not {_name(root.value)}", root.span)
        raise Unusable(_report(path, text, [trouble]))
    form = form_of(root.value)
    troubles = [*_duplicates(root, text), *_not_finite(root)]
    troubles += _against_schema(root, form, {trouble.path for trouble in troubles})
    given = _values(root, form)
    given |= _options(path, form, given, {"dimension": dimension, "walls": walls, "flow": flow})
    wrong = {trouble.path for trouble in troubles}
    troubles += _contradictions(root, form, {"dimension": 2, **given}, wrong)
    if troubles:
        raise Unusable(_report(path, text, troubles))
    return _foam(form, given, root.value)


def _text(path: Path) -> str:
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise Unusable(f"{path}: cannot be read: {error.strerror}") from None
    if len(raw) > 10_000_000:
        raise Unusable(f"{path}: {len(raw)} bytes are too many for an input of the thesis' program")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        raise Unusable(f"{path}:{line}: byte {error.start + 1} is not UTF-8, so this is no JSON") from None


def _tree(path: Path, text: str) -> places.Node:
    try:
        return places.read(text)
    except json.JSONDecodeError as error:
        message = "the file is empty" if not text.strip() else f"no JSON: {error.msg}"
        line, column, shown = places.show(text, places.Span(error.pos, error.pos + 1))
        raise Unusable(f"{path}:{line}:{column}: {message}\n{shown}") from None
    except RecursionError:
        raise Unusable(f"{path}: no input of the thesis' program: objects within objects without end") from None
    except ValueError as error:    # a whole number of thousands of digits
        raise Unusable(f"{path}: {error}") from None


def _report(path: Path, text: str, troubles: list[Trouble]) -> str:
    lines = []
    for trouble in sorted(troubles, key=lambda trouble: (trouble.span.start, trouble.message)):
        line, column, shown = places.show(text, trouble.span)
        place = f"{dotted(trouble.path)}: " if trouble.path else ""
        lines.append(f"{path}:{line}:{column}: {place}{trouble.message}\n{shown}")
    return "\n".join(lines)


def dotted(path: tuple[Any, ...]) -> str:
    text = ""
    for name in path:
        text += f"[{name}]" if isinstance(name, int) else f".{name}"
    return text.lstrip(".")


def _name(value: Any) -> str:
    """A value as it is named in a message."""
    if isinstance(value, dict):
        return "an object {...}"
    if isinstance(value, list):
        return "a list [...]"
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 40 else f"{text[:37]}..."


# ---- what is wrong --------------------------------------------------------------------------------------------------

def _nodes(node: places.Node, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], places.Node]]:
    yield path, node
    for name, child in node.children.items():
        yield from _nodes(child, (*path, name))


def _duplicates(root: places.Node, text: str) -> Iterator[Trouble]:
    for path, node in _nodes(root):
        first: dict[str, places.Span] = {}
        for key, span in node.keys:
            if key in first and not COMMENT.search(key):    # a published input has a comment twice
                line, column, _ = places.show(text, first[key])
                yield Trouble((*path, key), f"the same key is at {line}:{column} already", span)
            first.setdefault(key, span)


def _not_finite(root: places.Node) -> Iterator[Trouble]:
    for path, node in _nodes(root):
        value = node.value
        if isinstance(value, float) and not math.isfinite(value):
            what = "NaN" if math.isnan(value) else "too large a number"
            yield Trouble(path, f"{what}; a finite number is wanted", node.span)


def _against_schema(root: places.Node, form: str, known: set[tuple[Any, ...]]) -> Iterator[Trouble]:
    """What the schema does not allow, but for values of which something has been said."""
    import jsonschema    # takes a while to load

    validator = jsonschema.Draft202012Validator(schema(form))
    for error in validator.iter_errors(root.value):
        path = tuple(error.absolute_path)
        node = root.at(path)
        if error.validator == "required":
            missing = next(key for key in error.validator_value if f"{key!r} is a required" in error.message)
            yield Trouble((*path, missing), f"is missing; {_allowed(form, (*path, missing))}", _head(root, path))
        elif error.validator == "additionalProperties":
            yield from _unknown(form, path, node, error.schema)
        elif path not in known:
            known.add(path)    # one message for each value
            yield Trouble(path, f"{_name(node.value)} is not allowed; {error.schema['description']}", node.span)


def _head(root: places.Node, path: tuple[Any, ...]) -> places.Span:
    """The key of an object, or the brace of the whole."""
    if not path:
        return root.span
    return [span for key, span in root.at(path[:-1]).keys if key == path[-1]][-1]


def _unknown(form: str, path: tuple[Any, ...], node: places.Node, rules: dict[str, Any]) -> Iterator[Trouble]:
    other = "flat" if form == "nested" else "nested"
    for key, span in node.keys:
        if key in rules["properties"] or any(re.search(rule, key) for rule in rules.get("patternProperties", {})):
            continue
        likely = difflib.get_close_matches(key.lower(), [name.lower() for name in rules["properties"]], 1, 0.6)
        near = [name for name in rules["properties"] if name.lower() in likely]
        if not path and key in schema(other)["properties"]:
            hint = f"it belongs to the {other} form, and most of the others to the {form} form"
        elif near:
            hint = f"did you mean {near[0]}?"
        else:
            hint = f"known here: {', '.join(rules['properties'])}"
        yield Trouble((*path, key), f"is no key of the {form} form; {hint}", span)


def _allowed(form: str, path: tuple[Any, ...]) -> str:
    """What the schema says is allowed at a place."""
    whole = schema(form)
    rules = whole
    for name in path:
        rules = rules["properties"][name]
        if "$ref" in rules:
            rules = whole["$defs"][rules["$ref"].rpartition("/")[2]]
    return str(rules["description"])


def _contradictions(root: places.Node, form: str, given: dict[str, Any], wrong: set[tuple[Any, ...]]) -> list[Trouble]:
    """Values that are allowed, but not together."""
    where = PLACES[form]
    found: list[Trouble] = []

    def look(name: str, message: str, component: str = "") -> None:
        path = tuple(where[name].split(".")) + ((component,) if component else ())
        try:
            span = root.at(path).span
        except KeyError:    # said by an option
            path, span = (), root.span
        found.append(Trouble(path, message, span))

    def sound(*names: str) -> bool:
        """All of them are there, and nothing is wrong with them."""
        return all(name in given and not any(".".join(map(str, path)).startswith(where.get(name, "\0"))
                                             for path in wrong) for name in names)

    if sound("bubbles", "end") and given["end"] >= given["bubbles"]:
        look("end", f"{given['end']:g} bubbles at the end; there must be fewer than the {given['bubbles']:g} "
                    f"at the start ({where['bubbles']})")
    if sound("mean", "std") and given["std"] > 10 * given["mean"]:
        look("std", f"a standard deviation of {given['std']:g} is more than ten times the mean radius "
                    f"{given['mean']:g} ({where['mean']})")
    if sound("dimension", "wall_z") and given["dimension"] == 2 and given["wall_z"]:
        look("wall_z", "a wall across z needs three dimensions, and the box has 2")
    if sound("wall_x", "wall_y", "wall_z") and "wall_drag" not in given \
            and any(given[f"wall_{axis}"] for axis in "xyz"):
        found.append(Trouble((where["wall_drag"],), "is missing; there are walls", root.span))
    if sound("dimension", "flow") and given["flow"]:
        missing = [name for name in ("flow_velocity", "flow_lo", "flow_hi") if name not in given]
        found += [Trouble((where[name],), "is missing; a flow is imposed", root.span) for name in missing
                  if form == "flat"]
        if not missing and sound("flow_lo", "flow_hi"):
            for axis in "xyz"[:int(given["dimension"])]:
                lo, hi = given["flow_lo"][axis], given["flow_hi"][axis]
                if lo >= hi:
                    look("flow_hi", f"{hi:g} must be more than {lo:g}, where the flow begins along {axis} "
                                    f"({where['flow_lo']}.{axis})", axis)
                elif hi <= 0 or lo >= 1:
                    look("flow_hi", f"the flow, from {lo:g} to {hi:g} along {axis}, is outside of the box, which "
                                    "reaches from 0 to 1", axis)
    return found


# ---- what is meant --------------------------------------------------------------------------------------------------

def _values(root: places.Node, form: str) -> dict[str, Any]:
    """Those that are there, by their names here."""
    found = {}
    for name, place in PLACES[form].items():
        try:
            found[name] = root.at(place.split(".")).value
        except KeyError:
            pass
    return found


def _options(path: Path, form: str, given: dict[str, Any], options: dict[str, Any]) -> dict[str, Any]:
    """What the command line adds to an input that does not say it."""
    added: dict[str, Any] = {}
    for option, names in {"dimension": ["dimension"], "flow": ["flow"],
                          "walls": ["wall_x", "wall_y", "wall_z"]}.items():
        value = options[option]
        if value is None:
            continue
        said = [PLACES[form][name] for name in names if name in given]
        if said:
            raise Unusable(f"{path}: it says {', '.join(said)} itself, so the option --{option} is not allowed")
        if option == "walls":
            added.update({f"wall_{axis}": axis in value for axis in "xyz"})
        else:
            added[option] = value
    return added


def _foam(form: str, given: dict[str, Any], data: dict[str, Any]) -> Foam:
    notes = [f"{key} is ignored: {why}" for key, why in IGNORED.items() if key in data]
    defaults = {"dimension": 2, "flow": False, "wall_x": False, "wall_y": False, "wall_z": False, "wall_drag": 0.0,
                "frequency": 0.0, "filename": "snapshot", "first_step": 1.0e-4,
                **{name: dict.fromkeys("xyz", 0.0) for name in ("flow_velocity", "flow_lo", "flow_hi")}}
    told = {"dimension": "2 dimensions (--dimension 3 for 3)", "flow": "no flow (--flow for one)",
            "wall_x": "no walls (--walls x, xy, ... for some)"}
    notes += [f"{PLACES[form][name]} is not there, {text}" for name, text in told.items() if name not in given]
    if "frequency" not in given:
        notes.append(f"{PLACES[form]['frequency']} is not there, no snapshots")
    value = {**defaults, **given}
    if value["dimension"] == 2 and "sides" in given:
        notes.append(f"{PLACES[form]['sides']}.z is ignored: 2 dimensions")

    def vector(name: str) -> tuple[float, float, float]:
        x, y, z = (float(value[name][axis]) for axis in "xyz")
        return x, y, z

    # the fields that are one number
    kinds: dict[str, Any] = {"float": float, "int": int}
    numbers: dict[str, Any] = {field.name: kinds[str(field.type)](value[field.name])
                               for field in dataclasses.fields(Foam) if field.type in kinds}
    return Foam(form=form, **numbers, sides=vector("sides"),
                walls=(bool(value["wall_x"]), bool(value["wall_y"]), bool(value["wall_z"])), flow=bool(value["flow"]),
                flow_velocity=vector("flow_velocity"), flow_lo=vector("flow_lo"), flow_hi=vector("flow_hi"),
                filename=value["filename"], notes=tuple(notes))
