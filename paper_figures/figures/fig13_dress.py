"""Fig. 13: a dress of 14 stitched panels on a moving body, which pushes it out as a volume. Draws the panels apart, a
close view with the vertices inside the body marked, four moments of the motion, time, vertices inside and detections;
for the stand-in or for Codimensional IPC's dress and dancer (ogc run dress --set data=DIR)."""

import numpy as np

from paper_figures.workflow.common import claims_of, draw_a_run, scaled
from plots import render, style
from plots.bodies import bodies_of
from plots.camera import fitted, is_cloth, subject, view_of
from plots.scene_figure import (PLOTS, beside_paper, draw_detections, draw_lag, draw_time, frames_at,
                                moment, show, source_of)

SCENE, STEPS = "dress", (0, 320, 640, 968)
APART = 0.28  # how far panels are drawn from one another [m]
WIDE, BROAD = 480, (960, 720)  # a moment's picture has the width, and the shape of what it shows
TITLE = "Fig. 13. A dress of 14 stitched panels follows a dancer"
ALT = ("Panel a: the fourteen pieces of the dress, drawn apart. Panel b: the dress from near, with red dots at the "
       "cloth vertices that lie inside the body at the step with the most of them. Below: four moments of the motion; "
       "the dress swings with the grey figure and stays on it. Plots: time a step beside the paper's, vertices inside "
       "the body, detections.")


def exploded(run, frame):
    """Returns the panels, each moved away from the middle of all, so that none covers another: bodies, and for the
    camera their points."""
    bodies = [body for body in run.bodies() if is_cloth(body)]
    places = [frame.positions[b["first_vertex"]:b["first_vertex"] + b["vertex_count"]].astype(float) for b in bodies]
    middles = np.array([(p.min(axis=0) + p.max(axis=0)) / 2 for p in places])
    around = middles - middles.mean(axis=0)
    size = np.linalg.norm(np.ptp(middles, axis=0))
    moved = [p + APART / size * 2 * a * (1.6, 0.9, 0.2) for p, a in zip(places, around)]
    for front in (True, False):  # panels in front and behind are seen side by side
        chosen = [i for i, a in enumerate(around) if (a[2] >= 0) == front]
        for i in chosen:
            moved[i] = moved[i] + ((-0.5 if front else 0.5), 0, 0)
    shades = len(style.FRONTS)
    drawn = [(p, b["triangles"], style.FRONTS[i % shades], style.BACKS[i % shades])
             for i, (p, b) in enumerate(zip(moved, bodies))]
    return drawn, np.concatenate(moved)


def inside(run, frame):
    """Returns the cloth's vertices inside the bodies that move by themselves [k, 3], by the sign of VTK's distance."""
    from plots.render import poly

    cloth = subject(run, frame, is_cloth)
    found = np.zeros(len(cloth), bool)
    for body in run.bodies():
        if not is_cloth(body) and not body["fixed"] and len(body["triangles"]):
            own = frame.positions[body["first_vertex"]:body["first_vertex"] + body["vertex_count"]]
            import pyvista as pv
            distance = pv.PolyData(cloth).compute_implicit_distance(poly(own, body["triangles"]))
            found |= distance["implicit_distance"] < 0
    return cloth[found]


def draw_inside(axes, run):
    deepest = 1e3 * run.column("deepest") if "deepest" in run.steps else None
    axes.plot(run.column("step"), run.column("vertices_inside"), linewidth=0.8, color=style.BASELINE)
    axes.set(xlabel="step", ylabel="vertices", ylim=(0, None),
             title="Vertices inside" + (f", deepest {deepest.max():.2g} mm" if deepest is not None else ""))


def worst_frame(run):
    """Returns the stored frame with the most vertices inside the body, as the solver counts them."""
    counts = dict(zip(run.column("step").astype(int), run.column("vertices_inside")))
    numbers = [int(path.stem.removeprefix("frame_")) for path in run.frames]
    return run.frame_at_step(max(numbers, key=lambda step: counts.get(step, 0)))


def draw(run, out):
    run.require_finished()
    style.use()
    frames = frames_at(run, scaled(run, STEPS))
    seen = [frame for frame in frames if frame] or [run.frame(run.frames[-1])]
    volume = "vertices_inside" in run.steps and np.any(run.column("vertices_inside") > 0)
    last, below = int(run.column("step")[-1]), beside_paper(run, claims_of(run))
    if run.manifest.get("scale") == "paper" and last < STEPS[-1]:
        below += f"; the first {last} of {STEPS[-1]} steps"
    tall = render.shape_of(view_of(SCENE), np.concatenate([subject(run, frame) for frame in seen]), WIDE, 0.9, 1.5)
    figure, rows = style.page([style.pictures(2, BROAD), style.pictures(4, tall), PLOTS], TITLE, below)
    axes = rows[0][0]
    usable, reason = render.available()
    pieces, points = exploded(run, seen[0])
    title = f"(a) its {len(pieces)} pieces, drawn apart"
    if usable:
        style.picture(axes, render.picture(pieces, render.View((0.15, 0.1, 1)).fit(points, BROAD), BROAD), title)
    else:
        style.not_run(axes, reason)
    axes = rows[0][1]
    if volume and usable:
        worst = worst_frame(run)
        marks = inside(run, worst)
        camera = fitted(run, [worst], BROAD, is_cloth, render.View(view_of(SCENE).towards_eye, margin=0.0))
        glass = [(*body[:2], body[2], body[3]) for body in bodies_of(run, worst)]
        style.picture(axes, render.picture(glass, camera, BROAD, marks=marks),
                      f"(b) {len(marks)} vertices inside the body (red), {moment(worst)}")
    else:
        style.not_run(axes, "not run: here the body is a surface, which nothing enters")
        axes.set_title("(b) vertices inside the body")
    camera = fitted(run, seen, tall)
    for column, frame in enumerate(frames):
        show(rows[1][column], run, frame, camera, moment(frame), tall)
    draw_time(rows[2][0], run, claims_of(run), run)
    (draw_inside if volume else draw_lag)(rows[2][1], run)
    draw_detections(rows[2][2], run)
    style.save(figure, out, TITLE, ALT, source_of([run]))


if __name__ == "__main__":
    draw_a_run(SCENE, draw)
