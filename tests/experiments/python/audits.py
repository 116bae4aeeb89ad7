"""Exact audits by the Python package: what intersects, what meets between frames, smallest distances, bad input.

Usage: audits.py BUILD_DIR. Exit status 77: skipped, a Python package is missing.
"""

import unittest

from package import counts_during, grid, main, prepare

prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

FACES = np.array([[0, 1, 2], [3, 4, 5]], dtype=np.int32)


def frames(*heights):
    """Returns a triangle and another one above it whose lowest corner is at these heights."""
    lower = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    upper = np.array([[0.2, 0.2, 0], [0.3, 0.2, 0.5], [0.2, 0.3, 0.5]])
    return np.array([np.vstack([lower, upper + [0, 0, height]]) for height in heights])


class Audits(unittest.TestCase):
    def test_find_the_frame_and_its_primitives(self):
        report = ogc.audit(frames(0.5, 0.25, -0.25, 0), FACES)
        self.assertEqual(report.counts.tolist(), [0, 0, 2, 3])
        self.assertEqual(report.intersecting[:, 0].tolist(), [2, 2, 3, 3, 3])
        # the two edges of the upper triangle's lowest corner, 3, pierce triangle 0; at height 0 the corner lies on it
        for _, kind, first, second in report.intersecting:
            self.assertEqual(second, 0)
            if kind == 0:
                self.assertIn(3, report.edges[first])
            else:
                self.assertEqual((kind, first), (1, 3))
        self.assertFalse(report.clean)
        self.assertIn("frame 3: vertex 3", report.describe())

    def test_measure_exactly(self):
        report = ogc.audit(frames(0.5, 0.25), FACES)
        self.assertEqual(report.distance_vertex_triangle.tolist(), [0.5, 0.25])
        self.assertEqual(report.distance_edge_edge.shape, (2,))
        self.assertTrue(report.clean)

    def test_prove_the_motion_between_frames(self):
        passed = frames(0.25, -1.25)
        self.assertTrue(ogc.audit(passed, FACES).clean)
        report = ogc.audit(passed, FACES, motion=True)
        self.assertEqual((report.counts.tolist(), report.clean), ([0, 0], False))
        self.assertEqual(report.meeting_counts.shape, (1,))
        self.assertEqual(len(report.meetings), len(report.meeting_times))
        first = report.meetings[np.argmin(report.meeting_times)]
        self.assertEqual(first.tolist(), [0, 0, 3, 0])  # vertex 3 meets triangle 0
        self.assertEqual(report.meeting_times.min(), np.nextafter(1 / 6, 0) if 1 / 6 * 6 > 1 else 1 / 6)
        self.assertTrue(ogc.audit(frames(0.25, 1), FACES, motion=True).clean)

    def test_take_numbers_as_they_are(self):
        """In double precision the corner is 10⁻¹² above the triangle; in single precision it lies on it, as 1 + 10⁻¹²
        is 1."""
        near = frames(1e-12) + [0, 0, 1]
        self.assertTrue(ogc.audit(near, FACES).clean)
        self.assertFalse(ogc.audit(near.astype(np.float32), FACES).clean)

    def test_leave_out_groups_and_take_loose_edges(self):
        groups = np.zeros(6, dtype=np.int32)
        self.assertTrue(ogc.audit(frames(-0.25), FACES, groups=groups).clean)
        edge = np.array([[3, 4]], dtype=np.int32)
        self.assertEqual(ogc.audit(frames(-0.25), FACES[:1], edges=edge).counts.tolist(), [1])

    def test_list_so_many_and_count_all(self):
        report = ogc.audit(frames(0), FACES, limit=1)
        self.assertEqual((len(report.intersecting), report.counts.tolist()), (1, [3]))

    def test_other_threads_run_meanwhile(self):
        x, faces = grid(40)
        self.assertGreater(counts_during(lambda: ogc.audit(x[None], faces)), 0)

    def test_frames_may_come_as_a_capsule(self):
        """A capsule of DLPack can be read once."""
        x, faces = grid(4)
        for dtype in (np.float32, np.float64):
            self.assertTrue(ogc.audit(x[None].astype(dtype).__dlpack__(), faces).clean)

    def test_a_simulation_is_clean(self):
        x, faces = grid(8, 0.2, 0.01)
        scene = ogc.Scene(dt=1 / 100, iterations=10, radius=5e-3)
        scene.add_cloth(x, faces, young=100)
        scene.add_fixed_body(np.array([[-1, 0, -1], [0, 0, 2], [2, 0, -1]], dtype=np.float32), FACES[:1])
        sim = scene.start()
        states = [sim.positions.cpu()]
        for _ in sim.run(steps=15):
            states.append(sim.positions.cpu())
        report = ogc.audit(np.stack(states), scene.faces)
        self.assertTrue(report.clean)
        self.assertLess(report.distance_vertex_triangle[-1], 5e-3)


class Errors(unittest.TestCase):
    def test_name_what_is_wrong(self):
        good = frames(1)
        for kind, words, call in (
                (TypeError, r"frames: float32 or float64 \(F, V, 3\)", lambda: ogc.audit(good[0], FACES)),
                (TypeError, "frames: .*int64", lambda: ogc.audit(good.astype(np.int64), FACES)),
                (TypeError, "faces: int32", lambda: ogc.audit(good, FACES.astype(np.int64))),
                (ValueError, "faces: row 1 names vertex 6", lambda: ogc.audit(good, FACES + np.int32([[0], [1]]))),
                (ValueError, "faces: row 0 names vertex 0 twice", lambda: ogc.audit(good, FACES * 0)),
                (ValueError, "groups: 2 came for 6", lambda: ogc.audit(good, FACES, groups=np.zeros(2, np.int32))),
                (ValueError, "not finite", lambda: ogc.audit(good + np.inf, FACES))):
            with self.assertRaisesRegex(kind, words):
                call()


if __name__ == "__main__":
    main()
