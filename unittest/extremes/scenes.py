"""A scene is a foam and how it is run; assert_sound() is what holds for every one of them."""

import dataclasses
import itertools
import os

import numpy as np
import pytest

from runner import BACKENDS as ALL_BACKENDS, PLAIN, PRECISE, data_file

# integrators by name: the line of the fix, with the tolerance left open
INTEGRATORS = {
    "abm max": "foam/abm {tol:g} norm max",
    "abm rms": "foam/abm {tol:g} norm rms",
    "rkc": "foam/rkc {tol:g}",
}

FULL = os.environ.get("FOAM_EXTREMES") == "full"

# back ends: those that there are, or those named
BACKENDS = [name for name in PLAIN if os.environ.get(ALL_BACKENDS[name].variable)] or PLAIN[:1]
if os.environ.get("FOAM_EXTREME_BACKENDS"):
    BACKENDS = os.environ["FOAM_EXTREME_BACKENDS"].split(",")


def cases(names, *lists):
    """Parametrize by all combinations of the values in lists and of the back ends, as fixture lmp;
    in the short form by a few of them, in which each value occurs."""
    lists = [list(values) for values in (*lists, BACKENDS)]
    rows = list(itertools.product(*lists))
    if not FULL:
        random = np.random.default_rng(1)
        longest = max(map(len, lists))
        turns = [random.permutation(longest) % len(values) for values in lists]
        turns[np.argmax([len(values) for values in lists])] = range(longest)
        rows = [tuple(values[t] for values, t in zip(lists, turn)) for turn in zip(*turns)]
    return pytest.mark.parametrize(f"{names}, lmp", rows, indirect=["lmp"])


# A step changes the sum of gas by the rounding of some hundred terms, 1e-15, in either direction;
# in the longest runs here that adds up to less than this
GAS = 1e-12


def last(result):
    """The state at the end."""
    return result.dump("last")[0]


