"""Vertices that stand still, frame by frame: those whose bound is below the spacing of single-precision numbers at
their coordinates, so that truncation leaves them where they are, whatever pulls them. Beside them triangles that have
collapsed, and how many of the vertices stand beside one: at its corners or one edge away. For fast/PERFORMANCE.md.

Usage: python3 -m plots.standing_still RUN … (run folders)
"""

import sys

import numpy as np

from ogc_testbed.runs import RunError, Run

COLLAPSED = 1e-3  # share of the triangle's area in the run's first frame


def standing(positions, bounds):
    """Returns for each vertex whether its bound is below the spacing of numbers at its smallest coordinate, so that it
    can't move at all, and whether it is below the spacing at its largest coordinate, so that it can't move along that
    one."""
    spacing = np.spacing(np.abs(np.asarray(positions, dtype=np.float32)))
    return bounds < spacing.min(axis=1), bounds < spacing.max(axis=1)


def areas(positions, triangles):
    a, b, c = (np.asarray(positions, dtype=np.float64)[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def beside(triangles, collapsed, vertices):
    """Returns for each vertex whether it, or one of its neighbours, is a corner of a collapsed triangle."""
    corner = np.zeros(vertices, dtype=bool)
    corner[triangles[collapsed]] = True
    near = corner.copy()
    near[triangles[corner[triangles].any(axis=1)]] = True
    return near


def rows(run):
    """Yields a row for each frame after a detection, over the bodies that move: step, share of vertices that can't
    move, share that can't move along their largest coordinate, share of collapsed triangles, and the share of vertices
    beside one, among the second kind of vertices and among all."""
    bodies = run.bodies()
    moves = np.concatenate([np.full(body["vertex_count"], not body["fixed"]) for body in bodies])
    triangles = np.concatenate([body["triangles"] + body["first_vertex"] for body in bodies if not body["fixed"]])
    first = areas(run.frame(run.frames[0]).positions, triangles)
    for path in run.frames:
        frame = run.frame(path)
        if not frame.bounds.any():
            continue
        still, along = (flags[moves] for flags in standing(frame.positions, frame.bounds))
        collapsed = areas(frame.positions, triangles) < COLLAPSED * first
        near = beside(triangles, collapsed, len(moves))[moves]
        of_those = near[along].mean() if along.any() else np.nan
        yield frame.step, still.mean(), along.mean(), collapsed.mean(), of_those, near.mean()


def main(folders):
    for folder in folders:
        run = Run(folder)
        print(f"{run.manifest['scene']['name']}: step; vertices that can't move, that can't along their largest "
              f"coordinate; triangles below {COLLAPSED:g} of their "
              "first area; vertices beside one among those that can't, and among all [%]")
        for step, *parts in rows(run):
            print(f"{step:8d}" + "".join(f"{100 * part:10.4f}" for part in parts))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        main(sys.argv[1:])
    except (RunError, OSError) as problem:
        sys.exit(str(problem))
