"""Parts that vary what claims leave open, and repeated runs: medians by step, refused where bits differ; tables of real
steps at smoke; the mat made thicker; each table that a claim reads is made by a part.

Usage: varied.py SOURCE_DIR OGC. The standard library is enough.
"""

import csv
import dataclasses
import gzip
import json
import statistics
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import parts, steady, taken, varied, yarn_cases  # noqa: E402
from paper_figures.workflow.jobs import FINISHED, KEPT, Limit, RunFailure  # noqa: E402
from paper_figures.workflow.runner import Runner  # noqa: E402

SMOKE = parts.Wanted(scale="smoke", backend="cpu")


class Scratch(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name).resolve()

    def make(self, name, where="cores"):
        part = varied.parts_of(where, SMOKE)[name]
        self.assertIn(Runner(OGC, self.folder, Limit()).part(part), (FINISHED, KEPT))
        return self.folder / part.folder, part

    def rows(self, path):
        with (gzip.open if path.suffix == ".gz" else open)(path, "rt", newline="") as file:
            return list(csv.DictReader(file))


class Steady(Scratch):
    def test_a_step_counts_by_the_median_of_its_repetitions(self):
        folder, part = self.make("steady_cloth_on_sphere")
        runs = [self.rows(folder / f"cloth_on_sphere/repeat_{k}/steps.csv") for k in range(1, 6)]
        times = [statistics.median(float(run[i]["wall [ms]"]) for run in runs) for i in range(len(runs[0]))]
        (row,) = steady.gathered(folder)
        self.assertEqual((row["variant"], row["runs"], row["steps"]), ("cloth_on_sphere", "5", str(len(times))))
        self.assertAlmostEqual(float(row["largest median over mean [1]"]), max(times) / statistics.fmean(times), 4)
        self.assertLessEqual(float(row["largest over mean of one run, least [1]"]),
                             float(row["largest over mean of one run, most [1]"]))
        steps = self.rows(folder / "cloth_on_sphere/step_medians.csv.gz")
        self.assertAlmostEqual(float(steps[7]["median [ms]"]), times[7], delta=1e-5 * times[7])
        packed = {path.name for job in part.jobs for path in job.results(self.folder / part.folder, 0, 0)}
        self.assertEqual(packed, {"run.json", "steady.csv", "step_medians.csv.gz"})
        self.assertEqual([name for name, *_ in self.taken("steady")], ["steady_smoke.csv"])

        self.assertTrue(all(job.done(folder) for job in part.jobs[:-1]))
        self.unpacked(folder, part)

        rows = folder / "cloth_on_sphere/repeat_3/steps.csv"
        text = rows.read_text().splitlines()
        cells = text[20].split(",")
        cells[2] = str(int(cells[2]) + 1)  # a contact more
        rows.write_text("\n".join([*text[:20], ",".join(cells), *text[21:]]) + "\n")
        with self.assertRaisesRegex(RunFailure, "repeat_3 differs from .*repeat_1 in more than times"):
            part.jobs[-1].make(OGC, self.folder / part.folder)

    def unpacked(self, folder, part):
        """Repetitions travel without their rows: they are done with their table, and made again without it."""
        rows, table = folder / "cloth_on_sphere/repeat_2/steps.csv", folder / "cloth_on_sphere/steady.csv"
        text, said = rows.read_text(), table.read_text()
        rows.unlink()
        self.assertTrue(part.jobs[1].done(folder))
        part.jobs[-1].make(OGC, folder)
        self.assertEqual(table.read_text(), said)
        table.unlink()
        self.assertEqual([job.done(folder) for job in part.jobs[:3]], [True, False, True])
        rows.write_text(text)
        table.write_text(said)

    def taken(self, kind):
        """Returns what would be taken, of runs that stand in for those of a commit."""
        for path in self.folder.rglob("run.json"):
            path.write_text(json.dumps({**json.loads(path.read_text()), "dirty": False, "commit": "a" * 40}))
        return list(taken.KINDS[kind](taken.Runs(self.folder, "smoke", "cpu")))

    def test_the_published_dress_is_repeated_where_its_data_are_and_no_folder_is_kept(self):
        there, none = (varied.repeated("paper", "cuda", data) for data in ("/x/input", ""))
        published, = set(there) - set(none)
        self.assertEqual((published.name, published.row), ("dress_volumes_published", "dress_volumes"))
        run = published.jobs("paper", "cuda")[0]
        self.assertIn("data=/x/input", run.arguments)
        manifest = {**dict.fromkeys(("final_hash", "solver", "backend", "device", "ended"), "x"), "commit": "a" * 40,
                    "scene": {"name": "dress", "bodies": []}, "settings": {"bounds": {"value": "ball"}},
                    "command": " ".join(["ogc", "run", *map(str, run.arguments)])}
        said = steady.about(published, "paper", [manifest])["command"]
        self.assertIn("--set data=DIR", said)
        self.assertNotIn("/", said)

    def test_without_repetitions_there_is_no_table(self):
        with self.assertRaisesRegex(RunFailure, "has no steady.csv: make parts steady_"):
            steady.gathered(self.folder)


