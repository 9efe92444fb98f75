"""Tables and dumps are read as far as they are whole, and cut back to the step of a restart file that is whole."""

import gzip
import json
import math

import numpy as np
import pytest

from lammps_foam.run import lammps_input, restart, snapshots, tables, thesis_input
from lammps_foam.run.thesis_input import Unusable
from thesis import written

NAMES = list(lammps_input.COLUMNS)
MAGIC = b"LammpS RestartT\0"


def line(step, tau=None, energy=1.0):
    values = {"step": step, "tau": step / 1000 if tau is None else tau, "N": 100, "R": 1.0, "energy": energy,
              "edurian": 2 * energy}
    return ",".join(f"{values.get(name, 0):.10g}" for name in NAMES)


def series(path, steps, rest=""):
    path.write_text("\n".join([",".join(NAMES), *map(line, steps)]) + "\n" + rest)
    return path


COLUMNS = "id x y z ix iy iz radius vx vy vz path distance energy rdot contacts"


def frame(step, rows, side=10.0, lo=0.0):
    text = f"ITEM: TIME\n{step / 10}\nITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\n"
    text += f"ITEM: BOX BOUNDS pp pp pp\n{lo} {lo + side}\n{lo} {lo + side}\n-0.5 0.5\nITEM: ATOMS {COLUMNS}\n"
    return text + "".join(" ".join(map(str, row)) + "\n" for row in rows)


def bubble(i, x, y, ix=0, iy=0, vx=3.0, vy=4.0):
    return [i, x, y, 0, ix, iy, 0, 1.5, vx, vy, 0, 7, 8, 9, 0, 3]


def restart_file(directory, step, content=b"state", end=MAGIC):
    path = directory / f"restart.{step}"
    path.write_bytes(MAGIC + content + end)
    return path


# ---- series.csv -----------------------------------------------------------------------------------------------------

def test_series_with_a_cut_line(tmp_path):
    """At each byte: whole lines are whole, the rest is told apart."""
    whole = series(tmp_path / "whole", [0, 50, 100]).read_text()
    path = tmp_path / "series.csv"
    for end in range(len(whole) + 1):
        path.write_text(whole[:end])
        read = tables.read_series(path)
        lines = whole[:end].split("\n")
        assert read.rest == lines[-1]
        assert read.lines == lines[1:-1]


@pytest.mark.parametrize("damaged", ["50,abc", line(50) + ",7", line(50)[:-2], line(0), ""])
def test_damaged_series(tmp_path, damaged):
    path = tmp_path / "series.csv"
    path.write_text("\n".join([",".join(NAMES), line(0), damaged, line(100)]) + "\n")
    with pytest.raises(Unusable, match="series.csv:3: .*damaged"):
        tables.read_series(path)


# ---- dumps ----------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("packed", [False, True])
def test_cut_dump(tmp_path, packed):
    """Cut anywhere, a dump has its whole frames; cut back, it has those up to the step."""
    parts = [frame(step, [bubble(1, 1, 2), bubble(2, 3, 4)]) for step in (0, 20, 40)]
    path = tmp_path / ("foam.lammpstrj.gz" if packed else "foam.lammpstrj")
    raw = "".join(parts).encode()
    ends = np.cumsum([len(part) for part in parts])
    for end in (0, 1, ends[0] - 1, ends[0], ends[0] + 40, ends[1], ends[2] - 3, ends[2]):
        if packed:    # a stream without its end
            with gzip.open(path, "wb") as file:
                file.write(raw[:end])
                file.flush()
            path.write_bytes(path.read_bytes()[:-8])
        else:
            path.write_bytes(raw[:end])
        whole = int(np.sum(ends <= end))
        assert [one.step for one in tables.frames(path)] == [0, 20, 40][:whole]
        tables.plan_cut(path, 20).do()
        kept = gzip.open(path).read() if packed else path.read_bytes()
        assert kept == raw[:ends[min(whole, 2) - 1] if whole else 0]


def test_damaged_dump(tmp_path):
    path = tmp_path / "foam.lammpstrj"
    text = frame(0, [bubble(1, 1, 2)]) + frame(20, [bubble(1, 1, 2)])
    path.write_text(text.replace("ITEM: TIMESTEP\n20", "ITEM: STEP\n20"))
    with pytest.raises(Unusable, match=r"foam.lammpstrj:15: .*damaged"):
        list(tables.frames(path))
    path.write_text(text.replace("ITEM: NUMBER OF ATOMS\n1", "ITEM: NUMBER OF ATOMS\n2", 1))
    with pytest.raises(Unusable, match="damaged"):
        list(tables.frames(path))


# ---- restart files --------------------------------------------------------------------------------------------------

def test_restart_cut_anywhere(tmp_path):
    path = restart_file(tmp_path, 7, content=bytes(50))
    whole = path.read_bytes()
    assert restart.damage(path) is None
    for end in range(len(whole)):
        path.write_bytes(whole[:end])
        assert restart.damage(path)
    assert "no restart file" in restart.damage(written(tmp_path / "restart.8"))


