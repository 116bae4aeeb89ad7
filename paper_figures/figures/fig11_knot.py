"""Fig. 11: a long strip with four overhand knots, pulled at both ends, with planes. Draws the strip at two moments, its
middle at three, a small knot and the tight knot from near, a cut through the layers of the last state, time and
distances."""

import numpy as np
from matplotlib.collections import LineCollection

from paper_figures.workflow.common import claims_of, draw_a_run, scaled
from plots import render, style
from plots.camera import around, densest, subject, view_of
from plots.scene_figure import (MOVIE, PLOTS, beside_paper, draw_contacts, draw_distance, draw_time, frames_at,
                                moment, show, source_of)

SCENE, WHOLE, MIDDLE = "knot", (0, 3550), (4970, 8520, 10650)  # steps
REACH, SEEN, CUT = 0.06, 0.11, 0.05  # neighbourhood of the tightest place; parts shown from near and in the cut [m]
HEART, AROUND = 0.15, 0.42  # neighbourhood of the most crowded part, and what is shown of the strip's middle [m]
TITLE = "Fig. 11. Four knots in a strip are pulled small and tight; here not all of them run together"
ALT = ("Renderings of a long ribbon, blue in front and sand behind. At first it has four loose loops; pulled at both "
       "ends it straightens, and the loops become small knots, some of which run together. Two close views show a "
       "small knot and the tightest place at the end, and a drawing shows the cut through it: {layers} layers of the "
       "ribbon beside one another, none of which crosses another.")
WIDE, CLOSE, PART = 1280, (960, 600), (640, 380)


def section(points, triangles, centre, normal):
    """Returns the segments [k, 2, 3] in which the plane through `centre` cuts the triangles."""
    height = (points - centre) @ normal
    corners, heights = points[triangles], height[triangles]
    cut = (heights > 0).any(axis=1) & (heights <= 0).any(axis=1)
    found = []
    for x, h in zip(corners[cut], heights[cut]):
        ends = [x[i] + h[i] / (h[i] - h[j]) * (x[j] - x[i]) for i, j in ((0, 1), (1, 2), (2, 0))
                if (h[i] > 0) != (h[j] > 0)]
        found.append(ends)
    return np.array(found).reshape(-1, 2, 3)


def layers_of(segments):
    """Returns the most segments [k, 2, 2] that a vertical or horizontal line crosses, and that line as (axis, place):
    axis 0 for a vertical line."""
    best = (0, 0, 0.0)
    for axis in (0, 1):
        low, high = segments[..., axis].min(axis=1), segments[..., axis].max(axis=1)
        for place in np.linspace(-CUT, CUT, 201):
            best = max(best, (int(np.sum((low <= place) & (place < high))), axis, float(place)))
    return best


def cut_of(run, frame):
    """Returns the cut through the tightest place, along the plane across the line from end to end: segments [k, 2, 2]
    in that plane, from the place and within CUT of it [m]."""
    points = subject(run, frame)
    centre = densest(points, REACH)
    pull = points[0] - points[-1]
    normal = pull / np.linalg.norm(pull)
    right = np.cross((0, 1, 0), normal)
    right /= np.linalg.norm(right)
    segments = section(points, run.bodies()[0]["triangles"], centre, normal) - centre
    flat = np.stack([segments @ right, segments @ np.cross(normal, right)], axis=-1)
    return flat[(np.abs(flat) < CUT).all(axis=(1, 2))]


def draw_cut(axes, run, frame):
    """Draws the cut; returns the number of layers."""
    flat = cut_of(run, frame)
    layers, axis, place = layers_of(flat)
    axes.add_collection(LineCollection(1e3 * flat, colors=style.FRONTS[2], linewidths=1.6))
    (axes.axvline if axis == 0 else axes.axhline)(1e3 * place, color=style.MARK, linewidth=0.9, linestyle="--")
    reach = 1e3 * np.abs(flat).max(axis=(0, 1)) * 1.08 if len(flat) else (CUT, CUT)
    axes.set(xlim=(-reach[0], reach[0]), ylim=(-reach[1], reach[1]), aspect="equal", xlabel="[mm]", ylabel="[mm]",
             title=f"a cut: {layers} layers on the line")
    return layers


def middle_of(run):
    """Returns the movie's camera: it shows all that is between the places where the strip's ends are at the start, and
    the ends leave the picture."""
    sampled = run.frames[::max(1, len(run.frames) // 12)]
    points = np.concatenate([subject(run, run.frame(path)) for path in sampled])
    across = points @ view_of(SCENE).axes()[0]
    low, high = np.sort(subject(run, run.frame(run.frames[0])) @ view_of(SCENE).axes()[0])[[0, -1]]
    return view_of(SCENE).fit(points[(low <= across) & (across <= high)], MOVIE)


def draw(run, out):
    run.require_finished()
    style.use()
    frames = frames_at(run, scaled(run, (*WHOLE, *MIDDLE)))
    start, small, *middle = frames
    view, end = view_of(SCENE), run.frame(run.frames[-1])
    size = render.shape_of(view, subject(run, start or end), WIDE, 0.24, 0.34)
    near = style.pictures(2, CLOSE, 0.7)
    rows = [style.pictures(2, size), style.pictures(3, PART), (near[0], [*near[1], (0.3, "plot")]), PLOTS]
    figure, axes = style.page(rows, TITLE, beside_paper(run, claims_of(run)))
    for place, frame in zip(axes[0], (start, small)):
        show(place, run, frame, frame and view.fit(subject(run, frame), size), moment(frame), size)
    for place, frame in zip(axes[1], middle):
        points = subject(run, frame or end)
        camera = around(points, densest(points, HEART), AROUND, run, view, PART)
        show(place, run, frame, camera, f"its middle, {moment(frame)}", PART)
    for place, frame, words in zip(axes[2], (small, end), ("a small knot", "the tight knot")):
        points = subject(run, frame or end)
        camera = around(points, densest(points, REACH), SEEN, run, view, CLOSE)
        show(place, run, frame, camera, f"{words}, {moment(frame)}", CLOSE)
    layers = draw_cut(axes[2][2], run, end)
    draw_time(axes[3][0], run, claims_of(run), run)
    draw_contacts(axes[3][1], run)
    draw_distance(axes[3][2], run)
    style.save(figure, out, TITLE, ALT.format(layers=layers), source_of([run]))


if __name__ == "__main__":
    draw_a_run(SCENE, draw, seen=middle_of)
