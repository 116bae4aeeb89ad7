"""Fig. 21 from small runs: every table and the picture; forces and curvature ratios are those that the program draws;
what is varied is told apart by name.

Usage: fig21_activation_drop.py SOURCE_DIR OGC. Exit status 77: skipped, matplotlib or h5py is missing.
"""

import csv
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    import numpy as np

    from paper_figures.figures import fig21_activation_drop
    from paper_figures.figures.measured import activation_load
    from paper_figures.workflow import accept, commands, contact_forces
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

SHOWN = ("ogc", "ipc_log", "ogc_as_printed", "ipc_log_kappa40", "ogc_weak")


class TwoTriangles:
    """A moving triangle 0.6 r above the middle of a fixed one, and another fixed one 0.5 r below that: r = 1."""

    def setting(self, name):
        return {"contact_radius": 1.0}[name]

    def bodies(self):
        return [
            {"fixed": fixed, "first_vertex": 3 * i, "vertex_count": 3, "triangles": np.array([[0, 1, 2]])}
            for i, fixed in enumerate((False, True, True))
        ]

    @property
    def frame(self):
        small, large = np.array([[0, 0], [0.1, 0], [0, 0.1]]), np.array([[-9, -9], [9, -9], [0, 9]])
        plane = ((small, 0.6), (large, 0.0), (large, -0.5))
        return SimpleNamespace(positions=np.array([[x, y, z] for points, y in plane for x, z in points], np.float32))


class Forces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.curves = fig21_activation_drop.curves(Path(holder.name), OGC)

    def test_forces_are_those_that_the_program_draws(self):
        for energy, force in contact_forces.FORCE.items():
            distance, drawn = self.curves["force"][energy]
            inside = distance < 1
            np.testing.assert_allclose(force(distance[inside]), drawn[inside], rtol=1e-9, atol=1e-12)

    def test_ratios_at_equal_force(self):
        ratios = {float(row["force [k_c r]"]): row for row in fig21_activation_drop.ratio_rows(self.curves["ratio"])}
        self.assertEqual(ratios[0.5]["curvature_ratio_kappa_1 [1]"], "3.35")
        self.assertEqual(ratios[0.02]["curvature_ratio_kappa_1 [1]"], "0.518")
        self.assertEqual(list(self.curves["ratio"]), [str(ratio) for ratio in commands.STIFFNESS_RATIOS])

    def test_ipc_is_the_softer_energy_below_a_fifteenth_and_above_four_thirds(self):
        """Where the curve of κ = 1 crosses 1: 0.0675 and 1.316."""
        force = np.array([0.06, 0.067, 0.068, 0.5, 1.31, 1.32, 90])
        found = contact_forces.Forces(force, contact_forces.ratio_at(force, self.curves["ratio"]["1"]))
        self.assertEqual(list(found.ratio < 1), [True, True, False, False, False, True, True])
        self.assertAlmostEqual(found.share_softer, 4 / 7)
        self.assertAlmostEqual(found.share_above_half, 3 / 7)
        self.assertEqual(found.counts.sum(), len(force))

    def test_contacts_between_fixed_bodies_are_none(self):
        found = contact_forces.distances(OGC, TwoTriangles(), TwoTriangles().frame)
        self.assertEqual(len(found), 3, "the moving triangle's vertices over the fixed one")
        np.testing.assert_allclose(found, 0.6, rtol=1e-6)


class Variants(unittest.TestCase):
    def test_no_two_runs_of_the_figure_share_a_folder_or_a_row(self):
        names = [job.name for chain in commands.activations("small", "cpu") for job in chain]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(len({variant.label for variant in commands.VARIANTS}), len(commands.VARIANTS))

    def test_kappa_multiplies_the_stiffness_of_the_run_beside_it(self):
        for variant in commands.VARIANTS:
            beside = commands.Variant("ogc", weak=variant.weak)
            self.assertEqual(variant.stiffness("small"), variant.ratio * beside.stiffness("small"))
        self.assertIn("contact_stiffness=400", commands.Variant("ipc_log", 40).options("paper"))
        self.assertNotIn(
            "contact_stiffness",
            " ".join(commands.Variant("ipc_log").options("paper")),
            "the scene's own k_c is the printed one",
        )


