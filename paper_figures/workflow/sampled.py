"""Draws accepted files by a seed, with the commands that make them again, and compares what these commands made.

Usage: python3 -m paper_figures.workflow.sampled [--seed N] [--rows 10] [--machine M] [--again FOLDER]. Without --again
it prints the files and their commands. These make runs; `accept` and `taken` with --results FOLDER turn the runs into
files of the same names, and --again FOLDER compares these with the accepted ones.

The same program on the same kind of machine has the same bits, but Newton's method and IPC may differ by roundings from
host to host. So of a run the hash of its last state and the settings must be equal, of a table every cell but times and
what depends on them, of an audit its counts. A picture shows times too: it must have the same size and title. Standard
seeds: 58 frozen, and that of the day, which is printed.
"""

import argparse
import csv
import datetime
import gzip
import io
import json
import random
import re
import sys
from pathlib import Path

from paper_figures.workflow import captions
from paper_figures.workflow.contents import PROVENANCE, TRIED, rows_of
from paper_figures.workflow.evidence import RESULTS
from paper_figures.workflow.jobs import AUDIT
from paper_figures.workflow.kept import MOVIES, PICTURES

# Titles of columns that are times, follow from times, or say who made the row.
MADE_BY = re.compile(r"\[(ms|s|µs|ns|MiB)\]|_(ms|s|ns_a_case)$|paper's|\b(time|seconds|speed|detection_share_of_time|"
                     r"stages|measuring|commit|device|machine|command|compiler|ended)\b")
TIMES = ("ms", "s")  # units of rows that are times, in tables with a row for each metric
OF_A_RUN = ("final_hash", "scale", "solver", "backend", "jitter", "jitter_seed", "settings")
OF_AN_AUDIT = ("states", "intersections", "clean", "complete")


def drawn(seed, count, machines, results=RESULTS):
    """Returns (machine, row of its provenance.csv) of `count` files, in an order that only the seed decides."""
    there = [(machine, row) for machine in machines for row in rows_of(results / machine / PROVENANCE)]
    return random.Random(seed).sample(there, min(count, len(there)))


def text_of(path):
    data = path.read_bytes()
    return (gzip.decompress(data) if path.suffix == ".gz" else data).decode()


def of_tables(kept, again):
    """Returns how two tables differ, apart from times; empty if they do not."""
    before, now = (list(csv.reader(io.StringIO(text_of(path)))) for path in (kept, again))
    if before[0] != now[0]:
        return f"columns {', '.join(sorted(set(before[0]) ^ set(now[0])))} are in one of them"
    if len(before) != len(now):
        return f"{len(now) - 1} rows, {len(before) - 1} accepted"
    compared = [place for place, title in enumerate(before[0]) if not MADE_BY.search(title)]
    unit = before[0].index("unit") if "unit" in before[0] else None
    for number, (old, new) in enumerate(zip(before[1:], now[1:]), 1):
        for place in compared if unit is None or old[unit] not in TIMES else ():
            if old[place] != new[place]:
                return f"row {number}, {before[0][place]}: {new[place]}, accepted {old[place]}"
    return "" if compared else "no column is compared: all are times"


def of_documents(kept, again, keys):
    before, now = (json.loads(text_of(path)) for path in (kept, again))
    for key in keys:
        if before.get(key) != now.get(key):
            return f"{key}: {short(now.get(key))}, accepted {short(before.get(key))}"
    return ""


def short(value):
    text = json.dumps(value)
    return text if len(text) < 60 else f"{text[:56]} …"


def of_pictures(kept, again):
    from PIL import Image

    sizes = [Image.open(path).size for path in (kept, again)]
    if sizes[0] != sizes[1]:
        return f"{sizes[1][0]} × {sizes[1][1]} pixels, accepted {sizes[0][0]} × {sizes[0][1]}"
    titles = [captions.kept(path).get("title") for path in (kept, again)]
    return "" if titles[0] == titles[1] else f"titled “{titles[1]}”, accepted “{titles[0]}”"


def difference(kept, again):
    """Returns how a file that was made again differs from the accepted one, in words; empty if it does not."""
    if not again.is_file():
        return "not made again"
    if kept.read_bytes() == again.read_bytes() or kept.suffix in MOVIES:
        return ""
    if kept.suffix in PICTURES:
        return of_pictures(kept, again)
    if kept.name.endswith("run.json"):
        return of_documents(kept, again, OF_A_RUN)
    if kept.name.endswith(AUDIT):
        return of_documents(kept, again, OF_AN_AUDIT)
    if ".csv" in kept.suffixes:
        return of_tables(kept, again)
    return "" if text_of(kept) == text_of(again) else "its text differs"


def compared(chosen, again, results=RESULTS):
    """Returns (line, met) for each drawn file."""
    for machine, row in chosen:
        wrong = difference(results / machine / row["file"], again / machine / row["file"])
        yield f"{machine}/{row['file']}: {wrong or 'made again'}", not wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=int(datetime.date.today().strftime("%Y%m%d")),
                        help="default: the day's")
    parser.add_argument("--rows", type=int, default=10, help="how many (default: 10)")
    parser.add_argument("--machine", action="append", help="a folder of results (default: all)")
    parser.add_argument("--again", type=Path, metavar="FOLDER", help="results that were made again")
    options = parser.parse_args()
    machines = options.machine or sorted({path.parent.name for path in RESULTS.glob(f"*/{PROVENANCE}")} - {TRIED})
    for machine in machines:
        if not (RESULTS / machine / PROVENANCE).is_file():
            parser.error(f"no results of a machine '{machine}'")
    chosen = drawn(options.seed, options.rows, machines)
    print(f"seed {options.seed}")
    if not options.again:
        print("\n".join(f"{machine}/{row['file']}: {row['redo']}" for machine, row in chosen))
        return
    found = list(compared(chosen, options.again))
    print("\n".join(line for line, _ in found))
    print(f"{sum(met for _, met in found)} of {len(found)} made again")
    sys.exit(0 if all(met for _, met in found) else 1)


if __name__ == "__main__":
    main()
