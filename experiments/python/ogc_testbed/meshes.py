"""Meshes of files and of other libraries as arrays."""

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

_POSITIONS, _FACES = ("positions", "x"), ("triangles", "faces")  # keys that `ogc audit` reads, too


def _fan(faces: Any) -> npt.NDArray[np.int32]:
    """Returns PyVista's faces, which are counts and numbers in one array, as triangles."""
    rows = np.asarray(faces).reshape(-1, 4) if len(faces) % 4 == 0 else None
    if rows is None or (rows[:, 0] != 3).any():
        raise ValueError("mesh: it has polygons that are no triangles; pass mesh.triangulate()")
    return rows[:, 1:]


def from_mesh(mesh: Any) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.int32]]:
    """Returns positions, float32 (V, 3), and triangles, int32 (T, 3), of a mesh of trimesh, meshio, PyVista or Open3D.

    They are copies, rounded to single precision. TypeError: the object is none of these meshes. ValueError: it has no
    triangles, or polygons that are no triangles.
    """
    if hasattr(mesh, "cells_dict"):  # meshio
        x, faces = mesh.points, mesh.cells_dict.get("triangle")
    elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh
        x, faces = mesh.vertices, mesh.faces
    elif hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # Open3D
        x, faces = mesh.vertices, mesh.triangles
    elif hasattr(mesh, "points") and hasattr(mesh, "faces"):  # PyVista
        x, faces = mesh.points, _fan(mesh.faces)
    else:
        raise TypeError(f"mesh: a value of type {type(mesh).__name__} came; give a mesh of trimesh, meshio, PyVista or "
                        "Open3D, or take its arrays yourself")
    if faces is None or len(faces) == 0:
        raise ValueError("mesh: it has no triangles")
    return _arrays(x, faces)


def load(path: str | Path) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.int32]]:
    """Returns positions, float32 (V, 3), and triangles, int32 (T, 3), of a .npz with `positions` and `triangles` or
    `x` and `faces`; of frames (F, V, 3) the first.

    For other files a library that reads them is better: from_mesh(trimesh.load("shirt.obj")), or meshio.read.
    ValueError: another kind of file, or the arrays are missing.
    """
    path = Path(path)
    if path.suffix != ".npz":
        raise ValueError(f"{path}: load reads .npz; for others pass the mesh of a library: "
                         f"from_mesh(trimesh.load({str(path)!r}, process=False)) or from_mesh(meshio.read(…))")
    with np.load(path) as arrays:
        names = [next((name for name in known if name in arrays), None) for known in (_POSITIONS, _FACES)]
        if None in names:
            raise ValueError(f"{path}: it has {', '.join(arrays)}; give positions and triangles, or x and faces")
        x, faces = (arrays[name] for name in names)
    return _arrays(x[0] if x.ndim == 3 else x, faces)


def save(path: str | Path, simulation: Any, frames: Any = None) -> None:
    """Writes what Simulation.save says."""
    path, faces = Path(path), simulation.faces
    if path.suffix != ".npz":
        raise ValueError(f"{path}: a simulation is saved as .npz; give {str(path.with_suffix('.npz'))!r}")
    states = simulation.positions.cpu()[None] if frames is None else np.asarray(frames)
    shape = len(simulation.positions), 3
    if states.dtype != np.float32 or states.ndim != 3 or states.shape[1:] != shape:
        raise TypeError(f"frames: float32 (F, {shape[0]}, 3) is needed, but {states.dtype} {states.shape} came; pass "
                        "np.stack of states, each sim.positions.cpu()")
    with path.open("wb") as file:
        np.savez(file, positions=states, triangles=faces, metrics=np.asarray(simulation.metrics))


def _arrays(x: Any, faces: Any) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.int32]]:
    return np.array(x, dtype=np.float32, order="C"), np.array(faces, dtype=np.int32, order="C")
