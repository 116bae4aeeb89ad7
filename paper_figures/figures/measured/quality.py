"""Time to quality: how long a step takes until its residual (Eq. 29) has fallen to a tenth and to a hundredth of the
step's start, by bounds, from states of whole runs; how much energy it leaves above Newton's minimiser; and what the
whole runs say beside. Not in the paper.

`quality.csv` has a row for each state. Steps with few iterations, the scene's and many are timed, and the time up to an
iteration lies on straight lines between these; one step of the CPU from the same state gives the residual after each.
`quality_whole.csv` has a row for each whole run.

Runs and tables need only Python's standard library. The picture needs matplotlib and is left out with --no-picture.
--no-runs draws what is there.
"""

import csv
import statistics
import sys
from dataclasses import dataclass
from pathlib import Path

from paper_figures.workflow import commands
from paper_figures.workflow.evidence import columns_of, run_at
from paper_figures.workflow.jobs import RunFailure, manifest_of, options_of_figure

SHARES = {"a tenth": 0.1, "a hundredth": 0.01}
COUNTS = ("few", "the scene's", "most")
WHY_NOT = {"fifty_layers": "too large for Newton's method", commands.STRETCH: "no moving planes for rods"}
OTHER_STATE, ABSENT = "asked of another state", "not run"
FAILED, CUT_OFF = "Newton's method did not converge", "Newton's method had no result in time"
LAGS = "what is prescribed lags"
ALT = ("A panel for each scene with curves of the residual of one step over its time, for balls and for planes from "
       "three states of the run; dots mark the scene's number of iterations. Below, bars with the time until a tenth "
       "and a hundredth of the force is left.")


def finished(folder):
    """Returns the run in a folder, or None if there is none that has finished."""
    run = run_at(folder)
    return run if run and run.manifest["status"] == "finished" and run.column("step") else None


def iterations_of(run):
    rows = run.rows.with_name("iterations.csv")
    return columns_of(rows, rows.stat().st_mtime_ns)


@dataclass
class Watched:
    """Holds one step: the time with several numbers of iterations [ms], and the residual before its iterations and
    after each."""

    row: str
    share: int  # percentage of the whole run at which the step begins
    run: object  # one of the timed ones
    timed: dict  # number of iterations -> ms
    residuals: list
    minimum: dict  # the cells about Newton's minimiser

    def time_at(self, iteration):
        """Returns the time up to an iteration [ms], on the straight line through two timed numbers of iterations.
        Before the first number it is at least the iteration's share of that number's time."""
        counts = sorted(self.timed)
        upper = next((k for k in range(1, len(counts)) if iteration <= counts[k]), len(counts) - 1)
        low, high = counts[upper - 1], counts[upper]
        slope = (self.timed[high] - self.timed[low]) / (high - low)
        return max(self.timed[low] + slope * (iteration - low), self.timed[low] * min(1, iteration / low))

    @property
    def times(self):
        return [self.time_at(k) for k in range(len(self.residuals))]

    def first_at(self, limit):
        """Returns the time until the residual is at most `limit` [ms]; None if it never is."""
        return next((self.time_at(k) for k, left in enumerate(self.residuals) if left <= limit), None)


def watched(folder):
    """Returns the finished steps below the folder of Table 1, by scene, bounds and state."""
    found = []
    for scene, counts in commands.QUALITY_ITERATIONS.items():
        for row in commands.quality_rows(scene):
            for share in commands.QUALITY_SHARES:
                runs = {n: finished(Path(folder) / row / f"timed_{n}_{share}") for n in counts}
                left = finished(Path(folder) / row / f"left_{share}")
                if left and all(runs.values()):
                    timed = {n: statistics.median(run.column("wall")) for n, run in runs.items()}
                    found.append(Watched(row, share, runs[counts[1]], timed, iterations_of(left)["residual"],
                                         above_minimum(Path(folder) / row, share)))
    return found


