"""What each term of the model costs, and what leaving it out does to the answer.

`tradeoff.py --models`: the scenes with terms left out or added, one at a time, all with the same
integrator.  Times are the fastest of some repeats, in turn, so that other work on the machine meets
all alike.
"""

import csv
import time
from dataclasses import dataclass, field

from machine import Failed
from run import say
from scenes import SCENES
from states import errors, loop_seconds

STEP = "foam/abm 1e-4 norm rms"


@dataclass
class Model:
    """A scene with other terms than usual."""
    name: str
    variables: dict = field(default_factory=dict)
    more: str = ""              # arguments of the integrator
    scenes: tuple = ("2d", "3d", "bubbly")


MODELS = [
    Model("films and liquid"),
    Model("films and liquid by the law lsw", {"gas": "{gas} liquid lsw"}),
    Model("films alone", {"gas": "0.0"}),
    Model("films alone, liquid with kappa = 1e-12", {"gas": "1.0e-12"}),
    Model("liquid alone", {"gas": "{gas} film no"}),
    Model("liquid alone, by the law lsw", {"gas": "{gas} liquid lsw film no"}),
    Model("fixed sizes", {"K": 0}),
    Model("fixed sizes, fix foam/coarsen with K = 0", {"K": 0, "idle": "yes"}),
    Model("neighbor drag", {"drag": "neighbor"}, "drift remove"),
    Model("harmonic walls along x", {"wall": 1.0}),
    Model("compute foam/bubble, all, each 10 steps", {"output": "bubbles"}),
]
COLUMNS = ["scene", "bubbles", "model", "evaluations", "cpu seconds", "ns", "N", "R", "energy",
           "difference N", "difference R", "difference energy", "difference sizes", "recipe",
           "styles", "lammps", "machine", "date"]


class Models:
    """Measures on the starts, and with the LAMMPS, of a Campaign of tradeoff.py."""

    def __init__(self, campaign):
        self.campaign, self.args = campaign, campaign.args

    def measure(self, scene, bubbles, model):
        """Row and last state of a run."""
        about = SCENES[scene]
        chosen = {key: value.format(gas=about.gas) if isinstance(value, str) else value
                  for key, value in model.variables.items()}
        text, (found,) = self.campaign.run_scene(
            scene, bubbles, f"{STEP} {model.more}".strip(),
            {"until": f"{about.until[-1] / about.clock:.10g}", **chosen})
        row = {"scene": scene, "bubbles": bubbles, "model": model.name,
               "cpu seconds": loop_seconds(text)[1], "recipe": self.campaign.recipe(scene),
               "styles": self.campaign.styles, "lammps": self.campaign.version,
               "date": time.strftime("%Y-%m-%d"),
               **{k: found[k] for k in ("evaluations", "N", "R", "energy")}}
        row["ns"] = 1.0e9 * row["cpu seconds"] / (float(row["evaluations"]) * bubbles)
        return row, self.campaign.take_states(1)[0]

    def scene(self, scene, bubbles):
        """Rows of all models of a scene that this LAMMPS can do."""
        rows, states, impossible = {}, {}, set()
        models = [model for model in MODELS if scene in model.scenes]
        for repeat in range(self.args.repeat):
            for model in models:
                if model.name in impossible:
                    continue
                say(f"{scene} {bubbles} {model.name}" + (f", again ({repeat})" if repeat else ""))
                try:
                    row, states[model.name] = self.measure(scene, bubbles, model)
                except Failed as error:
                    say(f"  failed: {error}")
                    impossible.add(model.name)
                    continue
                if row["cpu seconds"] < rows.get(model.name, row)["cpu seconds"] or \
                        model.name not in rows:
                    rows[model.name] = row
        usual = models[0].name
        for name, row in rows.items():
            if name == usual:
                continue
            found = errors(states[name], row, states[usual], rows[usual], SCENES[scene].dim)
            row.update({f"difference {what}": f"{found[f'error {what}']:.3g}"
                        for what in ("N", "R", "energy", "sizes")})
        return list(rows.values())

    def run(self):
        rows = []
        for bubbles in self.args.bubbles:
            for scene in self.args.scene:
                if any(scene in model.scenes for model in MODELS):
                    rows += self.scene(scene, bubbles)
        return rows


def write(rows, path):
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n", restval="")
        table.writeheader()
        table.writerows({**row, "ns": f"{row['ns']:.4g}", "cpu seconds": f"{row['cpu seconds']:.4g}"}
                        for row in rows)


def table(rows):
    lines = [f"fix {STEP}; ns per bubble and evaluation; differences from the first line"]
    for scene, bubbles in dict.fromkeys((row["scene"], row["bubbles"]) for row in rows):
        lines += ["", f"{SCENES[scene].title}: {bubbles} bubbles, tau 0 to {SCENES[scene].until[-1]}",
                  f"{'terms':42s}{'evaluations':>12s}{'seconds':>9s}{'ns':>7s}{'N':>7s}{'<R>':>8s}"
                  f"{'energy':>10s}   {'N':>8s}{'<R>':>8s}{'energy':>8s}{'sizes':>8s}"]
        for row in rows:
            if (row["scene"], row["bubbles"]) != (scene, bubbles):
                continue
            line = (f"{row['model']:42s}{float(row['evaluations']):12.0f}"
                    f"{row['cpu seconds']:9.3g}{row['ns']:7.1f}{row['N']:>7s}"
                    f"{float(row['R']):8.4f}{float(row['energy']):10.4g}")
            if "difference N" in row:
                line += "   " + "".join(f"{float(row[f'difference {what}']):8.1e}"
                                        for what in ("N", "R", "energy", "sizes"))
            lines.append(line)
    return "\n".join(lines)
