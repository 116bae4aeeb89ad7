"""Provides the evidence that claims are judged by: accepted runs and tables, or a run folder, read with the standard
library alone so that a judgement needs no package.

A run is a manifest (`run.json`, or `X_run.json` of an accepted result) with its rows (`steps.csv`; of an accepted
result `X_steps.csv`, of a long one `X_hundreds.csv`, see thinned.py; compressed ones end in `.gz`). A table is
`figNN_SCALE.csv`, `tableN_SCALE.csv` or an ablation's (TABLES), with a commit and a device in each row. An accepted
manifest names its scene by the hash of `results/scenes/HASH.json`. Runs that are unfinished, of a changed tree, or that
failed their audit are no evidence.
"""

import copy
import csv
import gzip
import json
import math
import re
import statistics
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

from paper_figures.workflow import ratios
from paper_figures.workflow.jobs import AUDIT
from paper_figures.workflow.thinned import Hundreds
from ogc_testbed.columns import column_and_unit

ROOM = Path(__file__).parent.parent  # paper_figures
RESULTS, CLAIMS = ROOM / "results", ROOM / "claims"
SCENES = "scenes"  # folder below the results: the scenes of accepted manifests, each named by its hash
ROWS = ("steps.csv", "hundreds.csv")  # a run's rows: of each step, or thinned
PAPER_BOUNDS = "ball"
SURFACE, VOLUME = "surface", "volume"  # kinds of contact of a body
NOT_RUN = "not run"  # the status of a table's row about a run that its figure lacks
TABLES = ("fig*.csv", "table*_*.csv", "ablations*.csv", "ablations*.csv.gz", "radius*.csv", "sphere_off*.csv",
          "yarn_return*.csv", "cpu_windows_*.csv", "steady_*.csv", "peers_cipc_*.csv", "peers_gipc_*.csv")
WINDOWS = "cpu_windows"  # the table of steps on the CPU from states of whole runs
MEMBRANES = {"stable_neo_hookean": "stable Neo-Hookean", "st_venant_kirchhoff": "St. Venant–Kirchhoff"}


class EvidenceError(Exception):
    """Raised for a result that does not have what its claim needs; the message names it, the lack and a remedy."""


@dataclass(frozen=True)
class Measured:
    """Holds a number and its origin. `source` is a path below the folder of the results, `about` is what a reader must
    know besides, as a sentence, `membrane` is the model of its cloth, empty if there is none or it is not known,
    `sides` are the programs that it compares, one if it compares none."""

    value: float
    source: str
    device: str
    commit: str
    ended: str
    about: str = ""
    membrane: str = ""
    sides: tuple = ()


def opened(path):
    """Opens a file of rows, compressed or not."""
    return (gzip.open if path.suffix == ".gz" else open)(path, "rt", newline="")


class Columns(Mapping):
    """Maps names without units to columns of a file of rows; a column is converted to numbers when it is used."""

    def __init__(self, path):
        with opened(path) as file:
            names, *rows = [row for row in csv.reader(file) if row]
        rows = [row for row in rows if len(row) == len(names)]
        names = [column_and_unit(name)[0] for name in names]
        self.texts = dict(zip(names, zip(*rows) if rows else [()] * len(names)))
        self._numbers = {}

    def __getitem__(self, name):
        if name not in self._numbers:
            self._numbers[name] = [float(text or "nan") for text in self.texts[name]]
        return self._numbers[name]

    def __iter__(self):
        return iter(self.texts)

    def __len__(self):
        return len(self.texts)


@lru_cache(maxsize=None)
def columns_of(path, stamp):
    """Returns the columns of a file; `stamp` distinguishes its versions."""
    return Columns(path)


def is_driven(body):
    """Returns whether nothing of the body is simulated: it is fixed, or follows a prescribed motion as a whole."""
    return body["fixed"] or body.get("prescribed_vertices") == body["vertex_count"]


def membranes_of(manifest):
    """Returns the models of the simulated membranes: only cloth uses a body's model, and two figures may have one scene
    with different materials."""
    return {body["material"]["membrane"] for body in manifest["scene"]["bodies"] if not is_driven(body)
            and body.get("triangle_count") and not body.get("tetrahedron_count")}


def command_of(manifest):
    """Returns the command of a run as text; of its paths the last part."""
    command = manifest["command"] if isinstance(manifest["command"], str) else " ".join(manifest["command"])
    return "ogc " + re.sub(r"(?<= )/\S*/", "", command.partition(" ")[2])


