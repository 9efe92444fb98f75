#!/usr/bin/env python3
"""The error of a sheared foam at steps of one length, with fix foam/flow shear and with fix deform's remap x.

    python3 doc/scripts/shear_order.py --lmp "./foam lmp"
"""
import argparse
from pathlib import Path
import shlex
import subprocess
import tempfile

import numpy as np

STEPS = (40, 80, 160, 320)
FINE = 5120    # of the reference, by the flow
STYLES = {"foam/abm": "abm 1e9", "foam/rkc, 5 stages": "rkc 1e9 stages 5 spectral 4.0"}


def places(lmp, folder, how, style, steps):
    script = Path(__file__).resolve().with_name("in.shear_order")
    file = Path(folder) / "end.dump"
    subprocess.run([*shlex.split(lmp), "-in", str(script), "-log", "none", "-screen", "none", "-var", "how", how,
                    "-var", "style", style, "-var", "steps", str(steps), "-var", "file", str(file)], check=True)
    return np.loadtxt(file, skiprows=9, usecols=(1, 2))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp")
    lmp = parser.parse_args().lmp
    with tempfile.TemporaryDirectory() as folder:
        exact = places(lmp, folder, "flow", STYLES["foam/abm"], FINE)
        print("error of places, root mean square (and how many times that of the next line); strain 0.1")
        for name, style in STYLES.items():
            for how in "flow", "remap":
                errors = [np.sqrt(((places(lmp, folder, how, style, n) - exact)**2).mean()) for n in STEPS]
                for n, error, following in zip(STEPS, errors, [*errors[1:], np.nan]):
                    print(f"{name:20s} {how:6s} step {2.0 / n:<7g} {error:.2e} ({error / following:.2f})")


if __name__ == "__main__":
    main()
