"""Repeats whole runs on a quiet machine, so that a step's time is that of the method and not of what the machine did
beside it: the time of a step is the median of its times in all repetitions. The repetitions end in the same bits; if
any number in their rows differs except times, the table is refused.

`steady` is the largest of these medians over their mean, which claims about near-constant cost read. Beside it stands
the same ratio of single runs. Needs only Python's own library.

Usage: python3 -m paper_figures.workflow.steady FOLDER --out steady_SCALE.csv gathers the rows of all that was repeated
below FOLDER.
"""

import argparse
import csv
import gzip
import io
import statistics
import sys
from dataclasses import dataclass
from pathlib import Path

from paper_figures.workflow import commands
from paper_figures.workflow.evidence import contact_of, membranes_of
from paper_figures.workflow.jobs import DEVICE, KEPT, Job, Limit, RunFailure, manifest_of

TIME, STEP = "wall [ms]", "step [1]"
ROW, STEPS = "steady.csv", "step_medians.csv.gz"  # beside the repetitions
COLUMNS = ("variant", "row", "choice", "scene", "scale", "bounds", "body_contact", "membrane", "runs", "steps",
           "mean of medians [ms]", "largest median [ms]", "largest median over mean [1]",
           "largest over mean of one run, least [1]", "largest over mean of one run, most [1]", "detections a step",
           "final state", "solver", "backend", "device", "commit", "ended", "command")


@dataclass(frozen=True)
class Timed(Job):
    """Runs as a Job, but packs its manifest alone, and nothing looks at the device while it runs."""

    on_device, needs = False, DEVICE

    def done(self, root):
        """Returns whether it is finished and its rows are there, or the table that was made of them."""
        folder = root / self.name
        return super().done(root) and ((folder / "steps.csv").is_file() or (folder.parent / ROW).is_file())

    def results(self, root, frames, last):
        yield from (path for path in [root / self.name / "run.json"] if self.done(root))


@dataclass(frozen=True)
class Repeated:
    """Describes a whole run that is repeated `runs` times. `row`: of Table 1; `options`: what differs from it, and
    `choice`: the same in words, unless it is the membrane, which has a column; `scene` as in Job."""

    row: str
    runs: int = 5
    suffix: str = ""
    options: tuple = ()
    choice: str = ""
    scene: object = None

    @property
    def name(self):
        return self.row + self.suffix

    def jobs(self, scale, backend):
        """Returns the repetitions, and the table of their medians. Frames would be written beside the steps: there is
        one, at the end."""
        words = () if self.scene else (commands.scene_of(self.row), "--scale", scale)
        words += ("--backend", backend, "--audit", "off", *commands.of_row(self.row, ""), *self.options,
                  "--set", "frame_steps=1000000")
        timed = tuple(Timed(f"{self.name}/repeat_{k}", words, scene=self.scene, pictured=False)
                      for k in range(1, 1 + self.runs))
        return (*timed, Medians(self, scale, timed))


@dataclass(frozen=True)
class Medians:
    """Makes the row about finished repetitions and the table of their steps. As a job it costs nothing, and is made
    anew in each call."""

    repeated: Repeated
    scale: str
    jobs: tuple
    on_device = False

    @property
    def name(self):
        return f"{self.repeated.name}/medians"

    def done(self, _root):
        return False

    def make(self, _program, root, _limit=Limit(), _shown=False):
        if all((root / job.name / "steps.csv").is_file() and job.done(root) for job in self.jobs):
            row, steps = medians(self.repeated, self.scale, [root / job.name for job in self.jobs])
            folder = root / self.repeated.name
            write_changed(folder / ROW, as_csv(COLUMNS, [row]).encode())
            write_changed(folder / STEPS, gzip.compress(as_csv(list(steps[0]), steps).encode(), mtime=0))
        return KEPT

    def results(self, root, _frames, _last):
        yield from (path for name in (ROW, STEPS) for path in [root / self.repeated.name / name] if path.is_file())


