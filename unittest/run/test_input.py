"""The thesis' input is read as it is meant, and what is wrong with it is told where it stands."""

import dataclasses
import json
import re
from pathlib import Path

import pytest

from lammps_foam.run import places, thesis_input
from lammps_foam.run.thesis_input import Unusable
from thesis import FLAT, GONE, NESTED, changed, written

EXAMPLES = Path(__file__).parents[2] / "examples" / "thesis"


def refused(path, **options):
    """The messages, each [line, column, text]."""
    with pytest.raises(Unusable) as error:
        thesis_input.read(path, **options)
    text = str(error.value)
    found = re.findall(rf"^{re.escape(str(path))}:(\d+):(\d+): (.*)$", text, re.M)
    assert found, text
    return [(int(line), int(column), told) for line, column, told in found]


def test_both_forms_mean_the_same(tmp_path):
    nested = thesis_input.read(written(tmp_path / "nested.json"))
    flat = thesis_input.read(written(tmp_path / "flat.json", FLAT))
    assert (nested.form, flat.form) == ("nested", "flat")
    for field in dataclasses.fields(nested):
        if field.name not in ("form", "notes", "first_step", "filename"):
            assert getattr(nested, field.name) == getattr(flat, field.name), field.name
    assert (nested.bubbles, nested.end, nested.K, nested.frequency) == (100, 60, 0.01, 2.0)
    assert isinstance(nested.bubbles, int)
    assert flat.first_step == 1e-3
    assert any("numBubblesPerCell is ignored" in note for note in flat.notes)
    assert any("dimensionality is not there, 2 dimensions" in note for note in flat.notes)


@pytest.mark.parametrize("name", ["nested", "flat"])
def test_examples(name):
    foam = thesis_input.read(EXAMPLES / f"{name}.json")
    assert foam.form == name
    assert (foam.phi, foam.std, foam.K, foam.kappa, foam.tolerance) == (0.9, 0.21, 1e-3, 0.1, 1e-5)


def test_later_flat_form(tmp_path):
    """Walls, flow and dimension are keys there; skinRadius and the names of files have come and gone."""
    more = {"dimensionality": 3, "addFlow": True, "xWall": True, "yWall": False, "zWall": True, "skinRadius": 0.3,
            "flowTfr.z": 1.0, "snapshotFilename": "foam", "dataFilename": "data.dat"}
    path = written(tmp_path / "flat.json", FLAT, more)
    foam = thesis_input.read(path)
    assert (foam.dimension, foam.flow, foam.walls, foam.filename) == (3, True, (True, False, True), "foam")
    assert sum("is ignored" in note for note in foam.notes) == 3
    with pytest.raises(Unusable, match="says dimensionality itself, so the option --dimension"):
        thesis_input.read(path, dimension=2)


def test_options_for_the_flat_form(tmp_path):
    foam = thesis_input.read(written(tmp_path / "flat.json", FLAT), dimension=2, walls="y", flow=True)
    assert (foam.dimension, foam.walls, foam.flow) == (2, (False, True, False), True)


def test_booleans_and_comments(tmp_path):
    more = {"flow.impose": True, "box.wall.x": False, "constants.K.comments": ["a", "b"], "flow.lbb.comment": "c"}
    foam = thesis_input.read(written(tmp_path / "nested.json", NESTED, more))
    assert foam.flow and not foam.walls[0]


