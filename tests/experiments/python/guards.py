"""Guards of the Python package: random moves of a crowded state stay free of intersections, results lie where they are
asked for, and errors name what came.

Usage: guards.py BUILD_DIR. Exit status 77: skipped, a Python package is missing.
"""

import unittest

from package import counts_during, main, prepare, two_layers

prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

QUERY = 5e-2


def begin(bounds="planes", side=8):
    x, faces = two_layers(side, 2e-2)
    mesh = ogc.Mesh(faces)
    return mesh, x, faces, ogc.Guard(mesh, x, query_radius=QUERY, bounds=bounds)


class Guards(unittest.TestCase):
    def test_keep_random_moves_apart(self):
        for bounds in ("ball", "planes"):
            with self.subTest(bounds):
                _, x, faces, guard = begin(bounds)
                random = np.random.default_rng(2)
                states, cut = [x], 0
                for _ in range(20):
                    x = guard.step(x, random.normal(0, 2e-2, x.shape).astype(np.float32))
                    cut += guard.report.cut
                    states.append(x)
                self.assertGreater(cut, 20, "the moves are large enough to be cut")
                self.assertTrue(ogc.audit(np.stack(states), faces, motion=True).clean)

    def test_moves_within_the_region_are_taken_as_they_are(self):
        _, x, _, guard = begin()
        dx = np.full_like(x, 1e-5)
        y = guard.step(x, dx)
        self.assertEqual(y.tobytes(), (x + dx).tobytes())
        self.assertEqual((guard.report.cut, guard.lost, guard.most_restricted), (0, 0, -1))
        self.assertEqual(guard.positions.cpu().tobytes(), y.tobytes())

    def test_a_report_is_of_these_moves(self):
        _, x, _, guard = begin()
        dx = np.zeros_like(x)
        dx[5] = [0, 1, 0]
        y = guard.step(x, dx)
        report = guard.report
        self.assertEqual((report.cut, guard.most_restricted), (1, 5))
        self.assertEqual(report.asked, float((x + dx)[5, 1]) - float(x[5, 1]))  # of the rounded proposal
        lost = float(np.linalg.norm((x + dx - y)[5].astype(np.float64)))
        # sums in double of vectors of single precision: 2⁻²⁴ of each coordinate
        self.assertAlmostEqual(guard.lost, lost, delta=3 * 2.0**-24)
        self.assertAlmostEqual(report.most_lost, lost, delta=3 * 2.0**-24)

    def test_lend_their_state_until_it_is_overwritten(self):
        _, x, _, guard = begin()
        dx = np.full_like(x, 1e-5)
        view = guard.positions
        self.assertEqual(np.shares_memory(np.asarray(view), np.asarray(guard.positions)), True)
        guard.detect()
        self.assertEqual(view.cpu().tobytes(), x.tobytes())
        y = guard.step(view, dx)  # from the guard's own state
        self.assertEqual(y.tobytes(), (x + dx).tobytes())
        for overwrite in (lambda: guard.step(y, dx), lambda: guard.reset(x)):
            view = guard.positions
            overwrite()
            with self.assertRaisesRegex(BufferError, "overwritten"):
                np.asarray(view)
            with self.assertRaisesRegex(BufferError, "overwritten"):
                guard.step(view, dx)
        self.assertEqual(guard.positions.cpu().tobytes(), x.tobytes())

    def test_write_where_they_are_asked_to(self):
        _, x, _, guard = begin()
        dx = np.full_like(x, 1e-5)
        expected, out = x + dx, np.empty_like(x)
        self.assertIs(guard.step(x, dx, out=out), out)
        self.assertEqual(out.tobytes(), expected.tobytes())
        address = out.__array_interface__["data"]
        guard.step(out, dx, out=out)
        self.assertEqual(out.__array_interface__["data"], address)
        self.assertEqual(out.tobytes(), (expected + dx).tobytes())
        mine = guard.step(out, dx)
        self.assertTrue(mine.flags.writeable and mine.flags.c_contiguous and mine.base is not None)

    def test_other_threads_run_meanwhile(self):
        _, _, _, guard = begin(side=60)
        self.assertGreater(counts_during(guard.detect), 0)

    def test_reset_begins_anew(self):
        mesh, x, _, guard = begin()
        dx = np.random.default_rng(3).normal(0, 2e-2, x.shape).astype(np.float32)
        first = guard.step(x, dx)
        guard.reset(x)
        self.assertEqual(guard.step(x, dx).tobytes(), first.tobytes())
        guard.detect()
        self.assertEqual(guard.positions.cpu().tobytes(), first.tobytes())
        self.assertEqual(ogc.Guard(mesh, x, QUERY).step(x, dx).tobytes(), first.tobytes())

    def test_errors_name_what_came(self):
        mesh, x, _, guard = begin()
        frozen = x.copy()
        frozen.setflags(write=False)
        nan = x.copy()
        nan[2, 0] = np.nan
        view = guard.positions
        for kind, words, call in (
                (TypeError, r"dx: float32 \(V, 3\).*dx.astype", lambda: guard.step(x, x.astype(float))),
                (TypeError, "x: float32", lambda: guard.step(x[:, ::-1], x)),
                (TypeError, "out: .*read-only", lambda: guard.step(x, x, out=frozen)),
                (TypeError, "out: float32", lambda: guard.step(x, x, out=x.astype(float))),
                (ValueError, "dx: 127 rows came for 128", lambda: guard.step(x, x[1:])),
                (ValueError, "^x: vertex 2", lambda: guard.step(nan, x)),
                (ValueError, "^dx: vertex 2", lambda: guard.step(x, nan)),
                (ValueError, "^x: vertex 2", lambda: ogc.Guard(mesh, nan, QUERY)),
                (ValueError, "bounds.*'dat'", lambda: ogc.Guard(mesh, x, QUERY, bounds="dat")),
                (ValueError, "'plane'.*planes", lambda: ogc.Guard(mesh, x, QUERY, bounds="plane")),
                (ValueError, "query_radius", lambda: ogc.Guard(mesh, x, -1)),
                (ValueError, "query_radius is .*at least radius", lambda: ogc.Guard(mesh, x, QUERY, radius=2 * QUERY)),
                (ValueError, "backend", lambda: ogc.Guard(mesh, x, QUERY, backend="gpu"))):
            with self.assertRaisesRegex(kind, words):
                call()
        self.assertEqual(guard.positions.cpu().tobytes(), x.tobytes())
        self.assertEqual(view.cpu().tobytes(), x.tobytes(), "what is refused overwrites nothing")


if __name__ == "__main__":
    main()
