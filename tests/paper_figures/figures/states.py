"""What tables say of a state: a strip that lies on itself is one knot whose free part is its turn, one that is straight
is none; the pile's energy is that of the rows; times beside GIPC's are of the same steps; columns of Fig. 21's
distances are those of the vertices; and what a figure shows of a packed run is packed.

Usage: states.py SOURCE_DIR OGC. Exit status 77: skipped, NumPy or h5py is missing.
"""

import importlib
import runpy
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

SOURCE = Path(sys.argv[1]).resolve()
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    import numpy as np

    from paper_figures.figures import fig10_fifty_layers, fig21_activation_drop
    from paper_figures.figures.measured import gipc, knot, pile
    from paper_figures.workflow import parts
    from plots.scene_figure import NEAREST
    from ogc_testbed.runs import RunError
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

CELL, COLUMNS = 4e-3, 12  # of a strip as wide as the scene's


def strip(middle):
    """A strip whose rows lie across z at these points (x, y) of its middle."""
    z = CELL * (np.arange(COLUMNS) - (COLUMNS - 1) / 2)
    return np.concatenate([np.column_stack((np.full(COLUMNS, x), np.full(COLUMNS, y), z)) for x, y in middle])


class Knot(unittest.TestCase):
    def test_a_straight_strip_has_no_knot(self):
        found = knot.shape_of(strip([(CELL * i, 0) for i in range(200)]), 2e-3)
        self.assertEqual(list(found.values()), [0, "0", "0"])

    def test_a_strip_that_lies_on_itself_is_one_knot_and_its_turn_is_free(self):
        """80 rows there, half a circle of 20 cells, 80 rows back, 1.5 mm above the first half."""
        radius, turn = 20 * CELL / np.pi, 20
        there = [(CELL * i, 0.0) for i in range(80)]
        angles = np.pi * np.arange(1, turn) / turn
        round_it = [(CELL * 79 + radius * np.sin(a), radius * (1 - np.cos(a))) for a in angles]
        sink = [max(1.5e-3, 2 * radius * (1 - i / 20)) for i in range(80)]
        back = [(CELL * (79 - i), y) for i, y in enumerate(sink)]
        found = knot.shape_of(strip([*there, *round_it, *back]), 2e-3)
        self.assertEqual(found["knots [1]"], 1)
        # what is above or beside the turn touches nothing: the turn, and 20 rows that sink, on both sides
        free, whole = (float(found[f"{name} in knots [m]"]) for name in ("free strip", "strip"))
        self.assertAlmostEqual(free, CELL * (turn + 20) + np.hypot(CELL, 2 * radius / 20) * 20, delta=8 * CELL)
        self.assertGreater(whole, free + CELL * 110)

    def test_two_knots_far_apart_are_two(self):
        rows = [(CELL * i, 0.0) for i in range(60)]
        fold = [(CELL * (60 - i), 1.5e-3 if i > 3 else 0.4e-3 * i) for i in range(1, 50)]
        first = [*rows, *fold]
        far = [(x + 2.0, y) for x, y in first]
        self.assertEqual(knot.shape_of(strip([*first, *far]), 2e-3)["knots [1]"], 2)

    def test_another_order_of_vertices_is_refused(self):
        with self.assertRaisesRegex(RunError, "not numbered row by row"):
            knot.shape_of(strip([(CELL * i, 0) for i in range(20)])[:-1], 2e-3)


class Packed(unittest.TestCase):
    """A figure drawn from packed runs has each of its moments."""

    def moments(self, figure, scene):
        """The steps that a figure asks of a run, as shares of its last."""
        module, asked = importlib.import_module(f"paper_figures.figures.{figure}_{scene}"), []
        if hasattr(module, "STEPS"):
            asked = module.STEPS
        elif hasattr(module, "MIDDLE"):
            asked = (*module.WHOLE, *module.MIDDLE)
        else:
            with mock.patch("paper_figures.workflow.common.main", lambda _scene, steps, *_, **__: asked.extend(steps)):
                runpy.run_path(module.__file__, run_name="__main__")
        return [step / (100 if figure == "fig18" else max(asked)) for step in asked]

    def test_the_moments_of_figures_are_among_the_packed_frames(self):
        rows = {figure: (parts.commands.scene_of(row), frames) for row, (figure, frames) in parts.ROWS.items()
                if figure and row not in parts.SHOWN}
        self.assertEqual(sorted(rows), ["fig10", "fig11", "fig12", "fig13", "fig14", "fig18"])
        for figure, (scene, frames) in rows.items():
            for share in self.moments(figure, scene):
                nearest = round(share * (frames - 1)) / (frames - 1)
                # half of what a figure allows; a run's own frames may be as far from both
                self.assertLessEqual(abs(nearest - share), NEAREST / 2, f"{figure}: {share}")


