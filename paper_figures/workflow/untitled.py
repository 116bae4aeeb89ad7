"""Lays the pictures of the paper's 22 figures out without titles, under numbers in a random order, so that a reader can
say what each claims without having been told.

Usage: python3 -m paper_figures.workflow.untitled OUT KEY.csv [SEED]. OUT gets 01.png to 22.png; KEY.csv, which the
reader must not see, has number, figure, file and title, and an empty answer to fill in, and whether it is right.
"""

import csv
import random
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from paper_figures.workflow import captions
from paper_figures.workflow.evidence import RESULTS

FIGURES = [f"fig{number:02d}" for number in range(1, 23)]
# Of several pictures of a figure the first of these that there is.
ENDS = ("_paper", "_small", "_solvers_paper", "", "_smoke")
BLANK = 22  # rows without ink between a title and the first panel, at the least; lines of a title are nearer
INK = 250  # grey value below which a pixel is ink


def pictures():
    """Returns figure -> path of its picture. Throws FileNotFoundError for a figure without one."""
    found = {}
    for figure in FIGURES:
        names = [f"{machine}/{figure}{end}{suffix}" for end in ENDS for machine in ("h200", "two_cores")
                 for suffix in (".webp", ".png")]
        path = next((RESULTS / name for name in names if (RESULTS / name).is_file()), None)
        if path is None:
            raise FileNotFoundError(f"{figure} has no picture among {RESULTS}")
        found[figure] = path
    return found


def without_title(image):
    """Returns the picture below its title: below the first band without ink that is BLANK rows high."""
    inked = (np.asarray(image.convert("L")) < INK).any(axis=1)
    rows = np.flatnonzero(inked)
    gaps = np.diff(rows)
    wide = np.flatnonzero(gaps > BLANK)
    if not len(wide):
        return image
    return image.crop((0, int(rows[wide[0]] + gaps[wide[0]] // 2), *image.size))


def lay_out(out, key, seed):
    out.mkdir(parents=True)
    shown = list(pictures().items())
    random.Random(seed).shuffle(shown)
    with key.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["number", "figure", "file", "title", "answer", "right"])
        for number, (figure, path) in enumerate(shown, 1):
            without_title(Image.open(path).convert("RGB")).save(out / f"{number:02d}.png")
            title = captions.rows_of(path.parent).get(path.name, {}).get("title", "")
            writer.writerow([number, figure, path.relative_to(RESULTS).as_posix(), title, "", ""])


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        lay_out(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    except OSError as error:
        sys.exit(f"untitled: {error}")
