"""What hinders a release: each fault is named, a tree without faults is not hindered, and a version from 1 on has
evidence of its own sources alone.

Usage: releasable.py SOURCE_DIR OGC. The standard library is enough.
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SOURCE, OGC = Path(sys.argv[1]).resolve(), sys.argv[2]
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import contents, releasable  # noqa: E402

GOOD = {"CMakeLists.txt": "cmake_minimum_required(VERSION 3.25)\nproject(ogc_testbed VERSION 1.2.0 LANGUAGES C CXX)\n",
        "pyproject.toml": '[project]\nname = "x"\nversion = "1.2.0"\njudge = ["ogc-testbed-judge==1.2.0"]\n',
        "CITATION.cff": 'cff-version: 1.2.0\nversion: 1.2.0\ndate-released: 2026-12-01\nauthors:\n  - name: "A"\n',
        "CHANGELOG.md": "# Changelog\n\n## 1.2.0, 2026-12-01\n\n- A.\n\n## 1.1.0, 2026-11-01\n"}
# file, its words, other words, what is said
FAULTS = (("CMakeLists.txt", "1.2.0", "1.3.0", "pyproject.toml: version '1.2.0', CMakeLists.txt has 1.3.0"),
          ("CMakeLists.txt", "1.2.0", "1.2", "is not three numbers"),
          ("pyproject.toml", 'version = "1.2.0"', 'version = "1.1.0"', "pyproject.toml: version '1.1.0'"),
          ("pyproject.toml", "judge==1.2.0", "judge==1.1.0", "asks for ogc-testbed-judge 1.1.0"),
          ("CITATION.cff", "\nversion: 1.2.0", "", "CITATION.cff: version ''"),
          ("CITATION.cff", "date-released: 2026-12-01\n", "", "CITATION.cff: '' is no date"),
          ("CITATION.cff", "2026-12-01", "2026-11-30", "dates differ"),
          ("CITATION.cff", "authors:", "doi: 10.5281/zenodo.XXXXXXX\nauthors:", "'10.5281/zenodo.XXXXXXX' is a placeh"),
          ("CITATION.cff", "authors:", "repository-code: https://example.org/ogc\nauthors:", "is a placeholder"),
          ("CITATION.cff", "authors:", "repository-code:\nauthors:", "'repository-code:' is a placeholder"),
          ("CITATION.cff", "authors:", 'doi: ""\nauthors:', "is a placeholder"),
          ("CITATION.cff", '"A"', '"<name>"', "'<name>' is a placeholder"),
          ("CITATION.cff", '"A"', '"TODO"', "'TODO' is a placeholder"),
          ("CHANGELOG.md", "1.2.0, 2026-12-01", "1.2.0, unreleased", "CHANGELOG.md: 'unreleased' is no date"),
          ("CHANGELOG.md", "## 1.2.0, 2026-12-01\n\n- A.\n\n", "", "CHANGELOG.md: version '1.1.0'"))


class Faults(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)
        for name, text in GOOD.items():
            (self.root / name).write_text(text)

    def found(self, old=(), program=None):
        with mock.patch.object(contents, "old", return_value=list(old)), \
                mock.patch.object(contents, "in_words", return_value="1 of 2 are old."):
            return releasable.reasons(self.root, program)

    def test_nothing_hinders_a_tree_without_faults(self):
        self.assertEqual(self.found(), [])

    def test_each_fault_is_named(self):
        for name, words, other, said in FAULTS:
            self.assertIn(words, GOOD[name])
            (self.root / name).write_text(GOOD[name].replace(words, other))
            self.assertTrue(any(said in reason for reason in self.found()), (name, other, self.found()))
            (self.root / name).write_text(GOOD[name])

    def test_an_old_file_and_a_checkout_without_history_are_named(self):
        self.assertEqual(self.found(["m/a.csv"]),
                         ["1 of 2 are old. The first is m/a.csv: make them again (experiments/evidence)"])
        with mock.patch.object(contents, "old", side_effect=contents.ContentsError("no git repository: clone it")):
            self.assertEqual(releasable.reasons(self.root), ["accepted files: no git repository: clone it"])

    def test_a_program_of_another_version_or_commit_is_named(self):
        git = ["git", "-C", str(self.root), "-c", "user.name=a", "-c", "user.email=a@b"]
        for words in (("init", "-q"), ("add", "-A"), ("commit", "-q", "-m", "one")):
            subprocess.run([*git, *words], check=True)
        head = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
        program = self.root / "ogc"
        for number, commit, count in (("1.2.0", head, 0), ("1.1.0", head, 1), ("1.2.0", f"{head} (dirty: …)", 1),
                                      ("0.1.0", "f" * 40, 2)):
            program.write_text(f"#!/bin/sh\necho 'OGC Testbed {number}'\necho 'commit {commit}'\n")
            program.chmod(0o755)
            self.assertEqual(len(self.found(program=str(program))), count, (number, commit))
        self.assertIn("cannot be asked", self.found(program=str(self.root / "nothing"))[0])


    def test_a_dated_heading_needs_that_nothing_hinders_and_1_0_0_that_it_is_released(self):
        first_two = "## {}, {}\n\n- A.\n\n## {}, {}\n"
        for headings, old, count in ((("1.2.0", "2026-12-01", "1.1.0", "2026-11-01"), [], 0),
                                     (("1.2.0", "2026-12-01", "1.1.0", "2026-11-01"), ["m/a.csv"], 1),
                                     (("1.2.0", "unreleased", "1.1.0", "2026-11-01"), ["m/a.csv"], 0),
                                     (("1.2.0", "unreleased", "0.9.0", "2026-11-01"), [], 1)):
            (self.root / "CHANGELOG.md").write_text(first_two.format(*headings))
            with mock.patch.object(contents, "old", return_value=old), \
                    mock.patch.object(contents, "in_words", return_value="1 of 2 are old."):
                self.assertEqual(len(list(releasable.of_claim(self.root))), count, headings)


class Today(unittest.TestCase):
    def test_this_commit_is_no_release_that_something_hinders(self):
        self.assertEqual(list(releasable.of_claim()), [])

    def test_versions_agree_and_nothing_is_a_placeholder_at_any_time(self):
        found = [*releasable.of_versions(SOURCE), *releasable.of_placeholders(SOURCE)]
        self.assertEqual([reason for reason in found if "is no date of the release" not in reason], [])

    def test_the_program_says_its_version(self):
        said = subprocess.run([OGC, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertRegex(said, rf"^OGC Testbed {releasable.version()}\ncommit ([0-9a-f]{{40}}|unknown)")

    def test_the_command_lists_its_reasons(self):
        done = subprocess.run([sys.executable, "-m", "paper_figures.workflow.releasable", OGC], cwd=SOURCE,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1 if releasable.reasons(program=OGC) else 0, done.stderr)
        for reason in releasable.reasons():
            self.assertIn(reason, done.stdout)


if __name__ == "__main__":
    unittest.main()