WRONG_NESTED = [
    ("bubbles.numStart", 1.5, "1.5 is not allowed; a whole number from 2"),
    ("bubbles.numStart", 1e300, "1e+300 is not allowed"),
    ("bubbles.numStart", "100", '"100" is not allowed'),
    ("bubbles.numStart", True, "true is not allowed"),
    ("bubbles.numEnd", 100, "100 bubbles at the end; there must be fewer than the 100"),
    ("bubbles.numEnd", -1, "-1 is not allowed"),
    ("bubbles.radius.mean", 0, "0 is not allowed; a number above 0"),
    ("bubbles.radius.std", -0.1, "-0.1 is not allowed; a number from 0"),
    ("bubbles.radius.std", float("nan"), "NaN; a finite number is wanted"),
    ("bubbles.radius", 3, "3 is not allowed; an object with the keys mean, std"),
    ("box.dimensionality", 4, "4 is not allowed; 2 or 3"),
    ("box.dimensionality", 2.5, "2.5 is not allowed; 2 or 3"),
    ("box.wall.drag", 1.01, "1.01 is not allowed; a number from 0 to 1"),
    ("box.wall.drag", -0.01, "not allowed"),
    ("box.wall.z", 1, "a wall across z needs three dimensions"),
    ("box.wall.x", 2, "2 is not allowed; 0 or 1, false or true"),
    ("box.relativeDimensions.y", 0, "0 is not allowed"),
    ("constants.phi.value", 0, "0 is not allowed; a number above 0"),
    ("constants.phi.value", -0.9, "not allowed"),
    ("constants.phi.value", float("inf"), "too large a number"),
    ("constants.phi.value", [0.9], "a list [...] is not allowed"),
    ("constants.K.value", 0, "0 is not allowed"),
    ("constants.K.comment", 3, "3 is not allowed; a text"),
    ("errorTolerance.value", 0, "0 is not allowed"),
    ("rngSeed.value", -1, "-1 is not allowed"),
    ("stabilization.steps", 0, "0 is not allowed"),
    ("snapShot.frequency", -1, "-1 is not allowed"),
    ("snapShot.filename", "../foam", "the name of a file"),
    ("snapShot.filename", "", "the name of a file"),
]


@pytest.mark.parametrize("place, value, told", WRONG_NESTED)
def test_wrong_value(tmp_path, place, value, told):
    """One message, at the value."""
    path = written(tmp_path / "foam.json", NESTED, {place: value})
    (line, column, message), = refused(path)
    assert message.startswith(f"{place}: ") and told in message
    text = path.read_text().splitlines()[line - 1]
    shown = json.dumps(value, indent=2).splitlines()[0]
    assert text[column - 1:].startswith(shown)
    assert text[:column - 1].strip() == f'"{place.rpartition(".")[2]}":'


@pytest.mark.parametrize("place", ["bubbles.numEnd", "constants.kappa", "constants.K.value", "flow.tfr.z", "snapShot"])
def test_missing_key(tmp_path, place):
    """At the key of the object that lacks it."""
    path = written(tmp_path / "foam.json", NESTED, {place: GONE})
    (line, column, message), = refused(path)
    assert message.startswith(f"{place}: is missing; ")
    parent = place.rpartition(".")[0].rpartition(".")[2]
    assert path.read_text().splitlines()[line - 1][column - 1:].startswith(f'"{parent}"' if parent else "{")


@pytest.mark.parametrize("data, place, near", [
    (NESTED, "bubbles.numstart", "did you mean numStart?"),
    (NESTED, "constants.Kappa", "did you mean kappa?"),
    (NESTED, "box.wall.w", "known here: drag, x, y, z"),
    (NESTED, "phiTarget", "it belongs to the flat form"),
    (NESTED, "constants.K.valueExpl", "did you mean value?"),
    (FLAT, "phiTargt", "did you mean phiTarget?"),
    (FLAT, "constants", "it belongs to the nested form"),
    (FLAT, "AvgRad", "did you mean avgRad?"),
])
def test_unknown_key(tmp_path, data, place, near):
    """At the key; with what is likely to be meant."""
    path = written(tmp_path / "foam.json", data, {place: 1})
    (line, column, message), = refused(path)
    assert message.startswith(f"{place}: is no key of the ") and near in message
    assert path.read_text().splitlines()[line - 1][column - 1:].startswith(f'"{place.rpartition(".")[2]}"')


def test_flow_box(tmp_path):
    """It counts where a flow is imposed, and z in three dimensions."""
    inside_out = {"flow.lbb.x": 0.5, "flow.tfr.x": 0.4}
    thesis_input.read(written(tmp_path / "foam.json", NESTED, inside_out))
    path = written(tmp_path / "foam.json", NESTED, {**inside_out, "flow.impose": 1})
    (_, _, message), = refused(path)
    assert "flow.tfr.x: 0.4 must be more than 0.5" in message
    path = written(tmp_path / "foam.json", NESTED, {"flow.impose": 1, "box.dimensionality": 3})
    (_, _, message), = refused(path)
    assert message.startswith("flow.tfr.z: 0 must be more than 0")
    path = written(tmp_path / "foam.json", NESTED, {"flow.impose": 1, "flow.lbb.x": 1.2, "flow.tfr.x": 1.5})
    (_, _, message), = refused(path)
    assert "outside of the box" in message
    path = written(tmp_path / "flat.json", FLAT, {"flowVel": GONE})
    thesis_input.read(path)
    (_, _, message), = refused(path, flow=True)
    assert message == "flowVel: is missing; a flow is imposed"
    (_, _, message), = refused(written(path, FLAT), walls="z")
    assert "a wall across z needs three dimensions" in message


