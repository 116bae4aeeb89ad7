"""Draws the figure of one run (its moments, time a step, detections or lag, smallest distance), and its movie."""

import json
from pathlib import Path

import h5py  # noqa: F401  imported first, so that a missing reader is reported before anything is drawn
import numpy as np

from plots import render, style
from plots.bodies import bodies_of, floor_of
from plots.camera import fitted, is_cloth, subject, view_of
from ogc_testbed.runs import RunError, commits_in_words

RARE = 99.8  # percentile of the steps' times up to which they are drawn, if the longest is far above
FAR = 3  # factor over that percentile from which the longest is far above
NEAREST = 0.03  # share of the run within which a stored frame stands for the one that is asked for
WIDTH, PICTURE = 960, (960, 640)  # pixels
NEAR = (1280, 560)
MOVIE = (1280, 720)
PLOTS = (2.5, [(1 / 3, "plot")] * 3)  # the row of curves below the pictures
FRAMES_A_SECOND = 30
BOUNDS = {"planes": "bounds by planes", "dat": "bounds by planes of Divide and Truncate", "off": "without bounds"}


def load_claims(path, backend):
    """Returns the paper's claims about a scene on a backend: {quantity: (value, machine)}; empty if there are none."""
    path = Path(path)
    if not path.is_file():
        return {}
    return {c["quantity"]: (c["value"], c["machine"]) for c in json.loads(path.read_text())["claims"]
            if c.get("backend") == backend}


def look_of(run):
    """Returns the options of `render.picture` for a run: the floor of its scene."""
    return {"floor": floor_of(run)}


def render_frame(run, frame, camera, size=PICTURE, **look):
    """Returns the picture of a frame. Throws RunError if meshes can't be rendered here."""
    usable, reason = render.available()
    if not usable:
        raise RunError(reason)
    return render.picture(bodies_of(run, frame), camera, size, **{**look_of(run), **look})


def frames_at(run, steps):
    """Returns the frames at these steps; None for a step of which none is stored within NEAREST of the run."""
    last = run.column("step")[-1]
    found = [run.frame_at_step(step) for step in steps]
    return [frame if abs(frame.step - step) <= NEAREST * last else None for frame, step in zip(found, steps)]


def show(axes, run, frame, camera, title, size=PICTURE, **look):
    """Draws a frame into a panel, or the reason why it can't be. `frame`: None says that it was not kept."""
    usable, reason = render.available()
    if frame is None:
        style.not_run(axes, "this state was not kept")
    elif usable:
        style.picture(axes, render_frame(run, frame, camera, size, **look), title)
    else:
        style.not_run(axes, reason)
        axes.set_title(title)


def moment(frame):
    return f"t = {frame.time:.3g} s" if frame else ""


def times(run):
    """Returns the times of the run's steps without the first, which also starts the program [ms]."""
    wall = run.column("wall")
    return wall[1:] if len(wall) > 1 else wall


def ms(time):
    """Returns a time [ms] as text, with three digits or all of those before the point."""
    return f"{time:,.0f}" if time >= 100 else f"{time:.3g}"


def draw_time(axes, run, claims, profiled):
    """Draws the time of each step of `run` and the paper's numbers. Behind it, if `profiled` has times by stage, draws
    these; their sum is larger, because profiling synchronises after each stage. Few steps that took far longer than all
    others are counted in words, not drawn."""
    stages, steps, wall = profiled.stage_columns(), run.column("step"), run.column("wall")
    if stages:
        axes.stackplot(profiled.column("step"), list(stages.values()),
                       labels=[f"profiled: {name.replace('_', ' ')}" for name in stages],
                       colors=style.COLOURS[1:], alpha=0.7)
    axes.plot(steps, wall, color=style.OURS, linewidth=0.8)
    named = {"step_ms_average": ("mean", "--"), "step_ms_maximum": ("longest", ":")}
    top = np.percentile(wall, RARE)
    for quantity, (word, dash) in named.items():
        if quantity in claims:
            value, _ = claims[quantity]
            top = max(top, value)
            style.paper_line(axes, value, f"paper,\n{word} {value:g}", dash)
    title = "Time a step"
    if wall.max() > FAR * top:
        title += f" ({int(np.sum(wall > 1.25 * top))} steps above, the longest {ms(wall.max())} ms)"
    else:
        top = max(top, wall.max())
    axes.set(xlabel="step", ylabel="time [ms]", title=title, ylim=(0, 1.25 * top))
    style.label_ends(axes)
    if stages:
        axes.legend(fontsize=6.5, ncols=2)


def draw_detections(axes, run):
    steps = run.column("step")
    axes.step(steps, run.column("discrete_detections"), where="mid", linewidth=0.8)
    axes.set(xlabel="step", ylabel="detections", title="Detections a step", ylim=(0, None))


def draw_lag(axes, run):
    """Draws how far the prescribed vertices lag; a run that never lagged has its contacts drawn instead."""
    lag, radius = 1e3 * run.column("largest_lag"), 1e3 * run.setting("contact_radius")
    if not np.any(lag > 0):
        return draw_contacts(axes, run)
    axes.plot(run.column("step"), lag, linewidth=0.8)
    style.paper_line(axes, radius, f"contact\nradius {radius:.3g}")
    axes.set(xlabel="step", ylabel="lag [mm]", title="Lag behind the prescribed motion", ylim=(0, None))
    style.label_ends(axes)
    return None


