"""OGC Testbed: Offset Geometric Contact on arrays.

Contact sets and bounds of a mesh (find_contacts), cloth simulations (Scene), a solver's moves kept apart (Guard), exact
audits of anybody's frames (audit), kernels before the judge (kernel, judge), runs of the program (Run), and pages that
show them (view). Arrays are float32 and int32 in C order, from any library with DLPack; nothing is cast or copied
silently.
Names are loaded at their first use, so that the import takes milliseconds.
"""

import importlib

__version__ = "0.1.0"

_MODULES = {
    "_fast": ("Body", "ContactFinder", "ContactForceSums", "ContactForces", "ContactSets", "Guard", "GuardReport",
              "Mesh", "Scene", "Simulation", "Snapshot", "StateView", "Steps", "Worlds", "backend_info",
              "find_contacts", "scene", "scenes", "worlds"),
    "_audit": ("AuditReport", "audit"),
    "judging": ("judge",),
    "kernels": ("kernel",),
    "meshes": ("from_mesh", "load"),
    "page": ("view",),
    "runs": ("Run", "RunError"),
}
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names}

__all__ = sorted(_MODULE_OF)

_AUDIT_MISSING = (
    "ogc_testbed.{name} needs the exact audits, which are in a library of their own, because CGAL and GMP are under "
    "the LGPL: pip install 'ogc-testbed[judge]'; or, from a checkout with libcgal-dev, "
    "pip install . -C cmake.define.OGC_PYTHON_AUDIT=ON")


def __getattr__(name):
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = f"{__name__}.{_MODULE_OF[name]}"
    try:
        value = getattr(importlib.import_module(module), name)
    except ModuleNotFoundError as error:
        if error.name == module and _MODULE_OF[name] == "_audit":
            raise ImportError(_AUDIT_MISSING.format(name=name), name=module) from error
        raise
    globals()[name] = value
    return value


def __dir__():
    return sorted({*globals(), *__all__})