@dataclasses.dataclass
class Scene:
    """Bubbles of radii R at x in a box from the origin, or between (lo, hi); see input()."""
    x: np.ndarray
    R: np.ndarray
    box: list
    tilt: tuple = None             # xy, xz, yz
    boundary: str = "p p p"
    integrator: str = "abm max"
    tol: float = 1e-3
    dt0: float = 0.01
    dtmax: float = None
    step: str = ""                 # more keywords of the integrator
    K: float = 1e-2                # None: no fix foam/coarsen
    kappa: float = 0.1
    gas: str = ""                  # more keywords of fix foam/coarsen
    rmin: float = 0.1
    gas_first: bool = False        # of the two fixes
    gas_limit: float = GAS         # for variable radius and scheme source
    mu0: float = 1.0
    sigma0: float = 1.0
    rin: float = None              # None: as the pair style finds it, the mean
    pair: str = ""                 # more keywords of the pair style
    skin: float = 0.3
    neighbor: str = "bin"
    box_moves: bool = False        # a line of `after` sees to that
    before: str = ""               # lines before the box
    after: str = ""                # lines before the run
    run: int = 100
    every: int = 10                # steps between dumps, and lines of thermo output unless
    thermo: int = None             # these are more often

    def __post_init__(self):
        self.x, self.R = np.asarray(self.x, float), np.asarray(self.R, float)

    @property
    def dim(self):
        return self.x.shape[1]

    @property
    def volume(self):
        sides = [side if np.isscalar(side) else side[1] - side[0] for side in self.box]
        return np.prod(sides[:self.dim])

    @property
    def mean(self):
        """<R_in>"""
        return self.rin or self.R.mean()

    def fixes(self):
        dtmax = f"dtmax {self.dtmax:.17g}" if self.dtmax else ""
        lines = [f"fix step all {INTEGRATORS[self.integrator].format(tol=self.tol)} {dtmax} {self.step}"]
        if self.K is not None:
            lines += [f"fix gas all foam/coarsen {self.K:.17g} {self.kappa:.17g} "
                      f"rmin {self.rmin:.17g} {self.gas}"]
        return "\n".join([f"timestep {self.dt0:.17g}"] + lines[::-1 if self.gas_first else 1])

    def output(self):
        gas = "" if self.K is None else "f_gas[*]"
        return f"""
compute       b all foam/bubble contacts area free vfilm vliquid rdot espring edurian
compute       p all pressure NULL virial
thermo_style  custom step atoms time pe f_step[*] {gas} c_p[*]
{PRECISE}
thermo        {self.thermo or self.every}
dump          d all custom {self.every} dump id x y z xu yu zu vx vy vz fx fy fz radius c_b[*]
dump_modify   d sort id format float %.17g time yes
"""

    def begin(self):
        return f"""
units         lj
dimension     {self.dim}
atom_style    sphere 1
atom_modify   map array
boundary      {self.boundary}
{self.before}
"""

    def go_on(self, run, name="last"):
        return f"""
neighbor      {self.skin:.17g} {self.neighbor}
{self.fixes()}
{self.output()}
{self.after}
run           {run}
write_dump    all custom {name} id x y z vx vy vz fx fy fz radius modify sort id format float %.17g
"""    # the last state, since dumps are not written where a run ends early

    def input(self):
        rin = f"rin {self.rin:.17g}" if self.rin else ""
        return self.begin() + f"""
read_data     data
pair_style    durian/foam {self.mu0:.17g} {rin} {self.pair}
pair_coeff    * * {self.sigma0:.17g}
""" + self.go_on(self.run)

    def continued(self, name, run):
        """Input of a run that goes on from the restart file `name`."""
        text = self.begin() + f"read_restart {name} noremap\n" + self.go_on(run, name="last2")
        return text.replace("dump id", "dump2 id")

    def files(self):
        data = data_file(self.box, self.x, self.R)
        if self.tilt:
            tilt = " ".join(f"{t:.17g}" for t in self.tilt)
            data = data.replace("zlo zhi\n", f"zlo zhi\n{tilt} xy xz yz\n")
        return {"data": data}

    def but(self, **changes):
        return dataclasses.replace(self, **changes)

    def scaled(self, length=1.0, time=1.0, stiffness=1.0):
        """The same foam in other units, or one that is so much larger, slower, stiffer."""
        def sides(box):
            return [tuple(length * end for end in side) if np.iterable(side) else length * side
                    for side in box]
        return self.but(
            x=length * self.x, R=length * self.R, box=sides(self.box),
            tilt=self.tilt and tuple(length * t for t in self.tilt),
            skin=length * self.skin, rin=self.rin and length * self.rin,
            dt0=time * self.dt0, dtmax=self.dtmax and time * self.dtmax,
            K=self.K and self.K * length**2 / time,
            sigma0=stiffness * self.sigma0, mu0=stiffness * time * self.mu0)

    def __call__(self, lmp, check=True, **keywords):
        """Run it: with a result that is sound, or with the error that the caller looks at."""
        result = lmp(self.input(), files=self.files(), check=check, **keywords)
        if not result.returncode:
            assert_sound(result, self)
        return result


