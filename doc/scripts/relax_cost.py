#!/usr/bin/env python3
"""What it costs to relax a foam: by dynamics to several limits, and by LAMMPS' minimizers.

    python3 relax_cost.py --lmp "./foam lmp" [--bubbles 10000] [--out DIR]

Writes relax-cost.txt: evaluations of all forces (a number that no busy machine changes), and what is left of energy,
pressure, contacts and force, for foams from the same start.
"""
import argparse
from pathlib import Path
import re
import shlex
import subprocess
import sys
import tempfile

HERE = Path(__file__).resolve().parent
SCENES = [(2, 0.80), (2, 0.87), (2, 0.95), (3, 0.60), (3, 0.70), (3, 0.85)]
WAYS = [("run, limit 1e-2", "none", "limit 1e-2"), ("run, limit 1e-3", "none", "limit 1e-3"),
        ("run, limit 1e-4", "none", "limit 1e-4 rounds 1000"),
        ("minimize, fire, 1e-6", "fire", "method minimize 0 1e-6 100000 1000000"),
        ("minimize, cg, 1e-6", "cg", "method minimize 0 1e-6 100000 1000000")]
HEAD = (f"d {'phi':>5} {'way':<22}{'evaluations':>12}{'energy/N':>13}{'pressure':>13}"
        f"{'contacts':>10}{'max force':>11}")


def relax(lmp, dim, phi, name, style, how, bubbles):
    command = [*lmp, "-in", str(HERE / "in.relax_cost"), "-log", "none", "-nocite", "-var", "dim", str(dim),
               "-var", "phi", str(phi), "-var", "style", style, "-var", "how", how, "-var", "N", str(bubbles)]
    with tempfile.TemporaryDirectory() as directory:
        done = subprocess.run(command, cwd=directory, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    found = re.search(r"^RESULT (.*)$", done.stdout, re.M)
    if done.returncode or not found:
        sys.exit(f"LAMMPS stopped: {' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    evaluations, energy, pressure, contacts, force = map(float, found[1].split())
    evaluations += sum(int(n) for n in re.findall(r"Iterations, force evaluations = \d+ (\d+)", done.stdout))
    return (f"{dim} {phi:5.2f} {name:<22}{evaluations:12.0f}{energy / bubbles:13.4e}{pressure:13.4e}"
            f"{contacts:10.3f}{force:11.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND", help="how to start LAMMPS")
    parser.add_argument("--bubbles", type=int, default=10000)
    parser.add_argument("--out", type=Path, default=Path("."), metavar="DIR")
    args = parser.parse_args()
    lmp = [str(Path(word).absolute()) if "/" in word and Path(word).exists() else word
           for word in shlex.split(args.lmp)]
    lines = [HEAD]
    print(HEAD)
    for dim, phi in SCENES:
        for name, style, how in WAYS:
            line = relax(lmp, dim, phi, name, style, how, args.bubbles)
            print(line, flush=True)
            lines.append(line)
    args.out.mkdir(parents=True, exist_ok=True)
    (args.out / "relax-cost.txt").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
