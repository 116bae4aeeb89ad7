"""Fig. 1, of the scenes that exist: one state of each run, the last where nothing else is said, from the camera of its
own figure."""

import argparse
import sys

from paper_figures.figures import (fig10_fifty_layers, fig11_knot, fig12_twist, fig13_dress, fig14_robot_shirt,
                                   fig18_cloth_on_sphere)
from plots import render, style
from ogc_testbed.runs import Run, RunError, commits_in_words
from plots.scene_figure import bodies_of, is_cloth

CAMERAS = {"fifty_layers": fig10_fifty_layers.CAMERA, "knot": fig11_knot.CAMERA, "twist": fig12_twist.CAMERA,
           "dress": fig13_dress.camera,
           # or a function of the run
           "robot_shirt": fig14_robot_shirt.CAMERA, "cloth_on_sphere": fig18_cloth_on_sphere.CAMERA}
MOMENTS = {"robot_shirt": 0.62}  # share of the run at which it is shown: the shirt hangs; at the end it lies folded
SIZE = (960, 640)


def words(run, frame):
    """Returns a label with the scene, its number of cloth vertices, and the time."""
    cloths = [body for body in run.manifest["scene"]["bodies"] if is_cloth(body)]
    count = f"{len(cloths)} cloths, " if len(cloths) > 1 else ""
    vertices = sum(body["vertex_count"] for body in cloths)
    bounds = " with planes" if run.manifest["settings"].get("bounds", {}).get("value") == "planes" else ""
    return (f"{run.manifest['scene']['name'].replace('_', ' ')}{bounds}: {count}{vertices:,} vertices, "
            f"t = {frame.time:.3g} s")


def draw(runs, out):
    """Draws a picture for each run, two in a row. Throws RunError for a run that is not finished or failed its audit,
    and for a scene without a camera."""
    usable, reason = render.available()
    if not usable:
        raise RunError(reason)
    plt = style.use()
    figure, grid = plt.subplots(-(-len(runs) // 2), 2, figsize=(11, 3.75 * -(-len(runs) // 2)), squeeze=False)
    for axes in grid.flat:
        axes.axis("off")
    for axes, run in zip(grid.flat, runs):
        run.require_finished()
        scene = run.manifest["scene"]["name"]
        if scene not in CAMERAS:
            raise RunError(f"{run.folder} is a run of '{scene}', of which the teaser knows no camera; it has: "
                           f"{', '.join(CAMERAS)}")
        camera = CAMERAS[scene](run) if callable(CAMERAS[scene]) else CAMERAS[scene]
        frame = run.frame(run.frames[round(MOMENTS.get(scene, 1) * (len(run.frames) - 1))])
        axes.imshow(render.picture(bodies_of(run, frame), camera, SIZE))
        axes.set_title(words(run, frame))
    figure.suptitle(f"Vertex Block Descent with offset geometric contact, {runs[0].manifest['scale']}, "
                    f"{runs[0].manifest['backend']}: {commits_in_words(runs)}", fontsize=8)
    style.save(figure, out)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", help="PNG to write; a PDF is put beside it")
    parser.add_argument("runs", nargs="+", help="run folders")
    options = parser.parse_args()
    try:
        draw([Run(folder) for folder in options.runs], options.out)
    except RunError as error:
        sys.exit(f"fig01: {error}")
