"""Tests what the adapters of experiments/peers convert, without the peers: the shared conversions, the adapter of IPC
Toolkit on a fake module with the same names, and the pairs of gaps.py.

Usage: conversions.py SOURCE_DIR. Exit status 77: skipped, NumPy is missing.
"""

import enum
import json
import math
import os
import sys
import tempfile
import types
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

PEERS = Path(sys.argv.pop(1)).resolve() / "experiments/peers"
sys.path.insert(0, str(PEERS))
import conversions as to  # noqa: E402
import gaps  # noqa: E402


def fake_ipctk(calls):
    """Returns a module with the names that ipctk_adapter.py uses. Its functions note their arguments and return what
    `calls` holds."""
    module = types.ModuleType("ipctk")
    module.LoggerLevel = types.SimpleNamespace(off=0)
    module.set_logger_level = lambda level: None
    module.PointTriangleDistanceType = enum.Enum("P", "P_T0 P_T1 P_T2 P_E0 P_E1 P_E2 P_T AUTO")
    ends = "EA0_EB0 EA0_EB1 EA1_EB0 EA1_EB1 EA_EB0 EA_EB1 EA0_EB EA1_EB EA_EB AUTO"
    module.EdgeEdgeDistanceType = enum.Enum("E", ends)
    for name in ("TwoStageBarrier", "ClampedLogBarrier", "CubicBarrier"):
        def make(name=name):
            barrier = types.SimpleNamespace(first_derivative=lambda d, r: -1.0, second_derivative=lambda d, r: 3.0)
            return type(name, (), {"__call__": lambda self, d, r: 2.0, **vars(barrier)})
        made = make()
        made.first_derivative, made.second_derivative = staticmethod(lambda d, r: -1.0), staticmethod(lambda d, r: 3.0)
        setattr(module, name, made)

    def noted(name):
        def function(*arguments):
            calls.setdefault("asked", []).append((name, arguments))
            return calls[name]
        return function

    for name in ("point_triangle_distance_type", "point_triangle_distance", "point_triangle_closest_point",
                 "point_edge_closest_point", "edge_edge_distance_type", "edge_edge_distance", "edge_edge_closest_point",
                 "barrier", "barrier_first_derivative", "barrier_second_derivative"):
        setattr(module, name, noted(name))
    return module


def fake_testbed():
    module = types.ModuleType("ogc_testbed")
    module.kernel = lambda stage: lambda function: function
    return module


CALLS = {}
sys.modules["ipctk"] = fake_ipctk(CALLS)
sys.modules["ogc_testbed"] = fake_testbed()
import ipctk_adapter as adapter  # noqa: E402

FACES, EDGES = adapter.ipctk.PointTriangleDistanceType, adapter.ipctk.EdgeEdgeDistanceType


def points(rows):
    return np.array(rows, np.float32)


CORNER = points([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]])


