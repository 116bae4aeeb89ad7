"""Table 1, rows of cloth, of the mat and of yarn: ours beside the paper's, as CSV, Markdown and HTML, from the runs
that the runner makes (FOLDER/ROW/whole… and FOLDER/ROW/cpu_SHARE).

Average and maximum are times of whole steps from steps.csv. A step that was repeated because a list grew counts in the
average but not in the maximum; the number of such steps is listed. The CPU's average is that of its windows with equal
weights. With several whole runs each number is their median. Python's standard library suffices.
"""

import argparse
import csv
import html
import json
import statistics
import sys
from pathlib import Path

from paper_figures.workflow import commands
from paper_figures.workflow.device_memory import taken
from paper_figures.workflow.evidence import CLAIMS, NOT_RUN, EvidenceError, columns_of, run_at
from paper_figures.workflow.jobs import MEMORY

ROWS = commands.ROWS
TITLE = "Table 1, rows of cloth, of the mat and of yarn, with the paper's bounds and with planes"
WINDOWS = 5  # on the CPU, for each row
STALE, FRESH = "residual, last detection's contacts [1]", "residual, contacts of the end [1]"


def runs_below(folder, pattern):
    """Returns the runs with at least one step; ignores other content of the folder."""
    found = (run_at(path) for path in sorted(Path(folder).glob(pattern)))
    return [run for run in found if run and run.column("step")]


def times(run):
    """Returns (average, maximum, repeated steps) of a run's steps [ms]."""
    wall, repeats = run.column("wall"), run.column("repeats")
    clean = [ms for ms, n in zip(wall, repeats) if n == 0] or wall
    return statistics.fmean(wall), max(clean), sum(1 for n in repeats if n > 0)


def contacts(run):
    """Returns the number of contacts, of both kinds together, in each step."""
    return [a + b for a, b in zip(run.column("vertex_facet_contacts"), run.column("edge_edge_contacts"))]


def residuals(folder):
    """Returns by column the residual that a step leaves at each measured state, as text "first state: residual; …"."""
    runs = sorted(runs_below(folder, "residual_*"), key=lambda run: run.column("step")[0])
    found = {STALE: [], FRESH: []}
    for run in runs:
        first = int(run.column("step")[0]) - 1
        rows = run.rows.with_name(run.rows.name.replace("steps", "iterations"))
        if rows.is_file():
            found[STALE].append((first, columns_of(rows, rows.stat().st_mtime_ns)["residual"][-1]))
        found[FRESH].append((first, run.column("residual")[-1]))
    return {name: "; ".join(f"{first}: {value:.3g}" for first, value in values) for name, values in found.items()}


def paper(scene, backend, quantity):
    """Returns (number, machine) of the claim, or (None, "") if the paper gives none."""
    path = CLAIMS / f"{scene}.json"
    for claim in json.loads(path.read_text())["claims"] if path.is_file() else ():
        if claim["id"] == f"{scene}.{backend}_{quantity}":
            return claim["value"], claim["machine"]
    return None, ""


def origin(run):
    m = run.manifest
    return {"device": m["device"], "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else ""),
            "ended": m["ended"], "scale": m.get("scale", ""), "status": m["status"]}


def beside(run, average, maximum):
    """Returns our numbers, the paper's numbers and the quotients; below the paper's scale only ours."""
    row = {"average [ms]": average, "maximum [ms]": maximum}
    m = run.manifest
    for name, ours in (("average", average), ("maximum", maximum)):
        value, machine = paper(m["scene"]["name"], m["backend"], name) if m.get("scale") == "paper" else (None, "")
        row |= {f"paper {name} [ms]": value if value is not None else "",
                f"{name} / paper's": ours / value if value else "", "paper's machine": machine}
    return row


def penetration(run):
    """Returns the share of vertices that a step leaves cut, the lag of prescribed vertices and, for volumes, the number
    of vertices inside as the solver counts them."""
    columns = {"at bound, most [1]": "share_cut", "largest lag [m]": "largest_lag",
               "vertices inside, most": "vertices_inside", "deepest [m]": "deepest"}
    return {name: max(run.column(column)) if run and column in run.columns else "" for name, column in columns.items()}


def sizes(run):
    scene = run.manifest["scene"]
    return {"vertices": scene["vertices"], "triangles": scene["triangles"],
            "membrane": " and ".join(sorted(run.membranes)),
            "iterations": run.manifest["settings"]["iterations"]["value"]}


def device_row(scene, runs, memory="", left=None):
    """Returns the row of the whole runs on the device, which must have equal lengths. `left`: result of `residuals`."""
    if len({len(run.column("step")) for run in runs}) > 1:
        raise EvidenceError(f"{scene}: whole runs of different lengths ({', '.join(run.source for run in runs)}): "
                            "finish them, or remove the shorter ones")
    averages, maxima, repeats = zip(*(times(run) for run in runs))
    run, found = runs[-1], contacts(runs[-1])
    steps, wanted = len(run.column("step")), run.manifest["settings"]["steps"]["value"]
    audit = {True: "no intersection", False: "FAILED", None: "not audited"}[run.guarantee_kept]
    return {"scene": scene, "backend": run.manifest["backend"], **origin(run), **sizes(run),
            **beside(run, statistics.median(averages), statistics.median(maxima)), "steps": steps, "of steps": wanted,
            "runs": len(runs), "windows [ms]": "",
            "repeated steps": max(repeats), "contacts, average": statistics.fmean(found),
            "contacts, maximum": max(found), **penetration(run),
            "audited states": f"{run.audited_states}, {audit}", "audit [s]": run.afterwards.get("seconds", ""),
            **(left or {STALE: "", FRESH: ""}), "device memory [MiB]": memory}