def contact_of(body):
    """Returns a body's kind of contact; a manifest without it is from before there were volumes."""
    return body.get("body_contact", SURFACE)


def manifest_at(path):
    """Returns the manifest with its scene, wherever that is kept. Throws EvidenceError if it does not exist."""
    manifest = json.loads(path.read_text())
    digest = manifest.get("scene", {}).get("sha256")
    if digest is None:
        return manifest
    scene = next((way for folder in path.parents if (way := folder / SCENES / f"{digest}.json").is_file()), None)
    if scene is None:
        raise EvidenceError(f"{path}: its scene {digest}.json is in no folder {SCENES} above it: accept the run again")
    return {**manifest, "scene": json.loads(scene.read_text())}


class RunEvidence:
    """Holds a run: its manifest, and the columns of its rows without units."""

    def __init__(self, manifest, rows, source):
        self.manifest, self.rows, self.source = manifest_at(Path(manifest)), Path(rows), source
        afterwards = Path(manifest).with_name(Path(manifest).name.removesuffix("run.json") + AUDIT)
        self.afterwards = json.loads(afterwards.read_text()) if afterwards.is_file() else {}

    @cached_property
    def columns(self):
        about = self.rows.stat()
        return columns_of(self.rows, (about.st_mtime_ns, about.st_size))

    @cached_property
    def thinned(self):
        """Returns statistics of a run whose rows are thinned; None if every row is there."""
        if ROWS[1] not in self.rows.name:
            return None
        return Hundreds(self.columns.texts, self.manifest["whole_run"])

    def column(self, name):
        """Returns a number for each step. Throws EvidenceError if there is no such column, or not a row for every
        step."""
        if self.thinned:
            raise EvidenceError(f"{self.source} keeps a row of each hundred steps: ask for its mean, largest or course")
        return self._checked(name, self.columns)[name]

    def _checked(self, name, columns):
        if name not in columns:
            raise EvidenceError(f"{self.source} has no column '{name}'; it has: {', '.join(self.columns)}")
        return columns

    @property
    def step_count(self):
        return self.thinned.count if self.thinned else len(self.column("step"))

    @property
    def first_step(self):
        """Returns the number of the first row's step; None if there is no row. A thinned run begins at 1, or at the
        step that it names."""
        if self.thinned:
            return self.thinned.of("smallest", "step")[0]
        return next(iter(self.column("step")), None)

    def mean(self, name):
        return self._checked(name, self.thinned).mean(name) if self.thinned else statistics.fmean(self.column(name))

    def largest(self, name):
        return self._checked(name, self.thinned).largest(name) if self.thinned else max(self.column(name))

    def course(self, name):
        """Returns (steps, values): of every row, or of each hundred."""
        if self.thinned:
            return self.thinned.of("row", "step"), self._checked(name, self.thinned).of("row", name)
        return self.column("step"), self.column(name)

    @property
    def usable(self):
        return self.sound and self.manifest.get("dirty") is False

    @property
    def sound(self):
        """Returns whether the run is usable apart from its program, which may have uncommitted changes."""
        return self.manifest.get("status") == "finished" and self.guarantee_kept is not False

    @property
    def failed_audit(self):
        """Returns whether an audit of the run found an intersection: it is evidence against the guarantee, and for
        nothing else."""
        return self.manifest.get("dirty") is False and self.guarantee_kept is False

    @property
    def audited_states(self):
        """Returns how many states were audited exactly, during the run or afterwards."""
        return int(self.manifest.get("audited_states", 0)) + self.afterwards.get("states", 0)

    @property
    def guarantee_kept(self):
        """Returns False if any audit found an intersection, True if there was one and none did, else None."""
        found = [self.manifest.get("guarantee_kept"), self.afterwards.get("clean")]
        return False if False in found else True if True in found and self.audited_states else None

    @property
    def is_certified(self):
        """Returns whether the run's own certificate of motion held. IPC has none, and audits of stored states do not
        check motion."""
        return self.manifest.get("guarantee_kept") is True and self.manifest["solver"] != "ipc"

    @property
    def audit_in_words(self):
        return f"{self.audited_states:,} states of {self.step_count:,} steps were audited."

    @property
    def side(self):
        return ratios.Side(ratios.OURS, self.manifest["commit"][:10], self.manifest["device"])

    def matches(self, wanted):
        """Returns whether the run is the one that a claim wants. `wanted`: keys of the manifest, and profiled, audited,
        audited_states (at least so many), membrane, contact_activation, bounds, body_contact, detection_radius_cap,
        detection_fraction (rounded to single precision in the manifest), and steps: so many from the scene's start, not
        a window. A start moved by --jitter, bounds other than the paper's, and bodies that may be entered match only if
        the claim names them."""
        m = self.manifest
        bounds = m["settings"].get("bounds", {}).get("value", PAPER_BOUNDS)
        if "jitter" in m and "jitter" not in wanted or bounds != wanted.get("bounds", PAPER_BOUNDS):
            return False
        if self.contact != wanted.get("body_contact", SURFACE):
            return False
        if "time_repeats" in m:  # its times are those of warm repetitions of single steps
            return False
        special = {"steps": lambda n: self.first_step == 1 and self.step_count >= n,
                   "profiled": lambda yes: bool(m.get("stages")) == yes,
                   "membrane": lambda name: self.membranes == {name},
                   "contact_activation": lambda name: m["settings"].get("contact_activation", {}).get("value") == name,
                   "detection_radius_cap": lambda cap: m["settings"]["detection_radius_cap"]["value"] == cap,
                   "bounds": lambda name: bounds == name,
                   "body_contact": lambda name: self.contact == name,
                   "detection_fraction":
                       lambda share: math.isclose(m["settings"]["detection_fraction"]["value"], share, rel_tol=2**-23),
                   "audited_states": lambda n: self.audited_states >= n,
                   "audited": lambda yes: (self.guarantee_kept is not None) == yes,
                   "scene": lambda name: m["scene"]["name"] == name}
        return all(special[key](value) if key in special else m.get(key) == value for key, value in wanted.items())

    def first(self, steps):
        """Returns the run up to this step: beyond the end of its scene a run is no evidence of it."""
        if self.step_count <= steps:
            return self
        cut = copy.copy(self)
        if self.thinned:
            cut.thinned = self._cut(steps)
            return cut
        cut.columns = {name: self.columns[name][:steps] for name in self.columns}
        return cut

    def _cut(self, steps):
        try:
            return self.thinned.first(steps)
        except ValueError as error:
            raise EvidenceError(f"{self.source}: {error}: accept a run of {steps} steps") from error

    @property
    def contact(self):
        """Returns the contact of its bodies: VOLUME if others may enter any of them (compare/volumes.md)."""
        return VOLUME if any(contact_of(body) == VOLUME for body in self.manifest["scene"]["bodies"]) else SURFACE

    @property
    def membranes(self):
        return membranes_of(self.manifest)

    def measured(self, value, about=""):
        m = self.manifest
        return Measured(float(value), self.source, m["device"], m["commit"][:10], m["ended"], about,
                        " and ".join(sorted(self.membranes)), (self.side,))


