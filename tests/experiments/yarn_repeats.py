#!/usr/bin/env python3
"""Runs yarn scenes at scale smoke from jittered starts. Every run must end normally and keep its bounds, and no two
threads may meet in any step (compare/meetings.md). Usage: yarn_repeats.py OGC [REPEATS] [--out FILE]. By default there
are 20 repeats of 17 s on one core; the test makes two. FILE gets a row for each run. Python's standard library
suffices.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = ("yarn_stretch", "yarn_twist")
JITTER = "1e-5"  # a three-hundredth of the contact radius


def made(ogc, scene, seed, folder):
    """Returns (row, description of what is wrong) of a run."""
    words = [ogc, "run", scene, "--scale", "smoke", "--audit", "every", "--jitter", JITTER, "--seed", str(seed),
             "--json", "--out", str(folder)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return {"scene": scene, "seed": seed, "status": f"exit status {done.returncode}"}, [done.stderr.strip()]
    run, manifest = json.loads(done.stdout), json.loads((folder / "run.json").read_text())
    row = {"scene": scene, "seed": seed, "status": run["status"], "steps": run["last_step"] - run["first_step"],
           "guarantee kept": "yes" if run["guarantee_kept"] is True else "no",
           "audited states": run["audit"]["states"], "meetings [1]": run["audit"].get("meetings"),
           "final_hash": run["final_hash"], "device": run["device"],
           "commit": manifest["commit"][:10] + (" (dirty)" if manifest["dirty"] else "")}
    wrong = {"status": "finished", "guarantee kept": "yes", "meetings [1]": 0}
    return row, [f"{name}: {row[name]}" for name, right in wrong.items() if row[name] != right]


def repeats_of(ogc, scene, repeats, folder):
    """Returns (rows, descriptions of faults) of the scene's runs."""
    rows, faults = [], []
    for seed in range(1, repeats + 1):
        row, wrong = made(ogc, scene, seed, folder / str(seed))
        rows.append(row)
        faults += [f"{scene}, seed {seed}: {words}" for words in wrong]
    ends = {row["final_hash"] for row in rows if "final_hash" in row}
    if len(ends) != repeats:
        faults.append(f"{scene}: {len(ends)} different ends of {repeats} runs")
    return rows, faults


def write(path, rows):
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, list(max(rows, key=len)), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ogc")
    parser.add_argument("repeats", nargs="?", type=int, default=20)
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    rows, faults = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for scene in SCENES:
            found, wrong = repeats_of(options.ogc, scene, options.repeats, Path(scratch) / scene)
            rows, faults = rows + found, faults + wrong
    if options.out:
        write(options.out, rows)
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
