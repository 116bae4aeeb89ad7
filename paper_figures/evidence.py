"""What claims are judged by: accepted runs and tables, or a run folder, read with the standard library alone so that a judgement needs no package.

A run is a manifest (`run.json`, or `X_run.json` of an accepted result) with its rows (`steps.csv`, `X_steps.csv`, long ones as `X_steps.csv.gz`); a table is `figNN_SCALE.csv` or `tableN_SCALE.csv` with a commit
and a device in each row. Runs that are unfinished, of a changed tree, or that failed their audit are no evidence.
"""

import copy
import csv
import gzip
import json
import math
import statistics
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

from plots.columns import column_and_unit

RESULTS = Path(__file__).parent / "results"
AUDIT = "audit.json"  # beside a manifest: what an audit of the finished run found (paper_figures.audited)
NOT_RUN = "not run"  # the status of a table's row about a run that its figure was drawn without


class EvidenceError(Exception):
    """A result that can't be read as its claim wants it; the message says which, what and what to do."""


@dataclass(frozen=True)
class Measured:
    """A number and where it comes from; `source` is a path below the folder of the results, `about` what else must be
    known to read it."""

    value: float
    source: str
    device: str
    commit: str
    ended: str
    about: str = ""


class Columns(Mapping):
    """Columns of a file of rows by name without unit; numbers are made of a column when it is asked for."""

    def __init__(self, path):
        with (gzip.open if path.suffix == ".gz" else open)(path, "rt", newline="") as file:
            names, *rows = [row for row in csv.reader(file) if row]
        rows = [row for row in rows if len(row) == len(names)]
        self._texts = dict(zip((column_and_unit(name)[0] for name in names), zip(*rows) if rows else [()] * len(names)))
        self._numbers = {}

    def __getitem__(self, name):
        if name not in self._numbers:
            self._numbers[name] = [float(text or "nan") for text in self._texts[name]]
        return self._numbers[name]

    def __iter__(self):
        return iter(self._texts)

    def __len__(self):
        return len(self._texts)


@lru_cache(maxsize=None)
def columns_of(path, stamp):
    """The columns of a file; `stamp` tells its versions apart."""
    return Columns(path)


def is_driven(body):
    """Whether nothing of the body is simulated: it is fixed, or all of it follows a prescribed motion."""
    return body["fixed"] or body.get("prescribed_vertices") == body["vertex_count"]


class RunEvidence:
    """A run: its manifest, and the columns of its rows without units."""

    def __init__(self, manifest, rows, source):
        self.manifest, self.rows, self.source = json.loads(Path(manifest).read_text()), Path(rows), source
        afterwards = Path(manifest).with_name(Path(manifest).name.removesuffix("run.json") + AUDIT)
        self.afterwards = json.loads(afterwards.read_text()) if afterwards.is_file() else {}

    @cached_property
    def columns(self):
        about = self.rows.stat()
        return columns_of(self.rows, (about.st_mtime_ns, about.st_size))

    def column(self, name):
        if name not in self.columns:
            raise EvidenceError(f"{self.source} has no column '{name}'; it has: {', '.join(self.columns)}")
        return self.columns[name]

    @property
    def usable(self):
        return self.sound and self.manifest.get("dirty") is False

    @property
    def sound(self):
        """Usable but for what made it: a program with uncommitted changes, maybe."""
        return self.manifest.get("status") == "finished" and self.guarantee_kept is not False

    @property
    def failed_audit(self):
        """A run of which an audit found an intersection: evidence against the guarantee, and for nothing else."""
        return self.manifest.get("dirty") is False and self.guarantee_kept is False

    @property
    def audited_states(self):
        """How many states were audited exactly, while the run went on or afterwards."""
        return int(self.manifest.get("audited_states", 0)) + self.afterwards.get("states", 0)

    @property
    def guarantee_kept(self):
        """False where any audit found an intersection, True where one looked and none did, else None."""
        found = [self.manifest.get("guarantee_kept"), self.afterwards.get("clean")]
        return False if False in found else True if True in found and self.audited_states else None

    @property
    def audit_in_words(self):
        return f"{self.audited_states} states audited, {len(self.column('step'))} steps"

    def matches(self, wanted):
        """Whether the run is the one that a claim wants; `wanted`: keys of the manifest, and profiled, audited, membrane,
        activation, redetect_fraction (rounded to single precision in the manifest), and steps: so many from the
        scene's start, not a window."""
        m = self.manifest
        special = {"steps": lambda n: self.column("step")[:1] == [1] and len(self.column("step")) >= n, "profiled": lambda yes: bool(m.get("stages")) == yes,
                   "membrane": lambda name: self.membranes == {name},
                   "activation": lambda name: m["settings"].get("activation", {}).get("value") == name,
                   "redetect_fraction": lambda share: math.isclose(m["settings"]["redetect_fraction"]["value"], share, rel_tol=2**-23),
                   "audited": lambda yes: (self.guarantee_kept is not None) == yes,
                   "scene": lambda name: m["scene"]["name"] == name}
        return all(special[key](value) if key in special else m.get(key) == value for key, value in wanted.items())

    def first(self, steps):
        """The run up to this step: beyond the end of its scene a run is no evidence of it."""
        if len(self.column("step")) <= steps:
            return self
        cut = copy.copy(self)
        cut.columns = {name: self.columns[name][:steps] for name in self.columns}
        return cut

    @property
    def membranes(self):
        """Of the moving bodies: two figures may have one scene with different materials."""
        return {body["material"]["membrane"] for body in self.manifest["scene"]["bodies"] if not is_driven(body)}

    def measured(self, value, about=""):
        m = self.manifest
        return Measured(float(value), self.source, m["device"], m["commit"][:10], m["ended"], about)


