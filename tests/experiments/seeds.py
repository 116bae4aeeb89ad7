"""Tests experiments/seeds: other days have other cases; a failure is printed and written as a batch file that fails
again; a success leaves nothing.

Usage: seeds.py SOURCE_DIR OGC
"""

import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPT, OGC = Path(sys.argv[1]) / "experiments/seeds", sys.argv[2]

# Replaces ogc: the second seed has a mismatch, the third gives no result.
STUB = """#!/usr/bin/env python3
import json, sys
seed = int(sys.argv[sys.argv.index("--seed") + 1])
if seed % 100 == 2:
    sys.exit("out of memory")
found = {"problem": f"stage=truncate gen=bits seed={seed} index=7", "message": "position: off"}
listed = [found] if seed % 100 == 1 else []
verdict = "mismatch" if listed else "passed"
stage = {"stage": "truncate", "verdict": verdict, "mismatches": len(listed), "cases": 10, "listed": listed}
print(json.dumps({"stages": [stage]}))
sys.exit(1 if listed else 0)
"""


def seeds(program, out, *arguments):
    return subprocess.run([SCRIPT, program, "--out", out, *arguments], capture_output=True, text=True, check=False)


def test_passes(folder):
    done = seeds(OGC, folder / "passed", "truncate", "bound", "--seeds", "2", "--cases", "300", "--day", "20200229")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "seeds 2020022900 to 2020022901" in done.stdout and "all 2 seeds passed" in done.stdout
    assert not (folder / "passed").exists()
    other = seeds(OGC, folder / "passed", "truncate", "--seeds", "1", "--cases", "300", "--day", "20200301")
    assert "seed 2020030100: " in other.stdout


def test_failures(folder):
    stub = folder / "stub"
    stub.write_text(STUB)
    stub.chmod(0o755)
    out = folder / "failures"
    done = seeds(stub, out, "--seeds", "4", "--day", "20200229")
    assert done.returncode == 1, done.stdout
    problem = "stage=truncate gen=bits seed=2020022901 index=7"
    assert "2 of 4 seeds failed" in done.stdout and problem in done.stdout and "no result" in done.stdout, done.stdout
    assert (out / "problems.txt").read_text() == f"# position: off\n{problem}\n"
    assert "out of memory" in (out / "s2020022902/said.txt").read_text() and not (out / "s2020022903").exists()
    # ogc accepts the batch file; the current kernels pass it.
    again = subprocess.run([OGC, "compare", "--batch", out / "problems.txt"], capture_output=True, text=True,
                           check=False)
    assert again.returncode == 0, again.stderr


with tempfile.TemporaryDirectory() as name:
    test_passes(Path(name))
    test_failures(Path(name))
    for wrong, said in ((["nowhere"], "nowhere"), ([OGC, "no_stage", "--out", f"{name}/out"], "no_stage"),
                        ([OGC, "--seeds", "0"], "--seeds")):
        refused = subprocess.run([SCRIPT, *wrong], capture_output=True, text=True, check=False)
        assert refused.returncode == 2 and said in refused.stderr, refused.stderr
