"""Files that were made again are compared with the accepted ones: times may differ, nothing else may.

Usage: sampled.py SOURCE_DIR. Exit status 77: skipped, Pillow is missing.
"""

import gzip
import json
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    from PIL import Image
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow import sampled  # noqa: E402

TABLE = "step [1],wall [ms],residual [1],commit\n1,2.5,0.25,aaaa\n2,2.5,0.125,aaaa\n"
OF_A_STUDY = "metric,unit,median\nmedian_step,ms,2\ndetections,1,3\n"


class Sampled(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folders = Path(holder.name) / "kept", Path(holder.name) / "again"
        for folder in self.folders:
            folder.mkdir()

    def difference(self, name, before, now):
        paths = [folder / name for folder in self.folders]
        for path, text in zip(paths, (before, now)):
            path.write_bytes(gzip.compress(text.encode()) if name.endswith(".gz") else text.encode())
        return sampled.difference(*paths)

    def test_a_seed_decides_the_files(self):
        machines = ("h200", "two_cores")
        first = sampled.drawn(7, 10, machines)
        self.assertEqual(first, sampled.drawn(7, 10, machines))
        self.assertNotEqual(first, sampled.drawn(8, 10, machines))
        self.assertEqual(len({(machine, row["file"]) for machine, row in first}), 10)

    def test_times_and_programs_may_differ_in_a_table(self):
        for name in ("x_steps.csv", "x_steps.csv.gz"):
            self.assertEqual(self.difference(name, TABLE, TABLE.replace("2.5", "9").replace("aaaa", "bbbb")), "")
        self.assertEqual(self.difference("x.csv", OF_A_STUDY, OF_A_STUDY.replace("ms,2", "ms,9")), "")

    def test_a_number_a_row_or_a_column_that_differs_is_named(self):
        self.assertIn("row 2, residual [1]: 0.5, accepted 0.125",
                      self.difference("x.csv", TABLE, TABLE.replace("0.125", "0.5")))
        self.assertIn("1 rows, 2 accepted", self.difference("x.csv", TABLE, TABLE[:TABLE.index("2,2.5")]))
        self.assertIn("columns residual [1], rest [1]",
                      self.difference("x.csv", TABLE, TABLE.replace("residual", "rest")))
        self.assertIn("row 2, median", self.difference("x.csv", OF_A_STUDY, OF_A_STUDY.replace("1,3", "1,4")))

    def test_a_table_of_times_alone_proves_nothing(self):
        self.assertIn("no column", self.difference("x.csv", "wall [ms]\n1\n", "wall [ms]\n2\n"))

    def test_of_a_run_the_last_state_and_the_settings_count(self):
        run = {"final_hash": "aa", "settings": {"r": 1}, "ended": "today"}
        say = lambda **values: json.dumps({**run, **values})  # noqa: E731
        self.assertEqual(self.difference("x_run.json", say(), say(ended="later")), "")
        self.assertIn("final_hash", self.difference("x_run.json", say(), say(final_hash="bb")))
        self.assertIn("settings", self.difference("x_run.json", say(), say(settings={"r": 2})))
        audit = {"states": 3, "intersections": 0, "seconds": 1}
        self.assertIn("states", self.difference("x_audit.json", json.dumps(audit), json.dumps({**audit, "states": 2})))

    def test_a_picture_has_its_size(self):
        paths = [folder / "x.png" for folder in self.folders]
        Image.new("RGB", (4, 3), "red").save(paths[0])
        Image.new("RGB", (4, 3), "blue").save(paths[1])
        self.assertEqual(sampled.difference(*paths), "")
        Image.new("RGB", (4, 4), "blue").save(paths[1])
        self.assertIn("4 × 4 pixels", sampled.difference(*paths))

    def test_what_was_not_made_again_is_named(self):
        (self.folders[0] / "x.csv").write_text(TABLE)
        self.assertEqual(sampled.difference(self.folders[0] / "x.csv", self.folders[1] / "x.csv"), "not made again")


if __name__ == "__main__":
    unittest.main()
