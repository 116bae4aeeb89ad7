"""What accepted results were made of: each kept table has its provenance, none is of a changed program, there is one
Table 1, the contents of each commit are those of the history, and a file of other sources than HEAD's is old by
computation.

Usage: contents.py SOURCE_DIR. The standard library is enough.
"""

import csv
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import commands, contents  # noqa: E402
from paper_figures.workflow.evidence import RESULTS, SCENES, manifest_at  # noqa: E402

# Commits of accepted files that no history has; another one is refused, and a release refuses these.
LOST = {"a038bacd6236537c071fa50626caf008c0deb831", "b645cd2acbde930863b4a6e7ca1f14883f21340c"}
ABOUT_ITSELF = {"README.md", contents.PROVENANCE, "durations.csv", "captions.csv"}
A, B = "a" * 40, "b" * 40
TREES = {A: ("1", "2", "3", "4", "6"), B: ("1", "2", "3", "5", "6")}
HEAD = TREES[A]


def kept_tables():
    return [path for path in sorted(RESULTS.rglob("*")) if contents.is_table(path.name)
            and path.parent != RESULTS and path.name not in ABOUT_ITSELF]


class Accepted(unittest.TestCase):
    def test_every_kept_file_has_its_row_with_a_command(self):
        machines = [path for path in RESULTS.iterdir() if path.is_dir() and path.name != SCENES]
        self.assertGreater(len(machines), 1)
        for folder in machines:
            rows = contents.rows_of(folder / contents.PROVENANCE)
            there = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
            self.assertEqual(there - ABOUT_ITSELF, {row["file"] for row in rows}, folder.name)
            self.assertEqual([row["file"] for row in rows if not row["redo"]], [], folder.name)

    def test_no_kept_file_is_of_a_program_with_uncommitted_changes(self):
        for name, commits in contents.named().items():
            for commit in commits:
                self.assertRegex(commit, rf"^{contents.HEX.pattern}$", name)
        manifests = list(RESULTS.rglob("*run.json"))
        self.assertGreater(len(manifests), 100)
        self.assertEqual([path.name for path in manifests if manifest_at(path)["dirty"] is not False], [])

    def test_a_file_of_several_programs_is_old(self):
        """New ones are refused (accepted.py); those that there are can't be of HEAD's sources alone."""
        head = contents.of_head() if in_repository() else HEAD
        self.assertLessEqual(set(contents.mixed()), set(contents.old(head=head)))

    def test_the_times_of_table_1_on_a_gpu_stand_in_one_table(self):
        found = []
        for path in kept_tables():
            rows = contents.rows_of(path)
            scenes = {row.get("scene") for row in rows if "CUDA" in (row.get("device") or "")} & set(commands.ROWS)
            beside = any(key.startswith("paper") and "[ms]" in key for key in rows[0]) if rows else False
            if beside and len(scenes) > 3:
                found.append(path.relative_to(RESULTS).as_posix())
        self.assertEqual(found, ["h200/whole_runs.csv"])

    def test_the_contents_of_each_commit_are_those_of_the_history(self):
        try:
            again = contents.rebuilt()
        except contents.ContentsError as error:
            self.skipTest(str(error))
        self.assertEqual((RESULTS / contents.KEPT).read_text(), again,
                         "run: python3 -m paper_figures.workflow.contents --write")

    def test_commits_are_ancestors_of_head_but_those_known_to_be_lost(self):
        if not in_repository():
            self.skipTest("no git repository")
        try:
            known = contents.history()
        except contents.ContentsError as error:
            self.skipTest(str(error))
        lost = {commit for commit in contents.kept() if not any(name.startswith(commit) for name in known)}
        self.assertLessEqual(lost, LOST)
        for commit, each in contents.kept().items():
            self.assertEqual(each[0] == contents.UNKNOWN, commit in lost, commit)


def in_repository():
    return subprocess.run(["git", "-C", SOURCE, "rev-parse"], capture_output=True, check=False).returncode == 0


