from ._audit import AuditReport as AuditReport, audit as audit
from ._fast import (
    Body as Body,
    ContactFinder as ContactFinder,
    ContactForceSums as ContactForceSums,
    ContactForces as ContactForces,
    ContactSets as ContactSets,
    Guard as Guard,
    GuardReport as GuardReport,
    Mesh as Mesh,
    Scene as Scene,
    Simulation as Simulation,
    Snapshot as Snapshot,
    StateView as StateView,
    Steps as Steps,
    Worlds as Worlds,
    backend_info as backend_info,
    find_contacts as find_contacts,
    scene as scene,
    scenes as scenes,
    worlds as worlds,
)
from .judging import judge as judge
from .kernels import kernel as kernel
from .meshes import from_mesh as from_mesh, load as load
from .page import view as view
from .runs import Run as Run, RunError as RunError

__version__: str
__all__: list[str]