def test_all_errors_at_once(tmp_path):
    """In the order of the file."""
    path = written(tmp_path / "foam.json", NESTED,
                   {"bubbles.numStart": 1.5, "bubbles.numEnds": 3, "box.wall.drag": 7, "constants.K": GONE})
    found = refused(path)
    assert [message.split(":")[0] for *_, message in found] == [
        "bubbles.numStart", "bubbles.numEnds", "box.wall.drag", "constants.K"]
    assert [line for line, *_ in found] == sorted(line for line, *_ in found)


def test_duplicate_key(tmp_path):
    path = tmp_path / "foam.json"
    text = written(path).read_text()
    path.write_text(text.replace('"mean": 1.0', '"mean": 1.0,\n      "mean": 2.0'))
    (line, column, message), = refused(path)
    first = next(n for n, row in enumerate(path.read_text().splitlines(), 1) if '"mean": 1.0' in row)
    assert message == f"bubbles.radius.mean: the same key is at {first}:7 already"
    assert (line, column) == (first + 1, 7)
    # comments may be there twice, as in a published input
    path.write_text(text.replace('"comment": "fast"', '"comment": "fast", "comment": "slow"'))
    thesis_input.read(path)


@pytest.mark.parametrize("text, told", [
    ("", "the file is empty"), ("  \n", "the file is empty"), ("[1, 2]", "a JSON object is wanted, not a list"),
    ("{\n\t'bubbles': 1}", "no JSON: "), ('{"a": 1,}', "no JSON: "), ('{"a": 01}', "no JSON: "),
    ('{"a": "b\n"}', "no JSON: "),
])
def test_no_json(tmp_path, text, told):
    path = tmp_path / "foam.json"
    path.write_text(text)
    (_, _, message), = refused(path)
    assert told in message


@pytest.mark.parametrize("raw, told", [(b'{"a": "\xff"}', "not UTF-8"), (b"[" * 100_000, "without end"),
                                       (b'{"a": ' + b"1" * 10_000 + b"}", "digits")])
def test_other_files(tmp_path, raw, told):
    path = tmp_path / "foam.json"
    path.write_bytes(raw)
    with pytest.raises(Unusable, match=told):
        thesis_input.read(path)
    with pytest.raises(Unusable, match="cannot be read"):
        thesis_input.read(tmp_path / "none.json")


def test_other_spellings(tmp_path):
    """BOM, tabs, ends of lines as on Windows, all in a line, a colon in the next line."""
    expected = thesis_input.read(written(tmp_path / "a.json"))
    path = tmp_path / "b.json"
    for text in (json.dumps(NESTED), json.dumps(NESTED, indent="\t"),
                 json.dumps(NESTED, indent=2).replace("\n", "\r\n"), json.dumps(NESTED).replace(":", "\n:"),
                 "\ufeff" + json.dumps(NESTED)):
        path.write_bytes(text.encode())
        assert thesis_input.read(path) == expected


def test_caret(tmp_path):
    """Below the value, also behind tabs and in a long line."""
    path = tmp_path / "foam.json"
    for text in (json.dumps(changed(NESTED, {"bubbles.radius.std": -5}), indent="\t"),
                 json.dumps(changed(NESTED, {"bubbles.radius.std": -5}))):
        path.write_text(text)
        with pytest.raises(Unusable) as error:
            thesis_input.read(path)
        _, line, carets = str(error.value).splitlines()
        at = carets.index("^")
        assert line[at:at + 2] == "-5" and carets[at:] == "^^"


def test_places_agree_with_json():
    """Of any JSON: values are those of the json module, and the text of a place is the value."""
    text = '{"a" : [1, -2.5e3 ,{"b\\"]": null, "\\u00e9": "x:{,}"}], "c":{}, "d": [ ], "e":true, "a": "last"}'
    root = places.read(text)
    assert root.value == json.loads(text)
    assert [name for name, _ in root.keys] == ["a", "c", "d", "e", "a"]
    for name, span in root.keys:
        assert json.loads(text[span.start:span.end]) == name
    inner = places.read('[{"b": [10, {"c": 7}]}]').at([0, "b", 1, "c"])
    assert inner.value == 7
