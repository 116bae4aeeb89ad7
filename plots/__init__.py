"""Draws run folders. The package `ogc_testbed` of this checkout reads them, without an installation."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "experiments" / "python"))
