"""The Python package on a CUDA device: arrays stay there, and the host's arrays give the same bits.

Usage: device.py BUILD_DIR [PROGRAM]. Without the program `ogc` a simulation is not compared with it. Exit status 77:
skipped, there is no usable device, or a Python package is missing.
"""

import functools
import gc
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from package import main, prepare, two_layers

_, PROGRAM = prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

if not ogc.backend_info("cuda")["usable"]:
    print(f"SKIPPED: {ogc.backend_info('cuda')['description']}")
    sys.exit(77)
from device_array import CUDA, KEPT_ALIVE, DeviceArray, Exported, free_memory  # noqa: E402

RADIUS, QUERY = 5e-3, 5e-2
COLUMNS = ("vertex_facet", "vertex_facet_kind", "edge_edge", "edge_edge_kind", "bound", "distance_vertex",
           "distance_edge", "distance_triangle")


class Device(unittest.TestCase):
    def setUp(self):
        self.x, self.faces = two_layers(16, 4e-3)
        self.mesh = ogc.Mesh(self.faces)

    def test_contacts_lie_where_the_positions_do(self):
        there = DeviceArray(self.x)
        host = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY)
        copied = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY, backend="cuda")
        stayed = ogc.find_contacts(self.mesh, there, RADIUS, QUERY, backend="cuda")
        self.assertEqual((there.asked, host.device, copied.device, stayed.device), (1, None, None, 0))
        self.assertGreater(len(host.vertex_facet), 100)
        self.assertIs(copied.cpu(), copied)
        back = stayed.cpu()
        for name in COLUMNS:
            expected, exported = getattr(host, name), Exported(getattr(stayed, name))
            self.assertEqual((exported.device, exported.shape), ((CUDA, 0), expected.shape), name)
            self.assertEqual(getattr(stayed, name).__dlpack_device__(), (CUDA, 0))
            for found in (exported.numbers, getattr(copied, name), getattr(back, name)):
                self.assertEqual((found.dtype, found.tobytes()), (expected.dtype, expected.tobytes()), name)
            self.assertEqual(Exported(getattr(stayed, name)).address, exported.address, "it is not copied")
        self.assertEqual({sets.smallest_distance for sets in (host, copied, stayed, back)}, {host.smallest_distance})

    def test_no_later_call_overwrites_contacts(self):
        finder = ogc.ContactFinder(self.mesh, backend="cuda")
        sets = finder.find(DeviceArray(self.x), RADIUS, QUERY)
        kept = [getattr(sets, name) for name in COLUMNS]
        first = [Exported(column) for column in kept]
        others = [finder.find(DeviceArray(self.x * np.float32(scale)), RADIUS, QUERY) for scale in (2, 0.5, 1)]
        self.assertEqual(len({Exported(found.bound).address for found in (sets, *others)}), 4)
        del sets, finder
        gc.collect()
        for column, before in zip(kept, first):
            now = Exported(column)
            self.assertEqual((now.address, now.numbers.tobytes()), (before.address, before.numbers.tobytes()))

    def test_contacts_are_let_go(self):
        """A find keeps about 30 kB; a leak would keep 30 MB of 1,000."""
        finder, there = ogc.ContactFinder(self.mesh, backend="cuda"), DeviceArray(self.x)
        before = 0
        for call in range(1100):
            sets = finder.find(there, RADIUS, QUERY)
            sets.bound, sets.edge_edge
            if call == 100:
                before = free_memory()
        del sets
        self.assertLess(before - free_memory(), 8 * 2**20)

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

    def test_what_only_says_that_it_is_there_is_refused(self):
        """A kernel that read the host's memory would end all work of the process on the device."""
        liar, guard = DeviceArray(self.x), ogc.Guard(self.mesh, self.x, QUERY, backend="cuda")
        right, liar.address = liar.address, self.x.ctypes.data
        try:
            for name, call in (("x", lambda: ogc.find_contacts(self.mesh, liar, RADIUS, QUERY, backend="cuda")),
                               ("x", lambda: guard.step(liar, DeviceArray(self.x), out=DeviceArray(self.x))),
                               ("dx", lambda: guard.step(DeviceArray(self.x), liar, out=DeviceArray(self.x))),
                               ("out", lambda: guard.step(DeviceArray(self.x), DeviceArray(self.x), out=liar))):
                with self.assertRaisesRegex(ValueError, f"^{name}: it is not in the memory of a CUDA device"):
                    call()
        finally:
            liar.address = right
        self.assertGreater(len(ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY, backend="cuda").vertex_facet), 0)

    def test_a_state_is_read_where_it_lies(self):
        scene = ogc.scene("cloth_on_sphere", scale="smoke")
        sim = scene.start(backend="cuda")
        for _ in range(2):
            sim.advance(5)
            state = sim.snapshot()
            for name in ("positions", "velocities"):
                view = getattr(sim, name)
                exported, expected = Exported(view), getattr(state, name)
                self.assertEqual((view.device, view.shape, view.__dlpack_device__()), (0, expected.shape, (CUDA, 0)))
                self.assertEqual((exported.device, exported.shape), ((CUDA, 0), expected.shape))
                self.assertEqual(exported.numbers.tobytes(), expected.tobytes(), name)
                self.assertEqual(view.cpu().tobytes(), expected.tobytes(), name)
                self.assertEqual(Exported(getattr(sim, name)).address, exported.address, "it is not copied")
                with self.assertRaisesRegex(TypeError, r"on a CUDA device; call view.cpu\(\)"):
                    np.asarray(view)
        view, mesh = sim.positions, ogc.Mesh(scene.faces)
        self.assertEqual(ogc.find_contacts(mesh, view, RADIUS, QUERY, backend="cuda").cpu().bound.tobytes(),
                         ogc.find_contacts(mesh, view.cpu(), RADIUS, QUERY).bound.tobytes())
        sim.advance(1)
        for read in (view.cpu, view.__dlpack__,
                     lambda: ogc.find_contacts(mesh, view, RADIUS, QUERY, backend="cuda")):
            with self.assertRaisesRegex(BufferError, "overwritten"):
                read()

    def test_a_view_keeps_its_simulation(self):
        sim = ogc.scene("cloth_on_sphere", scale="smoke").start(backend="cuda")
        sim.advance(5)
        alone = sys.getrefcount(sim)
        capsule = sim.positions.__dlpack__()
        self.assertEqual(sys.getrefcount(sim), alone + 1)
        del capsule
        self.assertEqual(sys.getrefcount(sim), alone)

    def test_simulations_are_let_go(self):
        scene, before = ogc.scene("cloth_on_sphere", scale="smoke"), 0
        for call in range(30):
            sim = scene.start(backend="cuda")
            sim.advance(1)
            Exported(sim.positions)
            del sim
            if call == 5:
                before = free_memory()
        self.assertLess(before - free_memory(), 8 * 2**20)

    def test_a_guard_lends_its_state(self):
        guard = ogc.Guard(self.mesh, self.x, QUERY, backend="cuda")
        dx, out = DeviceArray(np.full_like(self.x, 1e-6)), DeviceArray(self.x)
        view = guard.positions
        self.assertEqual((view.device, Exported(view).numbers.tobytes()), (0, self.x.tobytes()))
        self.assertIs(guard.step(view, dx, out=out), out)
        self.assertEqual(guard.positions.cpu().tobytes(), (self.x + np.float32(1e-6)).tobytes())
        with self.assertRaisesRegex(BufferError, "overwritten"):
            guard.step(view, dx, out=out)
        with self.assertRaisesRegex(TypeError, "out: .*read-only"):
            guard.step(guard.positions, dx, out=guard.positions)

    def test_a_simulation_runs_there(self):
        scene = ogc.scene("cloth_on_sphere", scale="smoke")
        sim = scene.start(backend="cuda")
        states = [sim.positions.cpu()]
        for _ in range(3):
            sim.advance(10)
            states.append(sim.positions.cpu())
        groups = np.zeros(len(states[0]), np.int32) - 1
        groups[scene.bodies[1].vertices] = 0
        self.assertTrue(ogc.audit(np.stack(states), scene.faces, groups=groups).clean)
        self.assertGreater(sim.metrics.vertex_facet_contacts[-1], 0)

    def test_worlds_run_there(self):
        scene = ogc.scene("cloth_on_sphere", scale="smoke")
        worlds, alone = scene.worlds(3, backend="cuda"), scene.start(backend="cuda")
        begin = worlds.snapshot(1)
        rows = worlds.advance([20, 12, 20])
        own = alone.advance(20)
        self.assertEqual((worlds.failures, [len(of_world) for of_world in rows]), ({}, [20, 12, 20]))
        self.assertGreater(own.vertex_facet_contacts[-1], 0)
        for world in (0, 2):
            self.assertEqual(worlds.snapshot(world).positions.tobytes(), alone.positions.cpu().tobytes(), world)
            self.assertEqual(rows[world].elastic_energy.tolist(), own.elastic_energy.tolist(), world)
        self.assertNotEqual(worlds.snapshot(1).positions.tobytes(), alone.positions.cpu().tobytes())
        worlds.reset(1, begin)
        worlds.advance([0, 20, 0])
        self.assertEqual(worlds.snapshot(1).positions.tobytes(), alone.positions.cpu().tobytes())

    @unittest.skipUnless(PROGRAM, "no program was named")
    def test_a_simulation_ends_where_the_program_ends(self):
        scene = ogc.scene("cloth_on_sphere", scale="smoke")
        sim = scene.start(backend="cuda")
        sim.advance(int(scene.settings["steps"]))
        with tempfile.TemporaryDirectory() as folder:
            words = "run cloth_on_sphere --scale smoke --backend cuda --json --out".split()
            done = subprocess.run([*PROGRAM, *words, Path(folder) / "run"], stdout=subprocess.PIPE, check=True)
        ours = functools.reduce(lambda hash, byte: (hash ^ byte) * 0x100000001B3 % 2**64, sim.positions.cpu().tobytes(),
                                0xCBF29CE484222325)  # FNV-1a
        self.assertEqual(f"{ours:016x}", json.loads(done.stdout)["final_hash"])


if __name__ == "__main__":
    main()
