"""One table of the studies that were run, as results keep it: `python3 -m paper_figures.figures.ablations.gather
FOLDER... --out ablations_SCALE.csv`, FOLDERs that study.py left; a long one is compressed, as .csv.gz. A metric that is
one number in every run of a scene is left out, as it tells no setting from another, but for how many runs of a point
kept the guarantee."""

import argparse
import csv
import sys
from pathlib import Path

from paper_figures.figures.ablations.study import KEPT, TABLE
from paper_figures.workflow.kept import compressed
from paper_figures.workflow.runs import write_table

NUMBERS = ("median", "smallest", "largest")


def told(rows):
    """Rows of one study's scene whose metric differs between any two runs."""
    values = {}
    for row in rows:
        values.setdefault(row["metric"], set()).update(row[name] for name in NUMBERS if row[name] not in ("", "nan"))
    return [row for row in rows if row["metric"] == KEPT or len(values[row["metric"]]) > 1 and row["median"]]


def gathered(folders):
    scenes = {}
    for folder in folders:
        with (Path(folder) / TABLE).open(newline="") as file:
            for row in csv.DictReader(file):
                scenes.setdefault((row["study"], row["scene"]), []).append(row)
    return [row for rows in scenes.values() for row in told(rows)]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--out", required=True, type=Path)
    options = parser.parse_args()
    missing = [str(folder) for folder in options.folders if not (folder / TABLE).is_file()]
    if missing:
        sys.exit(f"gather: no {TABLE} in {', '.join(missing)}: run the study first")
    write_table(options.out, gathered(options.folders))
    name, data = compressed(options.out.name, options.out.read_bytes())
    options.out.unlink()
    options.out.with_name(name).write_bytes(data)