def run_at(folder):
    """Returns the run in a run folder; None if it has no manifest or no rows."""
    manifest, rows = folder / "run.json", folder / "steps.csv"
    return RunEvidence(manifest, rows, folder.as_posix()) if manifest.is_file() and rows.is_file() else None


@dataclass(frozen=True)
class Table:
    """Holds a table of results: name (figNN, tableN), scale, rows; `ended`: when its runs ended, empty if not known."""

    name: str
    scale: str
    rows: tuple
    source: str
    ended: str = ""


def table_name(path):
    """Returns (figure, scale) of `figNN_SCALE.csv`, or of `figNN.csv` in the folder FIGURE-SCALE-BACKEND of a figure's
    runs."""
    name, _, scale = path.name.removesuffix(".gz").removesuffix(".csv").rpartition("_")
    folder = path.parent.name.split("-")
    return (name, scale) if name else (scale, folder[1] if len(folder) == 3 else "")


def runs_in(folder):
    """Returns every run below `folder` that has rows, finished or not, by the name of its manifest."""
    found = []
    for path in sorted(Path(folder).rglob("*run.json")):
        stem = path.name.removesuffix("run.json")
        ways = (path.with_name(stem + rows + suffix) for rows in ROWS for suffix in ("", ".gz"))
        kept = [way for way in ways if way.is_file()]
        if kept:
            found.append(RunEvidence(path, kept[0], path.relative_to(folder).as_posix()))
    return found


def ended_of(path):
    """Returns when the runs of an accepted table ended, from the provenance beside it; empty if there is none."""
    provenance = path.with_name("provenance.csv")
    if not provenance.is_file():
        return ""
    with provenance.open(newline="") as file:
        return next((row["ended"] for row in csv.DictReader(file) if row["file"] == path.name), "")


