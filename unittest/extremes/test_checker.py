"""assert_sound() finds what it is there to find: a sound result, with one thing wrong at a time."""

import copy
from types import SimpleNamespace

import numpy as np
import pytest

from runner import HEAD, Runner
from scenes import anywhere, assert_sound

SCENE = anywhere(2, 40, 0.9, K=0.3, run=60)


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    result = SCENE(Runner("wheel", tmp_path_factory.mktemp("sound")))
    assert result.thermo[0]["f_gas[7]"][-1] > 0    # bubbles have vanished
    return result


def swap(column, i, value):
    column[i] = value


def drop(frame, i):
    for name, column in frame._columns.items():
        frame._columns[name] = np.delete(column, i)


WRONG = {
    "NaN in thermo": lambda t, f: swap(t["PotEng"], 3, np.nan),
    "NaN of a bubble": lambda t, f: swap(f[3]["vx"], 0, np.nan),
    "infinite force": lambda t, f: swap(f[-1]["fy"], 2, np.inf),
    "steps missing": lambda t, f: [t.update({name: t[name][:-1]}) for name in list(t)],
    "time stands still": lambda t, f: swap(t["Time"], 2, t["Time"][1]),
    "two times": lambda t, f: swap(t["f_step[1]"], -1, t["Time"][-1] * 1.01),
    "rejected for ever": lambda t, f: swap(t["f_step[4]"], -1, 1000),
    "error above the tolerance": lambda t, f: swap(t["f_step[6]"], 2, 2e-3),
    "N of the fix": lambda t, f: swap(t["f_gas[2]"], 2, t["f_gas[2]"][2] - 1),
    "removed unseen": lambda t, f: swap(t["f_gas[7]"], 4, t["f_gas[7]"][4] + 1),
    "N of the dump": lambda t, f: drop(f[2], 5),
    "back from the dead": lambda t, f: swap(f[-1]["id"], 0, 41),
    "gas lost": lambda t, f: swap(f[4]["radius"], 1, f[4]["radius"][1] * (1 + 1e-9)),
    "gas of the fix": lambda t, f: swap(t["f_gas[5]"], 2, t["f_gas[5]"][2] * (1 + 1e-11)),
    "no radius": lambda t, f: swap(f[1]["radius"], 0, 0.0),
    "push from outside": lambda t, f: swap(f[2]["fx"], 0, f[2]["fx"][0] + 1e-9),
    "outside": lambda t, f: swap(f[2]["x"], 0, SCENE.box[0] + 1.0),
    "out of the plane": lambda t, f: swap(f[2]["z"], 0, 1e-3),
}


def tampered(result, change=lambda thermo, frames: None):
    thermo, frames = copy.deepcopy(result.thermo[0]), copy.deepcopy(result.dump("dump"))
    change(thermo, frames)
    files = {"dump": frames, "last": result.dump("last")}
    return SimpleNamespace(returncode=0, screen=result.screen, thermo=[thermo], dump=files.get)


def test_sound(sound):
    assert_sound(tampered(sound), SCENE)


@pytest.mark.parametrize("what", WRONG)
def test_wrong(sound, what):
    with pytest.raises(AssertionError):
        assert_sound(tampered(sound, WRONG[what]), SCENE)


@pytest.mark.parametrize("value", ["10^400-10^400", "10^400", "-(10^400)"])
def test_no_number_in_thermo(lmp, value):
    """LogFile would leave the line out."""
    text = HEAD.format(dim=2) + f"""
region        box block 0 1 0 1 -0.5 0.5
create_box    1 box
variable      bad equal {value}
thermo_style  custom step v_bad
run           0
"""
    with pytest.raises(pytest.fail.Exception, match="thermo output that is no number: .*(nan|inf)"):
        lmp(text)
