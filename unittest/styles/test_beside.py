"""LAMMPS commands beside the styles that would give wrong numbers without a word: they do not."""

import re

import numpy as np
import pytest

from runner import PRECISE, data_file
from test_commands import BASIC, GAS, data, foam, packing, printed

RATE = 0.02


def warnings(result, about):
    return [line for line in result.screen.splitlines() if "WARNING" in line and about in line]


# ---- fix deform ---------------------------------------------------------------------------------

SHEAR = f"""
change_box    all triclinic
variable      shift equal {RATE}*f_step[7]*ly
variable      rate equal {RATE}*ly
fix           shear all deform 1 xy variable v_shift v_rate remap x
"""
STRAIN = BASIC.replace("vol", "vol xy ly")


@pytest.mark.parametrize("integrator", ["abm", "rkc"])
@pytest.mark.parametrize("pre", ["", "pre no"])
def test_shear_after_another_run(lmp, integrator, pre):
    """The tilt follows the time since the shear began, whatever has been run before, and on through a
    second run: tilts and times are the sums of the same steps, so they differ by rounding."""
    body = f"run 50\nreset_timestep 0 time 0.0\n{SHEAR}run 40\nrun 40 {pre}"
    text = foam(body, gas="", step="1e-6 dtmax 0.2", output=STRAIN, thermo=1)
    _, first, second = lmp(text.replace("foam/abm", f"foam/{integrator}"), files=data()).thermo
    for table in (first, second):
        strain = table["Xy"] / table["Ly"]
        assert strain == pytest.approx(RATE * table["Time"], abs=1e-12)
    assert np.diff(first["Time"]).max() > 1.01 * np.diff(first["Time"]).min()    # a rate in time alone
    assert first["f_step[7]"][0] == 0.0
    if not pre:
        assert second["f_step[7]"][0] == 0.0


def test_shear_goes_on_after_a_restart(lmp):
    """In a run from a restart file the time of the run begins anew, and so does the tilt to which fix
    deform adds: no jump."""
    body = f"{SHEAR}restart 30 state\nrun 40"
    whole = lmp(foam(body, gas="", step="1e-3 dtmax 0.1", output=STRAIN, thermo=1), files=data())
    again = lmp(f"""
read_restart  state.30 noremap
neighbor      0.3 bin
fix           step all foam/abm 1e-3 dtmax 0.1
{STRAIN}
thermo        1
{SHEAR.replace('change_box    all triclinic', '')}
run           10
""", directory=whole.directory)
    for name in ("Xy", "Time"):
        assert again.thermo[0][name] == pytest.approx(whole.thermo[0][name][30:], abs=1e-12)


@pytest.mark.parametrize("words, warned", [
    ("xy erate 0.01", "erate"), ("xy vel 0.1", "vel"), ("x trate 0.01", "trate"),
    ("x wiggle 0.1 10.0", "wiggle"), ("x erate 0.01 y vel 0.1", "erate and vel"),
    ("x erate 0.01 y erate -0.01", "erate"),
    ("x final 0 15", None), ("x delta 0 -0.5", None), ("x scale 0.99", None),
    ("x scale 0.99 y volume", None), ("xy variable v_shift v_rate", None)])
def test_styles_of_deform_by_steps(lmp, words, warned):
    """Those that take steps for time are named; the others, among them the recipe, pass in silence."""
    body = SHEAR.replace("xy variable v_shift v_rate", words) + "run 2\nrun 2"
    result = lmp(foam(body, gas="", step="1e-3 dtmax 0.1"), files=data())
    said = warnings(result, "fix deform")
    if warned:
        assert len(said) == 1 and f"the style {warned} of fix deform" in said[0]
    else:
        assert not said


# ---- the timestep after a run -------------------------------------------------------------------

@pytest.mark.parametrize("integrator", ["abm", "rkc"])
def test_timestep_is_put_back(lmp, integrator):
    """Steps of a run are long; what comes after it, as min_style fire, has the timestep as it was given."""
    body = """timestep 0.01
run 100
print "dt $(dt:%.17g) $(f_step[2])"
min_style fire
minimize 0.0 1e-9 200 1000
run 20
print "again $(dt:%.17g) $(f_step[2])" """
    text = foam(body, gas="").replace("foam/abm", f"foam/{integrator}")
    result = lmp(text, files=data())
    dt, step = printed(result, "dt")
    assert dt == 0.01 and step > 0.1
    relaxed = result.thermo[1]["PotEng"]
    assert relaxed[-1] < relaxed[0]
    assert printed(result, "again")[0] == 0.01


