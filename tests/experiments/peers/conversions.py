"""Tests what the adapters of experiments/peers convert, without the peers: the shared conversions, the adapter of IPC
Toolkit and of Newton on fake modules with the same names, what trajectories.py converts, and the pairs of gaps.py.

Usage: conversions.py SOURCE_DIR. Exit status 77: skipped, NumPy is missing.
"""

import enum
import json
import math
import os
import re
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


def fake_warp():
    """Returns modules with the names that newton_adapter.py uses when it is loaded. Kernels are not run: tests replace
    its `launch`."""

    class Array:
        def __class_getitem__(cls, kind):
            return cls

    def kernel(module):
        return lambda function: types.SimpleNamespace(key=function.__name__, module=module)

    warp = types.ModuleType("warp")
    warp.array = warp.array2d = Array
    warp.vec2 = warp.vec3 = warp.vec4 = warp.mat22 = warp.mat33 = object()
    warp.config, warp.init = types.SimpleNamespace(), lambda: None
    warp.kernel, warp.load_module = kernel, lambda module, device: None
    geometry = types.ModuleType("newton._src.geometry.kernels")
    names = "VERTEX_A VERTEX_B VERTEX_C EDGE_AB EDGE_AC EDGE_BC FACE_INTERIOR"  # numbers of newton 1.8.0
    for number, name in enumerate(names.split()):
        setattr(geometry, f"TRI_CONTACT_FEATURE_{name}", number)
    geometry.triangle_closest_point = None
    vbd = types.ModuleType("newton._src.solvers.vbd.particle_vbd_kernels")
    modules = {"warp": warp, geometry.__name__: geometry, vbd.__name__: vbd}
    for name in ("newton", "newton._src", "newton._src.geometry", "newton._src.solvers", "newton._src.solvers.vbd"):
        modules[name] = types.ModuleType(name)
    modules["newton._src.geometry"].kernels = geometry
    modules["newton._src.solvers.vbd"].particle_vbd_kernels = vbd
    return modules


CALLS = {}
sys.modules.update(fake_warp())
sys.modules["ipctk"] = fake_ipctk(CALLS)
sys.modules["ogc_testbed"] = fake_testbed()
import ipctk_adapter as adapter  # noqa: E402
import newton_adapter as newton  # noqa: E402
import newton_steps as steps  # noqa: E402
import reports  # noqa: E402
import sets  # noqa: E402
import trajectories  # noqa: E402

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


VECTOR = (np.float32, 3)
STENCIL = {"vertex": (np.float32, (4, 3)), "own": np.int32, "stiffness": np.float32, "damping": np.float32}


def cases(**members):
    """Returns one case with these members: name=(type, value)."""
    case = np.zeros(1, [(name, *(kind if isinstance(kind, tuple) else (kind,))) for name, (kind, _) in members.items()])
    for name, (_, value) in members.items():
        case[name] = value
    return case


