"""Whether the pile of Fig. 10 rests: the kinetic energy of the whole runs, at eight moments and at their end. Writes a
table.

Usage: python3 -m paper_figures.figures.measured.pile RUN … --out CSV
"""

import argparse
import sys
from pathlib import Path

from paper_figures.workflow.common import run_of
from paper_figures.workflow.runs import provenance, write_table
from ogc_testbed.runs import RunError

SCENE, MOMENTS = "fifty_layers", 8


def rows_of(run):
    """Returns the rows of a run: after each eighth of its steps."""
    run.require_finished()
    steps, energy = run.column("step"), run.column("kinetic_energy")
    places = [round(share * len(steps) / MOMENTS) - 1 for share in range(1, MOMENTS + 1)]
    return [{"bounds": run.setting("bounds"), "step [1]": int(steps[i]),
             "time [s]": f"{steps[i] * run.setting('time_step'):.4g}", "kinetic energy [J]": f"{energy[i]:.4g}",
             "scale": run.manifest["scale"], "status": run.manifest["status"], "ended": run.manifest["ended"],
             **provenance(run)} for i in places]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", metavar="RUN", help="run folder of fifty_layers")
    parser.add_argument("--out", type=Path, required=True, help="table to write")
    options = parser.parse_args()
    try:
        write_table(options.out, [row for folder in options.runs for row in rows_of(run_of(folder, SCENE))])
    except RunError as error:
        sys.exit(f"pile: {error}")


if __name__ == "__main__":
    main()
