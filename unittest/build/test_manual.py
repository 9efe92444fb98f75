"""The manual can be read without a network."""

import re
import subprocess
import sys

import pytest

from ways import PROJECT

# what a browser fetches to show a page; links that a reader may follow are not among it
FETCHED = re.compile(r"""<(?:script|link|img|iframe|object)\b[^>]*?\b(?:src|href|data)=["']([^"']*)""")


@pytest.fixture(scope="module")
def manual(tmp_path_factory):
    directory = tmp_path_factory.mktemp("manual")
    html = directory / "html"
    done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-b", "html", "-d", directory / "trees",
                           PROJECT / "doc", html], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return html


def test_nothing_from_elsewhere(manual):
    """All that a page is made of lies beside it."""
    pages = sorted(manual.glob("*.html"))
    assert manual / "index.html" in pages
    for page in pages:
        for address in FETCHED.findall(page.read_text()):
            assert not re.match(r"[a-z]+:|//", address), f"{page.name}: {address}"
            file = re.split("[?#]", address)[0]
            assert not file or (manual / file).exists(), f"{page.name}: {address}"
    for sheet in manual.glob("_static/*.css"):
        assert not re.search(r"(url\(|@import)\s*[\"']?([a-z]+:)?//", sheet.read_text()), sheet.name


def test_equations_are_drawn(manual):
    """Every page with an equation has the program that draws it."""
    with_equations = [page for page in manual.glob("*.html") if 'class="math ' in page.read_text()]
    assert manual / "model.html" in with_equations
    for page in with_equations:
        assert re.search(r'<script[^>]* src="_static/tex-svg\.js', page.read_text()), page.name
    assert "MathJax" in (manual / "_static" / "tex-svg.js").read_text()