class Newton(unittest.TestCase):
    """What kernels of Newton get, and what becomes of their results."""

    def setUp(self):
        self.asked = []
        self.addCleanup(setattr, newton, "launch", newton.launch)
        self.addCleanup(setattr, newton, "OWN", newton.OWN)

    def answer(self, *results):
        def launch(kernel, count, arguments, outputs):
            self.asked.append((kernel.key, [a[0] if isinstance(a, tuple) else a for a in arguments]))
            return [np.array(r, np.float32) for r in results]
        newton.launch = launch

    def test_features_of_triangles(self):
        for name, number, feature in (("AB", 3, to.EDGE_01), ("AC", 4, to.EDGE_20), ("BC", 5, to.EDGE_12)):
            self.assertEqual(newton.FEATURES[number], feature, name)
        others = [newton.FEATURES[k] for k in (0, 1, 2, 6)]
        self.assertEqual(others, [to.CORNER_0, to.CORNER_1, to.CORNER_2, to.INTERIOR])

    def test_a_lower_bound_is_below_the_distance(self):
        def launch(kernel, count, arguments, outputs):
            return np.array([6]), np.array([[0.5, 0.25, 0.25]], np.float32), np.array([3], np.float32)
        newton.launch = launch
        _, _, distance, below = newton.closest_face(points([[0.25, 0.25, 3]]), CORNER)
        self.assertTrue(distance[0] * (1 - 24 * to.UNIT * 3) < below[0] < distance[0])

    def test_the_hinge_has_opposite_vertices_first_and_damping_times_stiffness(self):
        x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0.5]])
        case = cases(vertex=(STENCIL["vertex"], x), start=(STENCIL["vertex"], x), own=(np.int32, 3),
                     stiffness=(np.float32, 2), damping=(np.float32, 0.5), rest_angle=(np.float32, 0.25),
                     model=(np.int32, 1), damping_form=(np.int32, 0))
        self.answer(np.ones((1, 3)), np.arange(9).reshape(1, 3, 3))
        force, block = newton.bending(case)
        ((_, (pos, before, edges, order, angle, length, stiffness, damping)),) = self.asked
        np.testing.assert_array_equal(pos[edges[0]], x[[2, 3, 0, 1]])
        np.testing.assert_array_equal(before, pos)
        self.assertEqual((order[0], angle[0], length[0], stiffness[0], damping[0]), (1, 0.25, 1, 2, 1))
        np.testing.assert_array_equal(force, np.ones((1, 3)))
        np.testing.assert_array_equal(block[0], [0, 1, 2, 4, 5, 8])

    def test_the_membrane_is_asked_without_damping_alone(self):
        members = {"corner": ((np.float32, (3, 3)), np.eye(3)), "gradient": ((np.float32, (2, 2)), [[1, 2], [3, 4]]),
                   "area": (np.float32, 0.5), "lame_mu": (np.float32, 7), "lame_lambda": (np.float32, 9)}
        self.answer(np.ones((1, 3)), np.ones((1, 3, 3)))
        newton.membrane(cases(**members, model=(np.int32, 2), damping=(np.float32, 1)))
        self.assertEqual(self.asked, [])
        newton.membrane(cases(**members, model=(np.int32, 2), damping=(np.float32, 0)))
        ((_, (_, _, triangles, pose, area, mu, lam)),) = self.asked
        np.testing.assert_array_equal(triangles, [[0, 1, 2]])
        np.testing.assert_array_equal(pose[0], [[1, 2], [3, 4]])
        self.assertEqual((area[0], mu[0], lam[0]), (0.5, 7, 9))

    def contact(self, sides, own, height=0.5, **other):
        x = [[0.2, 0.2, height], [0, 0, 0], [1, 0, 0], [0, 1, 0]]
        if sides == to.EDGE_EDGE:
            x = [[-1, 0, height], [1, 0, height], [0, -1, 0], [0, 1, 0]]
        members = {"sides": (np.uint8, sides), "own": (np.int32, own), "vertex": (STENCIL["vertex"], x),
                   "previous": (STENCIL["vertex"], x), "rest_squared": ((np.float32, 2), [4, 4]),
                   "contact_radius": (np.float32, 1), "stiffness": (np.float32, 5), "activation": (np.int64, 0),
                   "together": (np.uint8, 0)}
        return cases(**{**members, **other})

    def test_contacts_have_newtons_order_of_vertices(self):
        for sides, own, order in ((to.POINT_TRIANGLE, 0, 3), (to.POINT_TRIANGLE, 2, 1), (to.EDGE_EDGE, 2, 2)):
            self.asked.clear()
            self.answer(np.ones((1, 3)), np.ones((1, 3, 3)))
            case = self.contact(sides, own)
            force, _ = newton.contact_force(case)
            ((_, (pos, mesh, asked_order, radius, stiffness, *_)),) = self.asked
            self.assertEqual((asked_order[0], radius[0], stiffness[0]), (order, 1, 5))
            rows = [mesh[0]] if sides == to.POINT_TRIANGLE else mesh[:, 2:]
            wanted = [case["vertex"][0, 1:]] if sides == to.POINT_TRIANGLE else case["vertex"][0].reshape(2, 2, 3)
            for row, points_ in zip(rows, wanted):
                np.testing.assert_array_equal(pos[row], points_)
            np.testing.assert_array_equal(force, np.ones((1, 3)))

    def test_contacts_that_newton_defines_otherwise_are_ours(self):
        self.answer()
        for case in (self.contact(to.POINT_POINT, 0), self.contact(to.POINT_TRIANGLE, 0, activation=(np.int64, 3)),
                     self.contact(to.POINT_TRIANGLE, 0, together=(np.uint8, 2))):
            force, block = newton.contact_force(case)
            self.assertTrue(np.isfinite(force).all() and np.isfinite(block).all())
        newton.OWN = True
        newton.contact_force(self.contact(to.POINT_TRIANGLE, 0, height=2.0))
        newton.contact_force(self.contact(to.POINT_TRIANGLE, 0, height=1e-6))
        self.assertEqual(self.asked, [])