def draw_contacts(axes, run):
    steps = run.column("step")
    axes.plot(steps, run.column("vertex_facet_contacts"), linewidth=0.9, label="vertex–facet")
    axes.plot(steps, run.column("edge_edge_contacts"), linestyle="--", linewidth=0.9, label="edge–edge")
    axes.set(xlabel="step", ylabel="contacts", title="Contacts at the end of the step", ylim=(0, None))
    style.label_ends(axes)


def draw_distance(axes, run):
    radius, distance = 1e3 * run.setting("contact_radius"), 1e3 * run.column("smallest_distance")
    axes.plot(run.column("step"), distance, linewidth=0.8)
    style.paper_line(axes, radius, f"contact\nradius {radius:.3g}")
    axes.set(xlabel="step", ylabel="distance [mm]", title="Smallest distance")
    if 0 < distance.min() < radius / 30:  # a linear axis would make it look like an intersection
        axes.set_yscale("log")
    else:
        axes.set_ylim(0, None)
    style.label_ends(axes)


def draw_movie(run, out, camera=None, most=300, shortest=4):
    """Writes an MP4 of a finished run's stored frames, 30 in a second. If there are more than `most`, takes only every
    second, third … of them; if they would last less than `shortest` seconds, each is shown for several frames. Throws
    RunError like `draw`."""
    run.require_finished()
    chosen = run.frames[::-(-len(run.frames) // most)]
    shown = [run.frame(path) for path in chosen[::max(1, len(chosen) // 12)]]
    frames = (bodies_of(run, run.frame(path)) for path in chosen)
    usable, reason = render.write_movie(frames, camera or fitted(run, shown, MOVIE), out, FRAMES_A_SECOND, MOVIE,
                                        max(1, -(-shortest * FRAMES_A_SECOND // len(chosen))), **look_of(run))
    if not usable:
        raise RunError(f"{out} can't be made: {reason}")


def audit_in_words(run):
    m = run.manifest
    states = m.get("audited_states")
    if not int(states or 0):
        return "not audited"
    return f"exact audit of {int(states):,} states: no intersection"


def beside_paper(run, claims):
    """Returns our time a step and the paper's, and what the run is, as one line."""
    m, wall = run.manifest, times(run)
    size = sum(body["vertex_count"] for body in m["scene"]["bodies"] if is_cloth(body))
    ours = f"ours {ms(np.mean(wall))} ms a step, longest {ms(wall.max())} ({m['device']}"
    bounds = BOUNDS.get(m["settings"].get("bounds", {}).get("value"))
    ours += f", {bounds})" if bounds else ")"
    theirs = [f"{claims[key][0]:g}" for key in ("step_ms_average", "step_ms_maximum") if key in claims]
    paper = f"; paper {theirs[0]} ms, longest {theirs[-1]} ({claims['step_ms_average'][1]})" if theirs else ""
    scale = "" if m.get("scale") == "paper" else f" (scale {m.get('scale')})"
    return f"{size:,} vertices{scale}; {ours}{paper}; {audit_in_words(run)}"


def source_of(runs):
    """Returns, for a caption, the commands and the commit behind a picture."""
    return f"{'; '.join(' '.join(command_of(run)) for run in runs)}; {commits_in_words(runs)}"


def command_of(run):
    words = run.manifest["command"]
    words = words.split() if isinstance(words, str) else words
    return ["ogc", *(word.rpartition("/")[2] for word in words[1:])]


def draw(run, steps, claims, out, title, alt, profiled=None, driven=False, near=None):
    """Draws the whole figure into `out` (PNG, and a PDF beside it). Throws RunError for a run that is unfinished or
    failed its audit.

    `profiled`: a run of the same scene with --profile, for the times by stage; None: `run` itself. `driven`: shows lag
    instead of detections. `near`: (a function from run and frame to a camera, words) for a close view of the last of
    the frames."""
    run.require_finished()
    style.use()
    frames = frames_at(run, steps)
    seen = [frame for frame in frames if frame] or [run.frame(run.frames[-1])]
    view = view_of(run.manifest["scene"]["name"])
    size = render.shape_of(view, np.concatenate([subject(run, frame) for frame in seen]), WIDTH)
    camera = fitted(run, seen, size)
    wide = 3 if len(steps) % 3 == 0 or len(steps) > 4 else 2
    parts = [frames[:wide], frames[wide:]] if len(steps) > wide else [frames]
    rows = [*(style.pictures(len(part), size) for part in parts), *([style.pictures(1, NEAR)] if near else []), PLOTS]
    figure, axes = style.page(rows, title, beside_paper(run, claims))
    for part, row in zip(parts, axes):
        for frame, place in zip(part, row):
            show(place, run, frame, camera, moment(frame), size)
    if near:
        show(axes[-2][0], run, frames[-1], frames[-1] and near[0](run, frames[-1]), near[1], NEAR)
    draw_time(axes[-1][0], run, claims, profiled or run)
    (draw_lag if driven else draw_detections)(axes[-1][1], run)
    draw_distance(axes[-1][2], run)
    out = Path(out)
    try:
        style.save(figure, out, title, alt, source_of([run]))
    except OSError as error:
        raise RunError(f"{out} can't be written: {error}") from error
