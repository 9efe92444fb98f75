#!/usr/bin/env python3
"""Speed of the foam styles: time per bubble and evaluation, what it is spent on, and how far it is
from what memory allows.

    run.py --lmp "COMMAND" [--quick | --full] [--scene 2d,3d] [--bubbles 1e4,1e5]
           [--backends base,serial,omp,cuda] [--lmp-cuda "COMMAND"] [--out DIR]

Scenes: 2d, gas fraction 0.90, and 3d, 0.75.  A packing of 10^4 bubbles is relaxed and coarsened a
little (in.packing, kept in --cache); larger ones are copies of it side by side, each bubble moved
by a random 0.002 of a radius, as in.speed does.  Back ends, where LAMMPS has them:
  base     the styles without KOKKOS, one core
  serial   kk styles, a LAMMPS that has Kokkos' Serial back end alone (--lmp-serial)
  omp      kk styles, one and more OpenMP threads (--threads)
  cuda     kk styles on a GPU (--lmp-cuda)
On each of them in turn, the fastest of --repeat,
  foam     what a coarsening run does: springs, gas through films and liquid, adaptive integration
  relax    springs and integration alone
  hooke    for scale: LAMMPS' own gran/hooke on the same packing, nothing moves. It has no kk
           version, so gran/hooke/history without tangential forces stands beside it

Results: a table on the screen and in bench.txt, everything in bench.json, a plot in bench.png
(if there is matplotlib).  The manual, doc/performance.rst, explains the columns.
"""

import argparse
import hashlib
import json
import os
import platform
import re
import shlex
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import counts
import machine
import traffic
from machine import HERE, Failed
from tables import NAMES, table

SCENES = {"2d": (2, 0.90), "3d": (3, 0.75)}
PACKING = 10_000        # bubbles of the packing that larger ones repeat
SECTIONS = ("Pair", "Neigh", "Comm", "Output", "Modify", "Other")


@dataclass
class Configuration:
    """One way to run LAMMPS."""
    name: str
    command: list
    kokkos: list = field(default_factory=list)
    environment: dict = field(default_factory=dict)
    threads: int = 1
    precision: str = "double"
    package: list = field(default_factory=list)

    @property
    def device(self):
        return self.name == "cuda"

    def words(self, what):
        if not self.kokkos:
            return self.command
        # gran/hooke/history/kk works with these alone
        package = ["neigh", "half", "newton", "off"] if what == "history" else self.package
        return [*self.command, *self.kokkos, "-sf", "kk",
                *(["-pk", "kokkos", *package] if package else [])]


def configurations(args):
    """Those that are asked for and possible; says which are not."""
    wanted = args.backends
    found, absent = [], []
    back_ends, precision = machine.capabilities(args.lmp)
    base = shlex.split(args.lmp)
    environment = {"OMP_PROC_BIND": "spread", "OMP_PLACES": "threads"}
    if "base" in wanted:
        found.append(Configuration("base", base, environment={"OMP_NUM_THREADS": "1"}))
    if "serial" in wanted:
        command = args.lmp_serial or (args.lmp if back_ends == {"Serial"} else None)
        if command:
            found.append(Configuration("serial", shlex.split(command), ["-k", "on", "t", "1"],
                                       {"OMP_NUM_THREADS": "1"}, package=args.package,
                                       precision=machine.capabilities(command)[1]))
        else:
            absent.append("serial: no LAMMPS with Kokkos' Serial back end alone (--lmp-serial)")
    if "omp" in wanted:
        if "OpenMP" in back_ends:
            for threads in args.threads:
                found.append(Configuration(
                    f"omp{threads}", base, ["-k", "on", "t", str(threads)],
                    {**environment, "OMP_NUM_THREADS": str(threads)}, threads, precision,
                    args.package))
        else:
            absent.append(f"omp: {args.lmp} has no KOKKOS package with OpenMP")
    if "cuda" in wanted:
        if args.lmp_cuda and machine.nvidia_smi("name"):
            found.append(Configuration("cuda", shlex.split(args.lmp_cuda), ["-k", "on", "g", "1"],
                                       {"OMP_NUM_THREADS": "1"}, package=args.package,
                                       precision=machine.capabilities(args.lmp_cuda)[1]))
        else:
            absent.append("cuda: " + ("no GPU here" if args.lmp_cuda else "no --lmp-cuda COMMAND"))
    return found, absent


# ---- packings -----------------------------------------------------------------------------------

