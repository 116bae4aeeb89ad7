"""The Python package on a CUDA device: arrays stay there, and the host's arrays give the same bits.

Usage: device.py BUILD_DIR. Exit status 77: skipped, there is no usable device, or a Python package is missing.
"""

import gc
import sys
import unittest

from package import main, prepare, two_layers

prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

if not ogc.backend_info("cuda")["usable"]:
    print(f"SKIPPED: {ogc.backend_info('cuda')['description']}")
    sys.exit(77)
from device_array import KEPT_ALIVE, DeviceArray  # noqa: E402

RADIUS, QUERY = 5e-3, 5e-2


class Device(unittest.TestCase):
    def setUp(self):
        self.x, self.faces = two_layers(16, 4e-3)
        self.mesh = ogc.Mesh(self.faces)

    def test_contacts_are_those_of_the_host(self):
        there = DeviceArray(self.x)
        host = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY)
        copied = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY, backend="cuda")
        stayed = ogc.find_contacts(self.mesh, there, RADIUS, QUERY, backend="cuda")
        self.assertGreater(len(host.vertex_facet), 100)
        for name in ("vertex_facet", "edge_edge"):
            self.assertEqual(getattr(host, name).tobytes(), getattr(copied, name).tobytes(), name)
        for name in ("vertex_facet", "edge_edge", "bound", "distance_edge"):
            self.assertEqual(getattr(copied, name).tobytes(), getattr(stayed, name).tobytes(), name)
        self.assertEqual(there.asked, 1)

    def test_a_guard_works_where_the_arrays_are(self):
        for bounds in ("ball", "planes"):
            with self.subTest(bounds):
                here, there = (ogc.Guard(self.mesh, self.x, QUERY, bounds=bounds, backend="cuda") for _ in range(2))
                x, y = self.x, DeviceArray(self.x)
                random, states = np.random.default_rng(4), [self.x]
                for _ in range(10):
                    dx = random.normal(0, 4e-3, x.shape).astype(np.float32)
                    x, y = here.step(x, dx), there.step(y, DeviceArray(dx))
                    self.assertEqual(y.numpy().tobytes(), x.tobytes())
                    self.assertEqual((here.lost, here.report.cut), (there.lost, there.report.cut))
                    states.append(x)
                self.assertGreater(here.report.cut, 0)
                self.assertTrue(ogc.audit(np.stack(states), self.faces, motion=True).clean)

    def test_forces_are_those_of_the_hosts_arrays(self):
        here, there = (ogc.ContactForces(self.mesh, self.x, RADIUS, 100, friction=0.3, backend="cuda")
                       for _ in range(2))
        x, y = DeviceArray(self.x), self.x + np.random.default_rng(5).normal(0, 1e-3, self.x.shape).astype(np.float32)
        here.find(self.x)
        there.find(x)
        expected = here.evaluate(y, self.x, 1e-2)
        out = (DeviceArray(np.ones_like(y)), DeviceArray(np.ones_like(y)), DeviceArray(np.ones((len(y), 6))))
        sums = there.evaluate(DeviceArray(y), x, 1e-2, out=out)
        guard = ogc.Guard(self.mesh, self.x, QUERY, radius=RADIUS, backend="cuda")
        guarded = here.evaluate(y, self.x, 1e-2, guard=guard)
        self.assertGreater(expected.energy, 0)
        self.assertEqual((sums.energy, guarded.energy), (expected.energy, expected.energy))
        for name, array in zip(("force", "friction", "block"), out):
            self.assertIs(getattr(sums, name), array)
            self.assertEqual(array.numpy().tobytes(), getattr(expected, name).tobytes(), name)
            self.assertEqual(getattr(guarded, name).tobytes(), getattr(expected, name).tobytes(), name)
        for words, out in (("out: a tuple of three", (x, x)), ("block: float32", (x, x, x)),
                           ("force: .* on a CUDA device is needed", (y, x, x))):
            with self.assertRaisesRegex(TypeError, words):
                there.evaluate(x, out=out)

    def test_it_writes_in_place(self):
        guard = ogc.Guard(self.mesh, self.x, QUERY, backend="cuda")
        x, dx = DeviceArray(self.x), DeviceArray(np.full_like(self.x, 1e-6))
        self.assertIs(guard.step(x, dx, out=x), x)
        self.assertEqual(x.numpy().tobytes(), (self.x + np.float32(1e-6)).tobytes())

    def test_arrays_are_let_go(self):
        guard = ogc.Guard(self.mesh, self.x, QUERY, backend="cuda")
        x, dx = DeviceArray(self.x), DeviceArray(np.zeros_like(self.x))
        for _ in range(10):
            guard.step(x, dx, out=x)
        gc.collect()
        self.assertEqual(len(KEPT_ALIVE), 0)

    def test_errors_name_the_place(self):
        there = DeviceArray(self.x)
        guard = ogc.Guard(self.mesh, self.x, QUERY, backend="cuda")
        for words, call in (
                ("x: .* on the host is needed, .* on a device", lambda: ogc.find_contacts(self.mesh, there, 1, 1)),
                ("dx: .* on a CUDA device is needed, .* on the host", lambda: guard.step(there, self.x)),
                ("dx: .* on the host is needed, .* on a device", lambda: guard.step(self.x, there))):
            with self.assertRaisesRegex(TypeError, words):
                call()
        with self.assertRaisesRegex(ValueError, "x: 3 rows came for 512"):
            ogc.find_contacts(self.mesh, DeviceArray(self.x[:3]), RADIUS, QUERY, backend="cuda")

    def test_a_simulation_runs_there(self):
        scene = ogc.scene("cloth_on_sphere", scale="smoke")
        sim = scene.start(backend="cuda")
        states = [sim.positions]
        for _ in range(3):
            sim.advance(10)
            states.append(sim.positions)
        groups = np.zeros(len(states[0]), np.int32) - 1
        groups[scene.bodies[1].vertices] = 0
        self.assertTrue(ogc.audit(np.stack(states), scene.faces, groups=groups).clean)
        self.assertGreater(sim.metrics.vertex_facet_contacts[-1], 0)


if __name__ == "__main__":
    main()
