"""Draws the figure of one run (time a step, detections, contacts, smallest distance, rendered frames), and its
movie."""

import json
from pathlib import Path

import h5py  # imported first, so that a missing reader is reported before anything is drawn
import numpy as np

from plots import render, style, yarn
from ogc_testbed.runs import RunError, commits_in_words

UNEVEN = 100  # longest step over median step above which times have a logarithmic axis
NEAR = (1280, 560)  # pixels of a picture as wide as the figure
BOUNDS = {"planes": "bounds by planes", "dat": "bounds by planes of Divide and Truncate", "off": "without bounds"}
YARNS = ("#0072B2", "#D55E00", "#009E73")


def load_claims(path, backend):
    """Returns the paper's claims about a scene on a backend: {quantity: (value, machine)}; empty if there are none."""
    path = Path(path)
    if not path.is_file():
        return {}
    return {c["quantity"]: (c["value"], c["machine"]) for c in json.loads(path.read_text())["claims"]
            if c.get("backend") == backend}


def is_cloth(body):
    """Returns whether a body is simulated, that is neither fixed nor wholly prescribed."""
    return not body["fixed"] and body.get("prescribed_vertices") != body["vertex_count"]


def bodies_of(run, frame):
    """Returns the bodies as `render.picture` takes them, at the frame's positions. Fixed and wholly prescribed bodies
    are grey; rods are tubes with plies."""
    fronts, backs = ["#56B4E9", "#009E73", "#CC79A7"], ["#E69F00", "#D55E00", "#F0E442"]
    result, cloth = [], 0
    for body in run.bodies():
        first, count = body["first_vertex"], body["vertex_count"]
        points, triangles = frame.positions[first:first + count], body["triangles"]
        if "segments" in body:
            result.append(yarn_of(run, body, frame))
        if not len(triangles):
            continue
        if is_cloth(body):
            result.append((points, triangles, fronts[cloth % 3], backs[cloth % 3]))
            cloth += 1
        else:
            result.append((points, triangles, "#B0B0B0", "#B0B0B0"))
    return result


def yarn_of(run, body, frame):
    """Returns a rod as `render.picture` takes it, with a colour for each of its chains."""
    first, count, segments = body["first_vertex"], body["vertex_count"], body["segments"]
    start = run.start_positions[first:first + count].astype(float)
    lengths = np.linalg.norm(start[segments[:, 1]] - start[segments[:, 0]], axis=1)
    diameter = body["material"]["rod"]["diameter"]["value"]
    chains = yarn.chains(segments, count)
    colours = np.empty((len(segments), yarn.PLIES, 3))
    for number, links in enumerate(chains):
        colours[[e for e, _ in links]] = yarn.plies_of(YARNS[number % len(YARNS)])
    angles = yarn.angles_of(chains, lengths, yarn.PITCH * diameter)
    points = frame.positions[first:first + count]
    orientations = frame.orientations[body["first_segment"]:body["first_segment"] + len(segments)].astype(float)
    if not len(orientations):  # the start of a scene without orientations; frames follow from its rest shape
        orientations = yarn.untwisted(chains, points.astype(float), segments)
    return (*yarn.tubes(points, segments, orientations, angles, diameter, colours), None)


def draw_time(axes, run, claims, profiled):
    """Draws the time of each step of `run`. Behind it, if `profiled` has times by stage, draws these; their sum is
    larger, because profiling synchronises after each stage."""
    stages = profiled.stage_columns()
    if stages:
        axes.stackplot(profiled.column("step"), list(stages.values()),
                       labels=[f"profiled: {name.replace('_', ' ')}" for name in stages],
                       colors=style.COLOURS[1:], alpha=0.7)
    axes.plot(run.column("step"), run.column("wall"), label="step")
    for quantity, dash in (("step_ms_average", "--"), ("step_ms_maximum", ":")):
        if quantity in claims:
            value, machine = claims[quantity]
            axes.axhline(value, color="black", linestyle=dash, linewidth=0.8,
                         label=f"paper, {quantity.split('_')[-1]}: {value:g} ms ({machine})")
    axes.set(xlabel="step", ylabel="time a step [ms]", title="Time", ylim=(0, None))
    if run.column("wall").max() > UNEVEN * np.median(run.column("wall")):
        axes.set(ylim=(None, None), yscale="log")
        axes.legend(fontsize=6.5, ncols=2, loc="upper left")
    elif stages:
        axes.legend(fontsize=6.5, ncols=2)
    else:  # above the run's line: where we are slow, the paper's lines lie at the bottom and would cover the legend
        axes.set_ylim(0, 1.25 * axes.get_ylim()[1])
        axes.legend(fontsize=6.5, ncols=2, loc="upper left")


def draw_detections(axes, run):
    steps = run.column("step")
    axes.step(steps, run.column("discrete_detections"), where="mid", label="detections")
    axes.step(steps, run.column("guess_rounds"), where="mid", linestyle="--", label="rounds of the guess loop")
    axes.set(xlabel="step", ylabel="count a step", title="Detections (all discrete; none is continuous)",
             ylim=(0, None))
    axes.legend()


