"""One table of a sweep: the rows that `ogc ablate` wrote for each of its points. Usage: python3 -m paper_figures.sweep FOLDER OUT.csv"""

import csv
import sys
from pathlib import Path

from paper_figures.evidence import EvidenceError


def gather(folder):
    """Rows of all points; the folder's path is left out, its name says the point. Throws EvidenceError where there is none."""
    rows = []
    for path in sorted(Path(folder).glob("*/ablation.csv")):
        with path.open(newline="") as file:
            rows += [{key: value for key, value in row.items() if key != "folder"} for row in csv.DictReader(file)]
    if not rows:
        raise EvidenceError(f"{folder} holds no point of a sweep (POINT/ablation.csv)")
    return rows


if __name__ == "__main__":
    try:
        found = gather(sys.argv[1])
    except EvidenceError as error:
        sys.exit(f"sweep: {error}")
    with Path(sys.argv[2]).open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(found[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(found)