def cpu_row(scene, windows, wanted):
    """Returns the row of the windows on the CPU."""
    windows = sorted(windows, key=lambda run: run.column("step")[0])
    if len({(run.manifest["commit"], run.manifest["device"]) for run in windows}) > 1:
        raise EvidenceError(f"{scene}: CPU windows of different programs or machines: remove the old ones and make "
                            "them again")
    averages, maxima, repeats = zip(*(times(run) for run in windows))
    found = [n for run in windows for n in contacts(run)]
    each = "; ".join([f"{int(run.column('step')[0]) - 1}: {average:.4g}" for run, average in zip(windows, averages)]
                     + ([f"{WINDOWS - len(windows)} of {WINDOWS} not run"] if len(windows) < WINDOWS else []))
    return {"scene": scene, "backend": "cpu", **origin(windows[-1]), **sizes(windows[-1]),
            **beside(windows[-1], statistics.fmean(averages), max(maxima)),
            "steps": sum(len(run.column("step")) for run in windows), "of steps": wanted, "runs": len(windows),
            "windows [ms]": each,
            "repeated steps": sum(repeats), "contacts, average": statistics.fmean(found),
            "contacts, maximum": max(found), **dict.fromkeys(penetration(None), ""),
            "audited states": "windows: not audited", "audit [s]": "", STALE: "", FRESH: "",
            "device memory [MiB]": ""}


def rows_of(folder):
    rows = []
    for scene in ROWS:
        whole, windows = runs_below(Path(folder) / scene, "whole*"), runs_below(Path(folder) / scene, "cpu_*")
        if whole:
            memory = taken(Path(folder) / scene / f"whole{MEMORY}")
            rows.append(device_row(scene, whole, memory, residuals(Path(folder) / scene)))
        if windows:
            rows.append(cpu_row(scene, windows, whole[-1].manifest["settings"]["steps"]["value"] if whole else ""))
        if windows and not whole:
            rows.append(dict.fromkeys(rows[-1], "") | {"scene": scene, "scale": rows[-1]["scale"], "status": NOT_RUN,
                                                       "commit": "-"})
    if not rows:
        raise EvidenceError(f"{folder} holds no run of Table 1: make them with experiments/reproduce table1, or with "
                            "paper_figures.workflow.runner")
    return rows


def text(value):
    if isinstance(value, float):
        return f"{value:.4g}" if abs(value) < 10000 else f"{value:,.0f}"
    return f"{value:,}" if isinstance(value, int) else str(value)


SHOWN = ("scene", "backend", "vertices", "membrane", "iterations",
         "average [ms]", "paper average [ms]", "average / paper's", "maximum [ms]", "paper maximum [ms]",
         "maximum / paper's", "contacts, average", "contacts, maximum", "steps", "of steps", "repeated steps",
         "windows [ms]", "audited states",
         "audit [s]", STALE, FRESH, "device memory [MiB]", "device",
         "paper's machine", "status", "commit")

NOTE = ("Ours and the paper's times are of different machines. A step that was repeated because a list grew counts in "
        "the average, not in the maximum. "
        "audit [s]: after the run, which it is no part of. Residuals (Eq. 29, by the reference in double): what one "
        "step "
        "leaves of the force after its initial guess, from the run's states (first state: residual). "
        "CPU: windows of steps from states of the device's run, average of the windows (first state: average [ms]), "
        "maximum over all. fifty_layers and "
        "fifty_layers_1m stand beside the same printed times, as Table 1 and Fig. 10 print one pair for two "
        "resolutions.")


def markdown(rows):
    lines = [f"# {TITLE}", "", "| " + " | ".join(SHOWN) + " |", "|" + "---|" * len(SHOWN)]
    lines += ["| " + " | ".join(text(row[name]) for name in SHOWN) + " |" for row in rows]
    return "\n".join([*lines, "", NOTE, ""])


def page(rows):
    head = "".join(f"<th>{html.escape(name)}</th>" for name in SHOWN)
    body = "\n".join("<tr>" + "".join(f"<td>{html.escape(text(row[name]))}</td>" for name in SHOWN) + "</tr>"
                     for row in rows)
    style = ("body{font:14px sans-serif;margin:2em}table{border-collapse:collapse}"
             "td,th{border:1px solid #bbb;padding:.3em .6em;text-align:right}")
    title = TITLE
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
            f"<style>{style}</style></head>\n"
            f"<body><h1>{title}</h1>\n<table><thead><tr>{head}</tr></thead>\n"
            f"<tbody>\n{body}\n</tbody></table>\n<p>{html.escape(NOTE)}</p></body></html>\n")


def write(rows, out):
    """Writes table1_SCALE.csv, .md and .html; returns their paths."""
    scales = {row["scale"] for row in rows}
    if len(scales) > 1:
        raise EvidenceError(f"runs of different scales ({', '.join(sorted(scales))}) can't stand in one table: remove "
                            "one of them")
    stem = Path(out) / f"table1_{scales.pop()}"
    stem.parent.mkdir(parents=True, exist_ok=True)
    with stem.with_suffix(".csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    stem.with_suffix(".md").write_text(markdown(rows))
    stem.with_suffix(".html").write_text(page(rows))
    return [stem.with_suffix(suffix) for suffix in (".csv", ".md", ".html")]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", help="folder of these runs, table1-SCALE-BACKEND")
    parser.add_argument("--out", help="where the table goes, for accepted results paper_figures/results/MACHINE "
                                      "(default: the folder of the runs)")
    options = parser.parse_args()
    try:
        print("\n".join(str(path) for path in write(rows_of(options.runs), options.out or options.runs)))
    except EvidenceError as error:
        sys.exit(f"table1: {error}")
