"""The audit of a run after it goes in rounds that are spread over the run, and keeps what each of them found.

Usage: audited.py SOURCE_DIR. The standard library is enough.
"""

import json
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import audited  # noqa: E402
from paper_figures.workflow.jobs import CALL_AGAIN, Limit  # noqa: E402

# Stands for ogc: says what it was asked about; an intersection in step 30; from the round on that has step STUCK it
# says nothing and fails as one that was killed.
PROGRAM = """#!{python}
import json, os, pathlib, signal, sys
steps = sorted(int(path.stem[6:]) for path in pathlib.Path(sys.argv[2], "frames").glob("frame_*"))
if {stuck} in steps:
    os.kill(os.getpid(), signal.SIGINT)
states = [{{"state": f"step {{step}}", "count": int(step == 30)}} for step in steps]
print(json.dumps({{"states": states, "intersections": sum(state["count"] for state in states)}}))
sys.exit(int(30 in steps))
"""


class AuditedTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.run_folder = Path(self.folder.name) / "run"
        (self.run_folder / "frames").mkdir(parents=True)
        (self.run_folder / "scene").mkdir()
        (self.run_folder / "run.json").write_text("{}")

    def frames(self, count):
        for step in range(count):
            (self.run_folder / "frames" / f"frame_{step:06}.h5").write_text("")

    def program(self, stuck=-1):
        path = Path(self.folder.name) / "ogc"
        path.write_text(PROGRAM.format(python=sys.executable, stuck=stuck))
        path.chmod(0o755)
        return path

    def test_any_beginning_of_the_order_is_spread_over_the_run(self):
        for n in range(1, 70):
            order = audited.spread(list(range(n)))
            self.assertEqual(sorted(order), list(range(n)))
            for k in range(2, n + 1):
                seen = sorted(order[:k])
                self.assertEqual((seen[0], seen[-1]), (0, n - 1))
                # k - 1 of them halve again and again an interval of at most twice n: a power of two of parts is whole
                parts = 2 ** int(math.log2(k - 1))
                widest = max(b - a for a, b in zip(seen, seen[1:], strict=False))
                self.assertLessEqual(widest, 2 ** (n - 1).bit_length() / parts if k > 2 else n, (n, k))

    def test_a_frame_that_is_being_written_is_not_asked_about(self):
        self.frames(3)
        (self.run_folder / "frames" / "frame_000003.h5.partial").write_text("")
        _, found = audited.audit(self.program(), self.run_folder)
        self.assertEqual((found["steps"], found["complete"]), ([0, 1, 2], True))

    def test_all_states_are_audited_once_and_an_intersection_is_named(self):
        self.frames(100)
        status, found = audited.audit(self.program(), self.run_folder)
        self.assertEqual((status, found["states"], found["complete"]), (1, 100, True))
        self.assertEqual((found["steps"], found["intersecting_steps"]), (list(range(100)), [30]))
        self.assertEqual(json.loads((self.run_folder / "audit.json").read_text()), found)

    def test_what_a_round_found_is_kept_where_a_later_one_is_lost(self):
        self.frames(40 * len(os.sched_getaffinity(0)))
        last = audited.spread(list(range(40 * len(os.sched_getaffinity(0)))))[-1]
        status, found = audited.audit(self.program(stuck=last), self.run_folder)
        self.assertEqual(status, CALL_AGAIN)
        self.assertGreater(found["states"], 0)
        self.assertFalse(found["complete"])
        self.assertEqual(json.loads((self.run_folder / "audit.json").read_text()), found)
        status, whole = audited.audit(self.program(), self.run_folder)
        self.assertEqual((whole["states"], whole["complete"]), (40 * len(os.sched_getaffinity(0)), True))

    def test_nothing_is_begun_where_no_time_is_left(self):
        self.frames(3)
        self.assertEqual(audited.audit("no program", self.run_folder, Limit(0))[0], CALL_AGAIN)


if __name__ == "__main__":
    unittest.main()
