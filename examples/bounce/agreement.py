#!/usr/bin/env python3
"""How near the bounces of run.py are to the solution of reference.py.

    python3 agreement.py DIR            some minutes; writes agreement.csv in DIR

A row for each complete run in DIR/bounce and DIR/variant: the largest differences over the whole run, of the distance
from the wall and of the place along it (over R) and of both speeds (over the fastest); and the rebound of both, as
plot.py defines it, at the same times.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import sys
from typing import Any

import numpy as np

from lammps_foam.analysis import table
from lammps_foam.analysis.read import Unusable

import plot
import reference

RTOL = 1e-9    # the reference is then good to 1e-7: far less than what is looked for


def row_of(path: Path) -> dict[str, Any]:
    b = reference.read_settings(path / "settings.json")
    s = plot.read_series(path / "series.csv")
    y = reference.solve(b, rtol=RTOL)(s["time"])
    height, slide, un, ut = y[0] / b.R, y[1] / b.R, y[2], y[3]
    fastest = float(np.hypot(un, ut).max())
    first = int(np.argmax(s["closed"] > 0))
    ours, theirs = (plot.turns(h, first)[1] - float(h[-1]) for h in (s["height"], height))
    return {"run": f"{path.parent.name}/{path.name}", "height": np.abs(s["height"] - height).max(),
            "slide": np.abs(s["slide"] - slide).max(), "un": np.abs(s["un"] - un).max() / fastest,
            "ut": np.abs(s["ut"] - ut).max() / fastest, "rebound": ours, "rebound_reference": theirs}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    directory = parser.parse_args().directory
    paths = plot.complete(directory, "bounce") + plot.complete(directory, "variant")
    if not paths:
        raise Unusable(f"{directory} has no complete run of run.py --only bounce")
    rows = []
    for path in paths:
        rows.append(row_of(path))
        print(rows[-1]["run"], f"{rows[-1]['height']:.2g}", flush=True)
    columns = plot.columns_of(rows)
    table.show(columns, most=100)
    table.write(columns, directory / "agreement.csv")


if __name__ == "__main__":
    try:
        main()
    except Unusable as wrong:
        sys.exit(str(wrong))