def factors(copies, dim):
    """Numbers of copies along each axis, as equal as can be, whose product is `copies`."""
    best = None
    for a in range(1, copies + 1):
        for b in range(1, copies // a + 1) if dim == 3 else (1,):
            if copies % (a * b) == 0:
                shape = sorted((a, b, copies // (a * b)), reverse=True)
                if dim == 2 and shape[2] != 1:
                    continue
                key = shape[0] / shape[dim - 1]
                if best is None or key < best[0]:
                    best = key, shape
    return best[1]


def packing(args, scene, bubbles):
    """Variables of in.speed for a packing of about so many bubbles, prepared if need be."""
    dim, phi = SCENES[scene]
    single = min(bubbles, PACKING)
    recipe = hashlib.sha256((HERE / "in.packing").read_bytes()).hexdigest()[:8]
    path = (args.cache / f"{scene}-{phi}-{single}-{recipe}.data").absolute()
    if not path.exists():
        unfinished = path.with_suffix(f".{os.getpid()}")
        say(f"packing of {single} bubbles, {scene}, gas fraction {phi}")
        machine.lammps(shlex.split(args.lmp), "in.packing", args.out,
                       {"dim": dim, "N": single, "phi": phi, "file": unfinished},
                       {"OMP_NUM_THREADS": "1"})
        unfinished.rename(path)
    nx, ny, nz = factors(round(bubbles / single), dim)
    return {"dim": dim, "file": path, "nx": nx, "ny": ny, "nz": nz}


# ---- measurements -------------------------------------------------------------------------------

def say(text):
    print(text, file=sys.stderr, flush=True)


def number(pattern, text, default=None):
    """Of the last line of that kind in what LAMMPS printed; LAMMPS' LogFile has only thermo output."""
    found = re.findall(pattern, text, re.M)
    if not found:
        if default is None:
            raise Failed(f"no line '{pattern}' in what LAMMPS printed")
        return default
    return float(found[-1])


def measure(args, configuration, what, variables, steps, extra=None, environment=None,
            watch_device=False):
    """One run: its figures as a dictionary."""
    timeout = max(args.deadline - time.time(), 20) if args.deadline else None
    text, rss, device_memory, seconds = machine.lammps(
        configuration.words(what), "in.speed", args.out,
        {**variables, "what": what, "steps": steps, "warm": args.warm,
         "more": steps // 3 if configuration.device else 0,     # a GPU takes a while to speed up
         **(extra or {})},
        {**configuration.environment, **(environment or {})}, timeout, watch_device)
    style = re.search(r"\(1\) pair ([^, ]+)", text)
    if configuration.kokkos and not (style and "/kk" in style[1]):
        raise Failed(f"there is no kk version of pair style {style[1] if style else '?'}")
    run = {"what": what, "configuration": configuration.name, "threads": configuration.threads,
           "process seconds": seconds, "rss": rss, "device memory": device_memory,
           "loop": number(r"^Loop time of (\S+)", text),
           "cpu": number(r"^([\d.]+)% CPU use", text, 0.0),
           "builds": number(r"^Neighbor list builds = (\d+)", text, 0.0),
           "neighbours": number(r"^Ave neighs/atom = (\S+)", text, 0.0),
           "memory": number(r"^Per MPI rank memory .* = (\S+)", text, 0.0),
           "start energy": number(r"^start energy (\S+)", text)}
    for name in ("evaluations", "rejected", "tau", "bubbles", "energy"):
        run[name] = number(rf"^measured .*\b{name} (\S+)", text)
    for section in SECTIONS:
        mean = r"\| +(\S+)" if section == "Other" else r"(\S+)"
        run[section] = number(rf"^{section} +\| *{mean}", text, 0.0)
    run["scale"] = 1e9 / (run["evaluations"] * run["bubbles"])
    return run


def counted(args, tool, configuration, what, variables, few, many, skin=0.3, K=1.0e-3,
            **environment):
    """What `many` steps do beyond `few`, two runs that begin alike: the counts, the figures of
    both runs, and the largest memory of Kokkos."""
    path = (args.out / f"counts-{configuration.name}.json").absolute()
    environment = {"KOKKOS_TOOLS_LIBS": str(tool), "FOAM_COUNTS": str(path), **environment}
    runs, read = [], []
    for steps in (few, many):
        path.unlink(missing_ok=True)
        runs.append(measure(args, configuration, what, variables, steps,
                            {"skin": skin, "K": K, "more": 0}, environment))
        if not path.exists():
            raise Failed("Kokkos did not load the tool that counts")
        read.append(counts.read(path))
    path.unlink()
    return counts.difference(read[1][0], read[0][0]), runs, read[1][1]


def gained(runs, name):
    return runs[1][name] - runs[0][name]


def count(args, tool, configuration, what, variables):
    """Launches, fences and copies per evaluation and per list build: first with a skin so thick
    that no list is built, and so little gas exchange that no bubble vanishes; then as usual."""
    steady, runs, _ = counted(args, tool, configuration, what, variables, 20, 60, 2.0, 1.0e-6)
    evaluations, builds = gained(runs, "evaluations"), gained(runs, "builds")
    usual, runs, memory = counted(args, tool, configuration, what, variables, 20, 120)
    more, usual_builds = gained(runs, "evaluations"), gained(runs, "builds")
    result = {"bubbles": runs[1]["bubbles"], "memory": memory, "builds in steady": builds,
              "steady": counts.totals(steady, evaluations),
              "labels": counts.listed(steady, evaluations, 1)}
    if usual_builds:
        build = counts.difference(usual, steady, more / evaluations)
        result["per build"] = counts.totals(build, usual_builds)
        result["labels of builds"] = counts.listed(build, usual_builds, 1)
    return result


def kernel_times(args, tool, configuration, what, variables):
    """Time of each kernel, per bubble and evaluation, list builds included."""
    more, runs, _ = counted(args, tool, configuration, what, variables, 20, 60,
                            FOAM_COUNTS_TIME="1")
    bubbles = runs[1]["bubbles"]
    return {"bubbles": bubbles,
            "labels": counts.listed(more, gained(runs, "evaluations"), bubbles)}


def steps_for(args, setup, bubbles):
    if args.steps:
        return args.steps
    few = (200, 100, 50) if not setup.device else (1000, 300, 100)
    return few[0 if bubbles <= 2e4 else 1 if bubbles <= 2e6 and setup.device or bubbles <= 2e5
               else 2]


def repeats_for(args, bubbles):
    return args.repeat if bubbles <= 2e5 else min(args.repeat, 2 if bubbles <= 2e6 else 1)


class Campaign:
    """All measurements, smallest packings first; what fails or is too late is noted, not there."""

    def __init__(self, args, setups, tool, report):
        self.args, self.setups, self.tool, self.report = args, setups, tool, report
        self.failed = set()

    def late(self):
        return self.args.deadline and time.time() > self.args.deadline

    def attempt(self, key, action, *words, **more):
        name = " ".join(map(str, key))
        if key in self.failed:
            return None
        if self.late():
            self.report["notes"].append(f"out of time, not measured: {name}")
            return None
        say(name)
        try:
            return action(self.args, *words, **more)
        except Failed as error:
            self.report["notes"].append(f"{name}: {error}")
            say(f"{name}: {error}")
            self.failed.add(key)
            return None

    def run(self):
        args = self.args
        for bubbles in args.bubbles:
            for scene in args.scene:
                variables = self.attempt((scene, bubbles, "packing"), packing, scene, bubbles)
                if not variables:
                    continue
                jobs = [(setup, what) for setup in self.setups for what in args.what
                        if not (what == "hooke" and setup.kokkos)
                        and not (what in ("relax", "history") and bubbles > 2e6)
                        and (setup.device or bubbles <= args.host_max)
                        and (scene, setup.name, what) not in self.failed]
                measured = self.times(scene, bubbles, variables, jobs)
                self.insides(scene, bubbles, variables, measured)

    def times(self, scene, bubbles, variables, jobs):
        """Figures of each job, the fastest of some repeats; returns the jobs that worked."""
        args, best = self.args, {}
        for _ in range(repeats_for(args, bubbles)):
            for setup, what in jobs:
                key = (setup.name, what)
                if key in best and self.late():
                    continue
                run = self.attempt((scene, bubbles, *key), measure, setup, what, variables,
                                   steps_for(args, setup, bubbles))
                if run and (key not in best or run["loop"] < best[key]["loop"]):
                    best[key] = run
        for setup, what in jobs:
            run = best.get((setup.name, what))
            if not run:
                self.failed.add((scene, setup.name, what))
                continue
            run.update(scene=scene, dim=SCENES[scene][0], phi=SCENES[scene][1], nominal=bubbles)
            if setup.device and what == "foam":    # else kernels return at once, unseen by timers
                run["waiting"] = self.attempt(
                    (scene, bubbles, setup.name, what, "waiting"), measure, setup, what, variables,
                    steps_for(args, setup, bubbles) // 2,
                    environment={"CUDA_LAUNCH_BLOCKING": "1"}, watch_device=True)
            finish(self.report, setup, run)
            self.report["runs"].append(run)
            save(args, self.report)
        return [job for job in jobs if (job[0].name, job[1]) in best]

    def insides(self, scene, bubbles, variables, jobs):
        """What KOKKOS styles launch, at the smallest size; how long that takes, at a large one."""
        args = self.args
        largest = max((n for n in args.bubbles if n <= 2e6), default=args.bubbles[0])
        tasks = []
        if bubbles == args.bubbles[0]:
            tasks.append(("counts", count, ("foam", "history")))
        if args.kernels and bubbles == largest:
            tasks.append(("kernels", kernel_times, ("foam",)))
        for name, action, whats in tasks:
            for setup, what in jobs:
                if not self.tool or not setup.kokkos or what not in whats:
                    continue
                if setup.device and what != "foam":     # time there is short
                    continue
                found = self.attempt((scene, bubbles, setup.name, what, name), action, self.tool,
                                     setup, what, variables)
                if found:
                    self.report[name].append({"scene": scene, "what": what,
                                              "configuration": setup.name, **found})
        save(args, self.report)


def finish(report, setup, run):
    """Derived figures: ns per bubble and evaluation, floor, cost of a unit of tau."""
    scale = run["scale"]
    run["device memory"] = run["waiting"]["device memory"] if run.get("waiting") else 0.0
    run["ns"] = run["loop"] * scale
    run["cpu ns"] = run["ns"] * run["cpu"] / 100      # less sensitive to other work on the machine
    split = run.get("waiting") or run
    run["split"] = {section: split[section] * split["scale"] for section in SECTIONS}
    if run["tau"] > 0.0:
        run["evaluations per tau"] = run["evaluations"] / run["tau"]
        run["seconds per tau"] = run["loop"] / run["tau"]
    bandwidth = report["bandwidth"].get("cuda" if setup.device else str(setup.threads))
    if run["what"] in traffic.LOOPS:
        rejected = run["rejected"] / run["evaluations"]
        run["bytes"] = traffic.per_evaluation(run["what"], run["dim"], run["neighbours"], rejected,
                                              setup.precision)
        if bandwidth:
            run["floor ns"] = run["bytes"] / bandwidth
    base = next((r for r in report["runs"] if r["configuration"] == "base" and
                 all(r[k] == run[k] for k in ("what", "scene", "nominal"))), None)
    if base and base["start energy"]:
        off = abs(run["start energy"] / base["start energy"] - 1)
        if off > (1e-6 if setup.precision == "double" else 1e-2):
            report["notes"].append(f"{run['scene']} {run['nominal']:.0e} {setup.name} "
                                   f"{run['what']}: energy differs from base by {off:.1e}")


def busy(report):
    """Notes on a machine that was not idle."""
    used = [run["cpu"] / run["threads"] for run in report["runs"]
            if run["configuration"] != "cuda"]
    slow = [share for share in used if share < 90]
    if slow:
        report["notes"].append(f"{len(slow)} of {len(used)} runs had less than 90 % of their cores "
                               f"(down to {min(slow):.0f} %): other work on the machine, timings "
                               "are too long")


def save(args, report):
    (args.out / "bench.json").write_text(json.dumps(report, indent=1))


# ---- the command --------------------------------------------------------------------------------

def number_list(text):
    return [int(float(word)) for word in text.split(",")]


def choice_list(*allowed):
    def split(text):
        words = text.split(",")
        for word in words:
            if word not in allowed:
                raise argparse.ArgumentTypeError(f"'{word}' is none of {', '.join(allowed)}")
        return words
    return split


def other(text):
    found = re.fullmatch(r"(.+):(2d|3d):([\d.e+]+)=([\d.e+-]+)", text)
    if not found:
        raise argparse.ArgumentTypeError("must look like LABEL:2d:1e5=1.25")
    return {"label": found[1], "scene": found[2], "bubbles": float(found[3]),
            "ns": float(found[4])}


def arguments():
    cores = len(os.sched_getaffinity(0))
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0], epilog=__doc__.split(
        "\n\n", 2)[2], formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help="LAMMPS with the foam styles, for packings, base, omp (%(default)s)")
    parser.add_argument("--lmp-serial", metavar="COMMAND", help="one with Kokkos' Serial alone")
    parser.add_argument("--lmp-cuda", metavar="COMMAND", help="one with Kokkos' CUDA back end")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="10^4 and 10^5 bubbles (default)")
    size.add_argument("--full", action="store_true", help="10^4 to 10^7 bubbles")
    parser.add_argument("--bubbles", type=number_list, metavar="N,...", help="other numbers")
    parser.add_argument("--scene", type=choice_list(*SCENES), default=list(SCENES), metavar="S,...",
                        help="2d,3d")
    parser.add_argument("--what", type=choice_list(*NAMES), metavar="W,...",
                        default=list(NAMES), help="foam,relax,hooke,history")
    parser.add_argument("--backends", type=choice_list("base", "serial", "omp", "cuda"),
                        default=["base", "serial", "omp", "cuda"], metavar="B,...",
                        help="base,serial,omp,cuda")
    parser.add_argument("--threads", type=number_list, metavar="N,...",
                        help="numbers of OpenMP threads (1, 2, 4 ... to the number of cores)")
    parser.add_argument("--package", type=str.split, default=[], metavar="'KEY VALUE ...'",
                        help="options of package kokkos for the kk styles")
    parser.add_argument("--kernels", action="store_true",
                        help="also the time of each kernel, waiting for it")
    parser.add_argument("--steps", type=int, help="steps of a measurement (by size)")
    parser.add_argument("--warm", type=int, default=20, help="steps before it (%(default)s)")
    parser.add_argument("--repeat", type=int, default=3,
                        help="the fastest of so many (%(default)s; at 10^6 bubbles 2, at 10^7 1)")
    parser.add_argument("--host-max", type=float, default=1e9, metavar="N",
                        help="no more bubbles than this on the processor, if there is a GPU")
    parser.add_argument("--bandwidth", type=float, metavar="GB/S",
                        help="of the GPU's memory, where there is no nvcc to measure it with")
    parser.add_argument("--limit", type=float, metavar="SECONDS",
                        help="start nothing new after this time")
    parser.add_argument("--other", type=other, action="append", default=[],
                        metavar="LABEL:SCENE:N=NS",
                        help="a line for another program: its ns per bubble and evaluation")
    parser.add_argument("--out", type=Path, default=Path("foam-bench"), metavar="DIR",
                        help="where results go (%(default)s)")
    parser.add_argument("--cache", type=Path, metavar="DIR",
                        help="where packings and small programs are kept (--out)")
    args = parser.parse_args()
    args.bubbles = sorted(args.bubbles or ([10**n for n in (4, 5, 6, 7)] if args.full else
                                           [10**4, 10**5]))
    if not args.threads:
        args.threads = sorted({2**n for n in range(10) if 2**n <= cores} | {cores})
    args.cache = args.cache or args.out
    args.deadline = time.time() + args.limit if args.limit else None
    for name in ("lmp", "lmp_serial", "lmp_cuda"):     # runs have a working directory of their own
        command = getattr(args, name)
        if command:
            words = shlex.split(command)
            words = [str(Path(w).absolute()) if "/" in w and Path(w).exists() else w for w in words]
            setattr(args, name, shlex.join(words))
    return args


