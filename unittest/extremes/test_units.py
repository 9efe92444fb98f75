"""The answer does not depend on the units: lengths, times and stiffness scaled, each by itself.

With powers of two no number is rounded differently, so all are the same bit by bit; with 1e-9 and
1e9 the foam is the same up to rounding, which grows: SHORT of ../styles/foams.py.  (The cube root of
some C libraries rounds a number below 1 otherwise than 8 times that number if that is above 1:
units are changed on one side.)
"""

import numpy as np

from scenes import INTEGRATORS, anywhere, cases, last

SHORT = 1e-9


def units_of(dim, length, time, stiffness):
    """By what each number is multiplied that is not without units."""
    energy, gas = stiffness * length**2, length**dim
    units = {name: length for name in ("x", "y", "z", "xu", "yu", "zu", "radius")}
    units |= {name: length / time for name in ("vx", "vy", "vz", "c_b[6]")}
    units |= {name: stiffness * length for name in ("fx", "fy", "fz")}
    units |= {"c_b[2]": gas / length, "c_b[3]": gas / length, "c_b[4]": gas / time,
              "c_b[5]": gas / time, "c_b[7]": energy, "c_b[8]": energy}
    units |= {name: time for name in ("Time", "f_step[1]", "f_step[2]", "f_step[7]")}
    units |= {"f_step[9]": 1 / time, "PotEng": energy, "f_gas[6]": length, "f_gas[8]": gas,
              "f_gas[9]": length, "f_gas[10]": gas / length}
    units |= {f"c_p[{k}]": energy / gas for k in range(1, 7)}
    return units


def assert_scaled(a, b, dim, scale, limit):
    units = units_of(dim, *scale)
    tables = [(a.thermo[0], b.thermo[0])]
    tables += [(f._columns, g._columns) for f, g in zip(a.dump("dump"), b.dump("dump"))]
    tables += [(last(a)._columns, last(b)._columns)]
    for one, other in tables:
        for name in one:
            x, y = one[name] * units.get(name, 1.0), other[name]
            assert len(x) == len(y), name
            if limit == 0.0:
                assert np.array_equal(x, y), f"{name}: {np.abs(x - y).max()}"
            elif name not in ("f_step[6]", "id"):    # small differences, large relative changes
                # the spectral radius is a difference over 1e-6 <R_in>, of places known to 1e-15
                allowed = 10.0 * limit if name == "f_step[9]" else limit
                assert np.abs(x - y).max() <= allowed * np.abs(x).max(), name


WHAT = {"length": (1, 0, 0), "time": (0, 1, 0), "stiffness": (0, 0, 1), "all": (1, -1, 1)}


@cases("what, power, dim, gas, integrator, drag",
       WHAT, [-30, 30, -100], [2, 3], [None, 0.3], INTEGRATORS, ["static", "neighbor"])
def test_powers_of_two(lmp, what, power, dim, gas, integrator, drag):
    scene = anywhere(dim, 60, 0.9, K=gas, kappa=1.0, integrator=integrator, run=100, spread=0.4,
                     pair=f"drag {drag}")
    first = [2.0**(np.sign(power) * 10 * k) for k in WHAT[what]]
    scale = [2.0**(power * k) for k in WHAT[what]]
    scene = scene.scaled(*first)
    a, b = scene(lmp), scene.scaled(*scale)(lmp)
    assert_scaled(a, b, dim, scale, 0.0)


@cases("what, power, dim, gas, integrator", WHAT, [-9, 9], [2, 3], [None, 0.3], INTEGRATORS)
def test_powers_of_ten(lmp, what, power, dim, gas, integrator):
    scene = anywhere(dim, 60, 0.9, K=gas, kappa=1.0, integrator=integrator, run=20)
    scale = [10.0**(power * k) for k in WHAT[what]]
    a, b = scene(lmp), scene.scaled(*scale)(lmp)
    assert_scaled(a, b, dim, scale, SHORT)
