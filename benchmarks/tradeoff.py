#!/usr/bin/env python3
"""Speed against accuracy: what the settings of a run cost, and how far from the truth it ends.

    tradeoff.py --lmp "COMMAND" [--scene 2d,3d] [--bubbles 1e3,1e4] [--full] [--models]
                [--steps] [--lmp-mixed "COMMAND"] [--lmp-single "COMMAND"] [--out DIR]
                [--limit SECONDS]

Each scene starts from one relaxed foam (in.packing, tradeoff/in.relax), which is kept in --cache.
A reference with a tight tolerance comes first, then every method with every tolerance, then single
settings (knobs) one by one. All stop at the same times exactly; there the state is compared with
the reference. Runs from a start displaced by 1e-12, with equal settings, tell how much of a
difference is chaos.

Results: tradeoff.csv, a line for each run and time, written as runs finish: the same command again
goes on where it stopped. From it tables (tradeoff.txt) and a diagram for each scene (SCENE-N.png).
The manual, doc/tradeoff.rst, explains them.
"""

import argparse
import csv
import hashlib
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import machine
from machine import HERE, Failed
from run import choice_list, number_list, say
from scenes import QUICK, SCENES
from states import errors, loop_seconds, reached, read_state

CHAOS = 1.0e-12         # displacement of bubbles at the start of runs that show chaos
SEEDS = (1, 2, 3)       # so many of them; of large foams, which are their own average, the first
LARGE, VERY_LARGE = 20_000, 200_000


# ---- settings ------------------------------------------------------------------------------------

@dataclass
class Run:
    """Settings to be measured."""
    curve: str                  # the method, or knob
    value: str                  # its tolerance, or the knob's value
    step: str                   # fix style and arguments
    variables: dict = field(default_factory=dict)
    against: str = "reference"  # the run that it is compared with, by its name
    precision: str = "double"

    @property
    def name(self):
        return f"{self.curve} {self.value}"

    @property
    def known_as(self):     # where others are compared with it
        return self.curve if self.curve == "reference" else self.name


def reference(scene, bubbles):
    """The tightest settings that can be paid. The root mean square needs fewer steps for the same
    error at the end: doc/tradeoff.rst."""
    expensive = bubbles > LARGE or scene in ("slow", "drag")
    tol = "1e-9" if bubbles <= 2000 and scene != "drag" else "1e-7" if expensive else "1e-8"
    if bubbles > VERY_LARGE:
        tol = "1e-5"
    norm = "max" if tol == "1e-9" else "rms"
    return Run("reference", tol, f"foam/abm {tol} norm {norm}{without_drift(scene)}", against="")


def without_drift(scene):
    """What an integrator needs under neighbor drag, where a foam as a whole drifts."""
    return " drift remove" if SCENES[scene].drag == "neighbor" else ""


METHODS = {     # curve: step without tolerance
    "source": ("foam/abm", "scheme source"),
    "abm max": ("foam/abm", "norm max"),
    "abm rms": ("foam/abm", "norm rms"),
    "rkc max": ("foam/rkc", "norm max"),
    "rkc rms": ("foam/rkc", "norm rms"),
}
TOLERANCES = {
    "source": ("1e-3", "1e-4", "1e-5"),
    "abm max": ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6"),
    "abm rms": ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6"),
    "rkc max": ("1e-1", "1e-2", "1e-3", "1e-4", "1e-5"),
    "rkc rms": ("1e-2", "1e-3", "3e-4", "1e-4", "1e-5", "1e-6"),
}


PRECISE = ("foam/abm 1e-5 norm rms",     # of mixed and single precision
           *(f"foam/rkc {tol} norm rms" for tol in ("1e-3", "1e-4", "1e-5")))


def methods(known, scene):
    more_words = without_drift(scene)
    return [Run(curve, tol, f"{style} {tol} {more}{more_words}")
            for curve, (style, more) in METHODS.items() if style in known
            for tol in TOLERANCES[curve]
            # source cannot take the drift off; others follow velocities that lag, at a price
            if not more_words or (curve != "source" and float(tol) >= 1.0e-4)]


