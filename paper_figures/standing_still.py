"""Vertices that stand still, frame by frame: those whose bound is below the spacing of single-precision numbers at their coordinates, so that truncation leaves them
where they are, whatever pulls them. For fast/PERFORMANCE.md.

Usage: python3 -m paper_figures.standing_still RUN … (run folders)
"""

import sys

import numpy as np

from plots.run_folder import RunError, Run


def shares(positions, bounds):
    """Share of the vertices whose bound is below the spacing at their smallest coordinate (they can't move at all), and at their largest one (not along it)."""
    spacing = np.spacing(np.abs(np.asarray(positions, dtype=np.float32)))
    return float(np.mean(bounds < spacing.min(axis=1))), float(np.mean(bounds < spacing.max(axis=1)))


def rows(run):
    """(step, both shares) of each frame after a detection, of the bodies that move."""
    moves = np.concatenate([np.full(body["vertex_count"], not body["fixed"]) for body in run.manifest["scene"]["bodies"]])
    for path in run.frames:
        frame = run.frame(path)
        if frame.bounds.any():
            yield frame.step, *shares(frame.positions[moves], frame.bounds[moves])


def main(folders):
    for folder in folders:
        run = Run(folder)
        print(f"{run.manifest['scene']['name']}: step, share that can't move [%], share that can't move along its largest coordinate [%]")
        for step, still, along in rows(run):
            print(f"{step:8d} {100 * still:10.4f} {100 * along:10.4f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        main(sys.argv[1:])
    except (RunError, OSError) as problem:
        sys.exit(str(problem))
