"""experiments/judge_counts: its sums are those of its chunks, a chunk that fails is kept and fails the command, one without a result is named.

Usage: judge_counts.py SOURCE_DIR OGC
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPT, OGC = Path(sys.argv[1]) / "experiments/judge_counts", sys.argv[2]

# Stands for ogc: one mismatch in truncate, no answer in spring.
STUB = """#!/usr/bin/env python3
import json, sys
from pathlib import Path
stage, folder = sys.argv[2], Path(sys.argv[sys.argv.index("--report") + 1])
if stage == "spring":
    sys.exit("out of memory")
(folder / "failures").mkdir(parents=True)
(folder / "failures/problems.txt").write_text("stage=truncate")
keys = ("cases", "questions", "decisions", "grey", "grey_not_exact", "near", "seconds", "contestant_seconds", "authority_seconds")
(folder / "report.jsonl").write_text(json.dumps({"stage": stage, "mismatches": 1, **{key: 10**9 for key in keys}}))
sys.exit(1)
"""


def judge(program, out, *arguments):
    done = subprocess.run([SCRIPT, program, out, "--backend", "cpu", *arguments], capture_output=True, text=True, check=False)
    return done, json.loads((out / "counts.json").read_text())


def test_sums(folder):
    out = folder / "sums"
    done, counts = judge(OGC, out, "--share", "0.0005", "--seconds", "20", "truncate", "detect_edge_edge")
    assert done.returncode == 0, done.stdout + done.stderr
    assert set(counts["stages"]) == {"truncate", "detect_edge_edge"} and not counts["failed"]
    for stage, sums in counts["stages"].items():
        chunks = [json.loads(path.read_text()) for path in out.glob(f"{stage}.s*.jsonl")]
        assert chunks and all(chunk["stage"] == stage for chunk in chunks)
        for key, value in sums.items():
            assert abs(value - sum(chunk[key] for chunk in chunks)) <= 1e-9 * value, (stage, key)
    assert counts["stages"]["truncate"]["cases"] >= 450_000_000 * 0.0005
    table = (out / "counts.md").read_text()
    assert "| `truncate` | " in table and "pairs: " in table and not list(out.glob("*.s*/"))


def test_failures(folder):
    stub = folder / "stub"
    stub.write_text(STUB)
    stub.chmod(0o755)
    out = folder / "failures"
    done, counts = judge(stub, out, "truncate", "spring")
    assert done.returncode == 1
    assert len(counts["failed"]) == 2 and counts["stages"]["truncate"]["mismatches"] == 1 and counts["stages"]["spring"]["cases"] == 0
    assert (out / "truncate.s1000/failures/problems.txt").read_text() == "stage=truncate"
    assert "out of memory" in (out / "spring.s1000/said.txt").read_text()


with tempfile.TemporaryDirectory() as name:
    test_sums(Path(name))
    test_failures(Path(name))
for wrong in (["nowhere", "out"], [OGC, "out", "no_stage"]):
    refused = subprocess.run([SCRIPT, *wrong], capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and wrong[-1 if len(wrong) > 2 else 0] in refused.stderr
