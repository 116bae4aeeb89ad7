"""Fig. 1: one state of each run, the last where nothing else is said, each filling its frame."""

import argparse
import sys

import numpy as np

from plots import render, style
from plots.camera import around, densest, fitted, is_cloth, subject
from plots.scene_figure import PICTURE, moment, render_frame, source_of
from ogc_testbed.runs import Run, RunError

# Share of the run at which it is shown: the dancer in the middle of the motion, the shirt as it hangs.
MOMENTS = {"robot_shirt": 0.62, "dress": 0.66}
# Neighbourhood of the tightest place, and what is shown of it; what is shown of the loose knots [m].
KNOT, KNOT_SEEN, LOOSE = 0.06, 0.13, 0.6
TITLE = "Fig. 1. Scenes of the paper, {audit}"
ALT = ("Renderings of scenes, each at one moment, sheets blue in front and sand behind: {scenes}.")
WORDS = {"fifty_layers": "fifty cloths", "knot": "four knots, pulled", "twist": "a cloth, twisted",
         "three_cloths_on_sphere": "three cloths on a sphere", "dress": "a dress on a dancer",
         "robot_shirt": "a T-shirt between grippers",
         "cloth_on_sphere": "a cloth on a sphere", "yarn_twist": "one yarn, knitted, twisted",
         "yarn_stretch": "one yarn, knitted, pulled", "mat_twist": "a solid mat, twisted"}


def camera_of(run, frame):
    scene = run.manifest["scene"]["name"]
    if scene == "knot":
        points, tight = subject(run, frame), run.column("step")[-1] == frame.step
        centre = densest(points, KNOT if tight else LOOSE)
        return around(points, centre, KNOT_SEEN if tight else LOOSE, run, size=PICTURE)
    return fitted(run, [frame], PICTURE)


def words(run, frame):
    """Returns a label with what is seen, its number of vertices, and on a GPU its mean time a step."""
    scene = run.manifest["scene"]
    vertices = sum(body["vertex_count"] for body in scene["bodies"] if is_cloth(body))
    wall = np.mean(run.column("wall")[1:])
    where = run.manifest["device"].partition(",")[0].removeprefix("NVIDIA ")
    time = f", {wall:.2g} ms a step ({where})" if run.manifest["backend"] == "cuda" else ""
    return f"{WORDS[scene['name']]}, {moment(frame)}: {vertices:,} vertices{time}"


def draw(runs, out):
    """Draws a picture for each run, two in a row. Throws RunError for a run that is not finished or failed its audit,
    and for a scene without a camera."""
    usable, reason = render.available()
    if not usable:
        raise RunError(reason)
    for run in runs:
        run.require_finished()
        scene = run.manifest["scene"]["name"]
        if scene not in WORDS:
            raise RunError(f"{run.folder} is a run of '{scene}', of which the teaser knows no camera; it has: "
                           f"{', '.join(WORDS)}")
    style.use()
    pairs = [runs[i:i + 2] for i in range(0, len(runs), 2)]
    scales = sorted({run.manifest["scale"] for run in runs})
    audited = all(int(run.manifest.get("audited_states", 0)) for run in runs)
    title = TITLE.format(audit="simulated without one intersection" if audited else "each at one moment")
    below = "" if scales == ["paper"] else f"scale {' and '.join(scales)}, not the paper's size"
    figure, axes = style.page([style.pictures(2, PICTURE)] * len(pairs), title, below)
    places = [place for row in axes for place in row]
    for place in places[len(runs):]:
        place.axis("off")
    for place, run in zip(places, runs):
        frame = run.frame(run.frames[round(MOMENTS.get(run.manifest["scene"]["name"], 1) * (len(run.frames) - 1))])
        style.picture(place, render_frame(run, frame, camera_of(run, frame)), words(run, frame))
    scenes = "; ".join(WORDS[run.manifest["scene"]["name"]] for run in runs)
    style.save(figure, out, title, ALT.format(scenes=scenes), source_of(runs))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", help="PNG to write; a PDF is put beside it")
    parser.add_argument("runs", nargs="+", help="run folders")
    options = parser.parse_args()
    try:
        draw([Run(folder) for folder in options.runs], options.out)
    except RunError as error:
        sys.exit(f"fig01: {error}")