class Contacts(unittest.TestCase):
    """The answers of conversions.py to what a peer is not asked are derivatives of the stage's energy."""

    def test_the_force_is_the_derivative_of_the_energy(self):
        rng = np.random.default_rng(2)
        for sides, first in ((to.POINT_POINT, 1), (to.POINT_EDGE, 1), (to.EDGE_EDGE, 2), (to.POINT_TRIANGLE, 1)):
            for _ in range(20):
                x = rng.uniform(-1, 1, (4, 3))
                x[:first, 2] += 2
                kind = [("sides", np.uint8), ("own", np.int32), ("vertex", float, (4, 3)), ("previous", float, (4, 3)),
                        ("rest_squared", float, 2), ("contact_radius", float), ("stiffness", float),
                        ("activation", np.int64), ("together", np.uint8)]
                case = np.zeros(1, kind)
                case["sides"], case["vertex"], case["previous"] = sides, x, x
                case["contact_radius"], case["stiffness"] = 5, 3
                for own in range({to.POINT_POINT: 2, to.POINT_EDGE: 3}.get(sides, 4)):
                    case["own"] = own
                    force = to.contact_force(case)[0][0]
                    for axis in range(3):
                        energy = []
                        for h in (-1e-6, 1e-6):
                            case["vertex"] = x
                            case["vertex"][0, own, axis] += h
                            d = to.contact(case)[2]
                            energy.append(to.activation(d, np.array([5.0]), np.array([3.0]), np.array([0]))[0][0])
                        case["vertex"] = x
                        # a difference quotient of a function whose second derivative may jump errs by 1e-6 times it
                        self.assertAlmostEqual(force[axis], -(energy[1] - energy[0]) / 2e-6, delta=1e-4)


class Steps(unittest.TestCase):
    """Newton's formulas in newton_steps.py against those of conversions.py, which find the nearest points otherwise."""

    def setUp(self):
        self.addCleanup(setattr, steps, "DOUBLE", steps.DOUBLE)
        rng = np.random.default_rng(5)
        self.x = rng.uniform(-1, 1, (300, 4, 3)).astype(np.float32)
        self.start = (self.x + rng.normal(scale=1e-2, size=self.x.shape)).astype(np.float32)

    def case(self, edges, own):
        kind = [("sides", np.uint8), ("own", np.int32), ("vertex", float, (4, 3)), ("previous", float, (4, 3)),
                ("rest_squared", float, 2), ("contact_radius", float), ("stiffness", float), ("activation", np.int64),
                ("together", np.uint8)]
        both = np.zeros(len(self.x), [("contact", kind), ("start", float, (4, 3)), ("friction", float),
                                      ("slip_limit", float)])
        part = both["contact"]
        part["sides"], part["own"] = to.EDGE_EDGE if edges else to.POINT_TRIANGLE, own
        part["vertex"] = part["previous"] = self.x
        part["contact_radius"], part["stiffness"] = 1, 5
        both["start"], both["friction"], both["slip_limit"] = self.start, 0.5, 0.01
        return both

    def test_in_double_forces_are_those_of_the_stage(self):
        steps.DOUBLE = list(steps.STEPS)
        for edges in (False, True):
            for own in range(4):
                case = self.case(edges, own)
                part, order = case["contact"], np.full(len(self.x), own)
                d = to.contact(part)[2]
                self.assertGreater(int((d < 1).sum()), 100)  # the others have no force; both branches are met
                self.assertGreater(int((d < 0.5).sum()), 20)
                numbers = part["contact_radius"], part["stiffness"]
                force, _ = steps.contact_force(self.x, edges, order, *numbers)
                np.testing.assert_allclose(force, to.contact_force(part)[0], atol=1e-9)
                force, _ = steps.friction_force(self.x, self.start, edges, order, *numbers, case["friction"],
                                                case["slip_limit"])
                np.testing.assert_allclose(force, to.friction_force(case)[0], atol=1e-9)

    def test_far_from_the_origin_a_point_at_rest_slips_but_by_displacements(self):
        far = self.x + np.float32(100)
        for choice, slips in (([], True), (["moves"], False)):
            steps.DOUBLE = choice
            *_, way = steps.contact(far, far, edges=False)
            self.assertEqual(bool(np.abs(way).max() > 0), slips)