class Ipctk(unittest.TestCase):
    def setUp(self):
        CALLS.clear()

    def test_distances_come_squared_and_edges_by_their_first_corner(self):
        CALLS.update(point_triangle_distance_type=FACES.P_E2, point_triangle_distance=9.0,
                     point_edge_closest_point=0.25)
        feature, weights, distance, below = adapter.closest_face(points([[0, 0, 3]]), CORNER)
        self.assertEqual(feature[0], to.EDGE_20)
        np.testing.assert_array_equal(weights[0], [0.25, 0, 0.75])  # from corner 2 to corner 0
        self.assertEqual(distance[0], 3)
        self.assertTrue(3 - 24 * to.UNIT * 8 < below[0] < 3)
        _, (_, start, end) = CALLS["asked"][-1]
        np.testing.assert_array_equal([start, end], [[0, 1, 0], [0, 0, 0]])

    def test_weights_of_the_interior(self):
        CALLS.update(point_triangle_distance_type=FACES.P_T, point_triangle_distance=1.0,
                     point_triangle_closest_point=(0.5, 0.125))
        feature, weights, *_ = adapter.closest_face(points([[0.5, 0.125, 1]]), CORNER)
        self.assertEqual(feature[0], to.INTERIOR)
        np.testing.assert_array_equal(weights[0], [0.375, 0.5, 0.125])

    def test_names_of_features_of_edges(self):
        self.assertEqual(adapter.EDGE_FEATURES[EDGES.EA1_EB], (to.END_1, to.EDGE_INTERIOR))
        self.assertEqual(adapter.EDGE_FEATURES[EDGES.EA_EB0], (to.EDGE_INTERIOR, to.END_0))
        self.assertEqual(len(adapter.EDGE_FEATURES), 9)

    def test_edges_at_an_end(self):
        CALLS.update(edge_edge_distance_type=EDGES.EA1_EB, edge_edge_distance=4.0, point_edge_closest_point=0.5)
        first, second, parallel, parameters, distance, _ = adapter.closest_points(
            points([[-1, 0, 2], [0, 0, 2]])[None], points([[0, -1, 0], [0, 1, 0]])[None])
        self.assertEqual((first[0], second[0], parallel[0], distance[0]), (to.END_1, to.EDGE_INTERIOR, 0, 2))
        np.testing.assert_array_equal(parameters[0], [1, 0.5])

    def test_a_parameter_at_the_end_is_the_end(self):
        CALLS.update(edge_edge_distance_type=EDGES.EA_EB0, edge_edge_distance=1.0, point_edge_closest_point=1.0)
        first, second, *_ = adapter.closest_points(points([[-1, 0, 0], [0, 0, 0]])[None],
                                                   points([[0, 0, 1], [0, 5, 1]])[None])
        self.assertEqual((first[0], second[0]), (to.END_1, to.END_0))

    def test_nearly_parallel_edges_have_the_judges_points_and_the_peers_distance(self):
        CALLS.update(edge_edge_distance_type=EDGES.EA0_EB, edge_edge_distance=0.25, point_edge_closest_point=0.5)
        first, second, parallel, parameters, distance, below = adapter.closest_points(
            points([[0, 0, 0], [1, 0, 0]])[None], points([[0.5, 1, 0], [1.5, 1, 0]])[None])
        self.assertEqual((first[0], second[0], parallel[0]), (to.EDGE_INTERIOR, to.EDGE_INTERIOR, 1))
        np.testing.assert_array_equal(parameters[0], [0.75, 0.25])
        self.assertEqual(distance[0], 1)
        self.assertLess(below[0], 0.5)

    def test_the_barrier_gets_squared_distances_without_the_thickness(self):
        CALLS.update(barrier=1.0, barrier_first_derivative=2.0, barrier_second_derivative=3.0)
        out = adapter.barrier(np.float32([0.5]), np.float32([1]), np.float32([0.5]))
        np.testing.assert_array_equal(np.ravel(out), [1, 2, 3])
        self.assertEqual(CALLS["asked"][0][1], (0.25, 2.0))  # D − ξ², d̂ (d̂ + 2 ξ)

    def test_the_activation_multiplies_by_the_stiffness_and_answers_what_the_peer_lacks(self):
        one = np.float32([0.1, 0.1])
        energy, slope, curvature = adapter.activation(one, np.float32([1, 1]), np.float32([5, 5]), np.array([0, 2]))
        np.testing.assert_array_equal([energy[0], slope[0], curvature[0]], [10, -5, 15])
        self.assertAlmostEqual(float(energy[1]), 5 / 2 * 0.9**2, places=5)


