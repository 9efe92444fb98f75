"""A resolved liquid: every quantity of a step against numbers that were not made by this package, and flows whose laws
are known."""

import csv
from pathlib import Path

import numpy as np
import pytest

REFERENCE = Path(__file__).parents[1] / "reference" / "liquid"


def table(name):
    with (REFERENCE / name).open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def totals(name):
    with (REFERENCE / f"{name}.totals.csv").open(newline="") as file:
        return {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}


def vectors(*pairs):
    return {ours + x: theirs + x for ours, theirs in pairs for x in "xyz"}


# what computes call a column: what the reference calls it
PARTICLE = {**{name: name for name in ("c", "alpha", "h", "cover", "surface", "k", "eps")},
            "s": "S", "nus": "nu_S", "nub": "nu_B", "divstar": "div_u_star", "pnew": "p_new",
            **vectors(("n", "n_"), ("shift", "shift_"), ("m", "M_"), ("viscous", "viscous_"), ("ustar", "u_star_"),
                      ("p", "grad_p_new_"), ("gradux", "grad_u_x"), ("graduy", "grad_u_y"), ("graduz", "grad_u_z"))}
BUBBLE = {"vlb": "V_lb", "k": "k", "eps": "eps", "nub": "nu_b",
          **vectors(("ul", "u_l_"), ("curl", "curl_"), ("fd", "F_d_"), ("fl", "F_l_"), ("fvm", "F_vm_"),
                    ("fg", "F_g_"), ("a", "acceleration_"), ("m", "M_"))}
SOLVED = {"pnew", "px", "py", "pz"}


def lines(*columns):
    return "".join(" ".join(f"{value:.17g}" for value in row) + "\n" for row in zip(*columns))


def state(name):
    """Data file: particles are of type 1, bubbles of type 2; pressure and acceleration before are properties."""
    liquid, bubbles, known = table(f"{name}.liquid.csv"), table(f"{name}.bubbles.csv"), totals(name)
    n, m = len(liquid["id"]), len(bubbles["id"])
    ids = np.arange(1, n + m + 1)

    def both(key, gas):
        return np.concatenate([liquid[key], gas])

    kinds, diameters = np.repeat([1, 2], [n, m]), np.concatenate([np.full(n, known["dr"]), 2 * bubbles["a"]])
    places, speeds = ([both(f"{q}_{x}", bubbles[f"{q}_{x}"]) for x in "xyz"] for q in "ru")
    zeros = np.zeros(n + m)
    before = [both(key, np.zeros(m)) for key in ("p", "dudt_x", "dudt_y", "dudt_z")]
    return (f"a liquid with bubbles\n\n{n + m} atoms\n2 atom types\n\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\n"
            f"Atoms # sphere\n\n{lines(ids, kinds, diameters, zeros + 6 / np.pi, *places)}\n"
            f"Velocities\n\n{lines(ids, *speeds, zeros, zeros, zeros)}\nBefore\n\n{lines(ids, *before)}")


def script(name, newton="on", more=""):
    known = totals(name)
    z, wall = ("p", "") if name == "periodic" else ("f", "wall zlo noslip")
    return f"""
units         lj
newton        {newton}
atom_style    sphere 1
boundary      p p {z}
comm_modify   vel yes
fix           before all property/atom d_p d_ax d_ay d_az
read_data     data fix before NULL Before
variable      p atom d_p
variable      ax atom d_ax
variable      ay atom d_ay
variable      az atom d_az
group         water type 1
group         gas type 2
pair_style    liquid/sph {known["dr"]}
pair_coeff    * *
neighbor      0.05 bin
fix           l water liquid/flow {known["Re"]} {known["Fr"]} ma {known["Ma"]} dtmax {known["dt"]:.17g} {wall} &
              solver 1.0e-13 1000 shift published gravity published divergence published &
              pressure v_p acceleration v_ax v_ay v_az
fix           b gas bubble/flow {known["We"]} {known["beta"]:.17g} viscosity published
compute       c water liquid/particle {" ".join(PARTICLE)}
compute       d gas bubble/flow {" ".join(BUBBLE)}
dump          d all custom 1 dump id c_c[*] c_d[*]
dump_modify   d sort id format float %.17g
{more}
"""


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "on"), (4, "off")])
@pytest.mark.parametrize("name", ["periodic", "tank"])
def test_reference(base_lmp, name, ranks, newton):
    """To rounding, of sums of 100 numbers, 1e-13 of the largest; of what the pressure is found by, to 1e-11, since
    the solver ends at 1e-13 of the right side and the matrix has a condition of some 100."""
    frame = base_lmp(script(name, newton, "run 0"), files={"data": state(name)}, ranks=ranks).dump("dump")[0]
    liquid, bubbles = table(f"{name}.liquid-rates.csv"), table(f"{name}.bubble-rates.csv")
    n = len(liquid["id"])
    for prefix, names, of, reference in (("c_c", PARTICLE, slice(n), liquid), ("c_d", BUBBLE, slice(n, None), bubbles)):
        for column, (ours, theirs) in enumerate(names.items(), 1):
            expected = reference[theirs]
            size = np.abs(expected).max()
            assert frame[f"{prefix}[{column}]"][of] == pytest.approx(
                expected, rel=0, abs=size * (1e-11 if ours in SOLVED else 1e-12) + 1e-300), ours