class Layers(unittest.TestCase):
    def test_a_shorter_run_shows_the_moments_that_it_reaches_and_its_end(self):
        self.assertEqual(fig10_fifty_layers.moments(4800), [0, 240, 480, 960, 4800])
        self.assertEqual(fig10_fifty_layers.moments(9600), [0, 240, 480, 960, 4800])
        self.assertEqual(fig10_fifty_layers.moments(1200), [0, 240, 480, 960, 1200])
        self.assertEqual(fig10_fifty_layers.moments(300), [0, 240, 300])


class Pile(unittest.TestCase):
    def test_the_energy_is_that_of_the_rows_at_eighths_of_the_run(self):
        run = SimpleNamespace(column={"step": np.arange(1, 17), "kinetic_energy": np.arange(16) / 8}.__getitem__,
                              setting={"bounds": "ball", "time_step": 0.5}.__getitem__, require_finished=lambda: None,
                              manifest={"scale": "smoke", "status": "finished", "ended": "e"})
        with mock.patch.object(pile, "provenance", lambda _: {}):
            rows = pile.rows_of(run)
        self.assertEqual([row["step [1]"] for row in rows], [2, 4, 6, 8, 10, 12, 14, 16])
        self.assertEqual((rows[-1]["time [s]"], rows[-1]["kinetic energy [J]"]), ("8", "1.875"))


class Gipc(unittest.TestCase):
    THEIRS = [{"wall [ms]": str(wall), "newton_iterations [1]": "4"} for wall in (30, 50)]

    def run_of(self, *wall, friction=0):
        columns = {"wall": np.array(wall, float), "iterations": np.full(len(wall), 20.0)}
        scene = {"name": "mat_twist", "bodies": [{"material": {"friction": {"value": friction}}}]}
        return SimpleNamespace(column=columns.__getitem__, setting={"bounds": "planes"}.__getitem__, folder="mine",
                               manifest={"scale": "paper", "commit": "c" * 40, "scene": scene})

    def table(self, *runs):
        made_by = {"solver": "vbd", "backend": "cuda", "device": "card"}
        with mock.patch.object(gipc, "provenance", lambda _: dict(made_by)):
            return gipc.table(self.THEIRS, "46594e0", runs)

    def test_our_times_beside_gipcs_are_of_as_many_steps(self):
        theirs, ours = self.table(self.run_of(1, 3, 100))
        self.assertEqual((theirs["program"], theirs["version"], theirs["mean [ms]"], theirs["worst [ms]"]),
                         ("GIPC", "46594e0", "40", "50"))
        self.assertEqual((ours["steps"], ours["mean [ms]"], ours["worst [ms]"]), (2, "2", "3"))
        self.assertEqual(theirs["device"], ours["device"])

    def test_a_shorter_run_and_one_with_friction_are_refused(self):
        for run, said in ((self.run_of(1), "has 1 steps, GIPC's 2"),
                          (self.run_of(1, 3, friction=0.2), "has friction")):
            with self.assertRaisesRegex(RunError, said):
                self.table(run)


class Apart(unittest.TestCase):
    def test_columns_are_median_ninth_decile_and_largest_in_millimetres(self):
        def run(positions):
            return SimpleNamespace(frames=["last"], frame=lambda _: SimpleNamespace(positions=positions))

        zero, moved = np.zeros((11, 3)), np.zeros((11, 3))
        moved[:, 1] = 1e-3 * np.arange(11)
        found = fig21_activation_drop.apart(run(zero), run(moved))
        self.assertEqual(list(found.values()), ["5", "9", "10"])
        self.assertEqual(set(fig21_activation_drop.apart(None, run(moved)).values()), {""})


if __name__ == "__main__":
    unittest.main()
