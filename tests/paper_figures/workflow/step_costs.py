"""The costs of a step are found again where rows are made of known ones, and what can't be told apart is refused.

Usage: step_costs.py SOURCE_DIR. Exit status 77: skipped, numpy is missing.
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    from paper_figures.workflow import step_costs
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow.evidence import EvidenceError, runs_in  # noqa: E402

HEAD = "step [1],wall [ms],vertex_facet_contacts [1],edge_edge_contacts [1],discrete_detections [1]\n"


class StepCosts(unittest.TestCase):
    def run_of(self, rows):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "run.json").write_text("{}")
            Path(folder, "steps.csv").write_text(HEAD + "".join(",".join(map(str, row)) + "\n" for row in rows))
            run = runs_in(folder)[0]
            self.assertTrue(run.columns)  # read while the folder is there
        return run

    def test_known_costs_are_found(self):
        rows = [(k, 2 + 0.5 * (k % 3) + 4e-5 * (1000 * k), 400 * k, 600 * k, k % 3) for k in range(1, 40)]
        for found, known in zip(step_costs.costs(self.run_of(rows)), (2, 0.5, 4, 0)):
            self.assertAlmostEqual(found, known, places=9)

    def test_what_does_not_change_has_no_cost(self):
        with self.assertRaisesRegex(EvidenceError, "run.json: detections and contacts do not change"):
            step_costs.costs(self.run_of([(k, 2, 10, 10, 1) for k in range(1, 9)]))

    def test_a_folder_without_a_run_is_named(self):
        done = subprocess.run([sys.executable, "-m", "paper_figures.workflow.step_costs", "plots"], cwd=SOURCE,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("step_costs: plots: no run", done.stderr)


if __name__ == "__main__":
    unittest.main()
