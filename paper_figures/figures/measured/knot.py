"""How tight the knot of Fig. 11 is, from the last state of each run: layers through a cut, the number of knots left,
and how much of the strip in them is still free. A vertex touches another part of the strip if a vertex that is more
than a strip's width away along the strip is as near as two layers in contact have vertices. Such rows that are nearer
to one another than a strip's width belong to one knot, with all that lies between its first and its last row. Writes a
table; fig11_knot.py draws the states.

Usage: python3 -m paper_figures.figures.measured.knot RUN … --out CSV
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from paper_figures.figures.fig11_knot import SCENE, cut_of, layers_of
from paper_figures.figures.measured.yarn_rest import near
from paper_figures.workflow.common import run_of
from paper_figures.workflow.runs import provenance, write_table
from plots.camera import subject
from ogc_testbed.runs import RunError

WIDTH = 0.045  # of the strip [m] (experiments/scenes/knot.cpp)


def rows_of(points):
    """Returns the strip's vertices as rows across it [rows, columns, 3]; its vertices are numbered row by row. The
    number of columns is the first that gives a straight line."""
    near_by = np.linalg.norm(np.diff(points, axis=0), axis=1)
    columns = int(np.argmax(near_by > 0.5 * WIDTH)) + 1
    if columns < 2 or len(points) % columns:
        raise RunError("the strip's vertices are not numbered row by row")
    return points.reshape(-1, columns, 3)


def touching(rows, radius):
    """Returns for each row whether it touches another part of the strip. Layers at the distance r have vertices within
    the root of r² and of half a cell's diagonal squared."""
    along = np.linalg.norm(np.diff(rows[:, rows.shape[1] // 2], axis=0), axis=1)
    across = np.linalg.norm(np.diff(rows[0], axis=0), axis=1).mean()
    cell = 0.5 * np.hypot(np.median(along), across)
    pairs = near(rows.reshape(-1, 3), float(np.hypot(radius, cell)))
    apart = np.abs(pairs[:, 0] - pairs[:, 1]) // rows.shape[1] * np.median(along)
    found = np.zeros(rows.shape[0] * rows.shape[1], bool)
    found[pairs[apart > WIDTH].ravel()] = True
    return found.reshape(rows.shape[:2]).any(axis=1)


def clusters(points):
    """Returns the number of each point's cluster: points nearer than a strip's width belong to one."""
    if not len(points):
        return np.empty(0, int)
    found, pairs = np.arange(len(points)), near(points, WIDTH)
    while True:
        least = found.copy()
        np.minimum.at(least, pairs[:, 0], found[pairs[:, 1]])
        np.minimum.at(least, pairs[:, 1], found[pairs[:, 0]])
        least = least[least]
        if (least == found).all():
            return found
        found = least


def shape_of(points, radius):
    """Returns the numbers of a state as columns of the table."""
    rows = rows_of(points)
    touches, middle = touching(rows, radius), rows.mean(axis=1)
    lengths = np.append(np.linalg.norm(np.diff(middle, axis=0), axis=1), 0.0)
    met = np.flatnonzero(touches)
    numbers, inside = clusters(middle[met]), np.zeros(len(rows), bool)
    for number in np.unique(numbers):
        own = met[numbers == number]
        inside[own[0]:own[-1] + 1] = True
    return {"knots [1]": len(np.unique(numbers)), "strip in knots [m]": f"{lengths[inside].sum():.4g}",
            "free strip in knots [m]": f"{lengths[inside & ~touches].sum():.4g}"}


def row_of(run):
    """Returns the row of a run."""
    frame = run.frame(run.frames[-1])
    return {"bounds": run.setting("bounds"), "scale": run.manifest["scale"], "step [1]": frame.step,
            "layers in the cut [1]": layers_of(cut_of(run, frame))[0],
            **shape_of(subject(run, frame), run.setting("contact_radius")),
            "largest lag [m]": f"{run.column('largest_lag').max():.4g}",
            "status": run.manifest["status"], "ended": run.manifest["ended"], **provenance(run)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", metavar="RUN", help="run folder of the knot")
    parser.add_argument("--out", type=Path, required=True, help="table to write")
    options = parser.parse_args()
    try:
        found = [run_of(folder, SCENE) for folder in options.runs]
        for run in found:
            run.require_finished()
        write_table(options.out, [row_of(run) for run in found])
    except RunError as error:
        sys.exit(f"knot: {error}")


if __name__ == "__main__":
    main()
