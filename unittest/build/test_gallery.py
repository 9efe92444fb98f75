"""The gallery of the manual has every figure, but of a series one."""

import os
import re
from pathlib import Path

DOC = Path(os.environ["FOAM_SOURCE_DIR"]) / "doc"


def test_every_figure_is_in_the_gallery_with_a_command():
    gallery = (DOC / "gallery.rst").read_text()
    shown = set(re.findall(r"image:: figures/(\S+)\.png\n", gallery))
    assert shown >= {path.stem for path in (DOC / "figures").glob("*.png")}
    assert all((DOC / "figures" / f"{name}.png").exists() for name in shown)
    assert gallery.count("code-block:: sh") == len(shown)


def test_every_script_in_the_gallery_exists():
    gallery = (DOC / "gallery.rst").read_text()
    for script in re.findall(r"(?:examples|doc/scripts|benchmarks)/\S+\.(?:py|sh)\b", gallery):
        assert (DOC.parent / script).exists(), script