def test_timestep_is_put_back_after_a_restart_in_a_run(lmp):
    """A restart file has the step just taken for the timestep."""
    whole = lmp(foam("timestep 0.01\nrestart 100 state\nrun 120", gas=""), files=data())
    text = """
read_restart  state.100
neighbor      0.3 bin
fix           step all foam/abm 1e-3
{}
run           20
print "dt $(dt:%.17g)"
"""
    assert printed(lmp(text.format(""), directory=whole.directory), "dt") == [0.01]
    assert printed(lmp(text.format("timestep 0.02"), directory=whole.directory), "dt") == [0.02]
    text = text.replace("run           20", "min_style fire\nminimize 0 0 20 40")    # steps by it at once
    assert printed(lmp(text.format(""), directory=whole.directory), "dt") == [0.01]


# ---- tau, K, <R_in> -----------------------------------------------------------------------------

def test_change_of_K(lmp):
    """tau is the integral of K dt / <R_in>^2: a change of K does not touch the past, and a new fix
    foam/coarsen or a restart goes on from it."""
    watch = 'print "{} $(f_gas[1]:%.17g) $(f_gas[7]) $(f_gas[8]:%.17g) $(time:%.17g)"\n'
    body = ("run 60\n" + watch.format("first") + "fix_modify gas K 0.3 kappa 0.2\nrun 60\n"
            + watch.format("second") + "unfix gas\nfix gas all foam/coarsen 0.05 0.1\n"
            + watch.format("new") + "run 60\n" + watch.format("third") + "write_restart state")
    result = lmp(foam(body, gas="0.1 0.1"), files=data())
    R = packing()[1].mean()
    first, second, new, third = (printed(result, name) for name in ("first", "second", "new", "third"))
    assert first[0] == pytest.approx(0.1 * first[3] / R**2, rel=1e-12)    # sums of 60 steps
    assert second[0] - first[0] == pytest.approx(0.3 * (second[3] - first[3]) / R**2, rel=1e-12)
    assert third[0] - second[0] == pytest.approx(0.05 * (third[3] - second[3]) / R**2, rel=1e-12)
    assert first[1] > 0 and third[1] >= second[1] >= first[1] and new[:3] == second[:3]
    assert third[1] == 100 - result.thermo[-1]["Atoms"][-1]

    again = lmp(f"""
read_restart  state
neighbor      0.3 bin
fix           step all foam/abm 1e-3
fix           other all foam/coarsen 0.1 0.1
{GAS.replace('f_gas', 'f_other')}
run           0
""", directory=result.directory)
    for value, name in zip(third[:3], ("f_other[1]", "f_other[7]", "f_other[8]")):
        assert again.thermo[0][name][0] == value


def test_fix_modify(bitwise_lmp):
    """Its keywords do what those of the fix do: the run that they are set for is the same."""
    words = "rmin 0.3 film no liquid lsw nmin 70"
    plain = bitwise_lmp(foam("run 300", gas=f"0.3 1.0 {words}"), files=data())
    changed = bitwise_lmp(foam(f"fix_modify gas K 0.3 {words} kappa 1.0\nrun 300", gas="1.0 0.0"), files=data())
    for name, column in plain.thermo[0].items():
        assert np.array_equal(column, changed.thermo[0][name]), name
    assert changed.thermo[0]["Atoms"][-1] <= 70
    result = bitwise_lmp(foam("fix_modify gas tau 5.0\nrun 0"), files=data())
    assert result.thermo[0]["f_gas[1]"][0] == 5.0


@pytest.mark.parametrize("before, words", [
    ("1e-3 0.0", "kappa 1.0"), ("0.0 0.1", "K 1e-2"), ("1e-2 0.3 film no", "film yes"),
    ("1e-2 0.0", "kappa 1.0 liquid lsw")])
def test_fix_modify_without_set_up(lmp, before, words):
    """A term that is switched on is there in a run without set-up, too: the same run as with one, but for
    the evaluation that the set-up takes, and sums in the order of another list: 2e-12 after 20 steps."""
    def after(pre):
        return lmp(foam(f"run 30\nfix_modify gas {words}\nrun 20 {pre}", gas=before), files=data())

    plain, other = after("").thermo[-1], after("pre no").thermo[-1]
    for name in ("Time", "PotEng", "f_gas[1]", "f_gas[3]", "f_gas[4]", "f_gas[6]"):
        assert other[name][-1] == pytest.approx(plain[name][-1], rel=1e-11, abs=1e-14), name
    assert other["f_gas[3]"][-1] != other["f_gas[3]"][0]


