"""What the parts of a step do to energy and momentum, what truncation takes and which way, and vertices that stand
still: `twist`, `fifty_layers` and a sheet that slides without friction, by balls and by planes. Runs, table and
picture; reference/ledger.md defines every column. The first two begin with a state of a plain run, where truncation
takes most. Not in the paper.

Runs and table need only Python's own library; the picture needs matplotlib and is left out with --no-picture.
"""

import csv
import math
import sys
from itertools import accumulate

from paper_figures.workflow import commands
from paper_figures.workflow.evidence import run_at
from paper_figures.workflow.jobs import RunFailure, options_of_figure

PARTS = ("guess", "detection", "sweep", "truncation", "commit")
MOVERS = ("guess", "sweep", "truncation")  # parts that change momentum; the others leave it unchanged
BOUNDS = ("ball", "planes")
AXES = {"twist": "x", "fifty_layers": "y", "slide": "x"}  # direction of the shown momentum: axis, fall, downhill
CARRIERS = {"twist": "the cloth", "fifty_layers": "all layers", "slide": "the sheet"}  # bodies with that momentum
POINTS = 60  # shares are drawn for so many parts of a run


def free_vertices(manifest):
    return sum(body["vertex_count"] - body["prescribed_vertices"]
               for body in manifest["scene"]["bodies"] if not body["fixed"])


def share(part, whole):
    """Returns None if there is nothing to share."""
    return part / whole if whole > 0 else None


