"""Where a quantity crosses a value as the liquid fraction grows, and how wide the crossover is, with errors."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SAMPLES = 1000
DRY, WET = 1 / 2, 1 / 3                 # exponents on both sides
MIDDLE = (DRY + WET) / 2
QUARTERS = (DRY - (DRY - WET) / 4, WET + (DRY - WET) / 4)      # a quarter of the way from each side


@dataclass
class Crossing:
    value: float
    error: float
    share: float      # of the samples that cross

    @property
    def found(self) -> bool:
        """A crossing that a tenth of the samples misses is none: its error would be that of a selection."""
        return bool(np.isfinite(self.value)) and self.share >= 0.9


def first_crossing(x: np.ndarray, y: np.ndarray, level: float) -> float:
    """The first x at which y, linear between points, passes `level`; nan if it does not."""
    above = y >= level
    change = np.flatnonzero(above[1:] != above[:-1])
    if not len(change):
        return float("nan")
    k = change[0]
    return float(x[k] + (level - y[k]) / (y[k + 1] - y[k]) * (x[k + 1] - x[k]))


def between_points(x: np.ndarray, y: np.ndarray, where: float) -> float:
    """Error of a crossing because y is known at points alone.

    If all of the change lies between two points, the crossing may be anywhere there: their distance over sqrt(12), the
    standard deviation of a uniform distribution. If a part of the change does, that part of it.
    """
    k = int(np.clip(np.searchsorted(x, where) - 1, 0, len(x) - 2))
    return float((x[k + 1] - x[k]) / np.sqrt(12) * abs(y[k + 1] - y[k]) / np.ptp(y))


def crossing(x: np.ndarray, y: np.ndarray, error: np.ndarray, level: float) -> Crossing:
    """First crossing, and its error: of the points, each drawn from a normal distribution, and between the points."""
    value = first_crossing(x, y, level) if len(x) > 1 else float("nan")
    if not np.isfinite(value):
        return Crossing(float("nan"), float("nan"), 0.0)
    rng = np.random.default_rng(1)
    drawn = np.array([first_crossing(x, y + error * rng.standard_normal(len(y)), level) for _ in range(SAMPLES)])
    good = drawn[np.isfinite(drawn)]
    return Crossing(value, float(np.hypot(np.std(good), between_points(x, y, value))), len(good) / SAMPLES)


def peaks(density: np.ndarray, error: np.ndarray) -> tuple[float, int, int, int]:
    """How far the deepest valley between two maxima stands out, in standard errors; bins of both maxima and of it."""
    best = (0.0, -1, -1, -1)
    for valley in range(1, len(density) - 1):
        left, right = int(np.argmax(density[:valley])), valley + 1 + int(np.argmax(density[valley + 1:]))
        drops = [(density[top] - density[valley]) / np.hypot(error[top], error[valley])
                 for top in (left, right) if error[top] > 0 and density[top] > density[valley]]
        if len(drops) == 2 and min(drops) > best[0]:
            best = (float(min(drops)), left, right, valley)
    return best