def same_sources(first, second):
    """Returns whether two commits are one, or have the same sources."""
    return first == second or sources_of(first) is not None and sources_of(first) == sources_of(second)


@lru_cache(maxsize=None)
def sources_of(commit):
    """Returns the digests of the rooms at a commit by results/contents.csv; None if it does not know them."""
    from paper_figures.workflow import contents  # which takes RESULTS from here

    found = contents.contents_of(commit, contents.kept())[:len(contents.ROOMS)]
    return None if contents.UNKNOWN in found else found


class Evidence:
    """Holds all usable runs and tables below `folder`: accepted results, or run folders; `changed`: also those of a
    changed program."""

    def __init__(self, folder=RESULTS, changed=False):
        folder = Path(folder)
        self.runs, self.tables = sorted(runs_in(folder), key=lambda run: run.manifest.get("ended", "")), []
        self.failed = [run for run in self.runs if run.failed_audit]
        self.runs = [run for run in self.runs if run.usable or changed and run.sound]
        found = ((ended_of(path), path) for pattern in TABLES for path in folder.rglob(pattern))
        for ended, path in sorted(found):
            name, scale = table_name(path)
            with opened(path) as file:
                rows = tuple(csv.DictReader(file))
            self.tables.append(Table(name, scale, rows, path.relative_to(folder).as_posix(), ended))
        self._earlier = {}

    def before(self, moment):
        """Returns the part of this evidence that existed at a moment, in the form of manifests
        (2026-11-21T12:40:00Z)."""
        if moment not in self._earlier:
            earlier = self._earlier[moment] = copy.copy(self)
            was_there = lambda run: run.manifest.get("ended", "") < moment  # noqa: E731
            earlier.runs, earlier.failed = list(filter(was_there, self.runs)), list(filter(was_there, self.failed))
            earlier.tables = [table for table in self.tables if table.ended and table.ended < moment]
        return self._earlier[moment]

    def measure(self, spec, wanted):
        """Returns the number that `spec` describes from the newest run that matches `wanted`, or from the newest table;
        None if there is none."""
        if isinstance(spec, list):
            return next((found for found in (self.measure(each, wanted) for each in spec) if found), None)
        if "table" in spec:
            return self._of_table(spec, spec.get("scale", wanted.get("scale")))
        wanted = {**wanted, **({"membrane": spec["membrane"]} if "membrane" in spec else {})}
        if "ratio" in spec:
            return self._ratio(spec, wanted)
        wanted = {**wanted, **spec.get("run", {})}
        runs = self.runs_as(wanted)
        if "guarantee" in spec:
            # One failed audit outweighs every run that kept the guarantee, whatever its last step and its material.
            others = ("steps", "audited_states", *(() if "membrane" in spec else ("membrane",)))
            alike = {key: value for key, value in wanted.items() if key not in others}
            runs += [run for run in self.failed if run.matches(alike)]
        if not runs:
            return None
        return runs[-1].measured(value_of(runs[-1], spec), runs[-1].audit_in_words if "guarantee" in spec else "")

    def runs_as(self, wanted):
        found = [run for run in self.runs if run.matches(wanted)]
        return [run.first(wanted["steps"]) for run in found] if "steps" in wanted else found

    def _ratio(self, spec, wanted):
        """Returns the ratio of two runs of the same sources and the same materials, and of one machine unless the ratio
        is about two."""
        over, under = (self.runs_as({**wanted, **part.get("run", {})}) for part in spec["ratio"])
        alike = [(a, b) for a in over for b in under if same_sources(a.manifest["commit"], b.manifest["commit"])
                 and a.membranes == b.membranes
                 and (spec.get("devices") == "differ" or a.manifest["device"] == b.manifest["device"])]
        if not alike:
            return None
        a, b = alike[-1]
        first, second = value_of(a, spec["ratio"][0]), value_of(b, spec["ratio"][1])
        found = a.measured(first / second)
        devices = found.device, b.manifest["device"]
        on = (f"Both ran on {devices[0]}." if len(set(devices)) == 1
              else f"The first ran on {devices[0]}, the second on {devices[1]}.")
        ended = max(a.manifest["ended"], b.manifest["ended"])
        return Measured(found.value, f"{a.source} / {b.source}", found.device, found.commit, ended, on, found.membrane,
                        (a.side, b.side))

    def _of_table(self, spec, scale):
        """Returns a cell of a table of this scale (a `scale` of the spec's own goes first), or the quotient of two;
        `column` is then one for both, or a list of one for each. If runs vary, [smallest, largest] bounds the ratio of
        every run of the first to every run of the second. `membrane`: that of the rows."""
        asked = {"membrane": spec["membrane"]} if "membrane" in spec else {}
        for table in reversed([t for t in self.tables if t.name == spec["table"] and t.scale == scale]):
            places = ("over", "under") if "over" in spec else ("where",)
            rows = [_row(table, {**spec[place], **asked}) for place in places]
            if any(row is None for row in rows):
                continue
            columns = [spec["column"]] * len(rows) if isinstance(spec["column"], str) else spec["column"]
            cells = [_cell(table, row, column) for row, column in zip(rows, columns)]
            sides = tuple(map(ratios.side_of, rows))
            if len({side.program for side in sides}) == 1 and len({side.version for side in sides}) > 1:
                raise EvidenceError(f"{table.source} mixes commits {', '.join(sorted(s.version for s in sides))}: make "
                                    "all its rows by one program")
            is_time = any("[ms]" in column for column in columns) or rows[0].get("unit") == "ms"
            # A ratio of times on two machines means nothing; counts have the same bits on any number of threads.
            if is_time and len({side.machine for side in sides}) > 1:
                continue
            value = cells[0] / cells[1] if len(cells) > 1 else cells[0]
            on = f"Both ran on {rows[0]['device']}." if len(cells) > 1 and is_time else ""
            return Measured(value, table.source, rows[0]["device"], rows[0]["commit"], rows[0].get("ended", ""), on,
                            rows[0].get("membrane", ""), sides)
        return None

    def windows(self, wanted):
        """Returns what steps on the CPU took in windows from states of the whole run that `wanted` describes, as a
        sentence; empty if there are none."""
        name = wanted["scene"] + ("_volumes" if wanted.get("body_contact") == VOLUME else "")
        for table in reversed([t for t in self.tables if (t.name, t.scale) == (WINDOWS, wanted.get("scale"))]):
            rows = [row for row in table.rows if row["row"] in (name, f"{name}_planes")]
            rows = [row for row in rows if row["row"] == name] or rows
            if rows:
                means = sorted(float(row["mean step [ms]"]) for row in rows)
                worst = max(float(row["worst step [ms]"]) for row in rows)
                first, last, most = (f"{value:,.0f}" if value >= 1000 else f"{value:.3g}"
                                     for value in (means[0], means[-1], worst))
                steps = int(rows[0]["steps"])
                planes = ", with planes," if rows[0]["row"] != name else ""
                return (f"In windows of {steps} step{'s' * (steps > 1)} from {len(rows)} of its states a step{planes} "
                        f"takes {first} to {last} ms on average and {most} ms at most ({table.source}).")
        return ""


