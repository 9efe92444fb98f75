# The manual: sphinx-build -W doc doc/_build/html, or ./foam doc

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "Wet foams in LAMMPS"
author = "the authors of lammps-foam"
copyright = "the authors of lammps-foam; GNU General Public License, version 2"

extensions = ["sphinx.ext.mathjax", "lammps_lexer"]
exclude_patterns = ["_build", "_ext", "scripts"]
highlight_language = "none"

html_theme = "alabaster"     # comes with Sphinx
html_title = project
html_theme_options = {
    "description": "Bubbles that rearrange and exchange gas",
    "fixed_sidebar": True,
    "page_width": "1060px",
    "sidebar_width": "230px",
}
html_show_sourcelink = False
html_copy_source = False
