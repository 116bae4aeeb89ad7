"""The mat of Fig. 19 without friction by GIPC's official code and by ours, on one card: times of the same first steps.
Writes a table.

Usage: python3 -m paper_figures.figures.measured.gipc GIPC RUN … --version COMMIT --out CSV. GIPC is a table of its
steps (paper_figures/results/h200/gipc_mat.csv), COMMIT its version, each RUN one of ours on the same card with at least
as many steps.
"""

import argparse
import statistics
import sys
from pathlib import Path

from paper_figures.workflow.common import run_of
from paper_figures.workflow.contents import rows_of
from paper_figures.workflow.runs import provenance, write_table
from ogc_testbed.runs import RunError


def cells(run, count):
    """Returns what both programs' rows say of a run's first steps."""
    wall = run.column("wall")[:count]
    return {"scene": run.manifest["scene"]["name"], "scale": run.manifest["scale"], "program": "ogc",
            "version": run.manifest["commit"], "bounds": run.setting("bounds"), "friction [1]": 0, "steps": len(wall),
            "mean [ms]": f"{statistics.fmean(wall):.5g}", "worst [ms]": f"{max(wall):.5g}",
            "iterations a step [1]": f"{statistics.fmean(run.column('iterations')[:count]):.4g}", **provenance(run)}


def table(steps, version, runs):
    """Returns GIPC's row and one for each run. Throws RunError if a run is shorter, or has friction."""
    wall = [float(row["wall [ms]"]) for row in steps]
    for run in runs:
        if len(run.column("wall")) < len(wall):
            raise RunError(f"{run.folder} has {len(run.column('wall'))} steps, GIPC's {len(wall)}: run as many")
        if any(body["material"]["friction"]["value"] for body in run.manifest["scene"]["bodies"]):
            raise RunError(f"{run.folder} has friction, GIPC's steps have none: --set friction=0")
    ours = [cells(run, len(wall)) for run in runs]
    iterations = statistics.fmean(float(row["newton_iterations [1]"]) for row in steps)
    theirs = {**dict.fromkeys(ours[0], ""), **{name: ours[0][name] for name in ("scene", "scale", "backend", "device")},
              "program": "GIPC", "version": version, "friction [1]": 0, "steps": len(wall), "solver": "ipc",
              "mean [ms]": f"{statistics.fmean(wall):.5g}", "worst [ms]": f"{max(wall):.5g}",
              "iterations a step [1]": f"{iterations:.4g}"}
    return [theirs, *ours]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gipc", type=Path, help="table of GIPC's steps")
    parser.add_argument("runs", nargs="+", help="run folders of ours, without friction")
    parser.add_argument("--version", required=True, help="commit of GIPC")
    parser.add_argument("--out", required=True, type=Path, help="the table")
    options = parser.parse_args()
    steps = rows_of(options.gipc)
    if not steps:
        raise RunError(f"{options.gipc} has no row: name the table of GIPC's steps")
    write_table(options.out, table(steps, options.version, [run_of(folder, "mat_twist") for folder in options.runs]))


if __name__ == "__main__":
    try:
        main()
    except RunError as error:
        sys.exit(f"gipc: {error}")