def run_at(folder):
    """The run in a run folder; None where it has no manifest or no rows."""
    manifest, rows = folder / "run.json", folder / "steps.csv"
    return RunEvidence(manifest, rows, folder.as_posix()) if manifest.is_file() and rows.is_file() else None


@dataclass(frozen=True)
class Table:
    """A table of results: name (figNN, tableN), scale, rows; `ended`: when its runs did, empty where nobody says so."""

    name: str
    scale: str
    rows: tuple
    source: str
    ended: str = ""


def table_name(path):
    """(figure, scale) of `figNN_SCALE.csv`, or of `figNN.csv` in the folder FIGURE-SCALE-BACKEND of a figure's runs."""
    name, _, scale = path.stem.rpartition("_")
    folder = path.parent.name.split("-")
    return (name, scale) if name else (scale, folder[1] if len(folder) == 3 else "")


def runs_in(folder):
    """Every run below `folder` that has rows, finished or not, by the name of its manifest."""
    found = []
    for path in sorted(Path(folder).rglob("*run.json")):
        rows = path.with_name(path.name.removesuffix("run.json") + "steps.csv")
        kept = [way for way in (rows, rows.with_name(rows.name + ".gz")) if way.is_file()]
        if kept:
            found.append(RunEvidence(path, kept[0], path.relative_to(folder).as_posix()))
    return found


def ended_of(path):
    """When the runs of an accepted table ended, as the provenance beside it says; empty where there is none."""
    provenance = path.with_name("provenance.csv")
    if not provenance.is_file():
        return ""
    with provenance.open(newline="") as file:
        return next((row["ended"] for row in csv.DictReader(file) if row["file"] == path.name), "")


