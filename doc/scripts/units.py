#!/usr/bin/env python3
"""From a real foam to the parameters of the model and back: the figures of doc/units.rst.

    python3 doc/scripts/units.py                       # the table
    python3 doc/scripts/units.py --lmp "./foam lmp"    # and a foam in lj and in si units
"""
import argparse
from math import pi, sqrt
from pathlib import Path
import shlex
import subprocess
import tempfile


def model(foam):
    """sigma0, mu0, K, kappa in SI units, in 3D, of a foam given by what can be measured."""
    k = foam["diffusion"] * foam["solubility"] / (foam["film"] * foam["pressure"])
    return {"R": foam["R"], "sigma0": 3 * foam["gamma"], "mu0": 6 * pi * foam["eta"] * foam["R"],
            "k": k, "K": 2 * foam["gamma"] * k, "kappa": foam["film"] / foam["layer"]}


def reduced(si):
    """The same in units of <R_in>, sigma0 and mu0, and these units."""
    time = si["mu0"] / si["sigma0"]
    return {"K": si["K"] * time / si["R"]**2, "kappa": si["kappa"],
            "length": si["R"], "time": time, "force": si["sigma0"] * si["R"]}


def back(lj):
    """sigma0, mu0, K in SI units from reduced ones: R = 1, sigma0 = 1, mu0 = 1, K."""
    sigma0 = lj["force"] / lj["length"]
    return {"R": lj["length"], "sigma0": sigma0, "mu0": sigma0 * lj["time"],
            "K": lj["K"] * lj["length"]**2 / lj["time"]}


EXAMPLE = {       # nitrogen in soapy water
    "gamma": 30e-3,        # surface tension, N/m
    "R": 0.5e-3,           # mean radius, m
    "eta": 1e-3,           # viscosity, Pa s
    "diffusion": 2e-9,     # of the gas in the liquid, m^2/s
    "solubility": 0.016,   # concentration in the liquid / in the gas
    "film": 50e-9,         # thickness of films, m
    "pressure": 1e5,       # of the gas, Pa
    "layer": 0.0,          # thickness of the liquid's layer, m: set below
}


def coarsen(lmp, style, values):
    """What in.units prints at the end."""
    script = Path(__file__).resolve().with_name("in.units")
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "units.txt"
        words = [w for name, v in values.items() for w in ("-var", name, f"{v:.16g}")]
        subprocess.run([*shlex.split(lmp), "-in", str(script), "-log", "none", "-screen", "none",
                        "-var", "style", style, "-var", "file", str(out), *words], check=True)
        return [float(word) for word in out.read_text().split()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", metavar="COMMAND", help="how to start LAMMPS, to run a foam, too")
    args = parser.parse_args()
    layers = {"area": sqrt(EXAMPLE["film"] * 0.2 * EXAMPLE["R"]), "lsw": EXAMPLE["R"]}
    for law, layer in layers.items():
        si = model({**EXAMPLE, "layer": layer})
        lj = reduced(si)
        print(f"liquid {law}: layer {layer:.3g} m, kappa {si['kappa']:.3g}")
    print(f"k       {si['k']:.3g} m/(s Pa)")
    for name, unit in (("R", "m"), ("sigma0", "N/m"), ("mu0", "N s/m"), ("K", "m^2/s")):
        again = back(lj)[name]
        print(f"{name:7s} {si[name]:.4g} {unit}; back from reduced units {again:.4g}, "
              f"off {again / si[name] - 1:.0e}")
    print(f"reduced K {lj['K']:.3g}; units: length {lj['length']:.3g} m, time {lj['time']:.3g} s, "
          f"force {lj['force']:.3g} N, pressure {lj['force'] / lj['length']**2:.3g} Pa")
    print(f"a unit of tau is {si['R']**2 / si['K']:.4g} s")
    if args.lmp:
        # with a K that is larger, so that it takes a moment only
        K = 1e-3
        ours = coarsen(args.lmp, "lj", {"K": K})
        theirs = coarsen(args.lmp, "si", {
            "R": si["R"], "sigma0": si["sigma0"], "mu0": si["mu0"],
            "K": K * lj["length"]**2 / lj["time"]})
        print(f"lj: N {ours[0]:.0f}, <R>/<R_in> {ours[1]}, tau {ours[2]}, t {ours[3]}")
        print(f"si: N {theirs[0]:.0f}, <R>/<R_in> {theirs[1]}, tau {theirs[2]}, t {theirs[3]} s = "
              f"{theirs[3] / lj['time']:.6g} mu0/sigma0")


if __name__ == "__main__":
    main()
