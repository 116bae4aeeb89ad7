#!/usr/bin/env python3
"""Yarn scenes at smoke from jittered starts: every run comes to its end, keeps its bounds, and no thread meets a thread
on any step's way (compare/meetings.md). Usage: yarn_repeats.py OGC [REPEATS], 20 by default, which takes minutes; the
test makes two. Python's own library is enough.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = ("yarn_stretch", "yarn_twist")
JITTER = "1e-5"  # a three-hundredth of the contact radius


def faults_of(ogc, scene, repeats, folder):
    """What is wrong with the scene's runs, in words."""
    faults, ends = [], set()
    for seed in range(1, repeats + 1):
        words = [ogc, "run", scene, "--scale", "smoke", "--audit", "every", "--jitter", JITTER, "--seed", str(seed),
                 "--json", "--out", str(folder / str(seed))]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        name = f"{scene}, seed {seed}"
        if done.returncode != 0:
            faults.append(f"{name}: exit status {done.returncode}\n{done.stderr}")
            continue
        run = json.loads(done.stdout)
        ends.add(run["final_hash"])
        if run["status"] != "finished" or run["guarantee_kept"] is not True:
            faults.append(f"{name}: {run['status']}, guarantee kept: {run['guarantee_kept']}")
        if run["audit"].get("meetings") != 0:
            faults.append(f"{name}: {run['audit'].get('meetings')} meetings")
    if len(ends) != repeats:
        faults.append(f"{scene}: {len(ends)} different ends of {repeats} runs")
    return faults


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    repeats = int(sys.argv[2]) if len(sys.argv) == 3 else 20
    with tempfile.TemporaryDirectory() as scratch:
        faults = [fault for scene in SCENES for fault in faults_of(sys.argv[1], scene, repeats, Path(scratch) / scene)]
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