def test_pruning(tmp_path):
    """The last two whole ones stay, and those that are being written."""
    for step in (0, 100, 900, 1000):
        restart_file(tmp_path, step)
    restart_file(tmp_path, 1100, end=b"")
    (tmp_path / "restart.mine").write_text("")
    restart.prune(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["restart.1000", "restart.1100", "restart.900",
                                                                "restart.mine"]


@pytest.fixture
def run(tmp_path):
    """A directory as a killed run leaves it: restart files at 0, 120 and 240, lines to 250 and a part of one."""
    foam = thesis_input.read(written(tmp_path / "input.json"))
    (tmp_path / "in.foam").write_text(lammps_input.new_run(foam, "input.json"))
    (tmp_path / "log.foam").write_text("")
    series(tmp_path / "series.csv", range(0, 300, 50), rest="300,0.3,1")
    (tmp_path / "foam.lammpstrj").write_text("".join(frame(s, [bubble(1, 1, 2)]) for s in (0, 100, 200, 245)) + "ITEM")
    for step in (0, 120, 240):
        restart_file(tmp_path, step)
    return tmp_path


def content(directory):
    return {path.name: path.read_bytes() for path in directory.iterdir()}


def steps(directory):
    return [int(row.split(",")[0]) for row in tables.read_series(directory / "series.csv").lines]


def test_resume_cuts_tables(run):
    before = content(run)
    plan = restart.plan(run)
    assert content(run) == before    # a plan changes nothing
    plan.do(run)
    # the last line before step 240 is the title in in.resume, which LAMMPS writes
    assert steps(run) == [0, 50, 100, 150]
    text = (run / "in.resume").read_text()
    assert f'variable      title string "{line(200)}"' in text
    assert "read_restart  restart.240 noremap" in text
    for absent in ("create_foam", "relax_foam", "string file"):
        assert absent not in text
    assert [one.step for one in tables.frames(run / "foam.lammpstrj")] == [0, 100, 200]
    # killed before LAMMPS wrote anything, and resumed again: the line is not lost
    restart.plan(run).do(run)
    assert steps(run) == [0, 50, 100, 150]
    assert f'variable      title string "{line(200)}"' in (run / "in.resume").read_text()


def test_resume_takes_the_restart_file_before(run):
    restart_file(run, 240, end=MAGIC[:-1])
    plan = restart.plan(run)
    assert "restart.240 is cut short, after 36 bytes; taking the one before" in plan.told[0]
    plan.do(run)
    assert steps(run) == [0, 50]
    assert f'"{line(100)}"' in (run / "in.resume").read_text()
    assert [one.step for one in tables.frames(run / "foam.lammpstrj")] == [0, 100]


def test_line_at_the_step_of_the_restart_file(run):
    """LAMMPS writes it again, when the run begins: so it is not kept."""
    restart_file(run, 250)
    restart.plan(run).do(run)
    assert steps(run) == [0, 50, 100, 150]
    assert f'variable      title string "{line(200)}"' in (run / "in.resume").read_text()


def test_ranks_share_the_box_as_before(run):
    (run / "log.foam").write_text("a\n  2 by 3 by 1 MPI processor grid\nb\n")
    assert "processors    2 3 1 " in restart.plan(run).text
    assert "processors    2 3 1 " in restart.plan(run, ranks=6).text
    assert "processors" not in restart.plan(run, ranks=4).text
    (run / "log.foam").write_text("  1 by 1 by 1 MPI processor grid\n")
    assert "processors" not in restart.plan(run).text


def test_resume_takes_one_that_lammps_can_read(run):
    plan = restart.plan(run, lambda path: "is refused" if path.name == "restart.240" else None)
    assert plan.told == [f"{run / 'restart.240'} is refused; taking the one before", "goes on from step 120"]


def test_resume_from_the_relaxed_foam(run):
    """Tables are begun anew, by the section that the run itself has."""
    for step in (120, 240):
        (run / f"restart.{step}").unlink()
    restart.plan(run).do(run)
    text = (run / "in.resume").read_text()
    assert "read_restart  restart.0 noremap" in text and "string file" in text and "relax_foam" not in text
    assert not (run / "foam.lammpstrj").exists()


def test_resume_keeps_what_the_user_changed(run):
    text = (run / "in.foam").read_text()
    (run / "in.foam").write_text(text.replace("variable      kappa     index 0.1", "variable      kappa     index 0.7"))
    restart.plan(run).do(run)
    assert "variable      kappa     index 0.7" in (run / "in.resume").read_text()
    (run / "in.foam").write_text(text.replace("# ---------------- run ---", "# run"))
    with pytest.raises(Unusable, match="heading '# ---- run ----' is not there"):
        restart.plan(run)


def refused(run, told):
    before = content(run)
    with pytest.raises(Unusable, match=told):
        restart.plan(run)
    assert content(run) == before


def test_nothing_to_resume_from(run, tmp_path):
    for step in (0, 120, 240):
        restart_file(run, step, end=b"")
    refused(run, "restart.0 is cut short, .*; there is no other one. Nothing was changed")
    for step in (0, 120, 240):
        (run / f"restart.{step}").unlink()
    refused(run, "there is series.csv, but no restart file")
    (run / "series.csv").unlink()
    refused(run, "there is foam.lammpstrj, but no restart file")
    (run / "foam.lammpstrj").unlink()
    plan = restart.plan(run)    # killed in the relaxation
    assert plan.input == "in.foam" and "it begins again" in plan.told[0]
    (run / "in.foam").unlink()
    refused(run, "no in.foam there")


def test_lines_that_are_missing(run):
    """As after a disk that was full for a while."""
    series(run / "series.csv", [0, 50, 200, 250])
    refused(run, "lines are missing after step 50")
    series(run / "series.csv", [0, 50, 100])
    refused(run, "lines are missing after step 100")
    series(run / "series.csv", [])
    refused(run, "has no line before step 240")
    (run / "series.csv").unlink()
    refused(run, "series.csv: is not there")


def test_writing_whole_or_not_at_all(tmp_path):
    with pytest.raises(Unusable, match="cannot be written"):
        tables.replace(tmp_path / "none" / "file", "text")
    tables.replace(tmp_path / "file", "a")
    tables.replace(tmp_path / "file", "b")
    assert [path.name for path in tmp_path.iterdir()] == ["file"] and (tmp_path / "file").read_text() == "b"


# ---- the thesis' files ----------------------------------------------------------------------------------------------

def test_snapshots(tmp_path):
    """Displacements are those of unwrapped places; bubbles vanish; the last state is a snapshot, if it is later."""
    (tmp_path / "foam.lammpstrj").write_text(
        frame(0, [bubble(1, 1.0, 2.0), bubble(2, 9.5, 5.0), bubble(4, 5.0, 5.0)], lo=-1.0)
        + frame(10, [bubble(1, 4.0, 6.0), bubble(2, -0.25, 5.0, ix=1), bubble(4, -1.25, 5.0)], lo=-1.0))
    (tmp_path / "last.lammpstrj").write_text(frame(12, [bubble(1, 4.0, 6.0), bubble(4, 8.75, 5.0, ix=-1)], lo=-1.0))
    assert snapshots.snapshots(tmp_path, "bubbles") == 3
    names = (tmp_path / "bubbles.csv.0").read_text().splitlines()[0]
    assert names == "x,y,z,r,vx,vy,vz,vtot,path,distance,energy,displacement,index"
    first, second, third = (np.loadtxt(tmp_path / f"bubbles.csv.{n}", delimiter=",", skiprows=1) for n in range(3))
    assert first.tolist()[0] == [2.0, 3.0, 0.0, 1.5, 3.0, 4.0, 0.0, 5.0, 7.0, 8.0, 9.0, 0.0, 0.0]
    # 5 as in 3, 4, 5; through the boundary from 9.5 to 9.75; a little outside of the box, from 5 to -1.25
    assert second[:, 11].tolist() == [5.0, 0.25, 6.25]
    assert second[:, 0].tolist() == [5.0, 0.75, 9.75]    # from the lower corner, in the box
    assert third[:, 12].tolist() == [0.0, 3.0]           # the index stays
    assert third[:, 11].tolist() == [0.0, 0.0]           # -1.25 is 8.75 in the image before
    # the same state again is none
    (tmp_path / "last.lammpstrj").write_text(frame(10, [bubble(1, 4.0, 6.0)], lo=-1.0))
    assert snapshots.snapshots(tmp_path, "again") == 2


def test_results(tmp_path):
    """The first line at or after each unit of tau, and changes of the energy between these."""
    rows = [(0, 0.0, 8.0), (50, 0.6, 7.0), (100, 1.0, 6.0), (150, 1.7, 5.0), (200, 2.3, 4.0), (250, 2.9, 3.0),
            (300, 5.1, 2.0), (350, 5.9, 1.0)]
    path = tmp_path / "series.csv"
    path.write_text("\n".join([",".join(NAMES), *(line(*row) for row in rows)]) + "\n")
    assert snapshots.results(tmp_path) == 3
    names, *found = (tmp_path / "results.csv").read_text().splitlines()
    table = [dict(zip(names.split(","), map(float, row.split(",")))) for row in found]
    assert [row["tau"] for row in table] == [1.0, 2.3, 5.1]
    for row, (before, now) in zip(table, [(8, 6), (6, 4), (4, 2)]):
        assert math.isclose(row["change"], 2 * (before - now) / (before + now), rel_tol=1e-9)    # 10 digits
        assert row["change"] == row["change_edurian"] and row["edurian"] == 2 * row["energy"]


def test_results_of_loose_bubbles(tmp_path):
    path = tmp_path / "series.csv"
    path.write_text("\n".join([",".join(NAMES), line(0, 0, 0.0), line(50, 1, 0.0)]) + "\n")
    snapshots.results(tmp_path)
    assert json.loads((tmp_path / "results.csv").read_text().splitlines()[1].split(",")[7]) == 0


def test_lines_further_apart_since_the_last_resume(run):
    """`every` may be changed in in.foam before a resume: no line is missing for that."""
    series(run / "series.csv", [0, 20, 40, 60, 110, 160, 210])
    assert restart.plan(run)