@pytest.mark.parametrize("name", ["periodic", "tank"])
def test_exchange_conserves_momentum(lmp, name):
    """What the particles get is what bubbles give: sum V_i M_i = sum M_b, also where drag is taken in sub-steps."""
    frames = lmp(script(name, "off", "run 3"), files={"data": state(name)}).dump("dump")
    n, dr = len(table(f"{name}.liquid.csv")["id"]), totals(name)["dr"]
    at, of = list(PARTICLE), list(BUBBLE)
    for frame in frames:
        for x in "xyz":
            got = dr**3 / frame[f"c_c[{at.index('alpha') + 1}]"][:n] * frame[f"c_c[{at.index('m' + x) + 1}]"][:n]
            given = frame[f"c_d[{of.index('m' + x) + 1}]"][n:]
            assert got.sum() == pytest.approx(given.sum(), rel=0, abs=1e-14 * np.abs(given).sum() * n)


# ---- a vortex that decays -----------------------------------------------------------------------

VORTEX = """
units         lj
atom_style    sphere 1
boundary      p p p
comm_modify   vel yes
variable      dr equal 1.0/{n}
lattice       sc $(1/v_dr^3) origin 0.5 0.5 0.5
region        box block 0 1 0 1 0 $(6*v_dr) units box
create_box    1 box
create_atoms  1 box
set           group all diameter ${{dr}} density $(6/PI)
variable      ux atom sin(2*PI*x)*cos(2*PI*y)
variable      uy atom -cos(2*PI*x)*sin(2*PI*y)
velocity      all set v_ux v_uy 0.0
pair_style    liquid/sph ${{dr}}
pair_coeff    * *
neighbor      $(0.6*v_dr) bin
fix           l all liquid/flow {Re} none les none {more}
thermo        1
thermo_style  custom step time f_l[2] f_l[3] f_l[4] f_l[5] f_l[6]
thermo_modify norm no format float %.17g
"""


def test_friction_is_of_second_order(lmp):
    """The viscous term is nu times the Laplacian of u, -8 pi^2 u, times what the sums give of the Laplacian of x^2 on
    this lattice, a third of the cover, but for an error of second order in dr: it falls by 4, less a tenth by the next
    order."""
    Re, errors = 100, []
    for n in 16, 32:
        frame = lmp(VORTEX.format(n=n, Re=Re, more="") + """
compute       c all liquid/particle viscousx viscousy cover
dump          d all custom 1 dump id vx vy c_c[*]
run           0
""").dump("dump")[0]
        u, found = frame.array("vx", "vy"), frame.array("c_c[1]", "c_c[2]")
        expected = -8 * np.pi**2 / Re * u * frame["c_c[3]"][:, None] / 3
        errors.append(np.sqrt(np.mean((found - expected)**2) / np.mean(expected**2)))
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] < 0.01


