"""Runs of `ogc` that a figure needs, each done once: a folder that holds a finished run is used as it is."""

import csv
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from paper_figures.timed_runs import RunFailure, usable
from plots.run_folder import Run, RunError


@dataclass
class Iterations:
    """iterations.csv of one step: column name without unit -> array."""

    columns: dict

    def __getitem__(self, name):
        return self.columns[name]


def run_once(ogc, arguments, folder):
    """`ogc run ARGUMENTS --out FOLDER`, unless the folder holds that run, finished, already. Throws RunError where ogc fails."""
    folder = Path(folder)
    command = [str(ogc), "run", *map(str, arguments), "--out", str(folder)]
    if not usable(folder, command):
        if (folder / "run.json").is_file():
            print(f"{folder}: not finished, of another command or of another program: run again", file=sys.stderr, flush=True)
            shutil.rmtree(folder)
        print(" ".join(command), file=sys.stderr, flush=True)
        if subprocess.run(command, stdout=subprocess.DEVNULL).returncode != 0:
            raise RunError(f"{' '.join(command)}: failed; its last lines say why")
    return Run(folder)


def run_job(ogc, job, folder):
    """The run of a job (paper_figures.commands) below `folder`. Throws RunError."""
    try:
        return run_once(ogc, job.words(Path(folder)), Path(folder) / job.name)
    except RunFailure as error:
        raise RunError(str(error)) from error


def iterations(run, step):
    """Rows of one step. Throws RunError where the run has none."""
    path = run.folder / "iterations.csv"
    if not path.is_file():
        raise RunError(f"{path} is missing: run with --iterations")
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    names = [title.partition("[")[0].strip() for title in rows[0]]
    values = np.array([[float(text) for text in row] for row in rows[1:] if row and int(row[0]) == step])
    if not len(values):
        raise RunError(f"{path} has no row of step {step}")
    return Iterations({name: values[:, i] for i, name in enumerate(names)})


def last_frame(run):
    if not run.frames:
        raise RunError(f"{run.folder} has no frame")
    return run.frames[-1]


def provenance(run):
    """What a row of an accepted result must say about where it comes from. Of paths in the command the last part is kept."""
    m = run.manifest
    command = m["command"] if isinstance(m["command"], str) else " ".join(m["command"])
    return {"solver": m["solver"], "backend": m["backend"], "device": m["device"], "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else ""),
            "command": "ogc " + re.sub(r"(?<= )/\S*/", "", command.partition(" ")[2])}


def write_table(path, rows):
    """Rows (dictionaries with the same keys, units in their names) as CSV."""
    with Path(path).open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