class SolvedSteps(Scratch):
    def test_the_share_of_detection_is_that_of_the_median_repetition(self):
        folder, part = self.make("fig17_share")
        rows = self.rows(folder / "fig17_share.csv")
        asked = [(row["iterations [1]"], row["guess_rounds [1]"]) for row in rows]
        self.assertEqual(asked, [("500", "16"), ("500", "1")])
        for row in rows:
            steps = self.rows(folder / f"share_500_{row['guess_rounds [1]']}/steps.csv")
            self.assertEqual(len(steps), 1)
            stages = [float(text) for title, text in steps[0].items() if title.startswith("stage_")]
            share = float(row["detection_share_of_time [1]"])
            self.assertAlmostEqual(share, float(steps[0]["stage_detection [ms]"]) / sum(stages), 3)
            self.assertTrue(0 < share < 1)
        manifest = json.loads((folder / "share_500_1/run.json").read_text())
        self.assertEqual(manifest["time_repeats"], str(varied.REPEATS))
        for path in self.folder.rglob("run.json"):  # they stand in for those of a commit
            path.write_text(json.dumps({**json.loads(path.read_text()), "dirty": False, "commit": "a" * 40}))
        some = taken.Runs(self.folder, "smoke", "cpu", True)
        self.assertEqual([(name, words["figure"]) for name, _, words in taken.solved_steps(some)],
                         [("fig17_share_smoke.csv", "fig17_share")])
        with self.assertRaisesRegex(taken.Missing, "fig17_printed.csv is missing"):
            list(taken.solved_steps(taken.Runs(self.folder, "smoke", "cpu")))

    def test_a_row_for_each_step_with_the_printed_share_and_measured_times(self):
        folder, part = self.make("fig17_printed")
        (folder / "fig17_printed.csv").unlink()  # as if a limit had come before the table
        packed = [path.name for path in part.jobs[-1].results(folder, 0, 0)]
        self.assertEqual(packed, ["fig17_printed.csv"])
        rows = self.rows(folder / "fig17_printed.csv")
        self.assertEqual([row["step [1]"] for row in rows], ["10", "20"])
        for row in rows:
            self.assertEqual(row["curve"], "VBD, single, cpu")
            found = self.rows(folder / f"vbd_cpu_at_{row['step [1]']}/iterations.csv")
            left = [float(each["residual [1]"]) for each in found]
            self.assertEqual(len(left), 501)
            self.assertAlmostEqual(float(row["smallest_residual [1]"]), min(left), delta=5e-3 * min(left))
            times = [float(each["wall [ms]"]) for each in found]
            self.assertEqual(times, sorted(times))
            self.assertLessEqual(times[-1], float(row["step [ms]"]) * 1.001)


class Scenes(Scratch):
    def test_a_thicker_mat_is_the_scene_s_mesh_stretched(self):
        for times in (1, 3):
            varied.Thicker("smoke", times).write(OGC, self.folder)
        meshes = [next((self.folder / f"scenes/thicker_smoke_{times}").glob("*.msh")) for times in (1, 3)]
        before, after = ([list(map(float, line.split())) for line in mesh.read_text().splitlines()[3:]
                          if len(line.split()) == 3 and "$" not in line] for mesh in meshes)
        self.assertEqual(len(before), 480)
        self.assertEqual([[x, 3 * y, z] for x, y, z in before], after)
        self.assertTrue(any(y for _, y, _ in before))
        path = self.folder / varied.Thicker("smoke", 3).path
        done = subprocess.run([OGC, "run", path, "--steps", "2", "--out", self.folder / "run"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_an_edge_of_a_mesh_is_no_position(self):
        mesh = "$Nodes\n1 1 1 1\n3 1 0 1\n0.5 2e-1 1.0\n$EndNodes\n$Elements\n0.5 1.0 2.0\n$EndElements\n"
        self.assertEqual(varied.stretched(mesh, 2), mesh.replace("2e-1", "0.4"))


class Plans(unittest.TestCase):
    def test_every_part_has_an_expected_time_and_no_two_share_a_name(self):
        for where, backend in (("gpu", "cuda"), ("cores", "cpu")):
            book = varied.parts_of(where, parts.Wanted(scale="paper", backend=backend))
            self.assertLessEqual(set(book), set(varied.EXPECTED))
            self.assertFalse(set(book) & set(parts.book(parts.Wanted(scale="paper", backend=backend))))

    def test_ten_starts_are_among_the_cases_of_yarn_and_no_two_cases_share_a_run(self):
        chains = yarn_cases.chains("paper", "cuda")
        runs = [job.name for chain in chains for job in chain]
        self.assertEqual(len(set(runs)), len(runs))
        most = yarn_cases.Case(yarn_cases.TURNS["paper"][-1], fine=True)
        starts = [case for case in yarn_cases.cases("paper") if dataclasses.replace(case, seed=0) == most]
        self.assertEqual(len(starts), yarn_cases.STARTS)
        self.assertLessEqual({case.name for case in starts}, {chain[-1].name for chain in chains})

    def test_runs_of_the_steps_are_of_the_printed_share(self):
        for job in varied.printed("paper", "cuda")[1:-1]:
            self.assertNotIn("detection_fraction=0", job.arguments)
            self.assertIn("--repeats", job.arguments)


if __name__ == "__main__":
    unittest.main()
