"""Draws pictures again from accepted tables, without their runs: those whose every number is in a table.

Usage: python3 -m paper_figures.figures.from_tables OUT_FOLDER [PICTURE …], for example h200/quality_paper. Without a
picture all are drawn.
"""

import csv
import sys
from pathlib import Path

from paper_figures.figures.measured import activation_load, falling, growth, quality, yarn_rest, yarn_return
from paper_figures.workflow.evidence import RESULTS


def quality_at_paper(rows, out):
    quality.draw(rows, "paper", out)


def numbers(rows):
    """Returns rows whose cells that are numbers are numbers; a commit is none, even if all its digits are decimal."""
    return [{name: cell if name == "commit" else number(cell) for name, cell in row.items()} for row in rows]


def number(cell):
    try:
        return int(cell) if cell.isdigit() else float(cell)
    except ValueError:
        return cell


DRAWN = {  # machine/picture -> what draws the rows of the table of this name
    "h200/quality_paper": quality_at_paper, "two_cores/fig16_rest_small": yarn_rest.draw,
    "h200/yarn_return_paper": yarn_return.draw,
    "two_cores/activation_load_small": activation_load.draw,
    "h200/growth_paper": lambda rows, out: growth.draw(numbers(rows), out),
    "two_cores/falling": falling.draw,
}


def main(folder, names):
    for name in names or DRAWN:
        if name not in DRAWN:
            sys.exit(f"from_tables: there is no picture {name}; there are: {', '.join(DRAWN)}")
        with (RESULTS / f"{name}.csv").open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        out = Path(folder) / f"{name}.png"
        out.parent.mkdir(parents=True, exist_ok=True)
        DRAWN[name](rows, out)
        print(out)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
