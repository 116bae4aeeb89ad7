"""Draws a movie of any finished run: MP4 of its stored frames, seen from the side and a little from above.

Usage: python -m plots.movie RUN [--out FILE.mp4] [--picture FILE.png], from the root of the repository. Exit status 1:
the run can't be drawn, and why.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from plots import render
from ogc_testbed.runs import Run, RunError
from plots.scene_figure import bodies_of, draw_movie, is_cloth

UP, TOWARDS_EYE = (0, 1, 0), np.array([0.55, 0.35, 1.0])
DISTANCE = 2.2  # distance of the eye in diagonals of the box around the moving bodies


def camera_of(run):
    """Returns (eye, target, up) of a camera that shows the simulated bodies at their start and end."""
    moving = [body for body in run.manifest["scene"]["bodies"] if is_cloth(body)]
    ranges = [slice(body["first_vertex"], body["first_vertex"] + body["vertex_count"]) for body in moving or [
        {"first_vertex": 0, "vertex_count": None}] if body["vertex_count"]] or [slice(None)]
    states = [run.frame(path).positions for path in (run.frames[0], run.frames[-1])]
    seen = np.concatenate([state[part] for state in states for part in ranges]).astype(float)
    low, high = seen.min(axis=0), seen.max(axis=0)
    target = (low + high) / 2
    away = TOWARDS_EYE / np.linalg.norm(TOWARDS_EYE) * DISTANCE * np.linalg.norm(high - low)
    return tuple(target + away), tuple(target), UP


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", help="run folder, made by: ogc run … --out FOLDER")
    parser.add_argument("--out", type=Path, help="MP4 to write (default: movie.mp4 in the run folder)")
    parser.add_argument("--picture", type=Path, help="PNG of the last frame to write besides")
    options = parser.parse_args()
    try:
        run = Run(options.run)
        if not run.frames:
            raise RunError(f"{options.run} has no stored frame: its movie can't be drawn")
        camera, out = camera_of(run), options.out or run.folder / "movie.mp4"
        draw_movie(run, camera, out)
        if options.picture:
            from PIL import Image  # a dependency of the renderer
            Image.fromarray(render.picture(bodies_of(run, run.frame(run.frames[-1])), camera)).save(options.picture)
    except RunError as error:
        sys.exit(f"movie: {error}")
    print(out)


if __name__ == "__main__":
    main()
