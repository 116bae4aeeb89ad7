"""A figure drawn without some of its runs says so, in its table and to whoever accepts it.

Usage: left_out.py SOURCE_DIR OGC. Exit status 77: skipped, matplotlib, h5py or PyYAML is missing.
"""

import csv
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    from paper_figures.figures import fig17_three_cloths_on_sphere
    from paper_figures.workflow import accept
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)


class LeftOut(unittest.TestCase):
    def test_fig_17_without_the_curves_in_double(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name) / "fig17-smoke-cpu"
            picture = fig17_three_cloths_on_sphere.main(folder, OGC, "smoke", start_iterations=5,
                                                        without=("vbd_cpu_any", "vbd_double", "newton", "newton_any"))
            self.assertTrue(picture.is_file())
            with (folder / "fig17.csv").open(newline="") as file:
                rows = {row["curve"]: (row["status"], row["iterations_of_steps_before [1]"])
                        for row in csv.DictReader(file)}
            self.assertEqual(rows.pop("VBD, single, cpu"), ("finished", "5"))
            self.assertEqual(rows, dict.fromkeys(("VBD, single, cpu, γ_e = 0", "VBD, double", "Newton, double",
                                                  "Newton, double, γ_e = 0"), ("not run", "")))
            self.assertEqual(list(accept.left_out(folder)), list(rows))


if __name__ == "__main__":
    unittest.main()