def row_of(scene, bounds, run):
    """Returns sums over a run: energies and momenta by part, shares of motion, vertices that stand still."""
    m, steps = run.manifest, run.step_count
    summed = ("energy_", "momentum_", "motion_")
    total = {name: sum(run.column(name)) for name in run.columns if name.startswith(summed)}
    taken, count = total["motion_taken"], steps * free_vertices(m)
    energies = {f"energy {part} [J]": total[f"energy_{part}"] for part in PARTS}
    momenta = {f"momentum {part} [kg m/s]": total[f"momentum_{part}_{AXES[scene]}"] for part in MOVERS}
    shares = {"taken of proposed motion": share(taken, total["motion_proposed"]),
              "tangential of taken": share(total["motion_taken_tangential"], taken),
              "leaving of taken": share(total["motion_taken_leaving"], taken),
              "unpaired of taken": share(total["motion_taken_unpaired"], taken),
              "still vertices": sum(run.column("vertices_still")) / count,
              "held vertices": sum(run.column("vertices_held")) / count}
    return {"scene": scene, "bounds": bounds, "steps": steps, "free vertices": free_vertices(m),
            **{name: f"{value:.6g}" for name, value in (energies | momenta).items()},
            "momentum along": AXES[scene],
            **{f"{name} [%]": "" if value is None else f"{100 * value:.4g}" for name, value in shares.items()},
            "detections a step": f"{run.mean('discrete_detections'):.4g}",
            "audit": {True: "no intersection", False: "FAILED"}.get(m.get("guarantee_kept"), "not audited"),
            "final_hash": m["final_hash"], "device": m["device"],
            "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else "")}


def finished(folder):
    """Returns (scene, bounds) -> the finished run."""
    runs = {}
    for scene in AXES:
        for bounds in BOUNDS:
            run = run_at(folder / f"{scene}_{bounds}")
            if run and run.manifest["status"] == "finished":
                runs[scene, bounds] = run
    return runs


def write(folder, runs):
    """Writes the table of the runs, with Python's own library alone."""
    rows = [row_of(*key, run) for key, run in runs.items()]
    with (folder / "ledger.csv").open("w", newline="") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def sums_of_parts(values, parts):
    """Returns sums over consecutive parts of a column, as equal as can be."""
    edges = [round(k * len(values) / parts) for k in range(parts + 1)]
    return [sum(values[a:b]) for a, b in zip(edges, edges[1:])]


def draw_sums(axes, run, columns, dash, colours):
    for (label, name), colour in zip(columns.items(), colours):
        axes.plot(run.column("step"), list(accumulate(run.column(name))), dash, color=colour, linewidth=1,
                  label=label if dash == "-" else None)


def draw_shares(axes, run, dash, colours):
    parts = min(POINTS, run.step_count)
    steps = [run.first_step + (k + 0.5) * run.step_count / parts for k in range(parts)]
    taken = sums_of_parts(run.column("motion_taken"), parts)
    lines = {"taken of proposed": (taken, sums_of_parts(run.column("motion_proposed"), parts))}
    for way in ("tangential", "leaving"):
        lines[f"{way} of taken"] = (sums_of_parts(run.column(f"motion_taken_{way}"), parts), taken)
    for (label, (part, whole)), colour in zip(lines.items(), colours):
        values = [math.nan if portion is None else 100 * portion for portion in map(share, part, whole)]
        axes.plot(steps, values, dash, color=colour, linewidth=1, label=label if dash == "-" else None)


def note_on_shares(taken):
    """Returns the note in a panel of shares about missing lines: truncation takes nothing, or not with some bounds.
    `taken`: the sum over its run for each kind of bounds. Empty if no line is missing."""
    nothing = [bounds for bounds, total in taken.items() if not total > 0]
    if not nothing:
        return ""
    words = "truncation takes nothing"
    return words if len(nothing) == len(taken) else f"{words} with {' and '.join(nothing)}"


def draw_still(axes, run, dash, colours):
    parts = min(POINTS, run.step_count)
    steps = [run.first_step + (k + 0.5) * run.step_count / parts for k in range(parts)]
    each = run.step_count / parts * free_vertices(run.manifest)
    for name, label, colour in (("still", "end where they began", colours[0]),
                                ("held", "of these cut last", colours[3])):
        shares = [100 * n / each for n in sums_of_parts(run.column(f"vertices_{name}"), parts)]
        axes.plot(steps, shares, dash, color=colour, linewidth=1, label=label if dash == "-" else None)


def picture(runs, scale):
    """Draws a row of panels for each scene."""
    from plots import style  # imported here, so that runs and table need no matplotlib
    plt = style.use()
    scenes = [scene for scene in AXES if any(key[0] == scene for key in runs)]
    figure, panels = plt.subplots(len(scenes), 4, figsize=(14, 3.1 * len(scenes)), squeeze=False)
    for row, scene in zip(panels, scenes):
        axis = AXES[scene]
        for bounds, dash in zip(BOUNDS, style.DASHES):
            if (scene, bounds) not in runs:
                continue
            run = runs[scene, bounds]
            draw_sums(row[0], run, {part: f"energy_{part}" for part in PARTS}, dash, style.COLOURS)
            parts = {part: f"momentum_{part}_{axis}" for part in MOVERS}
            draw_sums(row[1], run, parts, dash, [style.COLOURS[PARTS.index(part)] for part in MOVERS])
            row[1].plot(run.column("step"), run.column(f"momentum_start_{axis}"), dash, color="black", linewidth=1,
                        label=f"momentum of {CARRIERS[scene]}" if dash == "-" else None)
            if bounds == BOUNDS[0]:
                begin, impulse = (run.column(f"momentum_{part}_{axis}")[0] for part in ("start", "guess"))
                row[1].plot(run.column("step"), [begin + impulse * k for k in range(run.step_count)], ":",
                            color="black", linewidth=0.8, label="with the first step's impulse in each")
            draw_shares(row[2], run, dash, style.COLOURS)
            draw_still(row[3], run, dash, style.COLOURS)
        note = note_on_shares({bounds: sum(runs[scene, bounds].column("motion_taken"))
                               for bounds in BOUNDS if (scene, bounds) in runs})
        if note:
            row[2].text(0.5, 0.5, note, transform=row[2].transAxes, ha="center", va="center", fontsize=8)
        row[1].legend(fontsize=7)
        row[0].set(ylabel=f"{scene}\nenergy, summed up [J]")
        row[1].set(ylabel=f"momentum along {axis}, summed up [kg m/s]")
        row[2].set(ylabel="share of motion [%]", ylim=(0, 100))
        row[3].set(ylabel="free vertices [%]", ylim=(0, None))
    for axes, title in zip(panels[0], ("What each part does to energy", "… and to momentum",
                                       "What truncation takes, and which way", "Vertices that stand still")):
        axes.set_title(title)
        axes.legend(fontsize=7)
    for axes in panels[-1]:
        axes.set_xlabel("step")
    about = next(iter(runs.values())).manifest
    commits = ", ".join(sorted({run.manifest["commit"][:10] + (" (dirty)" if run.manifest.get("dirty") else "")
                                for run in runs.values()}))
    figure.suptitle(f"Balls: solid lines; planes: dashed. {scale}, {about['backend']}, {about['device']}, commit "
                    f"{commits}", fontsize=8)
    return figure


def draw(runs, scale, out):
    from plots import style
    style.save(picture(runs, scale), out)


def main():
    options = options_of_figure(__doc__.splitlines()[0], commands.LEDGER_STEPS)
    try:
        for job in commands.ledgers(options.scale, options.backend):
            job.make(options.ogc, options.folder)
        runs = finished(options.folder)
        write(options.folder, runs)
        print(options.folder / "ledger.csv")
    except RunFailure as error:
        sys.exit(f"ledger: {error}")
    if not options.no_picture:
        draw(runs, options.scale, options.folder / "ledger.png")


if __name__ == "__main__":
    main()
