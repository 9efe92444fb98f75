"""Random foams in which bubbles vanish, and what it means that two of them are the same.

Foams are dense, so that a bubble has contacts in every direction.  Rounding differs between the
ways to add up the same numbers; it grows as nearby states part.  Limits:
  SAME     one state: sums of some ten numbers of order 1, so 1e-15 becomes 1e-14; 1e-12 leaves room
  SHORT    some 100 steps of the runs here: rounding has grown to a few 1e-12 (measured)
"""

import numpy as np

from runner import PRECISE, Runner, data_file

SAME = 1e-12
SHORT = 1e-9
SIZE = {2: 12, 3: 5}    # bubbles along a side


def foam(dim, n, seed=7, spacing=None):
    """n^dim bubbles near the sites of a grid, in a cubic box with a corner at the origin."""
    random = np.random.default_rng(seed)
    a = spacing or (1.6 if dim == 2 else 1.5)
    sites = np.stack(np.meshgrid(*[np.arange(n)] * dim, indexing="ij"), -1).reshape(-1, dim)
    x = (a * (sites + 0.5) + a * random.uniform(-0.5, 0.5, sites.shape)) % (n * a)
    R = np.clip(random.normal(1.0, 0.21, len(x)), 0.2, None)
    v = random.uniform(-0.1, 0.1, x.shape)
    return x, R, v, n * a


def case(dim, before="", neighbor="0.3 bin", pair="", after="", gas="1e-2 0.1",
         integrator="abm", step="1e-3", run="run 0", every=20, map="map array"):
    """Input of a coarsening foam; `before` stands before the box, `after` before the run."""
    return f"""
units         lj
dimension     {dim}
{before}
atom_style    sphere 1
atom_modify   {map}
read_data     data
neighbor      {neighbor}
pair_style    durian/foam 1.0 {pair}
pair_coeff    * * 1.0
fix           gas all foam/coarsen {gas}
fix           step all foam/{integrator} {step}
compute       b all foam/bubble contacts area free vfilm vliquid rdot espring edurian
compute       p all pressure NULL virial
thermo_style  custom step atoms time pe c_p[*] f_gas[*] f_step[*]
{PRECISE}
thermo        {every}
dump          d all custom {every} dump id x y z vx vy vz fx fy fz radius c_b[*]
dump_modify   d sort id format float %.17g
{after}
{run}
"""


def state(frame, dim):
    """Columns of a frame, by name: vectors of dim columns, scalars of one."""
    columns = {name: frame.array(*[letter.format(k) for k in "xyz"[:dim]])
               for name, letter in (("x", "{}"), ("v", "v{}"), ("f", "f{}"))}
    columns["radius"] = frame["radius"]
    for c in range(1, 9):
        columns[f"c_b[{c}]"] = frame[f"c_b[{c}]"]
    return columns


def assert_same_state(a, b, box, limit, turn=lambda vector: vector, shift=0.0):
    """b must be a with its vectors turned and its places shifted, up to images."""
    for name in a:
        if name == "x":
            d = turn(a[name]) + shift - b[name]
            error = np.abs(d - box * np.round(d / box)).max() / box
        else:
            one = turn(a[name]) if name in "vf" else a[name]
            error = np.abs(one - b[name]).max() / max(np.abs(b[name]).max(), 1e-300)
        assert error < limit, f"{name} differs by {error:.1e}"


def assert_same_run(a, b, limit=SHORT, names=("PotEng", "f_gas[3]", "f_gas[4]", "f_gas[6]")):
    for name in ("Step", "Atoms", "f_gas[2]"):
        assert name not in a or np.array_equal(a[name], b[name]), name
    for name in ("Time", *names):
        if name in a:
            error = np.abs(a[name] - b[name]).max() / max(np.abs(a[name]).max(), 1e-300)
            assert error < limit, f"{name} differs by {error:.1e}"


class Base:
    """The plain runs that others are compared with, each made once."""

    def __init__(self, directory):
        self.directory, self.made = directory, {}

    def __call__(self, dim, n, **keywords):
        key = (dim, n, *sorted(keywords.items()))
        if key not in self.made:
            runner = Runner("wheel", self.directory / str(len(self.made)))
            x, R, v, box = foam(dim, n)
            self.made[key] = runner(case(dim, **keywords),
                                    files={"data": data_file([box] * dim, x, R, v)})
        return self.made[key]