class Levels(unittest.TestCase):
    def test_the_first_iteration_at_a_level_counts_and_a_level_that_is_not_reached_is_never(self):
        """Newton has two rows of an iteration where contacts are detected to judge it."""
        rows = {"residual": np.array([1, 5e-3, 0.2, 9e-4]), "iteration": np.array([0, 1, 1, 2])}
        self.assertEqual(
            [fig21_activation_drop.first_below(rows, level) for level in (1e-2, 1e-3, 1e-4)], [1, 2, "never"]
        )


class Figure(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name) / "fig21-smoke-cpu"
        cls.folder.mkdir()
        left_out = [variant.name for variant in commands.VARIANTS if variant.name not in SHOWN]
        cls.picture = fig21_activation_drop.main(cls.folder, OGC, "smoke", without=left_out)
        cls.rows = {row["activation"]: row for row in cls.table("fig21")}

    @classmethod
    def table(cls, name):
        with (cls.folder / f"{name}.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def test_every_variant_has_a_row_and_what_was_left_out_says_so(self):
        self.assertTrue(self.picture.is_file())
        self.assertEqual(
            list(self.rows), [v.label for v in sorted(commands.VARIANTS, key=lambda v: v.name not in SHOWN)]
        )
        left_out = [v.label for v in commands.VARIANTS if v.name not in SHOWN]
        self.assertEqual(list(accept.left_out(self.folder)), left_out)

    def test_friction_and_contact_raise_the_condition_number(self):
        row = self.rows["ogc"]
        whole, normal, elastic = (float(row[f"{name}_at_end [1]"]) for name in fig21_activation_drop.CONDITIONS)
        self.assertGreater(whole, 1.5 * normal)
        self.assertGreater(normal, elastic)

    def test_every_solver_comes_to_every_level(self):
        for label in ("ogc", "ipc_log", "ipc_log, κ = 40", "ogc, weak contact"):
            for solver in ("newton", "vbd", "single_vbd"):
                found = [
                    int(self.rows[label][f"{solver}_iterations_to_{level} [1]"])
                    for level in fig21_activation_drop.LEVELS
                ]
                self.assertEqual(found, sorted(found))
                self.assertGreater(found[0], 0)

    def test_with_weak_contact_half_of_the_contacts_lie_above_half(self):
        self.assertGreaterEqual(float(self.rows["ogc, weak contact"]["share_above_half [1]"]), 0.5)
        self.assertLess(float(self.rows["ogc"]["share_above_half [1]"]), 0.1)

    def test_histograms_count_every_contact_once(self):
        for label in ("ogc", "ipc_log", "ipc_log, κ = 40", "ogc, weak contact"):
            counted = sum(int(row["contacts [1]"]) for row in self.table("fig21_forces") if row["activation"] == label)
            self.assertEqual(counted, int(self.rows[label]["contacts [1]"]))
            self.assertGreater(counted, 50)


class Load(unittest.TestCase):
    """Where both energies have the same curvature, or keep the same distance."""

    def test_the_logarithms_slope_and_curvature_are_those_of_its_energy(self):
        energy, step = lambda u: -((u - 1) ** 2) * np.log(u), 1e-4
        for u in (0.05, 0.3, 0.7, 0.95):
            low, here, high = (energy(u + shift) for shift in (-step, 0, step))
            self.assertAlmostEqual(activation_load.log_force(u), -(high - low) / (2 * step), delta=1e-3)
            self.assertAlmostEqual(activation_load.log_curvature(u), (high - 2 * here + low) / step**2, delta=1e-2)
            self.assertAlmostEqual(activation_load.distance_at(activation_load.log_force(u)), u, delta=1e-9)

    def test_equal_curvature_is_that_of_ours_at_that_force(self):
        for force, least in ((0.03, 0), (0.15, 0), (0.6, 2)):
            ratios = [activation_load.stiffer(force, ratio) for ratio in activation_load.RATIOS]
            self.assertGreater(min(ratios), least)
            place = activation_load.crossing(ratios, 1)
            self.assertEqual(place is None, least > 0, "a high load has no equal")
            if place is not None:
                self.assertAlmostEqual(activation_load.stiffer(force, np.exp(place)), 1, delta=0.05)

    def test_a_crossing_is_the_last_one(self):
        values = [3, 1, 3, 1, 1, 1, 1, 1]
        found = np.exp(activation_load.crossing(values, 2))
        self.assertTrue(activation_load.RATIOS[2] < found < activation_load.RATIOS[3])
        self.assertIsNone(activation_load.crossing(values, 4))


if __name__ == "__main__":
    unittest.main()
