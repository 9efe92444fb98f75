"""The fixtures and helpers of ../styles, for the tests of this directory, too: `from conftest import
...` and `from foams import ...` work here as they do there."""

import sys
from pathlib import Path

STYLES = Path(__file__).resolve().parent.parent / "styles"
sys.path.append(str(STYLES))

# in this name space, so that the classes and fixtures exist once, under the name conftest
exec(compile((STYLES / "conftest.py").read_text(), str(STYLES / "conftest.py"), "exec"))
