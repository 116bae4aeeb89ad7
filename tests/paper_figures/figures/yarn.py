"""Fig. 15 and 16: the tension at the first meeting, over k_c r, is the one counted by hand; steps that were not asked
count for nothing; both figures are drawn from the smallest runs, and nothing is made twice. Of cloths that were let go
a distance counts where both are at rest, and what brakes them does so at the rate that it says.

Usage: yarn.py SOURCE_DIR OGC. Exit status 77: skipped, matplotlib or h5py is missing.
"""

import csv
import json
import subprocess
import sys
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

SOURCE, OGC = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    import numpy as np

    from paper_figures.figures.measured import yarn, yarn_rest, yarn_return
    from paper_figures.workflow import commands, release, yarn_cases
    from paper_figures.workflow.first_meeting import FirstMeeting, met_at
    from paper_figures.workflow.jobs import FINISHED, KEPT
    from ogc_testbed.runs import Frame, Run, RunError
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)


def made_up(folder, met, stretch, bounds="off", first=1):
    """A run from step `first` on with k_s = 2 N, k_c = 10 N/m and r = 0.1 m."""
    folder.mkdir(parents=True)
    rod = {"stretch": {"value": 2}, "diameter": {"value": 0.1}}
    body = {"fixed": False, "vertex_count": 2, "material": {"rod": rod, "contact_stiffness": {"value": 10}}}
    values = {"bounds": bounds, "contact_radius": 0.1, "time_step": 0.5}
    (folder / "run.json").write_text(json.dumps(
        {"status": "finished", "scale": "smoke", "commit": "0123456789abcdef", "device": "device", "backend": "cpu",
         "solver": "vbd", "ended": "e", "command": "ogc run x", "scene": {"name": "x", "bodies": [body]},
         "settings": {name: {"value": value} for name, value in values.items()}}))
    head = "step [1],wall [ms],mean_stretch [1],largest_stretch [1],smallest_contact_distance [m],meetings [1]"
    rows = [f"{k + first},1,{s},1,nan,{n}" for k, (s, n) in enumerate(zip(stretch, met))]
    (folder / "steps.csv").write_text("\n".join([head, *rows]) + "\n")
    return Run(folder)