@pytest.mark.parametrize("words, what", [
    ("K -1", "K needs|K must be a number >= 0, not -1"), ("K", "keyword K needs a value"),
    ("kapa 0.1", r"unknown keyword kapa \(allowed are rmin, film, liquid, nmin, K, kappa, tau\)"),
    ("ain 3.0", "unknown keyword ain"), ("film maybe", "film must be no or yes")])
def test_fix_modify_refuses(lmp, words, what):
    result = lmp(foam(f"fix_modify gas {words}\nrun 0"), files=data(), check=False)
    assert result.returncode and re.search(f"Fix foam/coarsen: fix_modify.*({what})", result.errors[0])


def test_first_means_are_told_and_given(lmp):
    """<R_in> and <A_in> where they are taken, given, restored and handed over; as values of the fix, too."""
    R = packing()[1]
    means = (R.mean(), 2 * np.pi * R.mean())
    told = r"Pair style durian/foam: <R_in> = (\S+), <A_in> = (\S+), "
    result = lmp(foam("run 200\nrun 1\nwrite_restart state\nwrite_data old", gas="0.05 0.1"), files=data())
    assert [float(x) for x in re.findall(told + "means of the present bubbles", result.screen)[0]] \
        == pytest.approx(means, rel=1e-7)    # eight digits are printed
    assert len(re.findall(told, result.screen)) == 1
    for name, mean in zip(("f_gas[9]", "f_gas[10]"), means):
        assert result.thermo[-1][name][-1] == pytest.approx(mean, rel=1e-14)
    assert not warnings(result, "IDs")
    assert result.thermo[-1]["Atoms"][-1] < 100

    again = lmp("read_restart state\n", directory=result.directory)
    assert re.search(told + "from the restart file", again.screen)

    # read as data the foam has lost them

    for pair, warned in (("", 1), ("rin 1.0", 0)):
        text = foam("run 0", pair=pair).replace("read_data     data", "read_data     old nocoeff")
        other = lmp(text, directory=result.directory)
        assert len(warnings(other, "coarsened already: then give its first mean radius")) == warned
        assert re.search(told + ("the former as given" if pair else "means of"), other.screen)
    text = foam("reset_atoms id\nrun 0").replace("read_data     data", "read_data     old nocoeff")
    assert not warnings(lmp(text, directory=result.directory), "coarsened already")


def test_replaced_pair_style_goes_on(lmp):
    body = """run 60
print "before $(f_gas[1]:%.17g) $(f_gas[7]) $(f_gas[9]:%.17g)"
pair_style none
pair_style durian/foam 1.0
pair_coeff * * 1.0
run 0
print "after $(f_gas[1]:%.17g) $(f_gas[7]) $(f_gas[9]:%.17g)" """
    result = lmp(foam(body, gas="0.02 0.1"), files=data())
    assert printed(result, "before") == printed(result, "after")
    assert "as before" in result.screen


# ---- other commands -----------------------------------------------------------------------------

def test_rerun_is_refused_or_warned_of(base_lmp):
    result = base_lmp(foam("run 60", gas="0.05 0.1", dump="20"), files=data())
    rerun = "rerun ./dump dump x y"
    refused = base_lmp(foam(rerun), directory=result.directory, check=False)
    assert refused.returncode and "rerun reads no radii" in refused.errors[0]
    warned = base_lmp(foam(rerun, gas=""), directory=result.directory)
    assert len(warnings(warned, "rerun takes places from the dump")) == 1
    assert not warnings(result, "rerun")


# ---- fix press/berendsen ------------------------------------------------------------------------

