# The manual: sphinx-build -W doc doc/_build/html, or ./foam doc

import sys
from importlib import metadata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "Wet foams in LAMMPS"
author = "the authors of lammps-foam"
copyright = "the authors of lammps-foam; GNU General Public License, version 2"

extensions = ["sphinx.ext.mathjax", "sphinx_rtd_theme", "lammps_lexer"]
exclude_patterns = ["_build", "_ext", "scripts"]
highlight_language = "none"

html_theme = "sphinx_rtd_theme"    # as the manual of LAMMPS
html_title = project
html_theme_options = {"navigation_depth": 2}
html_static_path = ["_static"]
html_css_files = ["custom.css"]
html_show_sourcelink = False
html_copy_source = False

# Equations without a network: MathJax from a Python package, as one file that draws them as SVG and
# needs no fonts. Without the package the pages refer to MathJax's server, as Sphinx has it.
try:
    mathjax = metadata.distribution("django-static-mathjax").locate_file("mathjax/static/mathjax/es5")
    html_static_path.append(str(mathjax / "tex-svg.js"))
    mathjax_path = "tex-svg.js"
except metadata.PackageNotFoundError:
    pass