def write_changed(path, data):
    """Writes a file unless it is the same: one that changes is packed again."""
    if not path.is_file() or path.read_bytes() != data:
        path.write_bytes(data)


def as_csv(columns, rows):
    out = io.StringIO()
    writer = csv.DictWriter(out, fieldnames=columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


def rows_in(run):
    with (run / "steps.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def bits(row):
    """Returns all cells of a row that are no times."""
    return [text for title, text in row.items() if not title.endswith("[ms]")]


def medians(repeated, scale, folders):
    """Returns (row of the table, rows of the steps). Throws RunFailure if two repetitions differ in more than
    times."""
    runs, manifests = [rows_in(folder) for folder in folders], [manifest_of(folder) for folder in folders]
    for folder, rows, manifest in zip(folders, runs, manifests):
        same = len(rows) == len(runs[0]) and all(bits(row) == bits(first) for row, first in zip(rows, runs[0]))
        if not same or manifest["final_hash"] != manifests[0]["final_hash"]:
            raise RunFailure(f"{folder} differs from {folders[0]} in more than times: the same command of one program "
                             "gave other bits, which is an error of the program")
    times = [[float(row[TIME]) for row in rows] for rows in runs]
    by_step = list(zip(*times))
    middle = [statistics.median(of_step) for of_step in by_step]
    mean, singles = statistics.fmean(middle), [max(each) / statistics.fmean(each) for each in times]
    steps = [{STEP: row[STEP], "median [ms]": f"{median:.6g}", "smallest [ms]": f"{min(of_step):.6g}",
              "largest [ms]": f"{max(of_step):.6g}"} for row, median, of_step in zip(runs[0], middle, by_step)]
    return {**about(repeated, scale, manifests), "runs": len(runs), "steps": len(middle),
            "mean of medians [ms]": f"{mean:.6g}", "largest median [ms]": f"{max(middle):.6g}",
            "largest median over mean [1]": f"{max(middle) / mean:.6g}",
            "largest over mean of one run, least [1]": f"{min(singles):.6g}",
            "largest over mean of one run, most [1]": f"{max(singles):.6g}",
            "detections a step": f"{statistics.fmean(float(row['discrete_detections [1]']) for row in runs[0]):.6g}",
            }, steps


def about(repeated, scale, manifests):
    """Returns the cells that say what was run."""
    first, scene = manifests[0], manifests[0]["scene"]
    words = first["command"].split()
    return {"variant": repeated.name, "row": repeated.row, "choice": repeated.choice,
            "scene": scene["name"], "scale": scale,
            "bounds": first["settings"]["bounds"]["value"],
            "body_contact": "volume" if "volume" in map(contact_of, scene["bodies"]) else "surface",
            "membrane": " and ".join(sorted(membranes_of(first))), "final state": first["final_hash"],
            "solver": first["solver"], "backend": first["backend"], "device": first["device"],
            "commit": first["commit"][:10] + (" (dirty)" if first.get("dirty") else ""),
            "ended": max(manifest["ended"] for manifest in manifests),
            "command": " ".join(["ogc", *("data=DIR" if word.startswith("data=") else word.rpartition("/")[2]
                                          for word in words[1:])])}


def gathered(folder):
    """Returns the rows of all that was repeated below a folder, by their names. Throws RunFailure if there are
    none."""
    rows = []
    for path in sorted(Path(folder).rglob(ROW)):
        with path.open(newline="") as file:
            rows += csv.DictReader(file)
    if not rows:
        raise RunFailure(f"{folder} has no {ROW}: make parts steady_… with experiments/evidence first")
    return sorted(rows, key=lambda row: row["variant"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where the repetitions are")
    parser.add_argument("--out", type=Path, required=True, help="the table")
    options = parser.parse_args()
    try:
        options.out.write_text(as_csv(COLUMNS, gathered(options.folder)))
    except RunFailure as problem:
        sys.exit(f"steady: {problem}")


if __name__ == "__main__":
    main()