def chaos(scene, bubbles):
    step = "foam/abm 1e-7 norm max" if bubbles <= 2000 else "foam/abm 1e-6 norm rms"
    if scene == "drag":
        step = "foam/abm 1e-5 norm rms" + without_drift(scene)
    return [Run("chaos", "0", step, against=""),
            *(Run("chaos", str(seed), step, {"nudge": CHAOS, "seed": seed}, against="chaos 0")
              for seed in SEEDS[:1 if bubbles > LARGE else None])]


def knobs(known, scene):
    """One setting changed at a time."""
    runs = []
    for style, tol in (("foam/abm", "1e-5"), ("foam/rkc", "1e-3")):
        if style not in known:
            continue
        base, short = f"{style} {tol} norm rms" + without_drift(scene), style.removeprefix("foam/")
        runs += [Run(f"{short} dtmax", h, f"{base} dtmax {h}") for h in ("0.1", "0.3", "1", "10")]
        runs += [Run(f"{short} skin", s, base, {"skin": s})
                 for s in ("0.1", "0.2", "0.3", "0.5", "0.8")]
        runs += [Run(f"{short} safety", s, f"{base} safety {s}") for s in ("0.7", "0.8", "0.95")]
        runs += [Run(f"{short} growth", g, f"{base} growth {g}") for g in ("1.2", "1.5", "3", "5")]
        if SCENES[scene].K:
            runs.append(Run(f"{short} variable", "radius", f"{base} variable radius"))
        if short == "rkc":
            runs += [Run("rkc stages", s, f"{base} stages {s}") for s in ("3", "5", "8", "12", "20")]
            loose = f"{style} 1e-2 norm rms" + without_drift(scene)    # its steps may leave the list
            runs += [Run("rkc loose skin", s, loose, {"skin": s}) for s in ("0.5", "0.8")]
    return runs


# ---- runs ---------------------------------------------------------------------------------------

COLUMNS = ["scene", "bubbles", "curve", "value", "step", "settings", "precision", "clock",
           "evaluations", "rejected", "steps", "seconds", "cpu seconds", "N", "R", "energy",
           "against", "error N", "error R", "error energy", "error sizes", "error radii",
           "error x", "recipe", "styles", "lammps", "machine", "date"]


def digest(paths):
    """Short name of what these scripts or sources do: comments do not count."""
    lines = [re.sub(r"(^|\s+)" + ("//" if path.suffix in (".h", ".cpp") else "#") + ".*", "", line)
             for path in paths for line in path.read_text().splitlines()]
    return hashlib.sha256("\n".join(filter(str.strip, lines)).encode()).hexdigest()[:8]


