"""The accepted results that are there: each has its provenance, is small, is there once, and a thinned run says what
its manifest says.

Usage: kept.py SOURCE_DIR. Exit status 77: skipped, PyYAML is missing.
"""

import hashlib
import json
import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import yaml  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow import accept, captions, contents  # noqa: E402
from paper_figures.workflow.evidence import RESULTS, runs_in  # noqa: E402
from paper_figures.workflow.kept import PICTURES  # noqa: E402
from ogc_testbed.columns import column_and_unit  # noqa: E402

# Bytes of all accepted results: of tables and manifests, and of pictures and movies.
LIMIT, LIMIT_PICTURES = 10e6, 30e6
WORDS = 12  # of a text for a picture, at least


class Kept(unittest.TestCase):
    def test_every_file_is_the_one_that_its_provenance_says(self):
        """That each has its row is a test of contents.py."""
        for provenance in RESULTS.glob(f"*/{contents.PROVENANCE}"):
            for row in contents.rows_of(provenance):
                data = (provenance.parent / row["file"]).read_bytes()
                self.assertEqual(hashlib.sha256(data).hexdigest()[:16], row["sha256"], row["file"])

    def test_all_of_them_are_small(self):
        sizes = {seen: sum(path.stat().st_size for path in RESULTS.rglob("*") if path.is_file()
                           and accept.is_picture(path.name) == seen) for seen in (False, True)}
        self.assertLess(sizes[False], LIMIT)
        self.assertLess(sizes[True], LIMIT_PICTURES)

    def test_every_picture_has_a_caption_and_words_for_who_does_not_see_it(self):
        for folder in (path.parent for path in RESULTS.glob("*/provenance.csv")):
            rows = captions.rows_of(folder)
            there = {path.name for path in folder.glob("*") if path.suffix in PICTURES}
            self.assertEqual(there, set(rows), folder.name)
            for name, row in rows.items():
                self.assertTrue(row["title"] and row["source"], name)
                self.assertGreaterEqual(len(row["alt"].split()), WORDS, name)
                self.assertNotRegex(row["title"], r"commit|[0-9a-f]{10}", name)

    def test_no_file_is_there_twice(self):
        """Tables, audits and times apart: those of two runs may agree."""
        may_agree = (".csv", "_audit.json", "processor_time.json")
        seen = {}
        for path in sorted(path for path in RESULTS.rglob("*") if path.is_file() and not path.name.endswith(may_agree)):
            other = seen.setdefault(hashlib.sha256(path.read_bytes()).hexdigest(), path)
            self.assertEqual(other, path)

    def test_each_scene_has_the_name_of_its_hash_and_a_run(self):
        named = {json.loads(path.read_text())["scene"]["sha256"] for path in RESULTS.rglob("*run.json")}
        there = {path.stem for path in (RESULTS / "scenes").iterdir()}
        self.assertEqual(there, named)
        for path in (RESULTS / "scenes").iterdir():
            self.assertEqual(hashlib.sha256(path.read_bytes()).hexdigest()[:16], path.stem)

    def test_no_folder_has_the_name_of_a_commit(self):
        for path in RESULTS.rglob("*"):
            self.assertFalse(path.is_dir() and re.fullmatch(r"[0-9a-f]{7,}", path.name), path)

    def test_the_hundreds_of_a_thinned_run_say_what_its_manifest_says(self):
        found = [run for run in runs_in(RESULTS) if run.thinned]
        self.assertGreater(len(found), 10)
        for run in found:
            counts = run.thinned.of_rows()
            self.assertEqual(sum(counts), run.step_count, run.source)
            for key, mean in run.manifest["whole_run"]["mean"].items():
                name = column_and_unit(key)[0]
                parts = run.thinned.of("mean", name)
                # Nine digits of each mean: half a unit of the ninth, relative to the largest of them.
                scale = max(map(abs, parts)) or 1
                again = sum(part * count for part, count in zip(parts, counts)) / run.step_count
                self.assertAlmostEqual(again / scale, mean / scale, delta=5e-9, msg=f"{run.source} {name}")
                largest = run.manifest["whole_run"]["largest"][key]
                self.assertEqual(f"{max(run.thinned.of('largest', name)):.9g}", f"{largest:.9g}",
                                 f"{run.source} {name}")

    def test_no_manifest_names_a_folder_of_the_machine(self):
        for path in RESULTS.rglob("*run.json"):
            self.assertNotRegex(json.loads(path.read_text())["command"], r"(^|\s|=)/", path)


if __name__ == "__main__":
    unittest.main()
