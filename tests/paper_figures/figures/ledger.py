"""The table of ledgers: its sums and shares are those counted by hand, and of real runs of a few steps (a sheet that
slides, layers that fall) a row a run, whose numbers are what the definitions allow; nothing is made twice.

Usage: ledger.py SOURCE_DIR OGC
"""

import csv
import importlib.util
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

OGC, SOURCE = Path(sys.argv.pop(2)).resolve(), Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.figures.measured import ledger  # noqa: E402
from paper_figures.workflow import commands, slide  # noqa: E402
from paper_figures.workflow.evidence import run_at  # noqa: E402
from paper_figures.workflow.jobs import Job  # noqa: E402

LEDGER = ("--ledger", "--audit", "end")


def made_up(folder, rows):
    """A run of `rows` (column -> numbers); columns that are left out are 0."""
    folder.mkdir(parents=True)
    bodies = [{"fixed": False, "vertex_count": 12, "prescribed_vertices": 2},
              {"fixed": True, "vertex_count": 5, "prescribed_vertices": 0}]
    (folder / "run.json").write_text(json.dumps(
        {"status": "finished", "commit": "0123456789abcdef", "device": "device", "backend": "cpu", "final_hash": "f",
         "guarantee_kept": True, "audited_states": "1", "scene": {"bodies": bodies}}))
    names = ["step", "discrete_detections", *(f"energy_{part}" for part in ledger.PARTS),
             *(f"momentum_{part}_{axis}" for part in ("start", *ledger.MOVERS) for axis in "xyz"), "motion_proposed",
             "motion_taken", "motion_taken_tangential", "motion_taken_leaving", "motion_taken_unpaired",
             "vertices_still", "vertices_held"]
    count = len(next(iter(rows.values())))
    table = {name: rows.get(name, [0] * count) for name in names}
    lines = [",".join(f"{name} [1]" for name in names), *(",".join(map(str, row)) for row in zip(*table.values()))]
    (folder / "steps.csv").write_text("\n".join(lines) + "\n")