class Sets(unittest.TestCase):
    def test_two_ways_to_the_distance_of_a_pair_agree(self):
        rng = np.random.default_rng(3)
        for _ in range(50):
            x = np.round(rng.uniform(-1, 1, (4, 3)), 2)
            of_triangle = -to.nearest_of_triangle(x[None, 0], x[None, 1:])[0], sets.exact_triangle(x[0], x[1:])
            of_edges = to.nearest_of_edges(x[None, :2], x[None, 2:])[0], sets.exact_edges(x[:2], x[2:])
            for weights, exact in (of_triangle, of_edges):
                if len(weights) == 3:
                    gap = x[0] + weights @ x[1:]
                else:
                    s, t = weights
                    gap = (1 - s) * x[0] + s * x[1] - (1 - t) * x[2] - t * x[3]
                # both are right to 2⁻⁵³ times the conditioning of the closest points, below 1e4 at two digits
                self.assertAlmostEqual(float(gap @ gap), float(exact), delta=1e-11)

    def test_pairs_that_share_a_vertex_are_none_and_the_radius_is_open(self):
        r = sets.RADIUS
        x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, r], [2, 2, 1], [3, 2, 1]])
        edges, of_triangles, of_edges = sets.pairs_of(x, np.array([[0, 1, 2], [3, 4, 5]]), 2.0**-53)
        self.assertEqual((len(edges), len(of_triangles), len(of_edges)), (6, 6, 9))
        self.assertFalse(of_triangles.near.any())  # at the radius
        x[3, 2] = np.nextafter(r, 0)
        near = sets.pairs_of(x, np.array([[0, 1, 2], [3, 4, 5]]), 2.0**-53)[1]
        self.assertEqual([(near.first[i], near.second[i]) for i in np.flatnonzero(near.near)], [(3, 0)])


class Reports(unittest.TestCase):
    def test_each_page_has_lines_and_what_they_print_and_a_row(self):
        table = (reports.HERE / "README.md").read_text(encoding="utf-8")
        pages = {path.stem for path in reports.HERE.glob("*.md")} - {"README"}
        self.assertEqual(pages, set(re.findall(r"^\| \[(\w+)\]\(\1\.md\)", table, re.MULTILINE)))
        for name in pages:
            self.assertIn(name.split("_")[0], sum(reports.PROJECTS.values(), ()))
            blocks = reports.BLOCK.findall((reports.HERE / f"{name}.md").read_text(encoding="utf-8"))
            self.assertEqual([kind for kind, _ in blocks], ["python", "text"], name)
            compile(blocks[0][1], name, "exec")

    def test_what_lines_print_is_compared(self):
        self.assertEqual(reports.printed("print('a')\nprint(1)\n"), "a\n1\n")


class Scenes(unittest.TestCase):
    def test_handles_turn_about_their_axis(self):
        scene = {"x": np.array([[0.0, 1, 0], [0, 0, 1]]), "settings": {"time_step": 0.25},
                 "bodies": [{"name": "cloth", "first": 0}],
                 "motions": [{"vertices": [{"body": "cloth", "indices": [1]}], "centre": [0, 0, 0], "axis": [1, 0, 0],
                              "angular_velocity": math.pi, "velocity": [0, 0, 0], "start": 0, "end": 0.5}]}
        index, targets = trajectories.handles(scene, 4)
        np.testing.assert_array_equal(index, [1])
        half = math.sqrt(0.5)
        np.testing.assert_allclose(targets[:, 0], [[0, -half, half], [0, -1, 0], [0, -1, 0], [0, -1, 0]], atol=1e-7)

    def test_stiffness_of_a_hinge_is_that_of_the_stage_over_its_length(self):
        x = np.array([[0.0, 1, 0], [0, -3, 0], [0, 0, 0], [2, 0, 0]])
        material = {"bending_stiffness": 5.0, "bending_damping": 0.5}
        rows = trajectories.bending_of(x, np.array([[0, 1, 2, 3], [0, -1, 2, 3]]), material)
        np.testing.assert_allclose(rows, [[3 * 5 * 4 / (1 + 3) / 2, 0.5 * 3 * 5 * 4 / (1 + 3) / 2], [0, 0]])

    def test_a_stored_state_stays_when_the_array_goes_on(self):
        memory = np.zeros(3)
        state = trajectories.copied(types.SimpleNamespace(numpy=lambda: memory[:]))
        memory += 1
        np.testing.assert_array_equal(state, 0)

    def test_a_mesh_comes_from_its_file(self):
        header = ("ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                  "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n")
        x, face = np.arange(9.0).reshape(3, 3), np.array([(3, [2, 0, 1])], [("n", "u1"), ("v", "<i4", 3)])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "a.ply")
            path.write_bytes(header.encode() + x.tobytes() + face.tobytes())
            vertices, triangles = trajectories.read_ply(path)
        np.testing.assert_array_equal(vertices, x)
        np.testing.assert_array_equal(triangles, [[2, 0, 1]])


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