def _row(table, wanted):
    rows = [row for row in table.rows if all(row.get(key) == value for key, value in wanted.items())
            and "dirty" not in row["commit"] and row.get("status") != NOT_RUN]
    return rows[0] if rows else None


def _cell(table, row, column):
    if column not in row:
        raise EvidenceError(f"{table.source} has no column '{column}'; it has: {', '.join(row)}")
    try:
        return float(row[column])
    except ValueError:
        return math.nan


def value_of(run, spec):
    """Returns a number of one run: statistics of its rows, a setting, a count of its scene."""
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
        return run.step_count * m["settings"]["time_step"]["value"]
    if "real_time" in spec:
        return 1e3 * m["settings"]["time_step"]["value"] / run.mean(spec["real_time"])
    raise EvidenceError(f"a claim measures {json.dumps(spec)}, which nobody knows how to")


def _count(scene, moving, what):
    driven = [body for body in scene["bodies"] if is_driven(body)]
    counts = {"vertices": (moving, "vertex_count"), "triangles": (moving, "triangle_count"),
              "fixed_vertices": (driven, "vertex_count"), "fixed_triangles": (driven, "triangle_count")}
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
    if spec["statistic"] == "last":
        return sum(run.course(name)[1][-1] for name in names)
    mean = sum(run.mean(name) for name in names)
    kind = spec["statistic"]
    if kind in ("max", "max over mean"):
        largest = _largest(run, names)
        return largest if kind == "max" else largest / mean
    return {"mean": mean, "sum": mean * run.step_count}[kind] if kind != "sum over" else mean / run.mean(spec["over"])


def _largest(run, names):
    """Returns the largest of the sums of columns."""
    if len(names) == 1:
        return run.largest(names[0])
    return max(sum(row) for row in zip(*(run.column(name) for name in names)))