def main():
    args = arguments()
    for directory in (args.out, args.cache):
        directory.mkdir(parents=True, exist_ok=True)
    setups, absent = configurations(args)
    report = {"machine": machine.cpu_name(), "gpu": machine.nvidia_smi("name") if args.lmp_cuda
              else None, "system": platform.platform(), "date": time.strftime("%Y-%m-%d"),
              "load at start": os.getloadavg()[0], "command": sys.argv[1:],
              "precision": {s.name: s.precision for s in setups}, "bandwidth": {},
              "runs": [], "counts": [], "kernels": [], "others": args.other, "notes": absent}
    for threads in sorted({s.threads for s in setups if not s.device}):
        report["bandwidth"][str(threads)] = machine.host_bandwidth(threads, args.cache)
    if any(s.device for s in setups):
        report["bandwidth"]["cuda"] = args.bandwidth or machine.device_bandwidth(args.cache)
    tool = counts.build(args.cache) if any(s.kokkos for s in setups) else None
    if not tool and any(s.kokkos for s in setups):
        report["notes"].append("no C++ compiler: launches are not counted")

    Campaign(args, setups, tool, report).run()
    if not report["runs"]:
        raise SystemExit("nothing could be measured:\n" + "\n".join(report["notes"]))
    busy(report)
    save(args, report)
    text = table(report)
    (args.out / "bench.txt").write_text(text + "\n")
    print(text)
    try:
        from plot import draw
    except ImportError:
        say("no matplotlib, no plot: plot.py draws it from bench.json")
    else:
        draw(report, args.out / "bench.png")
    say(f"results: {args.out}/bench.txt, bench.json")


if __name__ == "__main__":
    main()
