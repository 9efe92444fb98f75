"""What the thesis leaves open: growth at other kappa, with other sizes, and with an imposed flow."""
from __future__ import annotations

import numpy as np

from common import Place, Result, late, tables, with_error
from lammps_foam.analysis import figure, growth, runs

COLORS = [*(f"C{n}" for n in range(7)), "0.5"]
WORDS = {"kappa0": "κ = 0", "kappa0.01": "κ = 0.01", "kappa1": "κ = 1", "equal": "like sizes, sd 0.05",
         "lognormal": "lognormal sizes, sd 0.5", "bidisperse": "bidisperse sizes, 1:2", "flow": "imposed flow"}


def draw(place: Place, names: list[str]) -> list[Result]:
    """A line for each run, and one figure of all."""
    fig, (left, right) = figure.panels(1, 2)
    rows = []
    for number, name in enumerate(names):
        (series,) = tables(place, [name])
        start, end = late([series])
        fit = growth.fit([series], start, end)
        n = fit.origin[0]
        label = label_of(name)
        rows.append({"run": label, "tau_from": start, "tau_to": end, "beta": fit.beta, "beta_error": fit.beta_error,
                     "1/n": 1 / n, "1/n_error": fit.origin_error[0] / n**2,
                     "tau_tenth": runs.tau_of_N(series, series["N"][0] / 10)})
        later, color = series["tau"] > 0.1, COLORS[number % len(COLORS)]
        left.plot(series["tau"][later], series["R"][later], color=color, label=label.replace("κ", r"$\kappa$"))
        windows = growth.windows_of([series], 0.5, max(start / 10, 0.1), end, False)
        local = growth.local_exponents([series], windows)
        right.errorbar(local["tau"], local["beta"], local["error"], lw=0.8, color=color, fmt=".-")
    place.write(rows, "questions")
    place.write([{"run": row["run"], "range of :math:`\\tau`": f"{row['tau_from']:.0f} to {row['tau_to']:.0f}",
                  "slope": with_error(row["beta"], row["beta_error"]),
                  "1/n": with_error(row["1/n"], row["1/n_error"]), "against the first": against(row, rows[0])}
                 for row in rows], "questions-table")
    finish(place, fig, left, right)
    said = "; ".join(f"{row['run']}: {with_error(row['beta'], row['beta_error'])}" for row in rows)
    return [Result("open questions", "asked, not answered", f"slopes: {said}", names)]


def against(row, first) -> str:
    """A sentence: how fast, and whether the slopes differ by more than two standard errors."""
    if row is first:
        return ""
    difference, error = row["beta"] - first["beta"], float(np.hypot(row["beta_error"], first["beta_error"]))
    word = "the same slope within two errors" if abs(difference) < 2 * error else (
        "a larger slope" if difference > 0 else "a smaller slope")
    speed = first["tau_tenth"] / row["tau_tenth"]
    return (f"Comes to a tenth of its bubbles {speed:.2f} times as fast, and has {word} "
            f"(difference {with_error(difference, error)}).")


def label_of(name: str) -> str:
    if name.startswith("phi"):
        return "κ = 0.1, normal sizes, sd 0.21"
    word = name.removeprefix("question-").rsplit("-", 1)[0]
    return WORDS.get(word, word)


def finish(place: Place, fig, left, right) -> None:
    left.set(xscale="log", yscale="log", xlabel=figure.TAU, ylabel=figure.R)
    figure.plain_ticks(left, "y")
    left.legend()
    right.set(xscale="log", xlabel=figure.TAU, ylabel="exponent in half a decade", ylim=(0, 0.8))
    figure.plain_ticks(right, "x")
    for value in (1 / 3, 1 / 2):
        right.axhline(value, color="0.7", lw=0.8, zorder=0)
    place.save(fig, "thesis-questions")