def above_minimum(folder, share):
    """Returns the cells about Newton's minimiser: the energy that is left above it after the scene's iterations, the
    share of this in the energy left before the first, by how much the minimiser's own energy jumped when its contacts
    were found at last (the force jumps between blocks, so that there may be no single minimum), and why there are no
    such numbers."""
    cells = dict.fromkeys(("energy above the minimiser [J]", "energy above, share of the start [1]",
                           "minimum known within [J]", "no energy because"), "")
    scene = commands.scene_of(folder.name)
    by_vbd, by_newton = (finished(folder / f"minimum_{name}_{share}") for name in ("vbd", "newton"))
    if scene in WHY_NOT or share not in commands.MINIMUM_SHARES:
        why = WHY_NOT.get(scene, OTHER_STATE)
    elif not by_vbd or not by_newton:
        status = manifest_of(folder / f"minimum_newton_{share}").get("status", "")
        why = FAILED if status.startswith("failed") else CUT_OFF if status else ABSENT
    elif max(*by_vbd.column("largest_lag"), *by_newton.column("largest_lag")) > 0:
        why = LAGS
    else:
        energies, newton = iterations_of(by_vbd)["energy"], iterations_of(by_newton)
        (*_, before, least), (*_, solved, last) = newton["energy"], newton["iteration"]
        above = energies[commands.QUALITY_ITERATIONS[scene][1]] - least
        jump = abs(least - before) if solved == last else 0.0  # the last row repeats the last iteration
        share_left = above / (energies[0] - least) if energies[0] > least else None
        return dict(zip(cells, (cell(above), cell(share_left), cell(jump), "")))
    return {**cells, "no energy because": why}


def cell(value):
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else value


