"""Evidence that no figure keeps becomes results: what is there is taken with its provenance, what lacks a part is left
as it was, and what is no evidence is refused.

Usage: taken.py SOURCE_DIR OGC. Exit status 77: skipped, PyYAML or numpy is missing.
"""

import csv
import hashlib
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    import numpy  # noqa: F401
    from paper_figures.workflow import everything, parts, taken  # noqa: E402
    from paper_figures.workflow.kept import AcceptError  # noqa: E402
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

COMMIT = "a" * 40
LAWS = {"rows": [{"law": "fall", "solver": "vbd", "backend": "cpu", "bounds": "ball", "readings": [
    {"what": "distance", "unit": "m", "measured": 0.5, "answer": 0, "side": "at most", "tolerance": 1,
     "verdict": "holds"}]}]}
DIGESTS = {"stages": [{"stage": "bound", "cases": 7, "digest": 255, "stated": "cpu_to_gpu", "skipped": False}]}


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


class Taken(unittest.TestCase):
    """The evidence is that of one row, made once, of a program that says it is of COMMIT."""

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.made = Path(holder.name) / "runs"
        subprocess.run([SOURCE / "experiments/evidence", "cores", "--scale", "smoke", "--out", cls.made, "--changed",
                        "--program", OGC, "twist", "windows_twist"], check=True, capture_output=True)
        for path in cls.made.rglob("run.json"):
            cls.change(path, commit=COMMIT, dirty=False)
        (cls.made / "program.txt").write_text(f"OGC Testbed\ncommit {COMMIT}\ncompiler X 1\n"
                                              "  cpu: usable (3 threads)\n")
        for name, said in (("laws", LAWS), ("determinism", DIGESTS)):
            folder = cls.made / f"{name}-smoke-cpu/all"
            folder.mkdir(parents=True)
            (folder / "said.txt").write_text(json.dumps(said))

    @staticmethod
    def change(path, **values):
        path.write_text(json.dumps({**json.loads(path.read_text()), **values}))

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.results = Path(holder.name)

    def take(self, kind, partly=False):
        runs = taken.Runs(self.made, "smoke", "cpu", partly)
        return taken.keep("machine", runs, list(taken.KINDS[kind](runs)), self.results)

    @property
    def provenance(self):
        return {row["file"]: row for row in rows_of(self.results / "machine/provenance.csv")}

    def test_each_file_has_a_row_with_its_digest_command_and_program(self):
        for kind in ("rows", "laws", "determinism"):
            for name in self.take(kind):
                row, data = self.provenance[name], (self.results / "machine" / name).read_bytes()
                self.assertEqual(row["sha256"], hashlib.sha256(data).hexdigest()[:16])
                self.assertEqual(row["commit"], COMMIT)
            self.assertRegex(row["redo"], "^experiments/evidence cores (--scale smoke twist|laws|determinism)$")
        self.assertLess({"twist_cpu_run.json", "twist_cpu_audit.json", "laws_cpu.csv"}, set(self.provenance))
        scene = json.loads((self.results / "machine/twist_cpu_run.json").read_text())["scene"]["sha256"]
        self.assertTrue((self.results / f"scenes/{scene}.json").is_file())

    def test_numbers_are_those_of_the_evidence(self):
        self.take("laws"), self.take("determinism"), self.take("windows", partly=True)
        self.assertEqual(rows_of(self.results / "machine/laws_cpu.csv")[0]["measured"], "0.5")
        self.assertEqual(rows_of(self.results / "machine/determinism_cpu.csv")[0]["digest"], f"{255:016x}")
        first = rows_of(self.results / "machine/cpu_windows_smoke.csv")[0]
        took = [float(row["wall [ms]"]) for row in rows_of(self.made / "table1-smoke-cpu/twist/cpu_0/steps.csv")]
        self.assertAlmostEqual(float(first["mean step [ms]"]), sum(took) / len(took), delta=1e-3 * max(took))

    def test_how_long_parts_took_is_what_a_later_call_expects(self):
        self.take("seconds")
        table = {row["part"]: row for row in rows_of(self.results / "machine" / everything.SECONDS)}
        times = json.loads((self.made / everything.TIMES).read_text())
        self.assertEqual(set(table), {"twist", "windows_twist"})
        self.assertEqual(float(table["twist"]["seconds"]), times["twist"]["seconds"])
        wanted = parts.Wanted(scale="smoke", backend="cpu")
        with mock.patch.object(everything, "RESULTS", self.results):
            self.assertEqual(everything.accepted_seconds("twist", wanted, {}), times["twist"]["seconds"])
            self.assertIsNone(everything.accepted_seconds("knot", wanted, {}))

    def test_newtons_curves_are_taken_with_the_iterations_from_which_their_numbers_come(self):
        folder, scene = self.made / "fig17-smoke-cpu", ("three_cloths_on_sphere", "--scale", "smoke", "--steps", "1")
        for name, words in (("start", ()), ("newton_any", ("--solver", "newton", "--iterations", "--profile",
                                                           "--set", "newton_iterations=3")), ("vbd_cpu", ())):
            subprocess.run([OGC, "run", *scene, *words, "--out", folder / name], check=True, capture_output=True)
            self.change(folder / name / "run.json", commit=COMMIT, dirty=False)
        self.assertEqual(set(self.take("newton")), {"fig17_newton_smoke.csv", "fig17_newton_iterations.csv"})
        (row,) = rows_of(self.results / "machine/fig17_newton_smoke.csv")
        curve = rows_of(self.results / "machine/fig17_newton_iterations.csv")
        self.assertEqual({each["curve"] for each in curve}, {row["curve"]})
        self.assertEqual(len(curve), int(row["iterations [1]"]) + 1)
        # The row has three digits, so that rounding moves its number by at most 5e-3 of it. The curve has six digits.
        self.assertAlmostEqual(float(row["smallest_residual [1]"]), min(float(each["residual [1]"]) for each in curve),
                               delta=5.1e-3 * float(row["smallest_residual [1]"]))

    def test_parts_of_a_table_add_up_if_they_are_of_the_same_sources(self):
        path = self.results / "machine/steady_smoke.csv"
        path.parent.mkdir()
        sources = {"new": ("s",) * 4 + ("judge",), "old": ("s",) * 4 + ("another",), "other": ("t",) * 5}
        lines = {name: f"{variant},{ms},{commit}\n" for name, variant, ms, commit in
                 (("replaced", "a", 1, "old"), ("kept", "b", 2, "old"), ("gone", "c", 3, "other"),
                  ("new", "a", 4, "new"))}
        head = "variant,ms,commit\n"
        path.write_text(head + lines["replaced"] + lines["kept"] + lines["gone"])
        with mock.patch.object(taken.contents, "of_history", lambda commits: {name: sources[name] for name in commits}):
            data = taken.joined(path, (head + lines["new"]).encode(), ("variant",))
        self.assertEqual(data.decode(), head + lines["new"] + lines["kept"])

    def test_studies_add_up_scene_by_scene_and_keep_the_order_of_their_points(self):
        path = self.results / "machine/ablations_smoke.csv.gz"
        path.parent.mkdir()
        head = "study,scene,point,commit\n"
        kept, gone, new = "a,twist,z,one\na,twist,b,one\n", "b,twist,x,one\n", "b,twist,z,two\nb,twist,a,two\n"
        path.write_bytes(taken.gzip.compress((head + kept + gone).encode()))
        with mock.patch.object(taken.contents, "of_history", lambda commits: dict.fromkeys(commits, ("s",) * 5)):
            data = taken.joined(path, taken.gzip.compress((head + new).encode()), taken.JOINED["ablations"])
        self.assertEqual(taken.gzip.decompress(data).decode(), head + kept + new)

    def test_a_devices_table_waits_for_no_study_of_a_solver_that_knows_processors_alone(self):
        listed = taken.everything.list_of_studies()
        here, there = (taken.everything.studies_of(listed, "paper", backend) for backend in ("cpu", "cuda"))
        self.assertEqual(set(here) - set(there), {"ablation_colours", "ablation_truncation"})

    def test_a_table_without_one_of_its_parts_is_left_as_it_was(self):
        with self.assertRaisesRegex(taken.Missing, "windows: .*run.json is missing"):
            self.take("windows")
        with self.assertRaisesRegex(taken.Missing, "judge: .*seed_1"):
            self.take("judge")
        with self.assertRaisesRegex(taken.Missing, "yarn: .*hanging/run.json is missing"):
            self.take("yarn")
        self.assertFalse((self.results / "machine").exists())

    def test_what_was_taken_before_goes_with_its_row(self):
        names = self.take("rows")
        old = self.results / "machine/twist_old.csv"
        old.write_text("x\n")
        with (self.results / "machine/provenance.csv").open("a") as file:
            file.write(f"twist_old.csv,twist_cpu,smoke,cpu,x,{COMMIT},,,,0\n")
        self.assertEqual(self.take("rows"), names)
        self.assertFalse(old.exists())
        self.assertNotIn("twist_old.csv", self.provenance)

    def refused(self, name, kind, words, **values):
        path = self.made / name
        before = path.read_text()
        self.change(path, **values)
        try:
            with self.assertRaisesRegex(AcceptError, words):
                self.take(kind, partly=True)
        finally:
            path.write_text(before)
        self.assertFalse((self.results / "machine").exists())

    def test_what_is_no_evidence_is_refused(self):
        row = "table1-smoke-cpu/twist"
        self.refused(f"{row}/whole/run.json", "rows", "uncommitted changes", dirty=True)
        self.refused(f"{row}/whole/audit.json", "rows", "failed its audit", clean=False, intersections=1)
        self.refused(f"{row}/cpu_25/run.json", "windows", "runs of commits", commit="b" * 40)


if __name__ == "__main__":
    unittest.main()
