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
COLOURS_OF = {"ball": lambda style: style.COLOURS[4], "ball, r_q = r": lambda style: style.COLOURS[1],
              "planes": lambda style: style.OURS}
ALT = ("Three plots with a line for each scene and dots for balls, balls with a query radius of r, and planes: the "
       "time until a tenth of a step's force is left, until a hundredth is left, with a cross where it never is, and "
       "the share of the force that the scene's number of iterations leaves.")


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


def draw_panel(axes, rows, column, style, scenes, kinds):
    """Draws one number of each state, a line a scene; numbers that a step never reaches stand at the right as ×."""
    from matplotlib.ticker import LogLocator, NullFormatter  # imported here, as in `draw`
    known = [float(row[column]) for row in rows if row[column]]
    never = 2.2 * max(known, default=1)
    for row in rows:
        kind = kinds.index(row["bounds"])
        states = sorted({int(r["state after step"]) for r in rows if r["scene"] == row["scene"]})
        place = scenes.index(row["scene"]) + 0.26 * (kind - (len(kinds) - 1) / 2)
        place += 0.06 * (states.index(int(row["state after step"])) - 1)
        value = float(row[column]) if row[column] else never
        axes.plot([value], [place], "o" if row[column] else "x", color=COLOURS_OF[row["bounds"]](style), markersize=4)
    if any(not row[column] for row in rows):
        axes.axvline(never / 1.4, color="0.7", linewidth=0.8)
        axes.annotate("never", (never, 1), xycoords=("data", "axes fraction"), xytext=(0, 2), ha="center", fontsize=7.5,
                      textcoords="offset points")
    axes.set(xscale="log", yticks=range(len(scenes)), ylim=(len(scenes) - 0.5, -0.6))
    axes.set_yticklabels([scene.replace("_", " ") for scene in scenes])
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 3)))
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())


def draw(rows, scale, out):
    """Draws, for each scene and each kind of bounds, the time to a tenth and to a hundredth of the force, and the share
    of it that the scene's iterations leave."""
    from plots import style  # imported here, so that runs and tables need no matplotlib
    plt = style.use()
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    kinds = [kind for kind in COLOURS_OF if any(row["bounds"] == kind for row in rows)]
    reached = {name: sum(bool(row[f"to {name} [ms]"]) for row in rows) for name in SHARES}
    title = (f"{reached['a tenth']} of {len(rows)} steps come down to a tenth of their force, "
             f"{reached['a hundredth']} to a hundredth")
    below = (f"scale {scale}, {rows[0]['device']}; steps from three states of each run, with two or four times the "
             "scene's iterations")
    figure, (panels,) = style.page([(0.95 + 0.5 * len(scenes), [(1 / 3, "plot")] * 3)], title, below)
    columns = {f"to {name} [ms]": f"Time to {name} of the force [ms]" for name in SHARES}
    columns["residual after the scene's [1]"] = "Share of the force after the scene's iterations"
    for number, (axes, (column, words)) in enumerate(zip(panels, columns.items())):
        draw_panel(axes, rows, column, style, scenes, kinds)
        axes.set_title(words, pad=14)
        place = axes.get_position()
        axes.set_position([0.16 + 0.28 * number, place.y0, 0.26, place.height - 0.03])
        if number:
            axes.set_yticklabels([])
    for limit in SHARES.values():
        panels[-1].axvline(limit, color="0.4", linewidth=0.8, linestyle=":")
    entries = [plt.Line2D([], [], color=COLOURS_OF[kind](style), marker="o", linestyle="", markersize=5, label=kind)
               for kind in kinds]
    figure.legend(handles=entries, loc="lower left", ncols=1, fontsize=8)
    style.save(figure, out, title, ALT, ", ".join(sorted({row["commit"] for row in rows})))


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
    rows = [row_of(step) for step in steps]
    for name, table in (("quality.csv", rows), ("quality_whole.csv", whole)):
        write(options.folder / name, table)
        print(options.folder / name)
    if not options.no_picture:
        draw(rows, options.scale, options.folder / "quality.png")


if __name__ == "__main__":
    main()