class Shared(unittest.TestCase):
    def test_a_truncated_position_is_inside_and_an_error_is_not_hidden(self):
        previous, bound = points([[0.3, 0.7, 0.1]]), np.float32([0.1])
        way = np.array([[0.6, 0.0, 0.8]])
        inside = to.truncated(previous, previous.astype(np.float64) + 0.1 * way, bound)
        self.assertLessEqual(np.linalg.norm(inside.astype(np.float64) - previous), float(bound[0]))
        outside = to.truncated(previous, previous.astype(np.float64) + 0.101 * way, bound)
        self.assertGreater(np.linalg.norm(outside.astype(np.float64) - previous), 0.1009)

    def test_touching_edges_have_the_lowest_features(self):
        cross = points([[-1, 0, 0], [1, 0, 0]]).astype(float)
        self.assertEqual(to.touching(cross, points([[0, 0, 0], [0, 1, 1]]).astype(float)), (to.EDGE_INTERIOR, 0))
        self.assertEqual(to.touching(points([[0, 1, 1], [1, 0, 0]]).astype(float), cross), (1, 1))
        self.assertIsNone(to.touching(cross, points([[0, -1, 0], [0, 1, 0]]).astype(float)))

    def test_an_overlap_in_a_point_is_none(self):
        first = np.array([[0.0, 0, 0], [1, 0, 0]])
        for start, holds in ((1.0, False), (1 - 2.0**-40, True)):
            second = np.array([[start, 1.0, 0], [2, 1, 0]])
            self.assertEqual(bool(to.nearly_parallel(first[None], second[None])[0][0]), holds)

    def test_the_hinge_is_the_derivative_of_its_energy(self):
        rng = np.random.default_rng(1)
        kind = np.dtype([("vertex", float, (4, 3)), ("start", float, (4, 3)), ("stiffness", float), ("own", int),
                         ("rest_angle", float), ("damping", float), ("damping_form", int)])
        case = np.zeros(1, kind)
        case["vertex"], case["start"] = rng.normal(size=(2, 1, 4, 3))
        case["stiffness"], case["rest_angle"], case["damping"], case["own"] = 2, 0.25, 0.5, 3
        at_start = to.dihedral(case["start"])[0]

        def energy(x):
            theta = to.dihedral(x)[0]
            return (theta - 0.25) ** 2 + 0.5 * (theta - at_start) ** 2

        theta, gradient, _ = to.dihedral(case["vertex"])
        force, block = to.hinge(theta, at_start, gradient[:, 3], case)
        for axis in range(3):
            step = np.zeros((1, 4, 3))
            step[0, 3, axis] = 1e-6
            slope = (energy(case["vertex"] + step) - energy(case["vertex"] - step)) / 2e-6
            # the difference quotient errs by (1e-6)² times third derivatives and 1e-16/1e-6 of the energy
            self.assertAlmostEqual(float(force[0, axis]), -float(slope[0]), delta=1e-7 * (1 + abs(float(slope[0]))))
        self.assertAlmostEqual(float(block[0, [0, 3, 5]].sum()), 3 * float((gradient[0, 3] ** 2).sum()), places=9)

    def test_our_activations_are_smooth_where_they_should_be(self):
        r = np.array([1.0])
        for kind in (0, 2, 3, 4):
            for d in (0.2, 0.7):
                k = np.array([kind])
                value = [to.activation(np.array([d + h]), r, r, k) for h in (-1e-6, 0, 1e-6)]
                for order in (0, 1):
                    slope = (value[2][order] - value[0][order]) / 2e-6
                    self.assertTrue(math.isclose(slope[0], value[1][order + 1][0], rel_tol=1e-6, abs_tol=1e-7), kind)

    def test_pairs_have_their_gap_and_the_seed_decides_them(self):
        pairs = gaps.questions(2, 1)
        self.assertEqual(len(pairs), 2 * len(gaps.SHAPES) * len(gaps.PLACES) * len(gaps.DECADES))
        for (shape, place, decade), x, triangles, dx in pairs:
            self.assertEqual(sorted(np.unique(triangles)), list(range(len(x))))
            lower, upper = x[: len(x) // 2], x[len(x) // 2 :]
            if place == "flat":  # the lower sheet is at or below z = 0, the upper one at or above the gap
                self.assertEqual(lower[:, 2].max(), 0)
                self.assertTrue(10.0**decade * (1 - 1e-6) <= upper[:, 2].min() <= 10.0 ** (decade + 1) * (1 + 1e-6))
            self.assertLessEqual(np.linalg.norm(dx, axis=1).max(), 0.3 * (1 + 1e-6))
        for one, same, other in zip(pairs, gaps.questions(2, 1), gaps.questions(2, 2)):
            np.testing.assert_array_equal(one[1], same[1])
            self.assertTrue((one[1] != other[1]).any())

    def test_the_log_counts_what_the_peer_was_asked(self):
        CALLS.clear()
        with tempfile.TemporaryDirectory() as folder:
            os.environ["OGC_PEERS_LOG"] = f"{folder}/log"
            self.addCleanup(os.environ.pop, "OGC_PEERS_LOG")
            one = np.float32([0.1, 0.1, 0.2])
            adapter.activation(one, np.float32([1, 1, 1]), np.float32([5, 5, 5]), np.array([0, 2, 4]))
            row = json.loads(Path(folder, "log").read_text())
        self.assertEqual(row, {"stage": "activation", "cases": 3, "asked": 2})


if __name__ == "__main__":
    unittest.main()
