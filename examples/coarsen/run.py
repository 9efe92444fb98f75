#!/usr/bin/env python3
"""Run in.coarsen and make a table and pictures of it.

    python3 run.py --lmp "mpiexec -n 2 lmp" --out DIR [--var NAME VALUE] ...

    python3 run.py --lmp lmp --out small --var N 1000 --var end 100
    python3 run.py --out sizes --var sizes bidisperse --var at_tau 1,10 --var at_N 1000
"""
import argparse
from pathlib import Path
import shlex
import subprocess
import sys
import time

from plot import Unusable, make_pictures


def command_words(command):
    """Words of the command, paths made absolute, since LAMMPS will run in another directory."""
    return [str(Path(word).absolute()) if "/" in word and Path(word).exists() else word
            for word in shlex.split(command)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS, as one string (default "%(default)s")')
    parser.add_argument("--out", default="out", type=Path, metavar="DIR",
                        help='where everything is written (default "%(default)s")')
    parser.add_argument("--var", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"),
                        help="a variable of in.coarsen, such as --var N 2000; may be repeated")
    args = parser.parse_args()

    script = Path(__file__).resolve().with_name("in.coarsen")
    args.out.mkdir(parents=True, exist_ok=True)
    command = command_words(args.lmp) + ["-in", str(script), "-log", "log.coarsen"]
    for name, value in dict(args.var).items():        # the last one counts, if one is repeated
        command += ["-var", name, value]

    for name in ("tau.lammpstrj", "N.lammpstrj"):     # of an earlier run, which asked for them
        (args.out / name).unlink(missing_ok=True)
    started = time.perf_counter()
    try:
        status = subprocess.run(command, cwd=args.out, stdin=subprocess.DEVNULL).returncode
    except FileNotFoundError:
        sys.exit(f"cannot start LAMMPS: there is no program {command[0]} (option --lmp)")
    if status != 0:
        sys.exit(f"LAMMPS stopped with status {status}: see above, or {args.out / 'log.coarsen'}")
    seconds = time.perf_counter() - started

    try:
        pictures, summary = make_pictures(args.out)
    except Unusable as wrong:
        sys.exit(str(wrong))
    print("\n" + "\n".join(summary))
    print(f"seconds          {seconds:.0f}")
    print("table:\n  " + str(args.out / "series.csv"))
    print("pictures:", *pictures, sep="\n  ")


if __name__ == "__main__":
    main()