class Known(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_the_number_of_fig_15_is_the_tension_at_the_first_meeting_over_k_c_r(self):
        run = made_up(self.folder / "a", ["nan", 0, 3, 4], [0.1, 0.2, 0.4, 0.9])
        row = yarn.row_of("a", run)
        names = ("steps asked [1]", "meetings [1]", "first meeting at step", "mean tension there [N]",
                 "tension over k_c r [1]", "largest mean tension [N]")
        self.assertEqual([row[name] for name in names], [3, 7, 3, "0.8", "0.8", "1.8"])
        self.assertEqual(row["kind"], "baseline")

    def test_where_a_run_was_not_asked_its_windows_are(self):
        runs = {"a": made_up(self.folder / "a", ["nan"] * 3, [0.1, 0.2, 0.4]),
                "a_window_20": made_up(self.folder / "c", [0, 5], [0.4, 0.5], first=3),
                "a_window_10": made_up(self.folder / "b", [0, 0], [0.2, 0.3])}
        row = yarn.row_of("a", runs["a"], yarn.windows_of("a", runs))
        names = ("steps asked [1]", "meetings [1]", "mean tension there [N]", "largest mean tension [N]")
        self.assertEqual([row[name] for name in names], [4, 5, "1", "0.8"])
        self.assertEqual(list(yarn.drawn_over_time(runs)), ["a"])

    def test_a_step_that_two_windows_asked_counts_once(self):
        runs = {"a": made_up(self.folder / "a", ["nan"] * 3, [0.1, 0.2, 0.4]),
                "a_window_0": made_up(self.folder / "b", [0, 2], [0.2, 0.3]),
                "a_window_after_0": made_up(self.folder / "c", [0, 2, 1], [0.2, 0.3, 0.4])}
        row = yarn.row_of("a", runs["a"], yarn.windows_of("a", runs))
        self.assertEqual([row[name] for name in ("steps asked [1]", "meetings [1]")], [3, 3])

    def test_a_run_that_nobody_asked_has_no_number_of_meetings_and_one_without_any_has_none_at_first(self):
        silent = yarn.row_of("a", made_up(self.folder / "a", ["nan"] * 2, [0.1, 0.2], "ball"))
        self.assertEqual([silent[name] for name in ("kind", "meetings [1]", "tension over k_c r [1]")], ["ogc", "", ""])
        kept = yarn.row_of("b", made_up(self.folder / "b", [0, 0], [0.1, 0.2]))
        self.assertEqual([kept[name] for name in ("meetings [1]", "first meeting at step")], [0, ""])
        self.assertEqual([yarn.met_in_words(row) for row in (silent, kept)], ["–", "0"])

    def test_the_title_says_what_happened_without_bounds(self):
        rows = lambda met: [{"kind": "ogc", "meetings [1]": 0}, {"kind": "baseline", "meetings [1]": met}]  # noqa: E731
        for met, said in ((3, "tangles with a penalty force"), (0, "here with a penalty force, too"), ("", "here")):
            self.assertIn(said, yarn.titled(commands.YARN_TWIST, rows(met))[0])

    def test_cloths_at_rest_that_were_not_made_are_named(self):
        made_up(self.folder / "released", [0], [0.1])
        with self.assertRaisesRegex(RunError, "run.json|no states of"):
            yarn.at_rest_of(self.folder)
        self.assertEqual(yarn.at_rest_of(""), [])

    def test_every_run_of_a_figure_has_a_name_of_its_own_and_the_claims_find_theirs(self):
        for scale in ("smoke", "paper"):
            for scene, jobs in yarn.JOBS.items():
                names = [job.name for chain in jobs(scale, "cpu") for job in chain]
                self.assertEqual(len(set(names)), len(names))
                self.assertLessEqual(set(yarn.main_runs(scene).values()), set(names))
        self.assertIn("baseline_222", [chain[0].name for chain in commands.yarn_stretched("paper", "cuda")])
        chains = list(commands.yarn_twisted("paper", "cuda"))
        self.assertIn("ogc_released", [chain[1].name for chain in chains if len(chain) > 1])
        self.assertIn("hanging", [chain[-1].name for chain in chains])


@dataclass(frozen=True)
class Asked:
    """A window of a made-up run whose threads meet in every step from `first_met` on."""

    name: str
    after: int
    length: int
    first_met: int
    on_device = False

    def done(self, root):
        return (root / self.name).is_dir()

    def make(self, program, root, limit=None, shown=False):
        if self.done(root):
            return KEPT
        steps = range(self.after + 1, self.after + self.length + 1)
        made_up(root / self.name, [int(step >= self.first_met) for step in steps], [1] * self.length,
                first=self.after + 1)
        return FINISHED


class Search(unittest.TestCase):
    def test_every_step_before_the_first_meeting_is_asked_and_no_other(self):
        for first_met in (1, 2, 20, 21, 130, 391, 1000):
            with self.subTest(first_met=first_met), tempfile.TemporaryDirectory() as name:
                root, length = Path(name), 20
                windows = tuple(Asked(f"a_window_{k}", after, 5, first_met) for k, after in enumerate((0, 200, 390)))
                for window in windows:
                    window.make("", root)
                job = FirstMeeting("a_window_search", windows,
                                   lambda step: Asked(f"a_window_after_{step}", step, length, first_met), length)
                self.assertEqual(job.done(root), first_met == 1000)
                job.make("", root)
                self.assertTrue(job.done(root))
                known = min(filter(None, (met_at(root / window.name) for window in windows)), default=None)
                self.assertEqual(known is None, first_met == 1000)
                found = [met_at(root / window.name) for window in job.made_below(root)]
                self.assertEqual(min(filter(None, found), default=None), None if known is None else first_met)
                self.assertEqual(len(found), 0 if known is None else -(-known // length))


class CastOn(unittest.TestCase):
    def test_no_loop_of_the_first_row_is_open(self):
        """The yarn's end is tied to the first bight and each bight to the next, and each loop is closed where its legs
        are nearest, all as they are at the start."""
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            cloth = release.Release("smoke")
            cloth.write(OGC, root)
            scene = json.loads((root / cloth.path).read_text())
            mesh = ((root / cloth.path).parent / scene["bodies"][0]["mesh"]).read_bytes()
        head = mesh.index(b"end_header\n") + len(b"end_header\n")
        points = np.frombuffer(mesh, "<f8", 3 * 830, head).reshape(-1, 3)
        joined = [(spring["first"]["index"], spring["second"]["index"]) for spring in scene["springs"]]
        apart = [np.linalg.norm(points[a] - points[b]) - spring["rest_length"]
                 for spring, (a, b) in zip(scene["springs"], joined)]
        along, necks, loops = joined[:4], joined[4:], 4
        self.assertEqual(along[0][0], 0)
        self.assertEqual([a for a, _ in along[1:]], [b for _, b in along[:-1]])
        for (a, b), difference in zip(along, apart):
            self.assertLess(max(points[a, 1], points[b, 1]) - points[:, 1].min(), 2e-4)
            # the last bight's middle is one vertex beside its lowest point, as the join lengthens it
            self.assertLess(abs(difference), 1.1e-3)
        for loop, (a, b) in zip(range(loops), necks, strict=True):
            legs = points[release.LOOP * loop:release.LOOP * (loop + 1) + 1]
            distance = np.linalg.norm(legs - legs[::-1], axis=1)[1:release.LOOP // 3]
            self.assertAlmostEqual(np.linalg.norm(points[a] - points[b]), distance.min())
        self.assertLess(np.abs(apart[4:]).max(), 1e-5)


class Returns(unittest.TestCase):
    def test_every_case_has_a_name_of_its_own_and_a_cloth_of_its_yarn_to_be_held_against(self):
        for scale in ("smoke", "small", "paper"):
            cases = list(yarn_return.cases(scale))
            names = [case.name for case in cases]
            self.assertEqual(len(set(names)), len(names))
            self.assertLessEqual({case.beside for case in cases}, set(names))
            jobs = [job for case in cases for job in case.jobs(scale, "cpu")]
            self.assertEqual(len({job.name for job in jobs}), len(jobs))

    def test_what_a_case_varies_is_in_its_scene(self):
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            plain, other = release.Twist("smoke", 1), release.Twist("smoke", 0.5, 0.25, 10)
            scenes = []
            for twist in (plain, other):
                twist.write(OGC, root)
                scenes.append(json.loads((root / twist.path).read_text()))
        turns = [motion["angular_velocity"] * motion["end"] / (2 * np.pi)
                 for scene in scenes for motion in scene["motions"] if motion["name"] == release.TURNED]
        np.testing.assert_allclose(turns, (1, 0.5))
        self.assertEqual((plain.seconds, other.seconds), (3, 5))
        plain, other = map(release.rod_of, scenes)
        for part in ("stretch", "bend"):
            self.assertAlmostEqual(other[part] / plain[part], 10)
        self.assertEqual(other["density"], plain["density"])


class Braked(unittest.TestCase):
    def test_a_rod_in_free_flight_slows_down_at_the_rate_that_brakes_a_cloth(self):
        rod, speed, steps = {"density": 1e-3, "stretch": 0.1, "bend": 2e-7}, 0.5, 800
        settings = dict(word.split("=") for word in commands.BRAKED if "=" in word)
        iterations, step = int(settings["iterations"]), float(settings["time_step"])
        scene = {"format_version": 2, "gravity": [0, 0, 0],
                 "settings": {"contact_radius": 0.003, "time_step": step, "iterations": iterations, "steps": steps,
                              "damping": "per_vertex"},
                 "bodies": [{"mesh": "rod.obj", "velocity": [0, speed, 0],
                             "material": {"rod": {**rod, "damping": release.brake(rod)}}}]}
        with tempfile.TemporaryDirectory() as name:
            folder, count = Path(name), 20
            points = [f"v {k * release.SEGMENT:.9f} 0 0" for k in range(count)]
            line = f"l {' '.join(str(k + 1) for k in range(count))}"
            (folder / "rod.obj").write_text("\n".join([*points, line]) + "\n")
            (folder / "rod.json").write_text(json.dumps(scene))
            subprocess.run([OGC, "run", folder / "rod.json", "--out", folder / "run"], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            velocities = yarn_rest.last_frame(Run(folder / "run")).velocities
        # Backward Euler. m/h² is two thirds of a vertex's block: after eight iterations 1e-4 of what a step is braked
        # by is left, 1e-8 m. Positions of 2 cm round off a tenth of this: 1 % over 800 steps, either way.
        left = speed / (1 + step * release.BRAKE_RATE) ** steps
        self.assertLess(np.abs(velocities - (0, left, 0)).max(), 0.03 * (speed - left))

    def test_a_distance_counts_where_both_cloths_are_at_rest(self):
        """Each cloth has frames half a second apart. The last second counts: 1 mm/s is ε_v."""
        ends = {"released": np.eye(3), "hanging": np.eye(3) + (0, 3e-3, 4e-3)}

        def row(ways):
            """`ways`: of all vertices until the end, from the frames before [m]."""
            runs = {}
            for name, end in ends.items():
                apart = [0.1, *ways[name], 0]
                frames = [Frame(k, 0.5 * k, end + (far, 0, 0), np.zeros((3, 3)), np.zeros(3))
                          for k, far in enumerate(apart)]
                run = runs[name] = mock.MagicMock(frames=frames)
                run.setting.return_value = 1e-3
                run.frame.side_effect = lambda frame: frame
                run.column.return_value = np.array([1.0])
            with mock.patch.object(yarn_rest, "provenance", return_value={}):
                return yarn_rest.row_of("released", runs)

        words = ("distance, largest [m]", "distance while it moves, largest [m]")
        still, swings = (9e-4, 1e-4), (1e-4, 2e-3)
        self.assertEqual([row({"released": still, "hanging": still})[name] for name in words], ["0.005", ""])
        for ways in ({"released": swings, "hanging": still}, {"released": still, "hanging": swings}):
            self.assertEqual([row(ways)[name] for name in words], ["", "0.005"])

    def test_pairs_that_are_near_are_those_of_all_pairs(self):
        """Also of points in one plane, and of one point alone."""
        draw = np.random.default_rng(7)
        for points in (draw.random((300, 3)), draw.random((300, 3)) * (1, 1, 0), np.zeros((1, 3))):
            apart = np.linalg.norm(points[:, None] - points[None], axis=2)
            wanted = {(a, b) for a, b in zip(*np.nonzero(apart < 0.1)) if a < b}
            found = yarn_rest.near(points, 0.1)
            self.assertEqual({tuple(pair) for pair in found}, wanted)
            self.assertEqual(len(found), len(wanted), "none is there twice")

    def test_threads_that_slid_apart_are_counted_and_a_fold_is_not(self):
        """Two threads of 20 vertices beside each other; one of them slides half away; both turn about an axis."""
        thread = np.zeros((20, 3))
        thread[:, 0] = 1e-3 * np.arange(20)
        flat = np.concatenate((thread, thread + (0, 3e-3, 0)))
        slid, folded = flat.copy(), flat.copy()
        slid[30:, 1] += 1
        folded[:, [0, 2]] = folded[:, [2, 0]]

        def kept(positions):
            with mock.patch.object(yarn_rest, "last_frame", side_effect=lambda run: mock.Mock(positions=run)):
                return yarn_rest.kept_threads(positions, flat)

        self.assertEqual((kept(flat), kept(folded)), (1.0, 1.0))
        self.assertTrue(0.4 < kept(slid) < 0.6, kept(slid))

    def test_the_claim_reads_what_the_figure_writes(self):
        claims = json.loads((SOURCE / "paper_figures/claims/yarn_twist.json").read_text())["claims"]
        measure = next(claim for claim in claims if claim["id"] == "yarn_twist.returns_small")["measure"]
        self.assertEqual((measure["table"], measure["where"]), (yarn_rest.NAME, {"run": "released"}))
        self.assertIn(measure["column"], [f"distance, {words} [m]" for words in yarn_rest.SHARES])

    def test_the_claims_of_the_paper_read_a_case_that_there_is(self):
        claims = json.loads((SOURCE / "paper_figures/claims/yarn_twist.json").read_text())["claims"]
        of = [claim for claim in claims if claim["id"] in ("yarn_twist.returns", "yarn_twist.returns_stiffer")]
        frames = [Frame(k, 0.5 * k, np.eye(3), np.zeros((3, 3)), np.zeros(3)) for k in range(3)]
        run = mock.MagicMock(frames=frames, manifest={"scene": {"springs": 66}, "status": "finished", "ended": "e"})
        run.setting.return_value = 1e-3
        run.frame.side_effect = lambda frame: frame
        run.column.return_value = np.array([1.0])
        with mock.patch.object(yarn_return, "provenance", return_value={}):
            row = yarn_return.row_of(yarn_cases.Case(), run, run)
        self.assertEqual([row[name] for name in ("at rest", "distance, largest [m]")], ["yes", "0"])
        names = [case.name for case in yarn_return.cases("paper")]
        for claim in of:
            self.assertEqual(claim["measure"]["table"], yarn_return.NAME)
            self.assertIn(claim["measure"]["column"], row)
            for where in (claim["measure"]["where"], *(choice["where"] for choice in claim.get("choices", []))):
                self.assertIn(where["case"], names)
                self.assertLessEqual(set(where), set(row))


class Drawn(unittest.TestCase):
    def drawn(self, scene, rows):
        with tempfile.TemporaryDirectory() as name:
            words = ["yarn", name, "--ogc", str(OGC), "--scale", "smoke", "--scene", scene]
            with mock.patch.object(sys, "argv", words):
                options = yarn.arguments()
            with mock.patch.object(yarn.render, "available", return_value=(False, "left out here")):
                yarn.make(options)
                written = {path: path.stat().st_mtime_ns for path in Path(name).glob("*/steps.csv")}
                yarn.make(options)
            self.assertEqual(written, {path: path.stat().st_mtime_ns for path in Path(name).glob("*/steps.csv")})
            self.assertTrue((Path(name) / f"{yarn.FIGURE[scene]}.png").is_file())
            with (Path(name) / f"{yarn.FIGURE[scene]}.csv").open(newline="") as file:
                found = {row["run"]: row for row in csv.DictReader(file)}
            self.assertEqual(list(found), rows)
            return found

    def test_fig_15_from_the_smallest_runs(self):
        rows = [f"{kind}_{k}" for k in commands.YARN_STIFFNESS for kind in commands.YARN_KINDS]
        found = self.drawn(commands.STRETCH, rows)
        self.assertEqual({row["steps asked [1]"] for row in found.values()}, {"100"})
        self.assertEqual([found[f"ogc_{k}"]["meetings [1]"] for k in commands.YARN_STIFFNESS], ["0"] * 3)

    def test_fig_16_from_the_smallest_runs(self):
        rows = ["ogc", "ogc_released", "baseline", "baseline_released", "hanging"]
        found = self.drawn(commands.YARN_TWIST, rows)
        self.assertEqual((found["ogc_released"]["first step"], found["ogc_released"]["last step"]), ("101", "160"))
        self.assertGreater(float(found["ogc_released"]["distance while it moves, largest [m]"]), 0)
        self.assertEqual(found["hanging"]["distance, largest [m]"], "")

    def test_fig_16_at_rest_from_the_smallest_runs(self):
        with tempfile.TemporaryDirectory() as name:
            words = ["yarn_rest", name, "--ogc", str(OGC), "--scale", "smoke"]
            with mock.patch.object(sys, "argv", words):
                options = yarn_rest.arguments()
            yarn_rest.make(options)
            written = {path: path.stat().st_mtime_ns for path in Path(name).glob("*/steps.csv")}
            yarn_rest.make(options)
            self.assertEqual(written, {path: path.stat().st_mtime_ns for path in Path(name).glob("*/steps.csv")})
            self.assertTrue((Path(name) / f"{yarn_rest.NAME}.png").is_file())
            with (Path(name) / f"{yarn_rest.NAME}.csv").open(newline="") as file:
                rows = {row["run"]: row for row in csv.DictReader(file)}
            damping = {row: json.loads((Path(name) / row / "run.json").read_text())["settings"]["damping"]["value"]
                       for row in rows}
        self.assertEqual({name: row["beside"] for name, row in rows.items() if row["beside"]}, commands.AT_REST)
        self.assertEqual((rows["released"]["first step"], rows["hanging"]["first step"]), ("161", "1"))
        self.assertEqual({name for name, form in damping.items() if form == "per_vertex"},
                         {name for pair in commands.AT_REST.items() for name in pair})


if __name__ == "__main__":
    unittest.main()
