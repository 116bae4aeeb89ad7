"""Time to quality: how long a step takes until its residual (Eq. 29) has fallen to a tenth and to a hundredth of the
step's start, with the paper's bounds and with planes, from states of Table 1's whole runs. A step with many times the
scene's iterations gives the residual after each iteration. The time up to iteration k of n is k/n of the median time of
five such steps, so that the guess loop and detections are spread evenly over the iterations. Not in the paper.

Runs and table need only Python's standard library. The picture needs matplotlib and is left out with --no-picture.
"""

import csv
import statistics
import sys
from dataclasses import dataclass
from pathlib import Path

from paper_figures.workflow import commands
from paper_figures.workflow.evidence import columns_of, run_at
from paper_figures.workflow.jobs import RunFailure, options_of_figure

SHARES = {"a tenth": 0.1, "a hundredth": 0.01}


@dataclass
class Watched:
    """Holds one step: milliseconds and residual before its iterations and after each."""

    row: str
    share: int  # percentage of the whole run at which the step begins
    run: object
    times: list
    residuals: list

    @property
    def bounds(self):
        return "planes" if self.row.endswith(commands.WITH_PLANES) else "ball"


def table1_of(folder, scale, backend):
    """Returns the workflow's folder with Table 1's whole runs, from whose states all steps here begin."""
    return Path(folder).parent / f"table1-{scale}-{backend}"


def watched(folder):
    """Returns the finished steps below the folder of Table 1."""
    found = []
    for row in commands.QUALITY_ROWS:
        for share in commands.QUALITY_SHARES:
            place = Path(folder) / row / f"quality_{share}"
            timed = run_at(Path(folder) / row / f"quality_timed_{share}")
            run, rows = run_at(place), place / "iterations.csv"
            if not all(r and r.manifest["status"] == "finished" for r in (run, timed)) or not rows.is_file():
                continue
            residuals = columns_of(rows, rows.stat().st_mtime_ns)["residual"]
            step = statistics.median(timed.column("wall"))
            times = [step * k / (len(residuals) - 1) for k in range(len(residuals))]
            found.append(Watched(row, share, run, times, residuals))
    return found


def first_at(step, limit):
    """Returns the time until the residual is at most `limit` [ms]; None if it never is."""
    return next((t for t, left in zip(step.times, step.residuals) if left <= limit), None)


def row_of(step):
    def cell(value):
        return "" if value is None else f"{value:.4g}"

    iterations = len(step.residuals) - 1
    m = step.run.manifest
    return {"scene": commands.scene_of(step.row), "bounds": step.bounds,
            "state after step": int(step.run.column("step")[0]) - 1, "iterations": iterations,
            "step [ms]": cell(step.times[-1]), "least residual [1]": cell(min(step.residuals)),
            **{f"to {name} [ms]": cell(first_at(step, limit)) for name, limit in SHARES.items()},
            "backend": m["backend"], "device": m["device"],
            "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else "")}


def write(out, steps):
    rows = [row_of(step) for step in steps]
    with Path(out).open("w", newline="") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def picture(steps, scale):
    """Draws a panel for each scene and a colour for each state."""
    from plots import style  # imported here, so that runs and table need no matplotlib
    plt = style.use()
    scenes = list(dict.fromkeys(commands.scene_of(step.row) for step in steps))
    columns = min(3, len(scenes))
    figure, panels = plt.subplots(-(-len(scenes) // columns), columns, squeeze=False,
                                  figsize=(4.2 * columns, 3.2 * -(-len(scenes) // columns)))
    for axes in panels.flat[len(scenes):]:
        axes.set_visible(False)
    for scene, axes in zip(scenes, panels.flat):
        for step in steps:
            if commands.scene_of(step.row) != scene:
                continue
            colour = style.COLOURS[commands.QUALITY_SHARES.index(step.share)]
            dash = style.DASHES[step.bounds == "planes"]
            axes.plot(step.times[1:], step.residuals[1:], dash, color=colour, linewidth=1.4,
                      label=f"{step.bounds}, from {step.share} % of the run")
        for limit in SHARES.values():
            axes.axhline(limit, color="black", linewidth=0.5)
        axes.set(xscale="log", yscale="log", title=scene, xlabel="time into the step [ms]", ylabel="residual [1]")
    panels.flat[0].legend(fontsize=6)
    about = steps[0].run.manifest
    commits = ", ".join(sorted({row_of(step)["commit"] for step in steps}))
    figure.suptitle(f"Residual of a step against its time; balls solid, planes dashed. {scale}, {about['backend']}, "
                    f"{about['device']}, commit {commits}", fontsize=8)
    return figure


def main():
    options = options_of_figure(__doc__.splitlines()[0], ("smoke", "small", "paper"))
    root = table1_of(options.folder, options.scale, options.backend)
    try:
        for job in commands.to_quality(options.scale, options.backend):
            job.make(options.ogc, root)
    except RunFailure as error:
        sys.exit(f"quality: {error}")
    options.folder.mkdir(parents=True, exist_ok=True)
    steps = watched(root)
    write(options.folder / "quality.csv", steps)
    print(options.folder / "quality.csv")
    if not options.no_picture:
        from plots import style
        style.save(picture(steps, options.scale), options.folder / "quality.png")


if __name__ == "__main__":
    main()