def draw_lag(axes, run):
    """Draws the lag; if the run never lagged, only the axis."""
    axes.plot(run.column("step"), 1e3 * run.column("largest_lag"), label="of the prescribed vertex that lags most")
    axes.axhline(1e3 * run.setting("contact_radius"), color="black", linestyle="--", linewidth=0.8,
                 label=f"contact radius r = {1e3 * run.setting('contact_radius'):g} mm")
    axes.set(xlabel="step", ylabel="lag [mm]", title="Lag behind the prescribed motion",
             ylim=(0, None))
    axes.legend()


def draw_contacts(axes, run):
    steps = run.column("step")
    axes.plot(steps, run.column("vertex_facet_contacts"), label="vertex–facet")
    axes.plot(steps, run.column("edge_edge_contacts"), linestyle="--", label="edge–edge")
    axes.set(xlabel="step", ylabel="contacts", title="Contacts at the last detection of the step", ylim=(0, None))
    axes.legend()


def draw_distance(axes, run):
    radius, distance = run.setting("contact_radius"), run.column("smallest_distance")
    axes.plot(run.column("step"), 1e3 * distance, label="smallest distance (never above the exact one)")
    axes.axhline(1e3 * radius, color="black", linestyle="--", linewidth=0.8,
                 label=f"contact radius r = {1e3 * radius:g} mm")
    axes.axhline(5e2 * radius, color="black", linestyle=":", linewidth=0.8, label="τ = r/2")
    axes.set(xlabel="step", ylabel="distance [mm]", title="Smallest distance of non-adjacent primitives")
    if 0 < distance.min() < radius / 100:  # a linear axis would make it look like an intersection
        axes.set_yscale("log")
    else:
        axes.set_ylim(0, None)
    axes.legend()


def draw_frames(figure, grid, run, steps, camera):
    usable, reason = render.available()
    for column, step in enumerate(steps):
        axes = figure.add_subplot(grid[column])
        axes.axis("off")
        frame = run.frame_at_step(step)
        axes.set_title(f"step {frame.step}, t = {frame.time:.3g} s")
        if usable:
            axes.imshow(render.picture(bodies_of(run, frame), camera))
        else:
            axes.text(0.5, 0.5, reason, ha="center", va="center", wrap=True, transform=axes.transAxes)


def draw_near(axes, run, frame, camera):
    """Draws a close view of the frame, as wide as the figure."""
    axes.axis("off")
    axes.set_title(f"step {frame.step}, from near")
    usable, reason = render.available()
    if usable:
        axes.imshow(render.picture(bodies_of(run, frame), camera(frame.positions), NEAR))
    else:
        axes.text(0.5, 0.5, reason, ha="center", va="center", wrap=True, transform=axes.transAxes)


def draw_movie(run, camera, out, most=160, frames_per_second=24, shortest=5):
    """Writes an MP4 of a finished run's stored frames. If there are more than `most`, takes only every second, third …
    of them. The movie lasts at least `shortest` seconds, even with few frames. Throws RunError like `draw`."""
    run.require_finished()
    chosen = run.frames[::-(-len(run.frames) // most)]
    frames = (bodies_of(run, run.frame(path)) for path in chosen)
    usable, reason = render.write_movie(frames, camera, out, max(1, min(frames_per_second, len(chosen) // shortest)))
    if not usable:
        raise RunError(f"{out} can't be made: {reason}")


def headline(run):
    wall = run.column("wall")[1:] if len(run.column("wall")) > 1 else run.column("wall")
    m = run.manifest
    words = {True: f"exact audit of {m.get('audited_states')} states: no intersection", False: "exact audit: FAILED"}
    kept = words.get(m.get("guarantee_kept"), "not audited")
    bounds = BOUNDS.get(m["settings"].get("bounds", {}).get("value"))
    return (f"{m['scene']['name']}{f', {bounds}' if bounds else ''}, {m['backend']} ({m['device']}), "
            f"{len(run.column('step'))} steps: median {np.median(wall):.3g} ms, "
            f"worst {wall.max():.3g} ms a step; {kept}; {commits_in_words([run])}")


def draw(run, frames, camera, claims, out, profiled=None, driven=False, near=None):
    """Draws the whole figure into `out` (PNG, and a PDF beside it). Throws RunError for a run that is unfinished or
    failed its audit.

    `profiled`: a run of the same scene with --profile, for the times by stage; None: `run` itself. `driven`: shows lag
    instead of detections. `near`: a function from positions to a camera for a close view of the last of the `frames`.
    """
    run.require_finished()
    plt = style.use()
    figure = plt.figure(figsize=(11, 12.6 if near else 8.2))
    grid = figure.add_gridspec(4 if near else 3, 4, height_ratios=[1, 1, 0.95, 1.9][:4 if near else 3])
    draw_time(figure.add_subplot(grid[0, :2]), run, claims, profiled or run)
    (draw_lag if driven else draw_detections)(figure.add_subplot(grid[0, 2:]), run)
    draw_contacts(figure.add_subplot(grid[1, :2]), run)
    draw_distance(figure.add_subplot(grid[1, 2:]), run)
    draw_frames(figure, [grid[2, i] for i in range(4)], run, frames, camera)
    if near:
        draw_near(figure.add_subplot(grid[3, :]), run, run.frame_at_step(frames[-1]), near)
    figure.suptitle(headline(run), fontsize=9)
    out = Path(out)
    try:
        style.save(figure, out)
    except OSError as error:
        raise RunError(f"{out} can't be written: {error}") from error