def assert_sound(result, scene):
    """Whatever the scene: the run came to its end, and nothing got lost on the way."""
    assert result.returncode == 0, result.screen[-2000:]
    thermo, frames = result.thermo[0], result.dump("dump") + [last(result)]
    ended = "coarsening ended" in result.screen
    n, dim = len(scene.R), scene.dim

    # every number is one
    for name, column in thermo.items():
        assert np.isfinite(column).all(), f"thermo {name}: {column}"
    for frame in frames:
        for name, column in frame._columns.items():
            assert np.isfinite(column).all(), f"{name} at step {frame.step}"

    # steps: as many as asked for unless the foam ended; time goes on, and most tries succeed
    steps, time = thermo["Step"], thermo["Time"]
    assert steps[-1] == scene.run or ended
    assert np.all(np.diff(time) > 0)
    assert time[-1] == thermo["f_step[1]"][-1]
    assert np.array_equal(thermo["f_step[3]"], steps)
    rejected = thermo["f_step[4]"][-1]
    assert rejected <= 2 * steps[-1] + 60, f"{rejected:.0f} rejected"    # 60: from any dt0
    assert np.all(thermo["f_step[6]"][1:] <= scene.tol)

    # bubbles: none unaccounted for, none back from the dead
    if scene.K is None:
        assert np.all(thermo["Atoms"] == n)
    else:
        assert np.array_equal(thermo["Atoms"], thermo["f_gas[2]"])
        assert np.all(thermo["Atoms"] + thermo["f_gas[7]"] == n)
    assert frames[-1].step == steps[-1]
    rows, ids = {step: row for row, step in enumerate(steps)}, set(range(1, n + 1))
    for frame in frames:
        row, now = rows[frame.step], set(frame["id"])
        assert len(frame) == len(now) == thermo["Atoms"][row]
        assert frame.time in (None, pytest.approx(time[row], rel=1e-14))    # 16 digits
        assert now <= ids, f"{now - ids} at step {frame.step}"
        ids = now

    # gas: the radii themselves, and the figure of the fix
    gas = (scene.R**dim).sum()
    for frame in frames:
        R = frame["radius"]
        assert np.all(R > 0)
        if scene.K is None:
            assert np.array_equal(R, scene.R)
            continue
        assert abs((R**dim).sum() / gas - 1) < scene.gas_limit, f"gas at step {frame.step}"
        if frame.step:
            assert R.min() >= scene.rmin * scene.mean * (1 - 1e-15)
    if scene.K is not None:
        content = np.pi if dim == 2 else 4 * np.pi / 3
        if scene.boundary == "p p p" and not scene.box_moves:
            assert np.abs(thermo["f_gas[5]"] * scene.volume / (content * gas) - 1).max() < scene.gas_limit
        assert np.all(thermo["f_gas[4]"] * (1 + 1e-14) >= thermo["f_gas[3]"])    # largest, mean

    # forces between bubbles add up to none, as far as their own size lets them
    for frame in frames:
        f = frame.array(*["fx", "fy", "fz"][:dim])
        if "fix" not in scene.after:
            assert np.abs(f.sum(0)).max() <= 1e-14 * len(f) * max(np.abs(f).max(), scene.mean * scene.sigma0)

    # bubbles are in their box, but for what they moved since the last list build
    if scene.boundary == "p p p" and not scene.box_moves:
        lo = np.array([0.0 if np.isscalar(s) else s[0] for s in scene.box])
        sides = np.array([s if np.isscalar(s) else s[1] - s[0] for s in scene.box])
        h = np.diag(sides[:3] if dim == 3 else [*sides[:2], 1.0])
        h[0, 1], h[0, 2], h[1, 2] = scene.tilt or (0, 0, 0)
        slack = np.abs(np.linalg.inv(h)).sum(1)[:dim] * scene.skin
        for frame in frames:
            x = frame.array("x", "y", "z")
            x[:, :dim] -= lo[:dim]
            part = np.linalg.solve(h, x.T).T[:, :dim]
            assert np.all(part > -slack) and np.all(part < 1 + slack), f"outside at {frame.step}"
            if dim == 2:
                assert np.all(x[:, 2] == 0.0)


# ---- foams --------------------------------------------------------------------------------------

def radii(random, n, spread, smallest=0.1):
    """Gaussian around 1; those that would be too small take another value."""
    R = random.normal(1.0, spread, n)
    while np.any(R < smallest):
        small = R < smallest
        R[small] = random.normal(1.0, spread, small.sum())
    return R


def box_for(R, dim, phi, shape=None):
    """Sides of a box, in the proportions of shape, for the gas fraction phi."""
    shape = np.ones(dim) if shape is None else np.asarray(shape, float)
    content = (np.pi if dim == 2 else 4 * np.pi / 3) * (R**dim).sum()
    return list(shape * (content / phi / shape.prod())**(1 / dim))


def anywhere(dim, n, phi, spread=0.21, seed=1, shape=None, **keywords):
    """n bubbles anywhere in a box: some on top of each other, whatever phi."""
    random = np.random.default_rng(seed)
    R = radii(random, n, spread)
    box = box_for(R, dim, phi, shape)
    return Scene(random.random((n, dim)) * box, R, box, **keywords)
