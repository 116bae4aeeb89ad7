"""Time a step over the number of vertices at one contact density (layers.py), with the exponent, on a device with both
bounds; over the threads of the CPU; and over 200 steps with twenty million contacts, whose last state is audited in
boxes: runs, table and picture. Not in the paper.

Steps are timed from FIRST on; before it lists grow and contacts settle. The exponent is the slope of a straight line
through the logarithms of the medians, by least squares, over all sizes and over the larger half of them.
"""

import argparse
import json
import math
import os
import statistics
import sys
from pathlib import Path

from paper_figures.workflow import commands
from paper_figures.workflow.audited import BOXES
from paper_figures.workflow.device_memory import taken
from paper_figures.workflow.evidence import run_at
from paper_figures.workflow.jobs import MEMORY, RunFailure

FIRST = 5
TITLE = "Time a step grows in proportion to the number of vertices"
BALL, PLANES = "ball", "planes"
ALT = ("Plots of the median time a step over the number of vertices of fifty layers, on a logarithmic scale in both "
       "directions, with the fitted powers; of the contacts a vertex; and of the time over the number of threads.")


def row_of(name, run, memory, found):
    """Returns the numbers of one run, measured over its timed steps; `found`: its audit in boxes."""
    m = run.manifest
    timed = [i for i, step in enumerate(run.column("step")) if step >= FIRST]
    names = ("wall", "discrete_detections", "vertex_facet_contacts", "edge_edge_contacts", "repeats")
    wall, detections, facets, edges, repeats = ([run.column(column)[i] for i in timed] for column in names)
    pairs = [a + b for a, b in zip(facets, edges)]
    free = sum(body["vertex_count"] for body in m["scene"]["bodies"] if not body["fixed"])
    over = kind_of(name)
    contacts = statistics.fmean(pairs)
    return {"over": over, "backend": m["backend"], "bounds": m["settings"]["bounds"]["value"], "vertices": free,
            "threads": int(name.rpartition("_")[2]) if over == "threads" else "", "steps": len(timed),
            "median [ms]": round(statistics.median(wall), 4), "mean [ms]": round(statistics.fmean(wall), 4),
            "worst [ms]": round(max(wall), 4),
            "contacts a vertex": round(contacts / free, 4), "contacts": round(contacts),
            "most contacts": round(max(pairs)),
            "detections a step": round(statistics.fmean(detections), 3),
            "repeated steps": sum(n > 0 for n in run.column("repeats")),
            "device memory [MiB]": memory,
            "time a contact [ns]": round(1e6 * statistics.median(wall) / contacts, 3),
            "device memory a contact [B]": round(memory * 2**20 / max(pairs)) if memory else "",
            "boxes": found.get("boxes", ""), "seed": found.get("seed", ""),
            "contacts in boxes": found.get("contacts", ""), "pairs tested in boxes": found.get("pairs_tested", ""),
            "wrong in boxes": sum(found[name] for name in ("intersections", "missing", "extra")) if found else "",
            "audit": {True: "no intersection", False: "FAILED"}.get(m.get("guarantee_kept"), "not audited"),
            "final_hash": m["final_hash"],
            "device": m["device"], "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else "")}


def kind_of(name):
    """Returns over what the run of this name is one of several."""
    first = name.partition("_")[0]
    return first if first in ("threads", "contacts") else "vertices"


def boxes_of(folder):
    """Returns the findings of an audit in boxes; nothing without one."""
    path = folder / BOXES
    return json.loads(path.read_text()) if path.is_file() else {}


def bounds_of(row):
    """Returns the bounds of a row; tables that were kept before runs had both have balls alone."""
    return row.get("bounds", BALL)


def lines_of(rows):
    """Returns (backend, bounds, rows over the number of vertices) of each line."""
    over = [row for row in rows if row["over"] == "vertices"]
    kinds = dict.fromkeys((row["backend"], bounds_of(row)) for row in over)
    return [(*kind, [row for row in over if (row["backend"], bounds_of(row)) == kind]) for kind in kinds]


def table(folder):
    """Returns the rows of the finished runs, ordered by size and number of threads."""
    rows = []
    for path in sorted(folder.glob("*/run.json"), key=lambda path: (path.parent.name.rpartition("_")[0],
                                                                    int(path.parent.name.rpartition("_")[2]))):
        run = run_at(path.parent)
        if run and run.manifest["status"] == "finished":
            memory = taken(folder / f"{path.parent.name}{MEMORY}") or ""  # 0: sampled before it used any
            rows.append(row_of(path.parent.name, run, memory, boxes_of(path.parent)))
    return rows


def exponent(rows):
    """Returns (p, factor) of median = factor · vertices^p, by least squares on logarithms."""
    x, y = ([math.log(row[name]) for row in rows] for name in ("vertices", "median [ms]"))
    slope, intercept = statistics.linear_regression(x, y)
    return slope, math.exp(intercept)


def in_words(rows):
    """Returns a line of text for each backend and one for the threads."""
    lines = []
    for backend, bounds, line in lines_of(rows):
        if len(line) > 1:
            density = [row["contacts a vertex"] for row in line]
            upper = line[len(line) // 2 - 1:] if len(line) > 3 else line
            lines.append(f"{backend}{', planes' if bounds == PLANES else ''}: "
                         f"time ∝ vertices^{exponent(line)[0]:.3f} from {line[0]['vertices']:,} to "
                         f"{line[-1]['vertices']:,}, "
                         f"^{exponent(upper)[0]:.3f} from {upper[0]['vertices']:,} on; {min(density):.3g} to "
                         f"{max(density):.3g} contacts a vertex")
    for row in (row for row in rows if row["over"] == "contacts"):
        lines.append(f"{row['contacts']:,} contacts: {row['median [ms]']:.4g} ms a step")
    alone = [row for row in rows if row["over"] == "threads"]
    if len(alone) > 1:
        first, last = alone[0], alone[-1]
        same = "with the same bits" if len({row["final_hash"] for row in alone}) == 1 else "NOT with the same bits"
        gain = first["median [ms]"] / last["median [ms]"]
        lines.append(f"{last['threads']} threads are {gain:.3g} times as fast as {first['threads']} "
                     f"({last['vertices']:,} vertices), {same}")
    return lines


def draw(rows, out):
    from plots import style  # imported here, so that runs and table need no matplotlib
    style.use()
    alone = [row for row in rows if row["over"] == "threads"]
    shares = (0.42, 0.27, 0.31) if alone else (0.6, 0.4)
    lines = in_words(rows)
    figure, (panels,) = style.page([(3.2, [(share, "plot") for share in shares])], TITLE, "; ".join(lines))
    time, density = panels[:2]
    for backend, bounds, line in lines_of(rows):
        colour, mark = {"cuda": style.OURS, "cpu": style.BASELINE}[backend], "s" if bounds == PLANES else "o"
        if line:
            x = [row["vertices"] for row in line]
            time.plot(x, [row["median [ms]"] for row in line], mark, color=colour,
                      label=line[-1]["device"] + (", planes" if bounds == PLANES else ""))
            density.plot(x, [row["contacts a vertex"] for row in line], mark + "-", color=colour)
        if len(line) > 1:
            slope, factor = exponent(line)
            time.plot(x, [factor * n**slope for n in x], ":" if bounds == PLANES else "--", color=colour, linewidth=1,
                      label=f"∝ vertices^{slope:.3f}")
    time.set(xscale="log", yscale="log", xlabel="free vertices", ylabel="median time a step [ms]",
             title="Time a step at one contact density")
    time.legend(loc="upper left")
    density.set(xscale="log", xlabel="free vertices", ylabel="contacts a vertex", title="The density, measured")
    density.set_ylim(0, 1.1 * density.get_ylim()[1])
    if alone:
        draw_threads(panels[2], alone, style)
    style.save(figure, out, TITLE, f"{ALT} {'; '.join(lines)}.", ", ".join(sorted({row["commit"] for row in rows})))


def draw_threads(axes, rows, style):
    numbers, times = [row["threads"] for row in rows], [row["median [ms]"] for row in rows]
    axes.plot(numbers, times, "o-", color=style.BASELINE, label="measured")
    axes.plot(numbers, [times[0] * numbers[0] / n for n in numbers], ":", color=style.PAPER,
              label="shared out\nperfectly")
    axes.set(xscale="log", yscale="log", xlabel="threads", ylabel="median time a step [ms]",
             title=f"CPU, {rows[0]['vertices']:,} vertices", xticks=numbers, xticklabels=numbers, yticks=times,
             yticklabels=[f"{t:.3g}" for t in times])
    axes.minorticks_off()
    style.label_ends(axes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the runs are, or go, and table and picture")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scale", default="small", choices=commands.SIDES)
    parser.add_argument("--backend", action="append", choices=["cpu", "cuda"], help="repeatable (default: cpu)")
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, and make none")
    options = parser.parse_args()
    try:
        if not options.made:
            over_sizes = [job for backend in dict.fromkeys(options.backend or ["cpu"])
                          for job in commands.sizes(options.scale, backend)]
            contacts = commands.many_contacts(options.scale, (options.backend or ["cpu"])[-1])
            for job in [*over_sizes, *contacts, *commands.threads(options.scale, os.cpu_count() or 1)]:
                job.make(options.ogc, options.folder)
        rows = table(options.folder)
        if not rows:
            raise RunFailure(f"{options.folder} holds no finished run; leave --made out, and they are made")
        from paper_figures.workflow.runs import write_table
        write_table(options.folder / "growth.csv", rows)
        draw(rows, options.folder / "growth.png")
        print("\n".join(in_words(rows)))
    except RunFailure as error:
        sys.exit(f"growth: {error}")


if __name__ == "__main__":
    main()
