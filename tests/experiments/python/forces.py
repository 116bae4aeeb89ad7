"""Forces of contacts of the Python package: laws that hold for every state, contacts of a guard, and errors that name
what came.

Usage: forces.py BUILD_DIR. Exit status 77: skipped, a Python package is missing.
"""

import unittest

from package import main, prepare, two_layers

prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

RADIUS, STIFFNESS = 2e-2, 100.0


def begin(**options):
    x, faces = two_layers(8, 1e-2)
    mesh = ogc.Mesh(faces)
    forces = ogc.ContactForces(mesh, x, RADIUS, STIFFNESS, **options)
    forces.find(x)
    return mesh, x, forces


def moved(x, size, seed=3):
    return x + np.random.default_rng(seed).normal(0, size, x.shape).astype(np.float32)


def matrices(block):
    return np.asarray(block, dtype=np.float64)[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)


class Forces(unittest.TestCase):
    def test_one_contact_has_the_numbers_of_the_law(self):
        x = np.array([[-4, 0, -4], [4, 0, -4], [0, 0, 6], [0, 0.25, 0], [0, 8, 1], [1, 8, 0]], dtype=np.float32)
        mesh = ogc.Mesh(np.array([[0, 1, 2], [3, 4, 5]], dtype=np.int32))
        forces = ogc.ContactForces(mesh, x, 0.375, 100, friction=0.3, friction_velocity=0.5)
        forces.find(x)
        start = x.copy()
        start[3, 0] -= 0.02  # beyond ε_v h = 0.005 m
        sums = forces.evaluate(x, start, dt=0.01)
        # λ = k_c (r − d) = 12.5 N; r − d is 1/8 exactly
        self.assertAlmostEqual(sums.energy, 0.5 * 100 * 0.125**2, places=5)
        self.assertEqual((sums.energy_vertex_facet, sums.energy_edge_edge), (sums.energy, 0))
        np.testing.assert_allclose(sums.force[3], [-0.3 * 12.5, 12.5, 0], rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(sums.friction[3], [-0.3 * 12.5, 0, 0], rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(sums.block[3], [0.3 * 12.5 / 0.02, 0, 0, 100, 0, 0.3 * 12.5 / 0.02], rtol=1e-5,
                                   atol=1e-4)
        self.assertEqual(np.count_nonzero(sums.force[4:]), 0)

    def test_the_force_is_minus_the_slope_of_the_energy(self):
        _, x, forces = begin()
        force = forces.evaluate(x).force.astype(np.float64)
        direction = np.random.default_rng(5).normal(size=x.shape)
        step = 2.0**-14
        ahead, behind = (x + np.float32(s * step) * direction.astype(np.float32) for s in (1, -1))
        way = ahead.astype(np.float64) - behind  # what the rounded positions are apart
        slope = forces.evaluate(ahead).energy - forces.evaluate(behind).energy
        work = -np.sum(force * way)
        # E's second order cancels; its third is bounded by the change of the work along the way
        bend = np.sum((forces.evaluate(ahead).force - 2 * force + forces.evaluate(behind).force) * way)
        # each energy is a float: 2⁻²⁴ of it for a few roundings
        rounding = 32 * 2.0**-24 * forces.evaluate(x).energy
        self.assertGreater(abs(work), 20 * rounding)
        self.assertAlmostEqual(slope, work, delta=abs(bend) + rounding)

    def test_forces_balance_and_blocks_are_semidefinite(self):
        _, x, forces = begin(friction=0.3)
        y = moved(x, 1e-3)
        for start, dt in ((None, 0.0), (x, 1e-2)):
            sums = forces.evaluate(y, start, dt)
            force = sums.force.astype(np.float64)
            size = np.abs(force).sum()
            self.assertGreater(size, 1)
            # weights, products and sums of at most 50 contacts err by 2⁻²⁴ each
            self.assertLess(np.abs(force.sum(axis=0)).max(), 64 * 2.0**-24 * size)
            lowest = np.linalg.eigvalsh(matrices(sums.block))[:, 0]
            self.assertGreater(lowest.min(), -64 * 2.0**-24 * np.abs(sums.block).max())
        self.assertLess(np.sum(sums.friction * (y - x)), 0)
        self.assertEqual(np.count_nonzero(forces.evaluate(y).friction), 0)

    def test_the_same_bits_again_and_from_a_guard(self):
        mesh, x, forces = begin(friction=0.3)
        y = moved(x, 1e-3)
        names = ("force", "friction", "block")
        first = forces.evaluate(y, x, 1e-2)
        guard = ogc.Guard(mesh, x, query_radius=5e-2, radius=RADIUS)
        fresh = ogc.ContactForces(mesh, x, RADIUS, STIFFNESS, friction=0.3)
        for sums in (forces.evaluate(y, x, 1e-2), fresh.evaluate(y, x, 1e-2, guard=guard)):
            self.assertEqual(sums.energy, first.energy)
            for name in names:
                self.assertEqual(getattr(sums, name).tobytes(), getattr(first, name).tobytes(), name)
        # after a detection of the guard, the contacts are those of its state
        state = guard.step(x, moved(x, 5e-3) - x)
        guard.detect()
        forces.find(state)
        self.assertEqual(forces.evaluate(state, guard=guard).force.tobytes(), forces.evaluate(state).force.tobytes())
        self.assertNotEqual(forces.evaluate(state).energy, first.energy)

    def test_vertices_that_are_updated_together_have_larger_blocks(self):
        _, x, alone = begin()
        _, _, together = begin(colours=np.zeros(len(x), dtype=np.int32))
        self.assertEqual(alone.evaluate(x).force.tobytes(), together.evaluate(x).force.tobytes())
        more = matrices(together.evaluate(x).block) - matrices(alone.evaluate(x).block)
        self.assertGreater(np.linalg.eigvalsh(more)[:, 0].min(), -1e-4 * STIFFNESS)
        self.assertGreater(np.trace(more.sum(axis=0)), 0.5 * np.trace(matrices(alone.evaluate(x).block).sum(axis=0)))

    def test_arrays_are_float32_and_outlive_their_object(self):
        _, x, forces = begin()
        force, block = (lambda sums: (sums.force, sums.block))(forces.evaluate(x))
        self.assertEqual((force.dtype, force.shape, block.dtype, block.shape),
                         (np.float32, x.shape, np.float32, (len(x), 6)))
        self.assertTrue(np.isfinite(force).all() and np.isfinite(block).all())

    def test_errors_name_what_came(self):
        mesh, x, forces = begin()
        nan = x.copy()
        nan[2, 0] = np.nan
        fresh = ogc.ContactForces(mesh, x, RADIUS, STIFFNESS)
        other = ogc.Guard(ogc.Mesh(mesh.triangles), x, 5e-2, radius=RADIUS)
        wide = ogc.Guard(mesh, x, 5e-2, radius=2 * RADIUS)

        def make(rest=x, radius=RADIUS, stiffness=STIFFNESS, **options):
            return ogc.ContactForces(mesh, rest, radius, stiffness, **options)

        for kind, words, call in (
                (TypeError, r"x: float32 \(V, 3\).*x.astype", lambda: forces.evaluate(x.astype(float))),
                (TypeError, "start: float32", lambda: forces.evaluate(x, x.astype(float), 1)),
                (TypeError, "rest: float32", lambda: make(rest=x.astype(float))),
                (TypeError, "colours: int32", lambda: make(colours=np.zeros(len(x)))),
                (TypeError, "out: only for arrays on a device", lambda: forces.evaluate(x, out=(x, x, x))),
                (ValueError, "x: 127 rows came for 128", lambda: forces.evaluate(x[1:])),
                (ValueError, "start: 127 rows came for 128", lambda: forces.evaluate(x, x[1:], 1)),
                (ValueError, "colours: 2 rows came for 128", lambda: make(colours=np.zeros(2, np.int32))),
                (ValueError, "colours: vertex 0 has -1", lambda: make(colours=np.full(len(x), -1, np.int32))),
                (ValueError, "^x: vertex 2", lambda: forces.evaluate(nan)),
                (ValueError, "^x: vertex 2", lambda: forces.find(nan)),
                (ValueError, "^start: vertex 2", lambda: forces.evaluate(x, nan, 1)),
                (ValueError, "^rest: vertex 2", lambda: make(rest=nan)),
                (ValueError, "^dt is 0", lambda: forces.evaluate(x, x)),
                (ValueError, "radius is -1", lambda: make(radius=-1)),
                (ValueError, "contact_stiffness is 0", lambda: make(stiffness=0)),
                (ValueError, "friction is -1", lambda: make(friction=-1)),
                (ValueError, "friction_velocity is 0", lambda: make(friction_velocity=0)),
                (ValueError, "'log'.*ipc_log", lambda: make(activation="log")),
                (ValueError, "backend", lambda: make(backend="gpu")),
                (ValueError, r"contacts: none were found: call find\(x\)", lambda: fresh.evaluate(x)),
                (ValueError, "guard: it has another Mesh", lambda: forces.evaluate(x, guard=other)),
                (ValueError, "guard: its radius is 0.04, but that of the forces is 0.02",
                 lambda: forces.evaluate(x, guard=wide))):
            with self.assertRaisesRegex(kind, words):
                call()
        with self.assertRaises(TypeError):
            forces.evaluate(x, guard=mesh)


if __name__ == "__main__":
    main()
