"""Draws run folders. The package `ogc_testbed` of this checkout reads them, without an installation. Its compiled
modules are those of the build folder that OGC_MODULES of the environment names, as `ogc view` does."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "experiments" / "python"))
if os.environ.get("OGC_MODULES"):
    import ogc_testbed
    ogc_testbed.__path__.append(os.environ["OGC_MODULES"])
