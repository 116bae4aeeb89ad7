"""Reads run folders (format of the data: experiments/README.md, "Read a run"). Missing data are reported in words."""

import csv
import json
import zlib
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from ogc_testbed.columns import column_and_unit


class RunError(Exception):
    """Raised if a run folder can't be drawn; the message names the problem, its place and the remedy."""


@dataclass
class Frame:
    """Holds one stored state: positions [m], velocities [m/s], bounds [m], orientations of rods' segments [n, 4] as x,
    y, z, w. Of runs that measure them also residual [V], NaN unless free, and cut [V], 1 or 0; else both are empty."""

    step: int
    time: float
    positions: np.ndarray
    velocities: np.ndarray
    bounds: np.ndarray
    orientations: np.ndarray = field(default_factory=lambda: np.empty((0, 4), np.float32))
    residual: np.ndarray = field(default_factory=lambda: np.empty(0, np.float32))
    cut: np.ndarray = field(default_factory=lambda: np.empty(0, np.float32))


class Run:
    """Holds a run folder: `manifest` (run.json), `steps` (column name without unit -> array), `frames` (paths,
    ascending)."""

    def __init__(self, folder):
        self.folder = Path(folder)
        manifest = self.folder / "run.json"
        if not manifest.is_file():
            raise RunError(f"{self.folder} is no run folder: it has no run.json. Make one with: ogc run SCENE --out "
                           f"{self.folder}")
        self.manifest = json.loads(manifest.read_text())
        self._take_audit(self.folder / "audit.json")
        self.steps, self.units = _read_steps(self.folder / "steps.csv")
        self.frames = sorted((self.folder / "frames").glob("frame_*.h5"))

    def _take_audit(self, path):
        """Applies the result of an audit after the run as if it had been made during the run."""
        found = json.loads(path.read_text()) if path.is_file() else {"states": 0}
        if found["states"]:
            kept = self.manifest.get("guarantee_kept") is not False and found["clean"]
            states = int(self.manifest.get("audited_states", 0)) + found["states"]
            self.manifest.update(guarantee_kept=kept, audited_states=str(states))

    @property
    def status(self):
        return self.manifest.get("status", "unknown")

    def column(self, name):
        if name not in self.steps:
            raise RunError(f"{self.folder}/steps.csv has no column '{name}'; it has: {', '.join(self.steps)}")
        return self.steps[name]

    def stage_columns(self):
        """Returns the times by stage [ms] if the run was profiled."""
        return {name.removeprefix("stage_"): self.steps[name] for name in self.steps if name.startswith("stage_")}

    def setting(self, name):
        """Returns the value of a setting in its own unit (SI)."""
        return self.manifest["settings"][name]["value"]

    def bodies(self):
        """Returns the scene's bodies as in run.json, each with `triangles` [n, 3] numbered from the body's first
        vertex. A rod also has `segments` [n, 2], numbered in the same way, and `first_segment`, the index of its first
        orientation."""
        triangles, edges = self.topology
        result, segment_count = [], 0
        for body in self.manifest["scene"]["bodies"]:
            first, vertex = body["first_triangle"], body["first_vertex"]
            result.append({**body, "triangles": triangles[first:first + body["triangle_count"]] - vertex})
            if "rod" in body["material"]:
                own = edges[(edges[:, 0] >= vertex) & (edges[:, 0] < vertex + body["vertex_count"])]
                result[-1].update(segments=own - vertex, first_segment=segment_count)
                segment_count += len(own)
        return result

    @cached_property
    def topology(self):
        """Returns triangles [n, 3] and loose edges [m, 2] of all bodies, numbered in the run's vertices."""
        path = self.folder / "trajectory.vtkhdf"
        if not path.is_file():
            raise RunError(f"{path} is missing: the run is not finished; assemble it with: ogc export {self.folder}")
        with _opened(path) as file:
            return (file["VTKHDF/Polygons/Connectivity"][:].reshape(-1, 3),
                    file["VTKHDF/Lines/Connectivity"][:].reshape(-1, 2))

    def view(self, **options):
        """Shows the run in a notebook; `.save("view.html")` of the result writes the page, which opens offline in any
        browser. Options are those of ogc_testbed.page.Page."""
        from ogc_testbed.motion import motion_of_run
        from ogc_testbed.page import Page
        return Page(motion_of_run(self, options.pop("every", 1)), **options)

    @cached_property
    def start_positions(self):
        """Returns the positions of the first stored frame [m]."""
        return self.frame(self.frames[0]).positions

    def frame(self, path):
        with _opened(path) as file:
            arrays = {name: file[name][:] for name in ("orientations", "residual", "cut") if name in file}
            frame = Frame(int(file.attrs["step"]), float(file.attrs["time"]),
                          file["positions"][:], file["velocities"][:], file["bounds"][:], **arrays)
            expected = int(file.attrs.get("crc32", _checksum(frame)))  # frames of format 1 have no checksum
        if expected != _checksum(frame):
            raise RunError(f"{path} is damaged: its content is not what its checksum says; "
                           "restore the file, or run the scene again")
        return frame

    def frame_at_step(self, step):
        """Returns the stored frame nearest to `step`."""
        if not self.frames:
            raise RunError(f"{self.folder} has no finished frame yet (status: {self.status})")
        numbers = [int(path.stem.removeprefix("frame_")) for path in self.frames]
        return self.frame(self.frames[int(np.argmin([abs(n - step) for n in numbers]))])

    def require_finished(self):
        if self.status != "finished":
            raise RunError(f"{self.folder} is not finished (status: {self.status}); its frames can be read, its figure "
                           "can't be drawn")
        if not self.manifest.get("guarantee_kept", True):
            raise RunError(f"{self.folder}: the audit failed; see run.json, or audit.json beside it")


def commits_in_words(runs):
    """Returns the commit of the program that made `runs`. If there are several, the text names the run of each, because
    the picture then also compares programs."""
    commits = [run.manifest["commit"][:10] + (" (dirty)" if run.manifest.get("dirty") else "") for run in runs]
    if len(set(commits)) == 1:
        return f"commit {commits[0]}"
    return "MIXED, not one program's runs: " + ", ".join(f"{run.folder.name} of commit {commit}"
                                                         for run, commit in zip(runs, commits))


def _opened(path):
    """Returns the HDF5 file, to be read. h5py is imported here, so that manifests and rows need only NumPy."""
    try:
        import h5py
    except ImportError as error:
        raise RunError(f"{path} is an HDF5 file, which h5py reads: pip install h5py") from error
    return h5py.File(path, "r")


def _checksum(frame):
    """Returns the CRC-32 of the bytes of positions, velocities, bounds, step, time, orientations, residual and cut, in
    the order of the writer."""
    step, time = np.array(frame.step, "<i8"), np.array(frame.time, "<f8")
    result = 0
    for part in (frame.positions, frame.velocities, frame.bounds, step, time, frame.orientations, frame.residual,
                 frame.cut):
        result = zlib.crc32(part.tobytes(), result)
    return result


def _read_steps(path):
    if not path.is_file():
        raise RunError(f"{path} is missing")
    with path.open(newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 2:
        raise RunError(f"{path} holds no step yet")
    names, units = zip(*(column_and_unit(text) for text in rows[0]))
    width = len(names)
    table = [[float(text) if text else np.nan for text in row] for row in rows[1:] if len(row) == width]
    return {name: np.array([row[i] for row in table]) for i, name in enumerate(names)}, dict(zip(names, units))
