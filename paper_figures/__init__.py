import plots  # noqa: F401, finds the package `ogc_testbed` of this checkout