class Campaign:
    def __init__(self, args):
        self.args = args
        self.commands = {"double": shlex.split(args.lmp)}
        for precision in ("mixed", "single"):
            if getattr(args, f"lmp_{precision}"):
                self.commands[precision] = shlex.split(getattr(args, f"lmp_{precision}"))
        self.scripts = digest([HERE / "in.packing", HERE / "tradeoff" / "in.relax",
                               HERE / "tradeoff" / "in.run"])
        self.styles = digest(sorted((HERE.parent / "src").glob("*FOAM/*.[hc]*")))
        self.version, self.known = self.look(self.commands["double"])
        self.table = args.out / "tradeoff.csv"
        self.rows = read_table(self.table)
        self.references = {}
        self.failed = []

    def look(self, command):
        """Version of a LAMMPS, and which of our integrators it knows."""
        script = self.args.out / "in.known"
        script.write_text("info styles fix\n")
        text = machine.lammps(command, script.absolute(), self.args.out, {})[0]
        script.unlink()
        known = {"foam/abm", "foam/rkc"} & set(text.split())
        if "foam/abm" not in known:
            raise SystemExit(f"{shlex.join(command)}: a LAMMPS without fix foam/abm")
        return re.search(r"LAMMPS \((.*)\)", text)[1], known

    def recipe(self, scene):
        """Short name of all that the result of a run hangs on, but for the code and its settings."""
        about = SCENES[scene]
        content = f"{self.scripts} {about.phi} {about.variables()}"
        return hashlib.sha256(content.encode()).hexdigest()[:8]

    # -- the start

    def start(self, name, bubbles):
        scene = SCENES[name]
        path = (self.args.cache / f"relaxed-{scene.dim}d-{scene.phi}-{bubbles}-{self.scripts}.data"
                ).absolute()
        if path.exists():
            return path
        say(f"a relaxed foam of {bubbles} bubbles, {scene.dim}D, gas fraction {scene.phi}")
        packing, unfinished = (path.with_suffix(f".{os.getpid()}-{part}") for part in "ab")
        self.lammps("double", "in.packing", {"dim": scene.dim, "N": bubbles, "phi": scene.phi,
                                             "coarsen": 0, "file": packing})
        self.lammps("double", "tradeoff/in.relax", {"dim": scene.dim, "start": packing,
                                                    "file": unfinished})
        packing.unlink()
        unfinished.rename(path)
        return path

    def lammps(self, precision, script, variables):
        words = self.commands[precision]
        if precision != "double":
            words = [*words, "-k", "on", "t", "1", "-sf", "kk"]
        limit = max(self.args.deadline - time.time(), 20) if self.args.deadline else None
        return machine.lammps(words, script, self.args.out, variables, {"OMP_NUM_THREADS": "1"},
                              limit)[0]

    # -- a run

    def kept(self, scene, bubbles, name):
        name = name.replace(" ", "-")
        return self.args.cache / f"{scene}-{bubbles}-{name}-{self.recipe(scene)}.npz"

    def have(self, scene, bubbles, run):
        return [row for row in self.rows if row["scene"] == scene and
                row["bubbles"] == str(bubbles) and row["curve"] == run.curve and
                row["value"] == run.value and row["precision"] == run.precision and
                row["step"] == run.step and row["recipe"] == self.recipe(scene) and
                (row["styles"] == self.styles or not named(run, self.args.again))]

    def run_scene(self, name, bubbles, step, variables, precision="double"):
        """Output of a run, and what it says at each time."""
        variables = {**SCENES[name].variables(), "file": self.start(name, bubbles), "step": step,
                     **variables}
        # a look at the time in each step lets removed bubbles be taken out in each, by a list build
        for look in (25, 1) if bubbles > LARGE else (1,):
            try:
                text = self.lammps(precision, "tradeoff/in.run", {**variables, "look": look})
                return text, reached(text)
            except Failed:
                if look == 1:
                    raise

    def take_states(self, count):
        """States at each time of the last run, whose files are not needed after."""
        paths = [self.args.out / f"state.{k + 1}" for k in range(count)]
        states = [read_state(path) for path in paths]
        for path in paths:
            path.unlink()
        return states

    def measure(self, name, bubbles, run):
        scene = SCENES[name]
        text, found = self.run_scene(name, bubbles, run.step, run.variables, run.precision)
        states = self.take_states(len(scene.until))
        rows, seconds, cpu, begin = [], 0.0, 0.0, 0
        for clock, one in zip(scene.until, found, strict=True):
            more = loop_seconds(text[begin:one.end()])
            seconds, cpu, begin = seconds + more[0], cpu + more[1], one.end()
            rows.append({
                "scene": name, "bubbles": bubbles, "curve": run.curve, "value": run.value,
                "step": run.step, "precision": run.precision, "clock": clock,
                "settings": " ".join(f"{k}={v}" for k, v in run.variables.items()),
                "seconds": f"{seconds:.4g}", "cpu seconds": f"{cpu:.4g}",
                "against": run.against, "recipe": self.recipe(name), "styles": self.styles,
                "lammps": self.version, "machine": machine.cpu_name(),
                "date": time.strftime("%Y-%m-%d"),
                **{k: v for k, v in one.groupdict().items() if k in COLUMNS}})
        if run.against:
            others = self.comparison(name, bubbles, run.against)
            for row, state, (other, other_row) in zip(rows, states, others, strict=True):
                row.update({k: f"{v:.4g}" for k, v in
                            errors(state, row, other, other_row, scene.dim).items()})
        else:
            np.savez(self.kept(name, bubbles, run.known_as), *states)
        return rows

    def comparison(self, scene, bubbles, name):
        """States and rows of a run that others are compared with."""
        key = scene, bubbles, name
        if key not in self.references:
            if not self.kept(*key).exists():
                raise Failed(f"there is no {name} to compare with")
            with np.load(self.kept(*key)) as states:
                states = [states[k] for k in states.files]
            curve, value = (name.split() + [None])[:2]
            rows = [row for row in self.rows if row["scene"] == scene and
                    row["bubbles"] == str(bubbles) and row["curve"] == curve and
                    value in (None, row["value"]) and row["recipe"] == self.recipe(scene)]
            self.references[key] = list(zip(states, rows[-len(states):], strict=True))
        return self.references[key]

    # -- all of them

    def jobs(self):
        for bubbles in self.args.bubbles:
            for name in self.args.scene:
                runs = [reference(name, bubbles), *methods(self.known, name), *chaos(name, bubbles)]
                if self.args.knobs and bubbles <= self.args.knobs:
                    runs += knobs(self.known, name)
                    runs += [Run("precision", precision, step, precision=precision)
                             for precision in self.commands if precision != "double"
                             for step in PRECISE]
                for run in runs:
                    if self.wanted(run):
                        yield name, bubbles, run

    def wanted(self, run):
        return run.curve == "reference" or not self.args.curve or named(run, self.args.curve)

    def missing(self, scene, bubbles, run):
        # of a run that others are compared with the states are needed, too
        return not self.have(scene, bubbles, run) or \
            not (run.against or self.kept(scene, bubbles, run.known_as).exists())

    def run(self):
        todo = [job for job in self.jobs() if self.missing(*job)]
        say(f"{len(todo)} runs to do; results so far: {self.table}")
        weights = [weight(*job) for job in todo]
        begin, done = time.time(), 0.0
        for number, (job, heavy) in enumerate(zip(todo, weights), 1):
            name, bubbles, run = job
            if self.args.deadline and time.time() > self.args.deadline:
                say("out of time: the same command again goes on from here")
                break
            togo = (time.time() - begin) / done * (sum(weights) - done) if done else None
            say(f"{number}/{len(todo)} {name} {bubbles} {run.name}" +
                (f", {clock_text(togo)} to go" if togo else ""))
            try:
                rows = self.measure(*job)
            except Failed as error:
                say(f"  failed: {error}")
                self.failed.append(f"{name} {bubbles} {run.name}: {error}")
            else:
                append(self.table, rows)
                self.rows += [{k: str(v) for k, v in row.items()} for row in rows]
                self.references.pop((name, bubbles, run.known_as), None)
            done += heavy


