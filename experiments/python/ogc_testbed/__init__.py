"""Python around the testbed: kernels of your own before the judge."""

from ogc_testbed.judging import judge
from ogc_testbed.kernels import kernel

__all__ = ["judge", "kernel"]
