"""What the last states of an ablation's runs show of their cloth: triangles that have collapsed, and vertices that
stand still (plots/standing_still.py says which). `python3 -m paper_figures.figures.measured.collapsed ABLATION... --out
TABLE`, folders of `ogc ablate`.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from paper_figures.figures.ablations.study import of_points
from paper_figures.workflow.runs import provenance, write_table
from ogc_testbed.runs import Run, RunError
from plots.standing_still import rows

METRICS = {"vertices that can't move": 1, "vertices that can't along their largest coordinate": 2,
           "triangles below a thousandth of their area": 3}  # place in a row


def rows_of(folder):
    """Returns a row for each point and each metric of an ablation."""
    for point, found in of_points(folder).items():
        runs = [Run(folder / Path(row["folder"]).name) for row in found if row["status"] == "finished"]
        last = [list(rows(run))[-1] for run in runs]
        for metric, place in METRICS.items():
            shares = np.array([row[place] for row in last])
            yield {"scene": runs[0].manifest["scene"]["name"], "point": point, "metric": metric, "unit": "1",
                   "runs": len(runs), "median": f"{np.median(shares):.4g}", "smallest": f"{shares.min():.4g}",
                   "largest": f"{shares.max():.4g}", **provenance(runs[0])}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("folders", nargs="+", type=Path, help="folders of `ogc ablate`, each with its ablation.csv")
    parser.add_argument("--out", required=True, type=Path, help="the table")
    options = parser.parse_args()
    missing = [str(folder) for folder in options.folders if not (folder / "ablation.csv").is_file()]
    if missing:
        raise RunError(f"no ablation.csv in {', '.join(missing)}: run `ogc ablate` to its end first")
    write_table(options.out, [row for folder in options.folders for row in rows_of(folder)])


if __name__ == "__main__":
    try:
        main()
    except RunError as error:
        sys.exit(f"collapsed: {error}")
