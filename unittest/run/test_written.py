"""The LAMMPS input says what the thesis' input means."""

import re

import pytest

from lammps_foam.run import lammps_input, thesis_input
from lammps_foam.run.thesis_input import Unusable
from thesis import FLAT, NESTED, written


def text_of(tmp_path, changes=None, data=NESTED, **options):
    foam = thesis_input.read(written(tmp_path / "foam.json", data, changes))
    return lammps_input.new_run(foam, "foam.json", **options)


def settings(text):
    return dict(re.findall(r"^variable +(\w+) +index +(\S+)", text, re.M))


def commands(text):
    """Lines as LAMMPS joins them, without comments."""
    joined = re.sub(r"&\n *", "", re.sub(r" #.*", "", text))
    return [" ".join(row.split()) for row in joined.splitlines() if row and not row.startswith("#")]


def test_settings(tmp_path):
    """Numbers come through to the last bit."""
    values = {"constants.phi.value": 0.1 + 0.2, "bubbles.radius.mean": 2.0, "constants.K.value": 1e-3 / 3}
    found = settings(text_of(tmp_path, values))
    assert float(found["phi"]) == 0.1 + 0.2 and float(found["K"]) == 1e-3 / 3
    assert (found["N"], found["end"], found["seed"], found["nrelax"]) == ("100", "60", "426", "100")
    assert float(found["limit"]) == 1.0 * (1e-3 / 3) / 2.0**2    # of the energy per time; the input has it per tau
    assert float(found["tol"]) == 1e-5


def test_mechanics(tmp_path):
    lines = commands(text_of(tmp_path))
    assert "boundary p p p" in lines and "dimension 2" in lines
    assert "create_foam ${N} ${seed} start grid box 1 1 sizes normal ${mean} ${std} rmin ${rmin}" in lines
    assert "fix step all foam/abm ${tol} norm max path yes" in lines
    assert "fix gas all foam/coarsen ${K} ${kappa} rmin ${rmin} nmin ${end}" in lines
    assert not any("foam/wall" in line or "foam/flow" in line or "drag neighbor" in line for line in lines)


def test_walls(tmp_path):
    lines = commands(text_of(tmp_path, {"box.wall.y": 1, "box.wall.z": 1, "box.dimensionality": 3, "box.wall.drag": 0.3,
                                        "box.relativeDimensions.z": 2}))
    assert "boundary p f f" in lines
    assert "fix walls all foam/wall ylo yhi zlo zhi drag ${walldrag}" in lines
    assert "variable walldrag index 0.3" in lines
    assert any("box 1 1 2 sizes" in line for line in lines)


def test_flow(tmp_path):
    """Velocity in units of sigma <R> / mu; a face of the flow at one of the box is none; z counts in 3D."""
    changes = {"flow.impose": 1, "constants.sigma.value": 3, "bubbles.radius.mean": 2, "constants.mu.value": 4}
    lines = commands(text_of(tmp_path, changes))
    region, = (line for line in lines if line.startswith("region flow"))
    assert region == ("region flow block INF $(xlo+lx*0.5:%.17g) $(ylo+ly*0.4:%.17g) $(ylo+ly*0.6:%.17g) INF INF")
    assert "fix flow all foam/flow region flow velocity 0.015 0 0 touch yes" in lines
    # the foam relaxes with the liquid at rest
    static = lines.index("pair_style durian/foam ${mu} drag static rin ${mean}")
    relax = next(n for n, line in enumerate(lines) if line.startswith("relax_foam"))
    assert static < relax < lines.index("pair_style durian/foam ${mu} drag neighbor rin ${mean}")
    changes |= {"box.dimensionality": 3, "flow.lbb.z": 0.25, "flow.tfr.z": 1.0, "flow.velocity.z": 1}
    lines = commands(text_of(tmp_path, changes))
    assert any(line.startswith("region flow") and line.endswith("$(zlo+lz*0.25:%.17g) INF") for line in lines)
    assert "fix flow all foam/flow region flow velocity 0.015 0 1.5 touch yes" in lines


def test_fast_integrator(tmp_path):
    text = text_of(tmp_path, integrator="rkc", tolerance=2e-3)
    assert "fix step all foam/rkc ${tol} norm rms path yes" in commands(text)
    assert settings(text)["tol"] == "0.002"
    assert "The input's rounds of 100 steps and its tolerance 1e-05" in text


def test_snapshots(tmp_path):
    assert "\ndump " not in text_of(tmp_path, {"snapShot.frequency": 0})
    dump, = (line for line in commands(text_of(tmp_path, gzip=True)) if line.startswith("dump "))
    assert dump.startswith("dump foam all custom/gz 1 foam.lammpstrj.gz id x y z ")


def test_first_step_and_notes(tmp_path):
    text = text_of(tmp_path, data=FLAT)
    assert settings(text)["dt0"] == "0.001"
    assert "# numBubblesPerCell is ignored" in text


def test_sections(tmp_path):
    """What resume needs is there, and a run that goes on has the same commands but for its beginning."""
    text = text_of(tmp_path)
    found = lammps_input.sections(text, "in.foam")
    assert list(found)[1:] == list(lammps_input.SECTIONS)
    resumed = lammps_input.going_on(text, "in.foam", "restart.100", "1,2,3")
    for section in ("settings", "mechanics", "coarsening", "run", "end"):
        assert found[section].strip() in resumed
    with pytest.raises(Unusable):
        lammps_input.sections("# nothing\n", "in.foam")


def test_width_and_characters(tmp_path):
    """Readable in an editor."""
    for changes in ({}, {"flow.impose": 1, "box.wall.x": 1}):
        text = text_of(tmp_path, changes)
        assert max(map(len, text.splitlines())) <= 125 and text.isascii() and "\t" not in text