def test_vortex_decays(lmp):
    """Short steps take what friction does: the work of the viscous term, to the first order in the 10^-3 of its time
    that they last. What the projection takes from the rest is less: on the lattice there is no divergence."""
    rows = lmp(VORTEX.format(n=16, Re=100, more="dtmax 1e-3") + """
compute       c all liquid/particle viscousx viscousy
variable      power atom (vx*c_c[1]+vy*c_c[2])*v_dr^3
compute       power all reduce sum v_power
thermo_style  custom step time f_l[5] c_power
thermo_modify norm no format float %.17g
run           1
""").thermo[0]
    lost = (rows["f_l[5]"][1] - rows["f_l[5]"][0]) / rows["Time"][1]
    assert lost == pytest.approx(rows["c_power"][0], rel=5e-3)


# ---- along walls --------------------------------------------------------------------------------

CHANNEL = """
units         lj
atom_style    sphere 1
boundary      p f f
comm_modify   vel yes
lattice       sc 512 origin 0.5 0.5 0.5
region        box block 0 1 0 1 0 1 units box
create_box    1 box
create_atoms  1 box
displace_atoms all random 0.0125 0.0125 0.0125 1 units box
set           group all diameter 0.125 density $(6/PI)
velocity      all set 1.0 0.0 0.0 units box
pair_style    liquid/sph 0.125
pair_coeff    * *
neighbor      0.075 bin
fix           l all liquid/flow 1.0e13 none les none {more} &
              wall ylo noslip wall yhi noslip wall zlo noslip wall zhi noslip
compute       p all liquid/particle p
compute       most all reduce maxabs c_p vy vz
variable      faster atom vx-1
compute       change all reduce maxabs v_faster
thermo_style  custom step f_l[5] c_most[*] c_change
thermo_modify norm no format float %.17g
thermo        1
run           20
"""


def test_liquid_slides_along_walls(lmp):
    """A channel that sticks, with particles in disorder that all have one velocity: without viscosity it stays.
    What viscosity is left takes some 4 / (Re dr^2) = 2.6e-11 in a unit of time, and there are 20 steps of 0.0325."""
    rows = lmp(CHANNEL.format(more="")).thermo[0]
    for what in "c_most[1]", "c_most[2]", "c_most[3]", "c_change":
        assert rows[what][1:] == pytest.approx(0, abs=2e-11), what
    assert rows["f_l[5]"] == pytest.approx(0.5, rel=4e-11)


def test_liquid_that_sticks_to_walls_as_published(lmp):
    """With images that are reversed the same liquid gets energy from nothing."""
    rows = lmp(CHANNEL.format(more="divergence published")).thermo[0]
    assert rows["f_l[5]"][-1] > 0.5002 and rows["c_change"][-1] > 5e-3


# ---- at rest ------------------------------------------------------------------------------------

TANK = """
units         lj
atom_style    sphere 1
boundary      p p f
comm_modify   vel yes
variable      dr equal 1.0/12
lattice       sc $(1/v_dr^3) origin 0.5 0.5 0.5
region        box block 0 $(6*v_dr) 0 $(6*v_dr) 0 1.5 units box
region        full block 0 $(6*v_dr) 0 $(6*v_dr) 0 1 units box
create_box    1 box
create_atoms  1 region full
set           group all diameter ${{dr}} density $(6/PI)
pair_style    liquid/sph ${{dr}}
pair_coeff    * *
neighbor      $(0.6*v_dr) bin
fix           l all liquid/flow 1e4 1.0 wall zlo {wall} {more}
compute       p all liquid/particle p
dump          d all custom 200 dump id z vx vy vz c_p
dump_modify   d sort id format float %.17g
thermo_style  custom step time f_l[5]
"""


@pytest.mark.parametrize("wall", ["slip", "noslip"])
def test_liquid_at_rest(lmp, wall):
    """On a lattice sums of linear functions are exact: p = z_s - z, where p is 0 at the highest particles, and nothing
    moves. What is left is what the solver leaves of the pressure, 1e-6 of it, in a step: velocities of
    1e-6 dt / Fr^2 / dr, less than 1e-5."""
    first, last = lmp(TANK.format(wall=wall, more="") + "run 200\n").dump("dump")
    top = first["z"].max()
    for frame in first, last:
        assert frame["c_p"] == pytest.approx(top - first["z"], abs=1e-4)
        assert np.abs(frame.array("vx", "vy", "vz")).max() < 1e-5
    assert last["z"] == pytest.approx(first["z"], abs=1e-4)
