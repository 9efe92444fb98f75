"""Tables of plot.py for the manual: what was measured, crossovers, checks, and the published statements beside ours.

Each conclusion is made from the numbers of the runs. What is not run yet is said to be so.
"""
from __future__ import annotations

from collections import Counter
import csv
from pathlib import Path

import numpy as np

from crossover import MIDDLE, QUARTERS, Crossing, crossing, peaks
from lammps_foam.analysis import sizes, table
from states import EDGES, Foam, is_late

Foams = dict[tuple[str, float], Foam]
Rows = list[dict[str, str]]
ADHESION = ["spring", "sticky0.01", "sticky0.05"]
EXCHANGE = ["spring", "kappa1", "kappa0.01", "films", "area", "sticky0.01-area"]
MISSING = "not run yet"
SIGMAS = 2.0           # two values agree if they differ by less standard errors
PEAK_SIGMAS = 3.0      # of a valley between two peaks: there are 40 bins, and some differ by two by chance
NEAR = 1 / 12          # an exponent with a larger error than half of 1/2 - 1/3 tells neither from the other


def short(value: float, error: float) -> str:
    """0.333(12): the last digits are uncertain by those in parentheses. 7.0(1.6) where the error is above 1."""
    if not error > 0 or not np.isfinite(error):
        return f"{value:.3g}"
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    shown_error = f"{error * 10**digits:.0f}" if error < 1 else f"{error:.{digits}f}"
    return f"{value:.{digits}f}({shown_error})"


def cell(foams: Foams, key: tuple[str, float], name: str) -> str:
    if key not in foams:
        return MISSING
    foam = foams[key]
    if not foam.scales:
        return f"stops at {foam.row['last_N']:.0f} of {foam.row['bubbles']:.0f}"
    if name not in foam.row:
        return MISSING
    return short(foam.row[name], foam.row[f"{name}_error"]) if np.isfinite(foam.row[name]) else "not known"


def with_smaller(foams: Foams, smaller: Foams) -> Foams:
    """Foams, and those of smaller runs of series that have one liquid fraction of larger ones at most.

    A series has one size: what depends on the liquid fraction must not depend on two numbers of bubbles.
    """
    count = Counter(series for series, _ in foams)
    small = {series for series, _ in smaller if count[series] < 2}
    return dict(sorted([*((key, foam) for key, foam in smaller.items() if key[0] in small),
                        *((key, foam) for key, foam in foams.items() if key[0] not in small)]))


def most_bubbles(foams: Foams) -> float:
    return max((foam.row["bubbles"] for foam in foams.values()), default=0.0)


def label(foams: Foams, series: str) -> str:
    """Its name, with the number of bubbles if other series have more."""
    mine = most_bubbles({key: foam for key, foam in foams.items() if key[0] == series})
    return f"{series} ({mine:.0f})" if 0 < mine < most_bubbles(foams) else series


def matrix(foams: Foams, series: list[str], fractions: list[float], name: str) -> Rows:
    """A quantity: liquid fractions below each other, series beside each other."""
    return [{"liquid fraction": f"{fraction:.2f}",
             **{label(foams, one): cell(foams, (one, fraction), name) for one in series}} for fraction in fractions]


