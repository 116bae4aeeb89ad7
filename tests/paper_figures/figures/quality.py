"""Time to quality: times lie on lines between timed numbers of iterations; the first iteration at which a residual is
low enough tells the time, a step that never gets there has none; of runs that are missing or unfinished there is no
row; energies stand above those of Newton's method, or words say why there are none; the picture shows every row.

Usage: quality.py SOURCE_DIR
"""

import csv
import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.figures.measured import quality  # noqa: E402
from paper_figures.workflow import commands, parts  # noqa: E402
from paper_figures.workflow.jobs import ENDED_BY_TIME, Share  # noqa: E402

COUNTS = commands.QUALITY_ITERATIONS["twist"]  # 3, 10, 40


def made_up(folder, walls=(1.0,), residuals=(), energies=(), lag=0.0, status="finished", again=False):
    """A run; `again`: its last iteration has a second row, with the contacts found there."""
    folder.mkdir(parents=True)
    (folder / "run.json").write_text(json.dumps(
        {"status": status, "commit": "0123456789abcdef", "device": "device", "backend": "cpu",
         "scene": {"bodies": [], "vertices": 9}}))
    columns = ("elastic_energy [J]", "kinetic_energy [J]", "share_at_bound [1]", "discrete_detections [1]",
               "smallest_distance [m]", "left_residual [1]")
    rows = "".join(f"{8 + k},{wall},{lag},{2 + k},{4 + k},0.5,{k},{1 - k / 4},{'nan' if k else 0.25}\n"
                   for k, wall in enumerate(walls))
    (folder / "steps.csv").write_text(f"step [1],wall [ms],largest_lag [m],{','.join(columns)}\n{rows}")
    if residuals or energies:
        pairs = list(zip(residuals or [1] * len(energies), energies or [0] * len(residuals)))
        rows = "".join(f"8,{min(k, len(pairs) - 1 - again)},{residual},{energy}\n"
                       for k, (residual, energy) in enumerate(pairs))
        (folder / "iterations.csv").write_text(f"step [1],iteration [1],residual [1],energy [J]\n{rows}")


def step(folder, row, share, residuals, status="finished"):
    """Steps of 2, 3 and 9 ms, each after a slow one, and one with residuals."""
    counts = commands.QUALITY_ITERATIONS[commands.scene_of(row)]
    for n, ms in zip(counts, (2, 3, 9)):
        made_up(folder / row / f"timed_{n}_{share}", (9 * ms, ms, ms))
    left = [*residuals, *[residuals[-1]] * (counts[1] + 1 - len(residuals))]
    made_up(folder / row / f"left_{share}", residuals=left, status=status)