def origin(run):
    m = run.manifest
    return {"backend": m["backend"], "device": m["device"],
            "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else "")}


def row_of(step):
    after = step.residuals[commands.QUALITY_ITERATIONS[commands.scene_of(step.row)][1]]
    timed = {f"{name} iterations{unit}": value for name, (n, ms) in zip(COUNTS, sorted(step.timed.items()))
             for unit, value in ((" [1]", n), (" [ms]", cell(ms)))}
    return {"scene": commands.scene_of(step.row), "bounds": commands.bounds_of(step.row),
            "state after step": int(step.run.column("step")[0]) - 1, **timed,
            "residual after the scene's [1]": cell(after), "least residual [1]": cell(min(step.residuals)),
            **{f"to {name} [ms]": cell(step.first_at(limit)) for name, limit in SHARES.items()},
            **step.minimum, **origin(step.run)}


def whole_row(row, run):
    mean = {"mean elastic energy [J]": "elastic_energy", "mean kinetic energy [J]": "kinetic_energy",
            "at bound, mean [1]": "share_cut", "detections a step [1]": "discrete_detections"}
    left = [value for value in run.column("left_residual") if value == value] if "left_residual" in run.columns else []
    return {"scene": commands.scene_of(row), "bounds": commands.bounds_of(row),
            "membrane": " and ".join(sorted(run.membranes)), "vertices": run.manifest["scene"]["vertices"],
            "steps": len(run.column("step")), "mean [ms]": cell(run.mean("wall")),
            "worst [ms]": cell(run.largest("wall")), "largest lag [m]": cell(run.largest("largest_lag")),
            **{title: cell(run.mean(column)) for title, column in mean.items()},
            "smallest distance [m]": cell(min(run.column("smallest_distance"))),
            "left residual, median [1]": cell(statistics.median(left) if left else None), **origin(run)}


def whole_rows(folder):
    rows = [row for scene in commands.QUALITY_ITERATIONS for row in commands.quality_rows(scene)]
    runs = {row: finished(Path(folder) / row / "whole") for row in rows}
    return [whole_row(row, run) for row, run in runs.items() if run]


def write(out, rows):
    with Path(out).open("w", newline="") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def curves(axes, steps, style, kinds):
    """Draws the residuals of one scene: a colour for each kind of bounds, a dash for each state."""
    from matplotlib.ticker import LogLocator, NullFormatter  # imported here, as in `picture`
    for step in steps:
        axes.plot(step.times[1:], step.residuals[1:], style.DASHES[commands.QUALITY_SHARES.index(step.share)],
                  color=style.COLOURS[kinds.index(commands.bounds_of(step.row))], linewidth=1.2)
        own = commands.QUALITY_ITERATIONS[commands.scene_of(step.row)][1]
        axes.plot(step.time_at(own), step.residuals[own], "o", markersize=4,
                  color=style.COLOURS[kinds.index(commands.bounds_of(step.row))])
    for limit in SHARES.values():
        axes.axhline(limit, color="black", linewidth=0.5)
    axes.set(xscale="log", yscale="log", title=commands.scene_of(steps[0].row), xlabel="time into the step [ms]",
             ylabel="residual [1]")
    # a panel often spans less than a decade, where the usual labels overlap
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(lambda time, _: f"{time:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())


def bars(axes, steps, style, kinds, scenes):
    """Draws the times to a tenth and to a hundredth of all scenes, bounds side by side. What is never reached stands
    above the line."""
    times = [step.first_at(limit) for step in steps for limit in SHARES.values()]
    never = 4 * max([time for time in times if time is not None], default=1)
    for step in steps:
        kind = kinds.index(commands.bounds_of(step.row))
        place = scenes.index(commands.scene_of(step.row)) + 0.25 * (kind - (len(kinds) - 1) / 2)
        place += 0.05 * (commands.QUALITY_SHARES.index(step.share) - 1)
        for limit, fill in zip(SHARES.values(), (style.COLOURS[kind], "none")):
            time = step.first_at(limit)
            axes.plot(place, never * (1 if limit == 0.1 else 1.6) if time is None else time,
                      "x" if time is None else "o", color=style.COLOURS[kind], markerfacecolor=fill, markersize=5)
    axes.axhline(never / 1.6, color="black", linewidth=0.5)
    axes.set(yscale="log", xticks=range(len(scenes)), xticklabels=scenes, ylabel="time to quality [ms]",
             title="time to a tenth (filled) and to a hundredth (hollow); × above the line: never")
    axes.tick_params(axis="x", labelsize=7)


def picture(steps, scale):
    """Draws a panel for each scene, and one with the times of all."""
    from plots import style  # imported here, so that runs and tables need no matplotlib
    plt = style.use()
    scenes = list(dict.fromkeys(commands.scene_of(step.row) for step in steps))
    kinds = [kind for kind in ("ball", "planes", "ball, r_q = r")
             if any(commands.bounds_of(step.row) == kind for step in steps)]
    columns = min(3, len(scenes))
    lines = -(-len(scenes) // columns)
    figure = plt.figure(figsize=(max(6, 4.2 * columns), 2.8 * (lines + 1)))
    grid = figure.add_gridspec(lines + 1, columns)
    for number, scene in enumerate(scenes):
        curves(figure.add_subplot(grid[number // columns, number % columns]),
               [step for step in steps if commands.scene_of(step.row) == scene], style, kinds)
    bars(figure.add_subplot(grid[lines, :]), steps, style, kinds, scenes)
    entries = [plt.Line2D([], [], color=style.COLOURS[k], label=kind) for k, kind in enumerate(kinds)]
    entries += [plt.Line2D([], [], color="grey", linestyle=dash, label=f"from {share} % of the run")
                for share, dash in zip(commands.QUALITY_SHARES, style.DASHES)]
    figure.legend(handles=entries, loc="outside lower center", ncols=len(entries), fontsize=7)
    about = origin(steps[0].run)
    figure.suptitle(f"Residual of a step against its time; dots: the scene's iterations ({scale}, {about['backend']}, "
                    f"{about['device']})", fontsize=9)
    return figure


def main():
    options = options_of_figure(__doc__.splitlines()[0], ("smoke", "small", "paper"))
    root = options.folder.parent / f"table1-{options.scale}-{options.backend}"
    try:
        for scene in commands.QUALITY_ITERATIONS if not options.no_runs else ():
            for job in commands.to_quality(scene, options.scale, options.backend):
                job.make(options.ogc, root)
    except RunFailure as error:
        sys.exit(f"quality: {error}")
    steps, whole = watched(root), whole_rows(root)
    if not steps or not whole:
        sys.exit(f"quality: {root} holds no step with its time and its residual")
    options.folder.mkdir(parents=True, exist_ok=True)
    for name, rows in (("quality.csv", [row_of(step) for step in steps]), ("quality_whole.csv", whole)):
        write(options.folder / name, rows)
        print(options.folder / name)
    if not options.no_picture:
        from plots import style
        commits = ", ".join(sorted({origin(step.run)["commit"] for step in steps}))
        style.save(picture(steps, options.scale), options.folder / "quality.png",
                   "Residual of a step against its time, by bounds", ALT, commits)


if __name__ == "__main__":
    main()
