"""Does the liquid separate with fewer bubbles, too? The numbers of draw_separation.py for runs of 10^5 and 10^4."""
from __future__ import annotations

import numpy as np

from common import Place, Result, with_error
from draw_separation import survey

LEFT = (1.0, 3.0, 7.0, 20.0)    # so many times fewer bubbles than at the start are left in the lines of the table


def draw(place: Place, names: list[str]) -> list[Result]:
    """Lines of states in LEFT, of the one with the most gaps, and of the last."""
    rows = []
    for name in names:
        kept = [row for row in survey(place, name).rows if np.isfinite(row["clustering"])]
        if not kept:
            continue
        first = kept[0]["N"]
        chosen = {id(min(kept, key=lambda row: abs(np.log(row["N"] * times / first)))) for times in LEFT}
        chosen |= {id(max(kept, key=lambda row: row["gaps"])), id(kept[-1])}
        rows += [{"bubbles at the start": f"{first:.0f}", ":math:`\\tau`": f"{row['tau']:.0f}",
                  "bubbles": f"{row['N']:.0f}", "spread": with_error(row["spread"], row["spread_error"]),
                  "clustering": with_error(row["clustering"], row["clustering_error"]),
                  "gaps [%]": f"{100 * row['gaps']:.2f}", "outside gaps": f"{row['outside']:.3f}"}
                 for row in kept if id(row) in chosen]
    if rows:
        place.merge(rows, "fewer-table", ["100000", "10000"])
    return []
