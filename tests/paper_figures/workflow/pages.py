"""The page of claims and the drafts are those of the accepted results, name every claim about a result, and follow a
verdict that changes.

Usage: pages.py SOURCE_DIR. Exit status 77: skipped, PyYAML is missing.
"""

import re
import sys
import unittest
from dataclasses import replace
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    from paper_figures.workflow import pages, recipes, verdicts
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.site.origins import Origin  # noqa: E402
from paper_figures.workflow.durations import measured_times  # noqa: E402
from paper_figures.workflow.evidence import Evidence  # noqa: E402


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.evidence = Evidence()
        cls.judgements, cls.book = verdicts.judge_all(cls.evidence), recipes.load()

    def test_they_are_those_of_the_accepted_results(self):
        for path, text in pages.pages().items():
            self.assertEqual(path.read_text(), text, "run: .venv/bin/python -m paper_figures.workflow.pages --write")
        self.assertEqual({path.stem for path in pages.DRAFTS.iterdir()}, {"replication", "software"})

    def test_each_claim_about_a_result_has_one_row_with_a_command_and_a_file_that_is_there(self):
        rows = re.findall(r"^\| `([\w.]+)` \|(.*)\|$", pages.PAGE.read_text(), re.M)
        results = verdicts.apart(self.judgements)[0]
        self.assertEqual([name for name, _ in rows], [each.claim["id"] for part in verdicts.by_origin(self.judgements)
                                                      for each in part])
        self.assertEqual(len(rows), len(results))
        for name, cells in rows:
            verdict, _, command, minutes, hardware, file = (cell.strip() for cell in cells.split(" | "))
            self.assertIn(verdict, verdicts.VERDICTS, name)
            self.assertRegex(command, r"^(`[^`]+`|\[listed\]\(\S+\))", name)
            self.assertRegex(minutes, r"^(–|(\d+|< 1)(, (\d+|< 1))?)$", name)
            self.assertTrue(hardware, name)
            for link in re.findall(r"\]\((\S+)\)", f"{command} {file}"):
                self.assertTrue((pages.ROOM / link).exists(), link)

    def test_the_quick_path_fits_into_half_an_hour_by_the_accepted_durations(self):
        self.assertLess(sum(pages.quick_seconds(self.book, measured_times())), 1800)
        self.assertRaises(KeyError, pages.quick_seconds, self.book, {})

    def test_a_verdict_that_changes_changes_pages_and_the_title(self):
        changed = [replace(each, verdict="refuted") if each.verdict == "reproduced" else each
                   for each in self.judgements]
        before, after = (pages.values(found, self.evidence) for found in (self.judgements, changed))
        self.assertEqual((before["mark"], after["mark"]), ("[Re]", "[¬Re]"))
        self.assertEqual(after["reproduced"], 0)
        self.assertNotEqual(pages.page(changed, self.evidence, self.book), pages.PAGE.read_text())

    def test_one_refuted_guarantee_makes_a_replication_fail(self):
        own = verdicts.by_origin(self.judgements)[0]
        self.assertEqual(pages.title_mark(own), "[Re]")
        one = next(each for each in own if "guarantee" in str(each.claim.get("measure"))
                   and each.verdict == "reproduced")
        broken = [replace(each, verdict="refuted") if each is one else each for each in own]
        self.assertEqual(pages.title_mark(broken), "[¬Re]")

    def test_commands_minutes_and_hardware_are_short(self):
        runner = "python3 -m paper_figures.workflow.runner --program build/bundle/ogc --out runs --backend cuda knot"
        for command, expected in ((runner, "`experiments/evidence gpu knot`"), ("a b", "`a b`"),
                                  ("x" * 99, "[listed](results/m/provenance.csv)")):
            self.assertEqual(pages.command_of(Origin("m/f.csv", command, 1, "", "")), expected)
        self.assertEqual([pages.minutes_of(seconds) for seconds in (None, float("nan"), 59, 90, 4432)],
                         ["–", "–", "< 1", "2", "74"])
        self.assertEqual(pages.hardware_of("NVIDIA H100 80GB HBM3, CUDA 13.0"), "H100")

    def test_paragraphs_are_wrapped_and_tables_are_not(self):
        self.assertEqual(pages.wrapped("# T\n\na\nb\n\n| c |\n|---|\n\n- d\n- e"),
                         "# T\n\na b\n\n| c |\n|---|\n\n- d\n- e")


if __name__ == "__main__":
    unittest.main()
