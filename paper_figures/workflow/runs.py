"""Provides the runs of `ogc` that a figure needs, each made once: a folder that holds a finished run is used as it
is."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from paper_figures.workflow.evidence import command_of, membranes_of
from paper_figures.workflow.jobs import Job, RunFailure
from ogc_testbed.columns import column_and_unit
from ogc_testbed.runs import Run, RunError


@dataclass
class Iterations:
    """Holds iterations.csv of one step: column name without unit -> array."""

    columns: dict

    def __getitem__(self, name):
        return self.columns[name]


def run_job(ogc, job, folder):
    """Returns the run of a job (paper_figures.workflow.commands) below `folder`. Throws RunError."""
    try:
        job.make(ogc, Path(folder), shown=True)
    except RunFailure as error:
        raise RunError(str(error)) from error
    return Run(Path(folder) / job.name)


def iterations(run, step):
    """Returns the rows of one step. Throws RunError if the run has none."""
    path = run.folder / "iterations.csv"
    if not path.is_file():
        raise RunError(f"{path} is missing: run with --iterations")
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    names = [column_and_unit(title)[0] for title in rows[0]]
    values = np.array([[float(text) for text in row] for row in rows[1:] if row and int(row[0]) == step])
    if not len(values):
        raise RunError(f"{path} has no row of step {step}")
    return Iterations({name: values[:, i] for i, name in enumerate(names)})


def provenance(run):
    """Returns the provenance that a row of an accepted result must have."""
    m = run.manifest
    return {"solver": m["solver"], "backend": m["backend"], "device": m["device"],
            "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else ""),
            "membrane": " and ".join(sorted(membranes_of(m))),
            "command": command_of(m)}


def write_table(path, rows):
    """Writes rows (dictionaries with the same keys, units in their names) as CSV."""
    with Path(path).open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
