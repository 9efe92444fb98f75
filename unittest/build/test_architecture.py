"""ARCHITECTURE.md: the floor plan is that of the sources, and its limits are kept."""

import re

import pytest

from ways import PROJECT

TEXT = (PROJECT / "ARCHITECTURE.md").read_text()
BASE, KOKKOS = (PROJECT / "src" / folder for folder in ("FOAM", "KOKKOS_FOAM"))
FILES = sorted(file for folder in (BASE, KOKKOS) for file in folder.glob("*.*") if file.suffix in (".h", ".cpp"))
# of those without a base style, the text beside the table tells the floor
OWN = {"foam_kokkos": "space", "foam_travelling_kokkos": "space", "foam_rows_kokkos": "contacts",
       "foam_pass_kokkos": "contacts", "foam_ghosts_kokkos": "contacts",
       "foam_found_kokkos": "contacts"}


def floors():
    """Names of floors from the highest to the lowest, and the files on each, some with a * at their end."""
    table = re.search(r"## Floor plan.*?```\n(.*?)```", TEXT, re.S).group(1)
    found, floor = {}, ""
    for line in table.splitlines():
        floor = line[:14].strip() or floor    # or the same as above
        files = re.findall(r"\b(?:foamplugin|(?:foam|bubble|liquid|fix|pair|compute|create|relax|lammps)_\w+\*?)", line)
        found.setdefault(floor, []).extend(files)
    return found


PLAN = floors()
ORDER = list(PLAN)


def floor_of(file):
    stem = file.stem
    if stem in OWN:
        return OWN[stem]
    stem = stem.removesuffix("_kokkos")
    exact = [floor for floor, files in PLAN.items() if stem in files]
    starred = [floor for floor, files in PLAN.items()
               if any(name.endswith("*") and stem.startswith(name[:-1]) for name in files)]
    assert exact or starred, f"{file.name} is not on the floor plan"
    assert len(exact or starred) == 1, f"{file.name} stands on several floors"
    return (exact or starred)[0]


def includes(file):
    return re.findall(r'^#include "(\w+\.h)"', file.read_text(), re.M)


def test_plan_is_that_of_the_sources():
    """Each word of the plan is a file, and each file has its floor."""
    stems = {file.stem for file in FILES}
    for files in PLAN.values():
        for name in files:
            assert any(stem == name or name.endswith("*") and stem.startswith(name[:-1]) for stem in stems), name
    assert len({floor_of(file) for file in FILES}) == len(ORDER)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_includes_go_downwards(file):
    ours = {other.name: other for other in FILES}
    for name in includes(file):
        if name in ours:
            assert ORDER.index(floor_of(ours[name])) >= ORDER.index(floor_of(file)), f"{file.name} includes {name}"


def test_lower_floors_know_nothing_of_lammps():
    for file in FILES:
        if floor_of(file) in ("schemes", "formulae"):
            assert all((BASE / name).exists() for name in includes(file)), file.name


def test_files_are_short():
    assert {file.name: n for file in FILES if (n := len(file.read_text().splitlines())) > 500} == {}


def test_names_in_the_text_exist():
    """Words in backquotes that look like names of our code are to be found in it."""
    code = "".join(file.read_text() for file in FILES)
    text = re.sub(r"```.*?```", "", TEXT, flags=re.S)
    names = set(re.findall(r"`(?:Foam::)?((?:Fix|Pair|Compute)?Foam\w+|[a-z]+_[a-z_]+(?=\(\)))", text))
    assert len(names) > 30
    missing = {name for name in names if not re.search(rf"\b{name}\b", code)}
    assert not missing
