"""Tables of the site, as heads and rows of texts, from accepted files: Table 1, the judge's counts, how far CPU and GPU
agree, and other people's kernels and solvers."""

import csv
from dataclasses import dataclass

from paper_figures.figures import table1_picture
from paper_figures.workflow import ratios
from paper_figures.workflow.evidence import RESULTS

GPU, CORES = RESULTS / "h200", RESULTS / "two_cores"
PEERS = {"ipctk": "IPC Toolkit", "newton": "Newton Physics", "ogc": "this testbed"}


@dataclass(frozen=True)
class Table:
    """Holds a table of texts. `numbers`: the first column of numbers; `shades`: for each row the class of each cell, or
    empty; `files` are those that the rows come from."""

    title: str
    head: tuple
    rows: tuple
    files: tuple
    numbers: int = 1
    shades: tuple = ()
    groups: tuple = ()


def rows_of(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def count(text):
    return f"{int(text):,}"


def paper_table():
    """Returns Table 1 as the paper prints it, ours beside it."""
    rows, shades = [], []
    names = {"white": "", table1_picture.FASTER: "faster", "#F1F2F4": "printed",
             **{colour: f"slower-{number}" for number, colour in enumerate(table1_picture.SLOWER, 1)}}
    for texts, colours in table1_picture.table():
        rows.append(tuple(texts))
        shades.append(("",) * (len(texts) - len(colours)) + tuple(names.get(colour, "") for colour in colours))
    first = table1_picture.GROUPS[0][0]
    groups = (("", first), *((words, wide) for _, wide, words in table1_picture.GROUPS))
    return Table("Time a step, mean / longest [ms]", table1_picture.COLUMNS, tuple(rows),
                 (GPU / "whole_runs.csv", GPU / "cpu_windows_paper.csv"), 1, tuple(shades), groups)


def just_made(path):
    """Returns Table 1 as the runs that were just made give it."""
    shown = ("vertices", "steps", "average [ms]", "maximum [ms]", "contacts, average", "audited states")
    rows = [(row["scene"], row["backend"], row["device"], *(rounded(row[name]) for name in shown))
            for row in rows_of(path)]
    return Table(f"Table 1 at scale {rows_of(path)[0]['scale']}, just made",
                 ("scene", "on", "device", *shown), tuple(rows), (path,), 3)


def rounded(text):
    """Returns a number in three digits, and any other text as it is."""
    try:
        return f"{float(text):,.0f}" if float(text) >= 1000 else f"{float(text):.3g}"
    except ValueError:
        return text or "–"


def judged(path, where):
    """Returns the judge's counts in a table, a row a stage. `where`: what computed the answers, in words."""
    stages = {}
    for row in rows_of(path):
        stages.setdefault(row["stage"], []).append(row)
    rows = []
    for stage, found in sorted(stages.items()):
        largest = {}
        for row in found:
            for part in filter(None, row["largest errors over tolerances"].split("; ")):
                name, _, ratio = part.rpartition(" ")
                error, _, tolerance = ratio.partition("/")
                largest[name] = max(largest.get(name, 0.0), float(error) / float(tolerance or "1"))
        worst = max(largest, key=largest.get, default="")
        rows.append((stage, count(sum(int(row["cases"]) for row in found)),
                     count(sum(int(row["mismatches"]) for row in found)), str(len(found)),
                     f"{largest[worst]:.0%} ({worst})" if worst else "–",
                     ", ".join(dict.fromkeys(row["device"].partition(",")[0] for row in found))))
    return Table(f"Kernels on {where} against exact answers", ("stage", "cases", "mismatches", "runs",
                 "largest error, of what is allowed", "device"), tuple(rows), (path,))


def agreement():
    """Returns how far the states of CPU and GPU lie apart in a run, with the default and with the strict build."""
    found = {name: {row["step [1]"]: row for row in rows_of(GPU / f"agreement_{name}.csv")}
             for name in ("default", "strict")}
    rows = [(step, *(f"{float(found[name][step]['largest [m]']):.3g}" if step in found[name] else "–"
                     for name in found)) for step in found["default"]]
    return Table("Largest distance between a vertex on the CPU and on the GPU [m]",
                 ("step", "default build", "strict build: no contraction"), tuple(rows),
                 tuple(GPU / f"agreement_{name}.csv" for name in found), 0)


def peers_kernels():
    """Returns other people's kernels before the judge."""
    files = (CORES / "peers_ipctk.csv", CORES / "peers_newton.csv")
    rows = [(PEERS[row["peer"]], row["stage"], row["definition"], count(row["cases"]),
             f"{float(row['asked_share']):.0%}", count(row["mismatches"]))
            for path in files for row in rows_of(path)]
    versions = ", ".join(dict.fromkeys(row["version"] for path in files for row in rows_of(path)))
    return Table(f"Their kernels before our judge ({versions})",
                 ("program", "stage", "whose definition", "cases", "asked of it", "mismatches"), tuple(rows), files, 3)


def peers_sets():
    files = (CORES / "peers_sets_ipctk.csv", CORES / "peers_sets_newton.csv")
    rows = [(PEERS[row["peer"]], row["set"], *(count(row[name]) for name in
                                               ("states", "pairs", "near_pairs", "missing", "extra")))
            for path in files for row in rows_of(path)]
    return Table("Their lists of near pairs, by exact distances",
                 ("program", "pairs of", "states", "pairs", "near pairs", "missing", "too many"), tuple(rows), files, 2)


def peers_scenes():
    """Returns scenes in Newton Physics' solver and in ours, audited alike; the last column says by the rule of ratios
    whether their times are comparable with ours of the same scene."""
    files = (GPU / "peers_newton_gpu.csv", CORES / "peers_trajectories.csv")
    rows = [(row["scene"], row["scale"], row["device"], f"{PEERS[row['program']]}, {row['variant']}",
             f"{row['steps_done']} of {row['steps']}", rounded(row["mean_ms"]), rounded(row["worst_ms"]),
             f"{row['states_intersecting']} of {row['states']}", f"{row['motions_meeting']} of {row['motions']}",
             comparable(row, found))
            for found in map(rows_of, files) for row in found]
    return Table("The same scene in Newton Physics and here",
                 ("scene", "scale", "device", "program", "steps", "mean [ms]", "longest [ms]",
                  "states that intersect", "motions that meet", "times comparable"), tuple(rows), files, 4)


def comparable(row, rows):
    """Returns "yes", or the reason why not; "–" for our own rows."""
    if row["program"] == ratios.OURS:
        return "–"
    ours = [other for other in rows if other["program"] == ratios.OURS
            and (other["scene"], other["scale"]) == (row["scene"], row["scale"])]
    said = {ratios.obstacle((ratios.side_of(other), ratios.side_of(row)), row["program"]) for other in ours}
    return " ".join(sorted(said - {""})) or "yes"