def named(run, curves):
    return any(run.name.startswith(curve) for curve in curves)


def weight(scene, bubbles, run):
    """What a run may cost, in some unit."""
    tol = float(re.search(r"foam/\S+ (\S+)", run.step)[1])
    cost = bubbles * max(1.0, (1.0e-4 / tol)**(1.0 / 3.0)) / SCENES[scene].clock
    return cost * (2.5 if SCENES[scene].dim == 3 else 1.0) * (0.3 if "rkc" in run.step else 1.0)


def clock_text(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"


def read_table(path):
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def append(path, rows):
    new = not path.exists()
    with path.open("a", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n", restval="")
        if new:
            table.writeheader()
        table.writerows(rows)


# ---- the command --------------------------------------------------------------------------------

def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0], epilog=__doc__.split(
        "\n\n", 2)[2], formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help="LAMMPS with the foam styles (%(default)s)")
    for precision in ("mixed", "single"):
        parser.add_argument(f"--lmp-{precision}", metavar="COMMAND",
                            help=f"one with KOKKOS_PREC={precision}")
    parser.add_argument("--full", action="store_true",
                        help="all scenes, 10^3 to 10^6 bubbles: many hours")
    parser.add_argument("--bubbles", type=number_list, metavar="N,...",
                        help="numbers of bubbles (1e3)")
    parser.add_argument("--scene", type=choice_list(*SCENES), metavar="S,...",
                        help=f"{','.join(SCENES)} ({','.join(QUICK)})")
    parser.add_argument("--curve", type=lambda text: text.split(","), metavar="C,...",
                        help="only runs whose names begin like this, say abm,'rkc rms 1e-3'")
    parser.add_argument("--again", type=lambda text: text.split(","), metavar="C,...", default=[],
                        help="measure these again, if the sources of the styles have changed since")
    parser.add_argument("--knobs", type=float, metavar="N", default=0,
                        help="also single settings, up to so many bubbles (--full: 10^4)")
    parser.add_argument("--models", action="store_true",
                        help="instead: what each term of the model costs, and does")
    parser.add_argument("--steps", action="store_true",
                        help="instead: single steps, also by other integrators: one_step.py")
    parser.add_argument("--repeat", type=int, default=3,
                        help="for --models: the fastest of so many (%(default)s)")
    parser.add_argument("--limit", type=float, metavar="SECONDS",
                        help="start nothing new after this time")
    parser.add_argument("--draw", action="store_true", help="run nothing, draw what there is")
    parser.add_argument("--out", type=Path, default=Path("foam-tradeoff"), metavar="DIR",
                        help="where results go (%(default)s)")
    parser.add_argument("--cache", type=Path, metavar="DIR",
                        help="where relaxed foams and references are kept (--out)")
    args = parser.parse_args()
    args.scene = args.scene or (list(SCENES) if args.full else QUICK)
    args.bubbles = args.bubbles or ([10**n for n in (3, 4, 5, 6)] if args.full else [1000])
    args.knobs = args.knobs or (10_000 if args.full else 0)
    args.cache = args.cache or args.out
    args.deadline = time.time() + args.limit if args.limit else None
    for name in ("lmp", "lmp_mixed", "lmp_single"):     # runs have a working directory of their own
        command = getattr(args, name)
        if command:
            words = shlex.split(command)
            words = [str(Path(w).absolute()) if "/" in w and Path(w).exists() else w for w in words]
            setattr(args, name, shlex.join(words))
    return args