class Quality(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def rows(self, rows):
        quality.write(self.folder / "table.csv", rows)
        with (self.folder / "table.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def test_times_are_those_of_the_first_iteration_that_is_low_enough(self):
        step(self.folder, "twist", 25, [1, 0.5, 0.4, 0.3, 0.1, 0.2, 0.009])
        step(self.folder, "twist_planes", 50, [1, 1.5, 0.5])
        step(self.folder, "twist_planes", 75, [1, 0.001], status="running")
        first, second = self.rows([quality.row_of(step) for step in quality.watched(self.folder)])
        self.assertEqual([first[name] for name in ("scene", "bounds", "state after step", "few iterations [1]",
                                                   "the scene's iterations [ms]", "most iterations [ms]",
                                                   "residual after the scene's [1]", "least residual [1]")],
                         ["twist", "ball, r_q = r", "7", "3", "3", "9", "0.009", "0.009"])
        self.assertEqual([first["to a tenth [ms]"], first["to a hundredth [ms]"]],
                         [f"{2 + 1 / 7:.4g}", f"{2 + 3 / 7:.4g}"])
        self.assertEqual([second[name] for name in ("bounds", "least residual [1]", "to a tenth [ms]",
                                                    "no energy because")], ["planes", "0.5", "", quality.ABSENT])

    def test_before_the_first_timed_number_no_time_is_below_its_share_of_it(self):
        step(self.folder, "twist", 25, [1])
        watched, = quality.watched(self.folder)
        self.assertEqual([watched.time_at(k) for k in (0, 3, 10, 25, 40)], [2 - 3 / 7, 2, 3, 6, 9])
        watched.timed = {3: 1.0, 10: 9.0, 40: 10.0}
        self.assertEqual([watched.time_at(k) for k in (0, 1.5)], [0, 0.5])

    def test_energies_are_above_those_of_newtons_method_after_the_scenes_iterations(self):
        step(self.folder, "twist", 50, [1, 0.001])
        by_vbd = [9 - k / 2 for k in range(COUNTS[1] + 1)]
        made_up(self.folder / "twist/minimum_vbd_50", energies=by_vbd)
        newton = self.folder / "twist/minimum_newton_50"
        made_up(newton, energies=[9, 3.25, 3], again=True)

        def row():
            found, = self.rows([quality.row_of(step) for step in quality.watched(self.folder)])
            return [found[name] for name in ("energy above the minimiser [J]", "energy above, share of the start [1]",
                                             "minimum known within [J]", "no energy because")]

        self.assertEqual(row(), ["1", f"{1 / 6:.4g}", "0.25", ""])
        (newton / "run.json").write_text((newton / "run.json").read_text().replace("finished", "failed: Newton"))
        self.assertEqual(row(), ["", "", "", quality.FAILED])
        (newton / "run.json").write_text((newton / "run.json").read_text().replace("failed: Newton", "interrupted"))
        (newton / ENDED_BY_TIME).touch()
        self.assertEqual(row(), ["", "", "", quality.CUT_OFF])
        shutil.rmtree(newton)
        made_up(newton, energies=[9, 3])
        self.assertEqual(row(), ["1", f"{1 / 6:.4g}", "0", ""], "no contacts were found anew")
        shutil.rmtree(newton)
        made_up(newton, energies=[9, 3], lag=0.5)
        self.assertEqual(row(), ["", "", "", quality.LAGS])

    def test_whole_runs_have_a_row_each(self):
        made_up(self.folder / "twist/whole", (1.0, 3.0), lag=0.25)
        made_up(self.folder / "knot_planes/whole", status="running")
        row, = self.rows(quality.whole_rows(self.folder))
        self.assertEqual([row[name] for name in (
            "scene", "bounds", "steps", "mean [ms]", "worst [ms]", "largest lag [m]", "mean elastic energy [J]",
            "mean kinetic energy [J]", "at bound, mean [1]", "detections a step [1]", "smallest distance [m]",
            "left residual, median [1]")],
            ["twist", "ball, r_q = r", "2", "2", "3", "0.25", "2.5", "4.5", "0.5", "0.5", "0.75", "0.25"])

    def test_the_picture_has_a_mark_for_each_row_and_number_and_a_cross_for_what_is_never_reached(self):
        for row in ("twist", "twist_planes", "knot_planes"):
            step(self.folder, row, 25, [1, 0.5, 0.1])
        with mock.patch("plots.style.save") as kept:
            quality.draw(self.rows([quality.row_of(step) for step in quality.watched(self.folder)]), "smoke", None)
        (figure, _, title, *_), _ = kept.call_args
        self.assertIn("3 of 3 steps come down to a tenth of their force, 0 to a hundredth", title)
        marks = [sorted(line.get_marker() for line in axes.get_lines() if line.get_marker() in ("o", "x"))
                 for axes in figure.axes]
        self.assertEqual(marks, [["o"] * 3, ["x"] * 3, ["o"] * 3])
        self.assertEqual([label.get_text() for label in figure.axes[0].get_yticklabels()], ["twist", "knot"])

    def test_every_scene_has_both_bounds_and_three_parts(self):
        book = parts.book(parts.Wanted())
        for scene, counts in commands.QUALITY_ITERATIONS.items():
            rows = commands.quality_rows(scene)
            bounds = [commands.bounds_of(row).split(",")[0] for row in rows]
            self.assertEqual((bounds[0], bounds[-1], {commands.scene_of(row) for row in rows}),
                             ("ball", "planes", {scene}))
            self.assertEqual(sorted(counts), list(counts))
            self.assertEqual(len(book[f"quality_{scene}"].jobs), len(rows) * (1 + 3 * len(counts)))
            self.assertFalse(any(job.on_device for job in book[f"left_{scene}"].jobs))
            self.assertEqual(f"minimum_{scene}" in book, scene not in quality.WHY_NOT)

    def test_whole_runs_are_those_of_table_1_and_pack_the_states_of_minima(self):
        for row in set(commands.quality_rows("dress")) & set(commands.ROWS):
            mine, table = next(commands.timed(row, "paper", "cuda")), next(commands.whole_runs(row, "paper", "cuda"))
            self.assertEqual((mine.name, mine.arguments), (table.name, table.arguments))
            self.assertEqual(mine.begins, (Share(50, 3),))
        self.assertEqual(next(commands.timed("fifty_layers", "paper", "cuda")).begins, ())


if __name__ == "__main__":
    unittest.main()