@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("ranks", [1, 2])
def test_constant_pressure(each_lmp, dim, ranks):
    """The box breathes by LAMMPS' own fix, with the length of each step as it was accepted: by its formula, in all
    directions alike. A foam that exchanges gas comes to the pressure that is asked for, and keeps its gas."""
    x, R, box = packing(dim, 10 if dim == 2 else 6)
    target, period, bulk = 0.05, 5.0, 0.5
    result = each_lmp(foam(f"""run 100
thermo 1
compute bare all pressure NULL virial
fix barostat all press/berendsen iso {target} {target} {period} modulus {bulk}
fix_modify barostat press bare
variable area atom radius^{dim}
compute gas all reduce sum v_area
thermo_style custom step time dt vol c_bare c_gas
{PRECISE}
run 300""", gas="1e-3 0.1", dim=dim), files={"data": data_file([box] * dim, x, R)}, ranks=ranks)
    step = result.thermo[-1]
    h = np.diff(step["Time"])
    assert h == pytest.approx(step["Dt"][1:], rel=1e-9) and h.max() > 1.5 * h.min()
    grown = step["Volume"][1:] / step["Volume"][:-1]
    before = step["c_bare"][1:] * grown    # output takes the same virial by the volume after the box has been moved
    assert grown == pytest.approx((1 - h / period * (target - before) / bulk)**(dim / 3), rel=1e-9)
    assert step["c_gas"] == pytest.approx(step["c_gas"][0], rel=1e-12)
    assert abs(step["c_bare"][0] / target - 1) > 0.1
    assert step["c_bare"][-1] == pytest.approx(target, rel=0.02)    # it lags behind what coarsening changes


def test_inertia_is_warned_of(lmp):
    body = "unfix step\nfix move all nve/sphere\ntimestep 0.001\nrun 2\nrun 2"
    result = lmp(foam(body, gas="", output="thermo_style custom step pe"), files=data())
    said = warnings(result, "by their inertia")
    assert len(said) == 1 and "fix nve/sphere" in said[0]
    assert not warnings(lmp(foam("run 2"), files=data()), "by their inertia")


@pytest.mark.parametrize("gas, R, warned", [
    ("0.01 0.1", np.ones(100), 1), ("0.0 0.1", np.ones(100), 0),
    ("0.01 0.1", np.linspace(0.999, 1.001, 100), 0)])
@pytest.mark.parametrize("dim, variable", [(2, "volume"), (2, "radius"), (3, "volume")])
def test_no_exchange_at_all(lmp, gas, R, warned, dim, variable):
    x, _, box = packing(dim, 10 if dim == 2 else 5)
    R = np.resize(R, len(x))
    result = lmp(foam("run 1\nrun 1", gas=gas, dim=dim, step=f"1e-3 variable {variable}"),
                 files={"data": data_file([box] * dim, x, R)})
    assert len(warnings(result, "no gas is exchanged")) == warned


NO_NUMBER = re.compile(r"the place of bubble (\d+), of radius (\S+) and at (\S+) (\S+) \S+ when .* is no number")


def test_bubble_of_a_bad_force_is_named(lmp):
    """A force that is no number: the error names the bubble on which it acts."""
    body = """variable fx atom "ternary(id==17, 1.0e200*1.0e200, 0.0)"
fix bad all addforce v_fx 0.0 0.0
run 10"""
    result = lmp(foam(body, gas=""), files=data(), check=False)
    x, R, _ = packing()
    assert result.returncode
    found = NO_NUMBER.search(result.errors[0])
    assert found[1] == "17"
    assert [float(found[k]) for k in (2, 3, 4)] == pytest.approx([R[16], *x[16]], rel=1e-7)


def test_bubble_at_a_wall_without_numbers_is_named(base_lmp):
    """The older form of fix wall/gran makes 0/0 of a damping of 0, for bubbles that move at the wall: the
    first step passes, and in the next one the place of that bubble is no number either."""
    body = """fix wall all wall/gran hooke 1.0 NULL 0.0 NULL 0.0 0 xplane 0.0 10.0
run 10"""
    files = {"data": data_file([10, 10], [[0.8, 5.0], [5.0, 5.0]], [1.0, 1.0])}
    text = foam(body, gas="").replace("boundary      p p p", "boundary f p p")
    result = base_lmp(text, files=files, check=False)
    assert result.returncode and NO_NUMBER.search(result.errors[0])[1] == "1"


def test_styles_are_told_at_load(lmp):
    line = re.search("Foam package: (.*)", lmp("print hello\n").screen)[1]
    styles = ("pair_style durian/foam", "fix foam/coarsen", "fix foam/contacts", "fix foam/flow", "fix foam/abm",
              "fix foam/rkc", "fix foam/wall", "compute foam/bubble", "pair_style bubble/collision", "fix bubble/rise",
              "fix wall/bubble", "fix bubble/nve", "pair_style liquid/sph", "fix liquid/flow", "fix bubble/flow",
              "compute bubble/collision", "fix bubble/sparger", "compute liquid/particle", "compute bubble/flow",
              "command create_foam", "command relax_foam")
    assert line.replace(", each also with /kk", "").split(", ") == list(styles)
    assert ("/kk" in line) == lmp.kokkos