class Evidence:
    """All usable runs and tables below `folder`: accepted results, or run folders; `changed`: of a changed program too."""

    def __init__(self, folder=RESULTS, changed=False):
        folder = Path(folder)
        self.runs, self.tables = sorted(runs_in(folder), key=lambda run: run.manifest.get("ended", "")), []
        self.failed = [run for run in self.runs if run.failed_audit]
        self.runs = [run for run in self.runs if run.usable or changed and run.sound]
        found = ((ended_of(path), path) for path in (*folder.rglob("fig*.csv"), *folder.rglob("table*_*.csv")))
        for ended, path in sorted(found):
            name, scale = table_name(path)
            with path.open(newline="") as file:
                rows = tuple(csv.DictReader(file))
            self.tables.append(Table(name, scale, rows, path.relative_to(folder).as_posix(), ended))
        self._earlier = {}

    def before(self, moment):
        """What of this was there at a moment, as manifests write it (2026-11-21T12:40:00Z)."""
        if moment not in self._earlier:
            earlier = self._earlier[moment] = copy.copy(self)
            was_there = lambda run: run.manifest.get("ended", "") < moment  # noqa: E731
            earlier.runs, earlier.failed = list(filter(was_there, self.runs)), list(filter(was_there, self.failed))
            earlier.tables = [table for table in self.tables if table.ended and table.ended < moment]
        return self._earlier[moment]

    def measure(self, spec, wanted):
        """The number that `spec` describes from the newest run that is as `wanted`, or the newest table, or None where there is none."""
        if isinstance(spec, list):
            return next((found for found in (self.measure(each, wanted) for each in spec) if found), None)
        if "table" in spec:
            return self._of_table(spec, wanted.get("scale"))
        if "ratio" in spec:
            return self._ratio(spec, wanted)
        wanted = {**wanted, **spec.get("run", {})}
        runs = self.runs_as(wanted)
        if "guarantee" in spec:
            # One failed audit outweighs every run that kept the guarantee, whatever its last step and its material.
            runs += [run for run in self.failed if run.matches({key: value for key, value in wanted.items() if key not in ("steps", "membrane")})]
        if not runs:
            return None
        return runs[-1].measured(value_of(runs[-1], spec), runs[-1].audit_in_words if "guarantee" in spec else "")

    def runs_as(self, wanted):
        found = [run for run in self.runs if run.matches(wanted)]
        return [run.first(wanted["steps"]) for run in found] if "steps" in wanted else found

    def _ratio(self, spec, wanted):
        """Of two runs of one commit and of the same materials, and of one machine unless the ratio is about two."""
        over, under = (self.runs_as({**wanted, **part.get("run", {})}) for part in spec["ratio"])
        alike = [(a, b) for a in over for b in under if a.manifest["commit"] == b.manifest["commit"] and a.membranes == b.membranes
                 and (spec.get("devices") == "differ" or a.manifest["device"] == b.manifest["device"])]
        if not alike:
            return None
        a, b = alike[-1]
        first, second = value_of(a, spec["ratio"][0]), value_of(b, spec["ratio"][1])
        found = a.measured(first / second)
        devices = found.device, b.manifest["device"]
        on = f"each on {devices[0]}" if len(set(devices)) == 1 else " over ".join(devices)
        ended = max(a.manifest["ended"], b.manifest["ended"])
        return Measured(found.value, f"{a.source} / {b.source}", found.device, found.commit, ended, on)

    def _of_table(self, spec, scale):
        for table in reversed([t for t in self.tables if t.name == spec["table"] and t.scale == scale]):
            rows = [_row(table, spec[key]) for key in (("over", "under") if "over" in spec else ("where",))]
            if any(row is None for row in rows):
                continue
            cells = [_cell(table, row, spec["column"]) for row in rows]
            if len({row["commit"] for row in rows}) > 1:
                raise EvidenceError(f"{table.source} mixes commits {', '.join(sorted({row['commit'] for row in rows}))}: make all its rows by one program")
            if len({row["device"] for row in rows}) > 1:  # a ratio of two machines says nothing
                continue
            value = cells[0] / cells[1] if len(cells) > 1 else cells[0]
            on = f"each on {rows[0]['device']}" if len(cells) > 1 and "[ms]" in spec["column"] else ""
            return Measured(value, table.source, rows[0]["device"], rows[0]["commit"], rows[0].get("ended", ""), on)
        return None


def _row(table, wanted):
    rows = [row for row in table.rows if all(row.get(key) == value for key, value in wanted.items()) and "dirty" not in row["commit"] and row.get("status") != NOT_RUN]
    return rows[0] if rows else None


def _cell(table, row, column):
    if column not in row:
        raise EvidenceError(f"{table.source} has no column '{column}'; it has: {', '.join(row)}")
    try:
        return float(row[column])
    except ValueError:
        return math.nan


def value_of(run, spec):
    """A number of one run: statistics of its rows, a setting, a count of its scene."""
    m = run.manifest
    if "steps" in spec:
        return _statistic(run, spec) * spec.get("times", 1)
    if "setting" in spec:
        return m["settings"][spec["setting"]]["value"]
    moving = [body for body in m["scene"]["bodies"] if not is_driven(body)]
    if "material" in spec:
        values = {body["material"][spec["material"]]["value"] for body in moving}
        return values.pop() if len(values) == 1 else math.nan
    if "scene" in spec:
        return _count(m["scene"], moving, spec["scene"])
    if "guarantee" in spec:
        return 0 if run.guarantee_kept else 1
    if "simulated" in spec:
        return len(run.column("step")) * m["settings"]["time_step"]["value"]
    if "real_time" in spec:
        return 1e3 * m["settings"]["time_step"]["value"] / statistics.fmean(run.column(spec["real_time"]))
    raise EvidenceError(f"a claim measures {json.dumps(spec)}, which nobody knows how to")


def _count(scene, moving, what):
    driven = [body for body in scene["bodies"] if is_driven(body)]
    counts = {"vertices": (moving, "vertex_count"), "triangles": (moving, "triangle_count"), "fixed_vertices": (driven, "vertex_count"), "fixed_triangles": (driven, "triangle_count")}
    if what in counts:
        bodies, key = counts[what]
        return sum(body[key] for body in bodies)
    if what == "moving_bodies":
        return len(moving)
    if what not in scene:
        raise EvidenceError(f"the manifest of {scene['name']} has no count of {what}")
    return scene[what]


def _statistic(run, spec):
    names = spec["steps"] if isinstance(spec["steps"], list) else [spec["steps"]]
    values = [sum(row) for row in zip(*(run.column(name) for name in names))]
    kinds = {"mean": statistics.fmean, "max": max, "sum": sum, "max over mean": lambda v: max(v) / statistics.fmean(v),
             "sum over": lambda v: sum(v) / sum(run.column(spec["over"]))}
    return kinds[spec["statistic"]](values)
