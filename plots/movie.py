"""Draws a movie of any finished run: MP4 of its stored frames, seen from the side and a little from above.

Usage: python -m plots.movie RUN [--out FILE.mp4] [--picture FILE.png], from the root of the repository. Exit status 1:
the run can't be drawn, and why.
"""

import argparse
import sys
from pathlib import Path

from plots import render
from ogc_testbed.runs import Run, RunError
from plots.bodies import bodies_of
from plots.camera import fitted
from plots.scene_figure import MOVIE, draw_movie, look_of


def camera_of(run, size=MOVIE):
    """Returns (eye, target, up) of a camera that shows the simulated bodies at their start and end."""
    return fitted(run, [run.frame(path) for path in (run.frames[0], run.frames[-1])], size)


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
        draw_movie(run, out, camera)
        if options.picture:
            from PIL import Image  # a dependency of the renderer
            shown = render.picture(bodies_of(run, run.frame(run.frames[-1])), camera, MOVIE, **look_of(run))
            Image.fromarray(shown).save(options.picture)
    except RunError as error:
        sys.exit(f"movie: {error}")
    print(out)


if __name__ == "__main__":
    main()