class Known(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_sums_and_shares_are_those_counted_by_hand(self):
        made_up(self.folder / "twist_ball", {
            "step": [1, 2], "energy_guess": [1, -3], "energy_commit": [0.5, 0.25], "momentum_sweep_x": [1, 2],
            "momentum_sweep_y": [7, 7], "motion_proposed": [6, 10], "motion_taken": [0, 4],
            "motion_taken_tangential": [0, 3], "motion_taken_leaving": [0, 1], "vertices_still": [5, 0],
            "vertices_held": [1, 0], "discrete_detections": [1, 4]})
        run = ledger.finished(self.folder)["twist", "ball"]
        row = ledger.row_of("twist", "ball", run)
        self.assertEqual((row["free vertices"], row["steps"]), (10, 2))
        self.assertEqual((row["energy guess [J]"], row["energy commit [J]"], row["energy sweep [J]"]),
                         ("-2", "0.75", "0"))
        self.assertEqual(row["momentum sweep [kg m/s]"], "3")
        self.assertEqual([row[f"{name} [%]"] for name in ("taken of proposed motion", "tangential of taken",
                                                          "leaving of taken", "unpaired of taken", "still vertices",
                                                          "held vertices")], ["25", "75", "25", "0", "25", "5"])
        self.assertEqual(row["detections a step"], "2.5")

    def test_where_nothing_is_taken_there_is_nothing_to_share(self):
        made_up(self.folder / "slide_planes", {"step": [1], "motion_proposed": [2]})
        row = ledger.row_of("slide", "planes", ledger.finished(self.folder)["slide", "planes"])
        self.assertEqual((row["taken of proposed motion [%]"], row["tangential of taken [%]"]), ("0", ""))

    def test_a_panel_without_lines_says_why(self):
        nothing = "truncation takes nothing"
        self.assertEqual(ledger.note_on_shares({"ball": 0, "planes": 0.0}), nothing)
        self.assertEqual(ledger.note_on_shares({"ball": 2, "planes": 0}), f"{nothing} with planes")
        self.assertEqual(ledger.note_on_shares({"planes": 0}), nothing)
        self.assertEqual(ledger.note_on_shares({"ball": 2, "planes": 1}), "")

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "the picture needs matplotlib")
    def test_each_row_of_the_picture_says_whose_momentum_it_has_and_where_nothing_is_taken(self):
        taken = {"twist": ([1], [2]), "fifty_layers": ([1], [0]), "slide": ([0], [0])}
        for scene, by_bounds in taken.items():
            for bounds, column in zip(ledger.BOUNDS, by_bounds):
                made_up(self.folder / f"{scene}_{bounds}", {"step": [1], "motion_proposed": [4],
                                                            "motion_taken": column})
        figure = ledger.picture(ledger.finished(self.folder), "smoke")
        rows = [figure.axes[k:k + 4] for k in range(0, len(figure.axes), 4)]
        whose = [[text.get_text() for text in row[1].get_legend().get_texts() if text.get_text().startswith("momentum")]
                 for row in rows]
        self.assertEqual(whose, [["momentum of the cloth"], ["momentum of all layers"], ["momentum of the sheet"]])
        notes = [[text.get_text() for text in row[2].texts] for row in rows]
        self.assertEqual(notes, [[], ["truncation takes nothing with planes"], ["truncation takes nothing"]])

    def test_parts_of_a_course_hold_every_step_once(self):
        for count in (1, 7, 60, 719):
            parts = ledger.sums_of_parts(list(range(count)), min(60, count))
            self.assertEqual(sum(parts), count * (count - 1) // 2)


class Real(unittest.TestCase):
    def test_a_sheet_that_slides_without_friction_gains_what_gravity_gives_it_along_the_plane(self):
        """Nothing else acts along the plane: what is missing of M g sin h n at the end, truncation took in the guess
        loop, iterations that are not converged did, or rounding."""
        steps, side = 12, 6
        with tempfile.TemporaryDirectory() as name:
            folder, ended = Path(name), {}
            for bounds in ledger.BOUNDS:
                job = Job(f"slide_{bounds}", (*LEDGER, "--set", f"bounds={bounds}"), scene=slide.Slide(side, steps))
                job.make(str(OGC), folder)
                run = run_at(folder / job.name)
                self.assertTrue(run.guarantee_kept)
                at_end = sum(run.column(f"momentum_{part}_x")[-1] for part in ("start", *ledger.MOVERS))
                mass = slide.DENSITY * ((side - 1) * slide.SPACING)**2
                ended[bounds] = at_end / (mass * slide.ALONG * slide.TIME_STEP * steps)
                row = ledger.row_of("slide", bounds, run)
                self.assertEqual(row["free vertices"], side * side)
                self.assertTrue(all(math.isfinite(float(row[f"energy {part} [J]"])) for part in ledger.PARTS))
            # At these speeds, below r a step, no ball holds the sheet, either.
            for bounds, share in ended.items():
                self.assertAlmostEqual(share, 1, delta=0.01, msg=bounds)

    def test_the_jobs_are_a_run_a_scene_and_kind_of_bounds(self):
        jobs = [job for job in commands.ledgers("smoke", "cpu") if not job.name.endswith("_start")]
        self.assertEqual({job.name for job in jobs}, {f"{scene}_{bounds}" for scene in ledger.AXES
                                                      for bounds in ledger.BOUNDS})
        self.assertTrue(all("--ledger" in job.arguments for job in jobs))
        self.assertEqual(sum(job.scene is not None for job in jobs), 2)
        starts = {job.name for job in commands.ledgers("smoke", "cpu")} - {job.name for job in jobs}
        self.assertEqual({job.state[0] for job in jobs if job.state}, starts)
        self.assertEqual(len(starts), 4)

    def test_the_table_of_finished_runs_has_a_row_each(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            words = ("fifty_layers", "--scale", "smoke", "--steps", 6, *LEDGER)
            Job("fifty_layers_ball", words).make(str(OGC), folder)
            ledger.write(folder, ledger.finished(folder))
            with (folder / "ledger.csv").open(newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([(row["scene"], row["bounds"], row["steps"], row["audit"]) for row in rows],
                             [("fifty_layers", "ball", "6", "no intersection")])
            self.assertLess(float(rows[0]["momentum guess [kg m/s]"]), 0)


if __name__ == "__main__":
    unittest.main()
