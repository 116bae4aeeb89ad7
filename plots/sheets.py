"""Reads what viewers show: run folders, .npz, and the sheets that `ogc view` writes of everything that it can read.

A sheet is a temporary folder: sheet.json, triangles and edges (int32), and positions of all frames (float32). That of a
run names the run's folder and has no positions; the frames are the run's.
"""

import json
import shutil
from pathlib import Path

import numpy as np

from ogc_testbed.motion import motion_of_arrays, motion_of_run
from ogc_testbed.runs import Run, RunError


def motion_at(path, every=1, keep=None):
    """Returns the motion of a run folder, a .npz with positions and triangles, or a sheet, which is removed. `keep`: a
    dictionary that keeps the faces of runs by folder, for the next look at a run that goes on."""
    path = Path(path)
    if (path / "sheet.json").is_file():
        return _of_sheet(path, every, {} if keep is None else keep)
    if (path / "run.json").is_file():
        return of_run(path, every, {} if keep is None else keep)
    if path.suffix == ".npz" and path.is_file():
        return _of_arrays(path, every)
    raise RunError(f"{path} is neither a run folder nor a .npz; ogc view {path} reads meshes and scenes, too")


def of_run(folder, every, keep):
    """Returns the motion of the frames that a run has now."""
    run = Run(folder)
    if str(folder) in keep:
        run.topology = keep[str(folder)]
    return motion_of_run(run, every)


def _of_arrays(path, every):
    with np.load(path) as arrays:
        found = [next((arrays[n] for n in names if n in arrays), None)
                 for names in (("positions", "x"), ("triangles", "faces"))]
    if found[0] is None or found[1] is None:
        raise RunError(f"{path}: it has no positions and triangles")
    motion = motion_of_arrays(*found, name=path.stem)
    return motion if every == 1 else motion.thinned(every)


def _of_sheet(folder, every, keep):
    sheet = json.loads((folder / "sheet.json").read_text())
    triangles = np.fromfile(folder / "triangles", np.int32).reshape(-1, 3)
    edges = np.fromfile(folder / "edges", np.int32).reshape(-1, 2)
    positions = None if "run" in sheet else np.fromfile(folder / "positions", np.float32)
    shutil.rmtree(folder, ignore_errors=True)
    if positions is None:
        keep[sheet["run"]] = triangles, edges
        return of_run(Path(sheet["run"]), every, keep)
    positions = positions.reshape(sheet["frames"], -1, 3)
    bodies = [(b["name"], b["first_vertex"], b["vertex_count"], b["still"]) for b in sheet["bodies"]]
    motion = motion_of_arrays(positions, triangles, edges, sheet["radius"], sheet["name"], bodies)
    return motion if every == 1 else motion.thinned(every)