class Scratch(unittest.TestCase):
    """Results of a temporary folder."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.results = Path(scratch.name)
        (self.results / "m").mkdir()
        (self.results / contents.KEPT).write_text(contents.as_table(TREES))

    def provide(self, **commits):
        """A provenance with a file for each name, empty unless it is there."""
        with (self.results / "m" / contents.PROVENANCE).open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerows([("file", "commit"), *((f"{name}.csv", commit) for name, commit in commits.items())])

    def rows(self, name, *commits):
        (self.results / "m" / f"{name}.csv").write_text("\n".join(["commit,n", *(f"{c},1" for c in commits)]) + "\n")


class Old(Scratch):
    def test_other_contents_unknown_ones_and_none_make_a_file_old(self):
        self.provide(new=A, other=B, lost="c" * 40, none="", both=f"{A} {B}")
        self.assertEqual(contents.old(self.results, HEAD),
                         ["m/both.csv", "m/lost.csv", "m/none.csv", "m/other.csv"])
        self.assertEqual(contents.in_words(self.results, HEAD),
                         "4 of 5 accepted files are of other sources than this commit's.")

    def test_what_was_tried_does_not_grow_old(self):
        self.provide(other=B)
        (self.results / "m").rename(self.results / contents.TRIED)
        self.assertEqual((contents.old(self.results, HEAD), contents.mixed(self.results)), ([], []))
        self.assertEqual(list(contents.named(self.results)), ["tried/other.csv"])

    def test_two_commits_of_the_same_content_are_one(self):
        (self.results / contents.KEPT).write_text(contents.as_table({A: HEAD, B: HEAD}))
        self.provide(both=f"{A} {B}")
        self.assertEqual((contents.old(self.results, HEAD), contents.mixed(self.results)), ([], []))

    def test_what_the_rows_of_a_table_and_a_manifest_name_counts(self):
        self.provide(t=A)
        self.rows("t", A[:10], A[:10], "-", "")
        self.assertEqual(contents.named(self.results), {"m/t.csv": (A,)})
        self.rows("t", A[:10], B[:10])
        self.assertEqual(contents.old(self.results, HEAD), ["m/t.csv"])
        self.assertEqual(contents.mixed(self.results), ["m/t.csv"])
        (self.results / "m/t_run.json").write_text(json.dumps({"commit": B}))
        self.assertEqual(contents.commits_in(self.results / "m/t_run.json"), [B])

    def test_each_commit_has_one_row_by_its_longest_name(self):
        self.assertEqual(contents.abbreviated([A[:10], A, B[:8], A, B[:10]]), [A, B[:10]])


class Keeping(Scratch):
    def keep(self, name, **more):
        with mock.patch.object(contents, "RESULTS", self.results), \
                mock.patch.object(contents, "history", lambda: frozenset({A})):
            return contents.keep(self.results / "m" / name, "the command", **more)

    def test_a_table_that_no_figure_made_gets_its_row(self):
        (self.results / "m/made_small.csv").write_text(f'device,commit\n"G, CUDA 13.0",{A[:10]}\n')
        row = self.keep("made_small.csv")
        self.assertEqual([row[key] for key in ("file", "figure", "scale", "backend", "redo", "commit", "device")],
                         ["made_small.csv", "made", "small", "cuda", "the command", A, "G, CUDA 13.0"])
        self.assertEqual(contents.rows_of(self.results / "m" / contents.PROVENANCE), [row])
        self.assertEqual(self.keep("made_small.csv")["ended"], row["ended"], "nothing was made")
        self.assertRegex(row["ended"], r"^20\d\d-\d\d-\d\dT.*Z$")

    def test_a_table_that_was_made_again_ended_then_and_keeps_what_its_rows_do_not_say(self):
        (self.results / "m/peers.csv").write_text("stage,cases\nbound,7\n")
        before = {**self.keep("peers.csv", commit=A), "device": "2 threads", "compiler": "GNU", "ended": "2020"}
        contents.merge(self.results / "m" / contents.PROVENANCE, contents.COLUMNS, [before], ("file",))
        (self.results / "m/peers.csv").write_text("stage,cases\nbound,8\n")
        row = self.keep("peers.csv", commit=A)
        self.assertEqual((row["device"], row["compiler"]), ("2 threads", "GNU"))
        self.assertNotEqual(row["ended"], "2020")

    def test_a_table_whose_rows_name_no_program_is_of_the_named_one(self):
        (self.results / "m/peers.csv").write_text("stage,cases\nbound,7\n")
        self.assertEqual(self.keep("peers.csv", commit=A[:10])["commit"], A)
        self.rows("t", A[:10])
        with self.assertRaisesRegex(contents.ContentsError, "t.csv names its program itself"):
            self.keep("t.csv", commit=A)
        with self.assertRaisesRegex(contents.ContentsError, "is of a changed program"):
            self.keep("peers.csv", commit=f"{A} (dirty)")

    def test_one_of_a_changed_program_is_refused(self):
        self.rows("t", f"{A[:10]} (dirty)")
        with self.assertRaisesRegex(contents.ContentsError, "t.csv is of a changed program"):
            self.keep("t.csv")
        with self.assertRaisesRegex(contents.ContentsError, "no table with rows"):
            self.keep("nothing.csv")


class Judge(unittest.TestCase):
    def test_no_run_uses_what_judges_kernels(self):
        used = re.compile(rf'#include "({"|".join(contents.JUDGE)})/')
        runs = [path for folder in ("fast", "reference", "compare", "experiments/scenes", "experiments/program/runs",
                                    "experiments/program/audits") for path in (SOURCE / folder).rglob("*.[ch]*")
                if not path.relative_to(SOURCE).as_posix().startswith("compare/judge/")]
        self.assertGreater(len(runs), 300)
        self.assertEqual([path.name for path in runs if used.search(path.read_text())], [])


class OfHistory(unittest.TestCase):
    """A repository of two commits, which differ in one room."""

    def setUp(self):
        if not shutil.which("git"):
            self.skipTest("no git")
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "repository"
        self.results = self.folder / "paper_figures/results"
        for room in contents.ROOMS:
            (self.folder / room).mkdir(parents=True)
            (self.folder / room / "f").write_text(room)
        self.results.mkdir(parents=True)
        (self.results / "f").write_text("")
        self.git("init", "-q")
        self.commits = [self.commit("one")]
        (self.folder / "fast/f").write_text("changed")
        self.commits.append(self.commit("two"))
        for patch in (mock.patch.object(contents, "RESULTS", self.results),):
            patch.start()
            self.addCleanup(patch.stop)
        for cached in (contents.history, contents.of_head):
            cached.cache_clear()
            self.addCleanup(cached.cache_clear)

    def git(self, *words):
        who = {f"GIT_{role}_{what}": "a@b" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        return subprocess.run(["git", "-C", self.folder, *words], check=True, capture_output=True, text=True,
                              env={**os.environ, **who}).stdout.strip()

    def commit(self, words):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", words)
        return self.git("rev-parse", "HEAD")

    def test_contents_are_digests_of_what_git_lists_and_a_lost_commit_has_none(self):
        one, two = self.commits
        found = contents.of_history([one[:10], two, "c" * 40])
        for commit, name in ((one, one[:10]), (two, two)):
            for room, digest in zip(contents.ROOMS, found[name]):
                listed = self.git("ls-tree", "-r", commit, "--", room) + "\n"
                self.assertEqual(digest, hashlib.sha256(listed.encode()).hexdigest()[:contents.DIGITS])
        self.assertEqual([a == b for a, b in zip(found[one[:10]], found[two])], [False, True, True, True, True])
        self.assertEqual(found["c" * 40], (contents.UNKNOWN,) * 5)
        self.assertEqual(contents.of_head(), found[two])

    def test_a_document_changes_no_content_and_a_file_that_is_named_like_one_does(self):
        for name, same in ((f"notes{contents.DOCUMENT.strip()}", True), ("md", False)):
            (self.folder / "fast" / name).write_text("text\n")
            after = self.commit(name)
            before = self.git("rev-parse", f"{after}~")
            found = contents.of_history([before, after])
            self.assertEqual(found[before] == found[after], same)

    def test_what_judges_kernels_has_a_digest_of_its_own_on_which_the_judge_s_tables_alone_depend(self):
        place = self.folder / contents.JUDGE[0] / "f"
        place.parent.mkdir(parents=True)
        place.write_text("judge")
        after = self.commit("judge")
        found = contents.of_history([self.commits[1], after])
        before, now = found[self.commits[1]], found[after]
        self.assertEqual(before[:4], now[:4])
        self.assertNotEqual(before[4], now[4])
        machine = self.results / "m"
        machine.mkdir()
        with (machine / contents.PROVENANCE).open("w") as file:
            file.write(f"file,commit\njudge_cpu.csv,{self.commits[1]}\nrows.csv,{self.commits[1]}\n")
        for name in ("judge_cpu.csv", "rows.csv"):
            (machine / name).write_text("a\n1\n")
        contents.write(self.results)
        self.assertEqual(contents.old(self.results, now), ["m/judge_cpu.csv"])

    def test_a_commit_that_no_history_reaches_is_unknown_though_its_object_is_there(self):
        self.git("reset", "-q", "--hard", self.commits[0])
        self.assertEqual(contents.of_history([self.commits[1]])[self.commits[1]], (contents.UNKNOWN,) * 5)

    def test_a_clone_without_history_says_so(self):
        shallow = self.folder.parent / "shallow"
        subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{self.folder}", shallow], check=True,
                       capture_output=True)
        with mock.patch.object(contents, "RESULTS", shallow / "paper_figures/results"):
            with self.assertRaisesRegex(contents.ContentsError, "without its history"):
                contents.of_history([self.commits[0]])
            self.assertEqual(len(contents.of_head()), 5)


if __name__ == "__main__":
    unittest.main()
