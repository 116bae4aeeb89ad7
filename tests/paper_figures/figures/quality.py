"""Time to quality: the first iteration at which a residual is low enough tells the time, a step that never gets there
has none; of runs that are missing or unfinished there is no row; a picture has a panel a scene.

Usage: quality.py SOURCE_DIR
"""

import csv
import json
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.figures.measured import quality  # noqa: E402


def made_up(folder, residuals, status="finished"):
    """A step, and steps that are timed, of 2 ms an iteration; the first is slow."""
    folder.mkdir(parents=True)
    (folder / "run.json").write_text(json.dumps(
        {"status": status, "commit": "0123456789abcdef", "device": "device", "backend": "cpu",
         "scene": {"bodies": []}}))
    steps = "".join(f"{8 + k},{2 * (len(residuals) - 1) * factor}\n" for k, factor in enumerate((9, 1, 1)))
    (folder / "steps.csv").write_text(f"step [1],wall [ms]\n{steps}")
    kind, share = folder.name.rsplit("_", 1)
    if not kind.endswith("timed"):
        made_up(folder.parent / f"{kind}_timed_{share}", residuals, status)
    rows = "".join(f"8,{k},{2 * k},{residual}\n" for k, residual in enumerate(residuals))
    (folder / "iterations.csv").write_text(f"step [1],iteration [1],wall [ms],residual [1]\n{rows}")


class Quality(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_times_are_those_of_the_first_iteration_that_is_low_enough(self):
        made_up(self.folder / "twist/quality_25", [1, 0.5, 0.1, 0.2, 0.009])
        made_up(self.folder / "twist_planes/quality_50", [1, 1.5, 0.5])
        made_up(self.folder / "twist_planes/quality_75", [1, 0.001], status="running")
        steps = quality.watched(self.folder)
        quality.write(self.folder / "quality.csv", steps)
        with (self.folder / "quality.csv").open(newline="") as file:
            first, second = csv.DictReader(file)
        self.assertEqual([first[name] for name in ("scene", "bounds", "state after step", "iterations", "step [ms]",
                                                   "least residual [1]", "to a tenth [ms]", "to a hundredth [ms]")],
                         ["twist", "ball", "7", "4", "8", "0.009", "4", "8"])
        self.assertEqual([second[name] for name in ("bounds", "least residual [1]", "to a tenth [ms]")],
                         ["planes", "0.5", ""])

    def test_a_scene_has_a_panel_with_a_line_a_step(self):
        for row in ("twist", "twist_planes", "knot_planes"):
            made_up(self.folder / row / "quality_25", [1, 0.5, 0.1])
        panels = [axes for axes in quality.picture(quality.watched(self.folder), "smoke").axes if axes.get_visible()]
        curves = {axes.get_title(): sum(len(line.get_xdata()) == 2 and line.get_ydata()[0] == 0.5
                                        for line in axes.get_lines()) for axes in panels}
        self.assertEqual(curves, {"twist": 2, "knot": 1})

    def test_every_scene_that_has_iterations_to_watch_has_both_bounds(self):
        self.assertEqual(len(quality.commands.QUALITY_ROWS), 2 * len(quality.commands.QUALITY_ITERATIONS))


if __name__ == "__main__":
    unittest.main()
