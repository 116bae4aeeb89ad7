"""What stands behind accepted files: the command, the time that it took, the hardware, the commit; from the provenance
and durations beside them, and from the manifests of runs."""

import csv
import math
from dataclasses import dataclass, replace

from paper_figures.workflow import contents
from paper_figures.workflow.durations import OF_ALL_RUNS, in_words, measured_times, seconds_between
from paper_figures.workflow.evidence import NOT_RUN, RESULTS

QUOTIENT = " / "  # between the two sources of a ratio


@dataclass(frozen=True)
class Origin:
    """Holds what is known of a file below the results. `seconds`: how long its run or figure took, None if nobody
    measured it; `by_rows`: it is the time that the table's rows name."""

    file: str
    command: str
    seconds: float
    hardware: str
    commit: str
    by_rows: bool = False

    @property
    def time(self):
        if self.seconds is None:
            return "not measured: the file has no times of its runs"
        return in_words(self.seconds) + (", by its rows" if self.by_rows else "")

    @property
    def machine(self):
        """Returns the folder of the results, whose README describes the machine."""
        return self.file.partition("/")[0]


def seconds_by_rows(path):
    """Returns how long the rows of a table say that they took [s]: the steps of runs by their mean, single steps by
    their own time, the runs of ablations by the rows about it; None if it does not say for each row that was run, or
    each scene."""
    if not contents.is_table(path.name):
        return None
    rows = [row for row in contents.rows_of(path) if row.get("status") != NOT_RUN]
    if rows and "metric" in rows[0]:
        scenes = lambda found: {(row["study"], row["scene"]) for row in found}  # noqa: E731
        timed = [row for row in rows if row["metric"] == OF_ALL_RUNS and row["median"]]
        return sum(float(row["median"]) for row in timed) if scenes(timed) == scenes(rows) else None
    try:
        times = [float(row["step [ms]"]) if "step [ms]" in row
                 else float(row["mean [ms]"]) * (int(row["last step"]) - int(row["first step"]) + 1) for row in rows]
    except (KeyError, ValueError):
        return None
    return sum(times) / 1000 if times and all(map(math.isfinite, times)) else None


class Origins:
    """Knows the origins of all accepted files."""

    def __init__(self, runs, folder=RESULTS):
        self.folder, self.runs = folder, {run.source: run for run in runs}
        self.rows, self.times = {}, measured_times()
        for path in sorted(folder.glob("*/provenance.csv")):
            with path.open(newline="", encoding="utf-8") as file:
                self.rows.update({f"{path.parent.name}/{row['file']}": row for row in csv.DictReader(file)})

    def of_file(self, name):
        """Returns the origin of a file, named as below the results."""
        row, run = self.rows.get(name, {}), self.runs.get(name)
        seconds = seconds_between(run.manifest) if run else None
        took = self.times.get((row.get("figure"), row.get("scale"), row.get("backend")))
        if run is None and took and took[1] == name.partition("/")[0]:
            seconds = took[0]
        by_rows = seconds_by_rows(self.folder / name) if seconds is None and name in self.rows else None
        device = run.manifest["device"] if run else row.get("device", "")
        return Origin(name, row.get("redo", ""), by_rows if seconds is None else seconds, device,
                      row.get("commit", "")[:10], seconds is None and by_rows is not None)

    def of(self, measured):
        """Returns the origins of a measured number: of a ratio those of both runs."""
        found = [self.of_file(name) for name in measured.source.split(QUOTIENT)]
        return [each if each.hardware not in ("", "rows say") else
                replace(each, hardware=measured.device, commit=each.commit or measured.commit) for each in found]

    def title_of_machine(self, machine):
        """Returns the machine in words: the title of the README of its results. What was tried is of no machine, and
        has the whole title."""
        title = (self.folder / machine / "README.md").read_text(encoding="utf-8").partition("\n")[0]
        return title.removeprefix("# ").rpartition(": ")[2]
