"""One table of the studies that were run, as results keep it: `python3 -m paper_figures.figures.ablations.gather
FOLDER... --out ablations_SCALE.csv`, where study.py wrote the FOLDERs. Long tables are compressed, as .csv.gz. `--keep
TABLE` takes scenes that the folders lack from an older table. A metric with the same value in every run of a scene is
left out, because it does not distinguish settings. The number of runs that kept the guarantee, and the time that they
took, are always kept."""

import argparse
import csv
import gzip
import io
import sys
from pathlib import Path

from paper_figures.figures.ablations.study import KEPT, TABLE
from paper_figures.workflow.durations import OF_ALL_RUNS
from paper_figures.workflow.kept import compressed
from paper_figures.workflow.runs import write_table

NUMBERS = ("median", "smallest", "largest")


def told(rows):
    """Returns the rows of one scene of a study whose metrics differ between at least two runs."""
    values = {}
    for row in rows:
        values.setdefault(row["metric"], set()).update(row[name] for name in NUMBERS if row[name] not in ("", "nan"))
    return [row for row in rows
            if row["metric"] in (KEPT, OF_ALL_RUNS) or len(values[row["metric"]]) > 1 and row["median"]]


def by_scene(path):
    """Returns (study, scene) -> rows of a table, which may be compressed."""
    data, scenes = path.read_bytes(), {}
    for row in csv.DictReader(io.StringIO((gzip.decompress(data) if path.suffix == ".gz" else data).decode())):
        scenes.setdefault((row["study"], row["scene"]), []).append(row)
    return scenes


def gathered(folders, kept=None):
    scenes = by_scene(kept) if kept else {}
    for folder in folders:
        scenes.update({scene: told(rows) for scene, rows in by_scene(Path(folder) / TABLE).items()})
    return [row for _, rows in sorted(scenes.items()) for row in rows]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--keep", type=Path, metavar="TABLE", help="an older table, whose other scenes stay")
    options = parser.parse_args()
    missing = [str(folder) for folder in options.folders if not (folder / TABLE).is_file()]
    if missing:
        sys.exit(f"gather: no {TABLE} in {', '.join(missing)}: run the study first")
    write_table(options.out, gathered(options.folders, options.keep))
    name, data = compressed(options.out.name, options.out.read_bytes())
    options.out.unlink()
    options.out.with_name(name).write_bytes(data)