def show(text, path):
    path.write_text(text + "\n")
    print(text)


def measure_models(args):
    import models
    rows = models.Models(Campaign(args)).run()
    models.write(rows, args.out / "models.csv")
    show(models.table(rows), args.out / "models.txt")


def single_steps(args):
    """By LAMMPS' Python module, from this Python's environment, where MPI is, too."""
    campaign = Campaign(args)
    places = [str(Path(sys.prefix) / "lib"), *filter(None, [os.environ.get("LD_LIBRARY_PATH")])]
    environment = {**os.environ, "LD_LIBRARY_PATH": ":".join(places)}
    for name in args.scene:
        scene = SCENES[name]
        if not scene.K:
            raise SystemExit(f"--steps: the scene {name} does not coarsen")
        for bubbles in args.bubbles:
            result = args.out / f"steps-{name}-{bubbles}"
            done = subprocess.run(
                [sys.executable, HERE / "one_step.py", campaign.start(name, bubbles),
                 "--dim", str(scene.dim), "-K", str(scene.K), "--kappa", scene.gas,
                 "--out", result.with_suffix(".png")],
                env=environment, stdout=subprocess.PIPE, text=True, check=True)
            show(done.stdout.rstrip(), result.with_suffix(".txt"))


def main():
    args = arguments()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))     # then the LAMMPS in work is ended, too
    for directory in (args.out, args.cache):
        directory.mkdir(parents=True, exist_ok=True)
    if args.models:
        return measure_models(args)
    if args.steps:
        return single_steps(args)
    if not args.draw:
        campaign = Campaign(args)
        campaign.run()
        for line in campaign.failed:
            print(f"failed: {line}")
    rows = read_table(args.out / "tradeoff.csv")
    if not rows:
        raise SystemExit("nothing was measured")
    import frontier
    (args.out / "recommended.txt").write_text(frontier.recommended(rows) + "\n")
    show(frontier.tables(rows), args.out / "tradeoff.txt")
    try:
        frontier.draw(rows if args.draw else
                      [row for row in rows if row["scene"] in args.scene and
                       int(row["bubbles"]) in args.bubbles], args.out)
    except ImportError:
        say("no matplotlib, no diagrams: --draw makes them later")
    say(f"results: {args.out}/tradeoff.csv, tradeoff.txt")


if __name__ == "__main__":
    main()