def column(foams: Foams, series: str, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Liquid fractions, values and errors of a series, where it has late states and the error is known."""
    rows = [(fraction, foam.row[name], foam.row[f"{name}_error"]) for (one, fraction), foam in sorted(foams.items())
            if one == series and foam.scales and name in foam.row]
    x, y, e = np.array(rows, dtype=float).reshape(-1, 3).T
    good = np.isfinite(y) & np.isfinite(e)
    return x[good], y[good], e[good]


# ------------------------------------------------------------------ crossovers

READINGS = {"exponent": ("1/n", MIDDLE), "Sauter": ("1/n_R32", MIDDLE), "rattlers": ("rattlers", 0.5),
            "films": ("through_films", 0.5)}


def read_off(foams: Foams, series: str, what: str) -> Crossing:
    name, level = READINGS[what]
    x, y, e = column(foams, series, name)
    if level == MIDDLE:     # an exponent that is hardly known moves the crossing anywhere
        known = e < NEAR
        x, y, e = x[known], y[known], e[known]
    return crossing(x, y, e, level)


def width_of(foams: Foams, series: str, what: str = "exponent") -> tuple[float, float]:
    """Liquid fractions over which 1/n goes through the middle half of its way, with the error; nan if it does not."""
    x, y, e = column(foams, series, READINGS[what][0])
    known = e < NEAR
    ends = [crossing(x[known], y[known], e[known], level) for level in QUARTERS]
    if not all(end.found for end in ends):
        return float("nan"), float("nan")
    return ends[1].value - ends[0].value, float(np.hypot(ends[0].error, ends[1].error))


def shown(found: Crossing, foams: Foams, series: str) -> str:
    if found.found:
        return short(found.value, found.error)
    x = sorted(fraction for one, fraction in foams if one == series)
    return f"not between {x[0]:.2f} and {x[-1]:.2f}" if len(x) > 1 else MISSING


def crossovers(foams: Foams, series: list[str]) -> Rows:
    rows = []
    for one in series:
        row = {"series": label(foams, one)}
        for what in READINGS:
            row[what] = shown(read_off(foams, one, what), foams, one)
            if READINGS[what][1] == MIDDLE:
                row[f"width ({what})"] = said_width(foams, one, what)
        rows.append(row)
    return rows


def shifts(foams: Foams) -> Rows:
    """How far adhesion moves each crossover from that of the spring."""
    rows = []
    for one in ADHESION[1:]:
        row = {"series": label(foams, one)}
        for what in READINGS:
            a, b = read_off(foams, "spring", what), read_off(foams, one, what)
            row[what] = shift(a, b, column(foams, one, READINGS[what][0]), READINGS[what][1], what == "rattlers")
        rows.append(row)
    return rows


def shift(spring: Crossing, other: Crossing, points, level: float, rises: bool) -> str:
    """The shift and whether it is larger than its error; or that the other series does not cross where it was run."""
    x, y, error = points
    if spring.found and other.found:
        by, error = other.value - spring.value, float(np.hypot(spring.error, other.error))
        verdict = "moved" if abs(by) > SIGMAS * error else "not moved beyond the error"
        return f"{'+' if by > 0 else ''}{short(by, error)}: {verdict}"
    if len(x) < 2:
        return MISSING
    dry_side = (level - y if rises else y - level) > SIGMAS * error
    return f"moved beyond {x[-1]:.2f}" if spring.found and x[-1] > spring.value and dry_side.all() else "not known"


# ------------------------------------------------------------------ sizes

def size_table(foams: Foams, series: str, fractions: list[float]) -> Rows:
    rows = []
    for fraction in fractions:
        row = {"liquid fraction": f"{fraction:.2f}"}
        foam = foams.get((series, fraction))
        for name, head in (("width", "sd"), ("skewness", "skewness"), ("below_0.5", "below 0.5"),
                           ("below_0.3", "below 0.3"), ("rattlers", "rattlers"), ("rattlers_gas", "gas in rattlers")):
            row[head] = cell(foams, (series, fraction), name)
        row["peaks"] = said_peaks(foam) if foam else MISSING
        rows.append(row)
    return rows


def said_peaks(foam: Foam) -> str:
    if foam.density is None:
        return "none"
    middle = (EDGES[1:] + EDGES[:-1]) / 2
    stands_out, left, right, _ = peaks(foam.density.mean, foam.density.error)
    if stands_out < PEAK_SIGMAS:
        return f"one, {middle[int(np.argmax(foam.density.mean))]:.2f}"
    return f"two, {middle[left]:.2f} and {middle[right]:.2f}"


# ------------------------------------------------------------------ checks of the set-up

def drift(foam: Foam, index: int, kind: str) -> tuple[float, float]:
    """Change of a number from the first to the last late state of the first run, with its error."""
    late = [state for state in foam.states[0] if is_late(state.N, foam.row["bubbles"])]
    first, last = late[0], late[-1]
    a, b = (getattr(state, kind)[index] for state in (first, last))
    errors = [getattr(state, f"{kind}_error")[index] for state in (first, last)]
    return float(b - a), float(np.hypot(*errors))


def checks(foams: Foams) -> Rows:
    """Of the runs with the most bubbles."""
    foams = {key: foam for key, foam in foams.items() if foam.row["bubbles"] == most_bubbles(foams)}
    scaling = {key: foam for key, foam in foams.items() if foam.scales}
    if not scaling:
        return [{"check": "all", "result": MISSING}]
    all_foams = list(foams.values())
    jammed = [foam.row["imbalance"] for foam in scaling.values() if foam.row["rattlers"] < 0.5]
    loose = [foam.row["imbalance"] for foam in scaling.values() if foam.row["rattlers"] >= 0.5]
    rows = [("gas fraction, largest relative change in a run", f"{max(f.row['gas_change'] for f in all_foams):.1e}"),
            ("bubbles at the end of runs with late states",
             range_of([f.row["last_N"] for f in scaling.values()], ".0f")),
            ("largest diameter over the side of the box, at the end",
             range_of([f.row["across"] for f in scaling.values()])),
            ("net force over contact forces, foams with fewer than half rattlers", range_of(jammed)),
            ("the same, foams with more rattlers", range_of(loose)),
            ("overlaps: liquid fraction with overlaps counted once, less that of the model",
             range_of([f.row["liquid"] - f.fraction for f in scaling.values()], ".4f"))]
    x, width, error = column(foams, "spring", "width")
    if len(x):
        lsw = sizes.theory_moments("lsw", 3)[0]
        reached = abs(width[-1] - lsw) <= SIGMAS * error[-1]
        rows.append((f"width of sizes, *spring* at {x[-1]:.2f}, against {lsw:.3f} of LSW",
                     f"{short(width[-1], error[-1])}: "
                     + ("equal within the error" if reached else "the scaling state of free bubbles is not reached")))
    for title, index, kind in (("width of sizes", 0, "sizes"), ("share of rattlers", 2, "means"),
                               ("share of gas through films", 4, "means")):
        moved = [drift(foam, index, kind) for foam in scaling.values()]
        many = sum(abs(by) > SIGMAS * error for by, error in moved)
        rows.append((f"{title}, change from the first to the last late state",
                     f"beyond two standard errors in {many} of {len(moved)} foams; "
                     f"{range_of([by for by, _ in moved])}"))
    return [{"check": check, "result": result} for check, result in rows]


def range_of(values: list[float], digits: str = ".3f") -> str:
    if not values:
        return MISSING
    low, high = f"{min(values):{digits}}", f"{max(values):{digits}}"
    return low if low == high else f"{low} to {high}"


CHANGES = {"slow": ("spring", "a tenth of K"), "sticky0.05-slow": ("sticky0.05", "a tenth of K"),
           "fine": ("spring", "a tenth of the tolerance"), "narrow": ("spring", "sd 0.2 at the start")}


def changes(foams: Foams) -> Rows:
    """What one more thing that is changed does to late states, at the same liquid fraction and number of bubbles."""
    names = {"1/n_R32": "1/n of R32", "z_wide": "neighbors", "rattlers": "rattlers", "through_films": "through films",
             "width": "sd of sizes"}
    rows = []
    for (other, fraction), foam in foams.items():
        base, what = CHANGES.get(other, ("", ""))
        before = foams.get((base, fraction))
        if not before or not (foam.scales and before.scales) or foam.row["bubbles"] != before.row["bubbles"]:
            continue
        row = {"series": base, "change": what, "bubbles": f"{foam.row['bubbles']:.0f}",
               "liquid fraction": f"{fraction:.2f}"}
        for name, head in names.items():
            by = foam.row[name] - before.row[name]
            error = float(np.hypot(foam.row[f"{name}_error"], before.row[f"{name}_error"]))
            row[head] = f"{'+' if by > 0 else ''}{short(by, error)}" + (" *" if abs(by) > SIGMAS * error > 0 else "")
        rows.append(row)
    return rows


def keep_others(rows: Rows, path: Path) -> Rows:
    """Rows of changes(), and those of runs that are not here from the table that is there."""
    keys = ("series", "change", "bubbles", "liquid fraction")
    here = {tuple(row[key] for key in keys) for row in rows}
    if path.exists():
        with path.open(newline="") as file:
            rows = rows + [row for row in csv.DictReader(file)
                           if row.get("change") and tuple(row[key] for key in keys) not in here]
    heads = dict.fromkeys(head for row in rows for head in row)
    return [{head: row.get(head, "") for head in heads}
            for row in sorted(rows, key=lambda row: tuple(row[key] for key in keys))]


# ------------------------------------------------------------------ conclusions

def verdict(value: float, error: float) -> str:
    if not error < NEAR:
        return "too uncertain to tell 1/2 from 1/3"
    near = [text for number, text in ((1 / 2, "1/2"), (1 / 3, "1/3"), (1 / 4, "1/4"))
            if abs(value - number) <= SIGMAS * error]
    return f"within two standard errors of {' and '.join(near)}" if near else "neither 1/2 nor 1/3"


def at_end(foams: Foams, series: str, wet: bool, name: str = "1/n") -> str:
    x, y, e = column(foams, series, name)
    if not len(x):
        return MISSING
    k = -1 if wet else 0
    return f"{short(y[k], e[k])} at {x[k]:.2f}, {verdict(y[k], e[k])}"


def ends_of(foams: Foams, series: str, name: str) -> str:
    """The driest and the wettest foam."""
    x, y, e = column(foams, series, name)
    return " to ".join(f"{short(y[k], e[k])} at {x[k]:.2f}" for k in sorted({0, len(x) - 1})) if len(x) else MISSING


def below_half(theory: str) -> float:
    """Share of bubbles below half of the mean radius."""
    middle = (np.arange(5000) + 0.5) / 10000
    return float(np.mean(sizes.density_over_mean(theory, middle, 3)) / 2)


def two_peaks(foams: Foams, series: str) -> str:
    found = [(fraction, said_peaks(foam)) for (one, fraction), foam in sorted(foams.items())
             if one == series and foam.scales]
    if not found:
        return MISSING
    two = [f"{fraction:.2f}" for fraction, said in found if said.startswith("two")]
    one = [f"{fraction:.2f}" for fraction, said in found if said.startswith("one")]
    return "; ".join(f"{count} at {', '.join(where)}"
                     for count, where in (("two peaks", two), ("one peak", one)) if where)


def stopped(foams: Foams) -> str:
    found = [foam for (one, _), foam in sorted(foams.items()) if one == "films"]
    if not found:
        return MISSING
    ends = [f"at {foam.fraction:.2f} the run ends with {foam.row['last_N']:.0f} of {foam.row['bubbles']:.0f} bubbles"
            + ("" if foam.scales else ", which exchange no more gas") for foam in found]
    return "; ".join(ends)


def unjamming(foams: Foams, series: list[str]) -> str:
    return "; ".join(f"{one} {shown(read_off(foams, one, 'rattlers'), foams, one)}" for one in series)


def above_packing(foams: Foams, series: str) -> str:
    """Crossovers of a series less random close packing of its sizes, at the liquid fraction of the crossover."""
    x, rcp, error = column(foams, series, "rcp")
    if not len(x):
        return MISSING
    said = []
    for what in READINGS:
        found = read_off(foams, series, what)
        if not found.found:
            said.append(f"{what} {shown(found, foams, series)}")
            continue
        by, e = found.value - float(np.interp(found.value, x, rcp)), float(np.hypot(found.error, error.max()))
        verdict = "equal within the error" if abs(by) <= SIGMAS * e else "above" if by > 0 else "below"
        said.append(f"{what} {'+' if by > 0 else ''}{short(by, e)}, {verdict}")
    return "; ".join(said)


def summary(foams: Foams) -> Rows:
    """Published statements, and ours."""
    rows = [
        ("Isert et al. [I13]_", "exponent 1/2 in dry foams",
         f"spring: 1/n = {at_end(foams, 'spring', False)}; by the Sauter radius "
         f"{at_end(foams, 'spring', False, '1/n_R32')}"),
        ("the same", "exponent 1/3 in wet foams",
         f"spring: 1/n = {at_end(foams, 'spring', True)}; by the Sauter radius "
         f"{at_end(foams, 'spring', True, '1/n_R32')}"),
        ("the same", "the laws change at a liquid fraction of about 0.30 [I13r]_",
         f"spring, middle of the exponent: {shown(read_off(foams, 'spring', 'exponent'), foams, 'spring')}; by the "
         f"Sauter radius: {shown(read_off(foams, 'spring', 'Sauter'), foams, 'spring')}"),
        ("Pasquet et al. [P23]_", "a sharp crossover at :math:`\\varphi^*`",
         f"width of the crossover, spring: {said_width(foams)}; by the Sauter radius: "
         f"{said_width(foams, 'spring', 'Sauter')}"),
        ("the same", ":math:`\\varphi^*` is significantly larger than random close packing, for weak adhesion",
         f"crossovers less random close packing. spring: {above_packing(foams, 'spring')}. "
         f"sticky0.05: {above_packing(foams, 'sticky0.05')}"),
        ("Galvani et al. [G23]_", "an excess of small roaming bubbles below :math:`\\varphi^*`",
         f"spring: {two_peaks(foams, 'spring')}; rattlers {ends_of(foams, 'spring', 'rattlers')}; smaller than half of "
         f"the mean {ends_of(foams, 'spring', 'below_0.5')} (Lemlich {below_half('lemlich'):.3f}, LSW "
         f"{below_half('lsw'):.3f})"),
        ("the same", "a single narrow distribution above :math:`\\varphi^*`",
         f"spring: sd {ends_of(foams, 'spring', 'width')}"),
        ("Morgan & Cox [M26]_", "no adhesion, films only: unjamming at about 0.36",
         f"spring, half rattlers: {unjamming(foams, ['spring'])}"),
        ("the same", "many small bubbles, and no rattlers", f"films: {stopped(foams)}"),
    ]
    return [{"source": a, "published": b, "here": c} for a, b, c in rows]


def said_width(foams: Foams, series: str = "spring", what: str = "exponent") -> str:
    wide, error = width_of(foams, series, what)
    if np.isfinite(wide):
        return short(wide, error)
    return "not known" if any(one == series for one, _ in foams) else MISSING


def findings(foams: Foams) -> str:
    """Bullets for the manual."""
    if not foams:
        return f"* {MISSING}.\n"
    smaller = sorted({foam.row["bubbles"] for foam in foams.values()})[:-1]
    where = {what: shown(read_off(foams, "spring", what), foams, "spring") for what in READINGS}
    halves = ", ".join(f"*{label(foams, one)}* {shown(read_off(foams, one, 'films'), foams, one)}"
                       for one in EXCHANGE if one != "films")
    lines = [
        f"These numbers are of runs that begin with {most_bubbles(foams):.0f} bubbles"
        + "".join(f", or with {n:.0f} where the series has this number" for n in smaller) + ".",
        *(f"**Exponent** of {of}, *spring*. 1/n is {at_end(foams, 'spring', False, name)}. It is "
          f"{at_end(foams, 'spring', True, name)}." for of, name in (("the mean radius", "1/n"),
                                                                    ("the Sauter radius", "1/n_R32"))),
        f"**Crossover,** *spring*. Middle of the exponent's way: {where['exponent']}, width {said_width(foams)}. By "
        f"the Sauter radius: {where['Sauter']}, width {said_width(foams, 'spring', 'Sauter')}. Half of the gas through "
        f"films: {where['films']}. Half of the bubbles rattlers: {where['rattlers']}.",
        *(f"**Adhesion,** *{row['series']}*. Shift of the exponent's middle: {row['exponent']}. By the Sauter radius: "
          f"{row['Sauter']}. Of half rattlers: {row['rattlers']}. Of half of the gas through films: {row['films']}."
          for row in shifts(foams)),
        *(f"**Rattlers,** *{one}*. Their share: {ends_of(foams, one, 'rattlers')}."
          for one in ("spring", "sticky0.05")),
        *(f"**Sizes,** *{one}*. {two_peaks(foams, one).capitalize()}." for one in ("spring", "sticky0.05")),
        f"**Random close packing** of these sizes, *spring*: {ends_of(foams, 'spring', 'rcp')}.",
        f"**Exchange.** Half of the gas through films: {halves}.",
        f"**Films alone.** {stopped(foams).capitalize()}.",
    ]
    return "".join(f"* {line}\n" for line in lines)


def run_table(foams: Foams, series: list[str], fractions: list[float]) -> Rows:
    """What each run took: liquid fractions below each other, series beside each other."""
    rows = []
    for fraction in fractions:
        row = {"liquid fraction": f"{fraction:.2f}"}
        for one in series:
            head = label(foams, one)
            row[head] = MISSING
            if (one, fraction) in foams:
                numbers = foams[one, fraction].row
                row[head] = f"{numbers['minutes']:.0f}" + (f" ({numbers['runs']} runs)" if numbers["runs"] > 1 else "")
        rows.append(row)
    return rows


def as_columns(rows: list[dict]) -> dict[str, list]:
    heads = list(dict.fromkeys(head for row in rows for head in row))
    return {head: [row.get(head, float("nan")) for row in rows] for head in heads}


def write(rows: list[dict], path) -> None:
    table.write(as_columns(rows), path)
