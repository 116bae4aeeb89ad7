"""Arrays of torch, CuPy and Warp go in and out where they lie, on the streams of their libraries.

Usage: other_arrays.py BUILD_DIR. What is not installed is skipped; so is a device that is not there. Exit status 77:
skipped, nothing is there.
"""

import contextlib
import gc
import importlib.util
import sys
import unittest

from package import main, prepare, two_layers

prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

RADIUS, QUERY = 5e-3, 5e-2
HAS_DEVICE = ogc.backend_info("cuda")["usable"]
if not any(importlib.util.find_spec(name) for name in (["torch", "warp"] + ["cupy"] * HAS_DEVICE)):
    print("SKIPPED: none of torch, Warp and, with a device, CuPy is installed")
    sys.exit(77)


class Torch:
    """What the tests need of a library. `late` writes an array's content on the current stream, behind work that takes
    some 50 ms: whoever does not wait for the stream sees what was there before."""

    def __init__(self, backend):
        self.torch = importlib.import_module("torch")
        self.place = "cuda" if backend == "cuda" else "cpu"
        if backend == "cuda" and not self.torch.cuda.is_available():
            raise unittest.SkipTest("torch sees no device")

    def array(self, values):
        return self.torch.from_numpy(np.array(values)).to(self.place)

    def numpy(self, array):
        return array.cpu().numpy()

    def address(self, array):
        return array.data_ptr()

    def view(self, exporting):
        return self.torch.from_dlpack(exporting)

    @contextlib.contextmanager
    def stream(self):
        stream = self.torch.cuda.Stream()
        with self.torch.cuda.stream(stream):
            yield
        stream.synchronize()

    def late(self, to, source):
        blocks = [self.torch.empty(2**28, device="cuda") for _ in range(2)]
        for _ in range(100):
            blocks[0].copy_(blocks[1])
        to.copy_(source)


class CuPy:
    def __init__(self, backend):
        if backend == "cpu":
            raise unittest.SkipTest("CuPy has no arrays on the host")
        self.cupy = importlib.import_module("cupy")

    def array(self, values):
        array = self.cupy.empty(values.shape, values.dtype)
        array.set(np.ascontiguousarray(values))
        return array

    def numpy(self, array):
        return array.get()

    def address(self, array):
        return array.data.ptr

    def view(self, exporting):
        return self.cupy.from_dlpack(exporting)

    @contextlib.contextmanager
    def stream(self):
        stream = self.cupy.cuda.Stream(non_blocking=True)
        with stream:
            yield
        stream.synchronize()

    def late(self, to, source):
        blocks = [self.cupy.empty(2**28, np.float32) for _ in range(2)]
        for _ in range(100):
            blocks[0].data.copy_from_device_async(blocks[1].data, blocks[0].nbytes)
        to.data.copy_from_device_async(source.data, to.nbytes)


class Warp:
    def __init__(self, backend):
        self.warp = importlib.import_module("warp")
        self.warp.config.quiet = True
        self.place = "cuda:0" if backend == "cuda" else "cpu"

    def array(self, values):
        return self.warp.array(values, dtype=self.warp.float32, device=self.place)

    def numpy(self, array):
        return array.numpy()

    def address(self, array):
        return array.ptr

    def view(self, exporting):
        return self.warp.from_dlpack(exporting)

    @contextlib.contextmanager
    def stream(self):
        stream = self.warp.Stream(self.place)
        with self.warp.ScopedStream(stream):
            yield
        self.warp.synchronize_stream(stream)

    def late(self, to, source):
        blocks = [self.warp.empty(2**28, dtype=self.warp.float32, device=self.place) for _ in range(2)]
        for _ in range(100):
            self.warp.copy(blocks[0], blocks[1])
        self.warp.copy(to, source)


class OfArrays:
    """The tests of one library on one backend; `backend` and `library` are set by the classes below."""

    @classmethod
    def setUpClass(cls):
        if cls.backend == "cuda" and not HAS_DEVICE:
            raise unittest.SkipTest(ogc.backend_info("cuda")["description"])
        try:
            cls.arrays = cls.library(cls.backend)
        except ImportError as missing:
            raise unittest.SkipTest(str(missing)) from None
        cls.x, cls.faces = two_layers(16, 4e-3)
        cls.mesh = ogc.Mesh(cls.faces)
        cls.dx = np.random.default_rng(4).normal(0, 4e-3, cls.x.shape).astype(np.float32)

    def numbers(self, array):
        """Returns the numbers of one of our arrays, which is NumPy's on the host."""
        return array if isinstance(array, np.ndarray) else self.arrays.numpy(self.arrays.view(array))

    def guard(self):
        return ogc.Guard(self.mesh, self.x, QUERY, backend=self.backend)

    def test_contacts_are_those_of_numpy(self):
        expected = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY)
        sets = ogc.find_contacts(self.mesh, self.arrays.array(self.x), RADIUS, QUERY, backend=self.backend)
        self.assertEqual(sets.device, 0 if self.backend == "cuda" else None)
        for name in ("vertex_facet", "edge_edge_kind", "bound"):
            self.assertEqual(self.numbers(getattr(sets, name)).tobytes(), getattr(expected, name).tobytes(), name)

    def test_a_guard_reads_and_writes_where_arrays_lie(self):
        x, dx = self.arrays.array(self.x), self.arrays.array(self.dx)
        expected = ogc.Guard(self.mesh, self.x, QUERY, backend=self.backend).step(self.x, self.dx)
        guard, address = self.guard(), self.arrays.address(x)
        out = self.arrays.array(np.zeros_like(self.x))
        self.assertIs(guard.step(x, dx, out=out), out)
        self.assertEqual(self.arrays.numpy(out).tobytes(), expected.tobytes())
        guard.reset(x)
        self.assertIs(guard.step(x, dx, out=x), x)
        self.assertEqual((self.arrays.address(x), self.arrays.numpy(x).tobytes()), (address, expected.tobytes()))

    def test_of_other_types_are_refused_with_the_librarys_call(self):
        with self.assertRaisesRegex(TypeError, r"x: float32 \(V, 3\) .* came; pass "):
            ogc.find_contacts(self.mesh, self.arrays.array(self.x[:, :2]), RADIUS, QUERY, backend=self.backend)


    def test_a_state_is_read_where_it_lies(self):
        sim = ogc.scene("cloth_on_sphere", scale="smoke").start(backend=self.backend)
        sim.advance(2)
        view, expected = sim.positions, sim.snapshot().positions
        there, again = self.arrays.view(view), self.arrays.view(sim.positions)
        self.assertEqual(self.arrays.numpy(there).tobytes(), expected.tobytes())
        self.assertEqual(self.arrays.address(there), self.arrays.address(again))
        del again
        sim.advance(1)
        with self.assertRaisesRegex(BufferError, "overwritten"):
            self.arrays.view(view)
        there = self.arrays.view(sim.positions)
        expected = sim.positions.cpu().tobytes()
        del sim, view
        gc.collect()
        ogc.scene("cloth_on_sphere", scale="smoke").start(backend=self.backend).advance(3)
        self.assertEqual(self.arrays.numpy(there).tobytes(), expected, "it keeps its simulation")


class OnDevice(OfArrays):
    backend = "cuda"

    def test_a_state_that_another_stream_still_reads_is_not_overwritten(self):
        sim = ogc.scene("cloth_on_sphere", scale="smoke").start(backend="cuda")
        guard = ogc.Guard(ogc.Mesh(sim.faces), sim.positions.cpu(), QUERY, backend="cuda")
        dx = self.arrays.array(np.full_like(sim.positions.cpu(), 1e-6))
        out, start = self.arrays.array(sim.positions.cpu()), sim.snapshot()
        # A guard has two states in turn, so the second step overwrites the first one's start.
        for owner, overwrite in ((sim, lambda: sim.advance(5)), (sim, lambda: sim.restore(start)),
                                 (guard, lambda: [guard.step(guard.positions, dx, out=out) for _ in range(2)])):
            expected = owner.positions.cpu()
            copy = self.arrays.array(np.zeros_like(expected))
            with self.arrays.stream():
                self.arrays.late(copy, self.arrays.view(owner.positions))
                overwrite()
            self.assertEqual(self.arrays.numpy(copy).tobytes(), expected.tobytes())
            self.assertNotEqual(owner.positions.cpu().tobytes(), expected.tobytes())

    def test_views_lie_where_the_contacts_do_and_outlive_them(self):
        finder = ogc.ContactFinder(self.mesh, backend="cuda")
        sets = finder.find(self.arrays.array(self.x), RADIUS, QUERY)
        views = [self.arrays.view(sets.edge_edge) for _ in range(2)]
        self.assertEqual(*map(self.arrays.address, views))
        before = self.arrays.numpy(views[0]).tobytes()
        self.assertEqual(before, sets.cpu().edge_edge.tobytes())
        del sets
        gc.collect()
        for scale in (0.5, 1, 2):
            finder.find(self.arrays.array(self.x * np.float32(scale)), RADIUS, QUERY)
        self.assertEqual(self.arrays.numpy(views[1]).tobytes(), before)

    def test_a_new_array_is_of_the_same_library(self):
        x, dx = self.arrays.array(self.x), self.arrays.array(self.dx)
        out = self.guard().step(x, dx)
        self.assertIs(type(out), type(x))
        self.assertNotEqual(self.arrays.address(out), self.arrays.address(x))
        self.assertEqual(self.arrays.numpy(x).tobytes(), self.x.tobytes())
        self.assertEqual(self.arrays.numpy(out).tobytes(), self.guard().step(self.x, self.dx).tobytes())

    def test_what_another_stream_still_writes_is_waited_for(self):
        expected = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY)
        moved = self.guard().step(self.x, self.dx)
        finder, guard = ogc.ContactFinder(self.mesh, backend="cuda"), self.guard()
        x, dx = self.arrays.array(self.x), self.arrays.array(self.dx)
        with self.arrays.stream():
            late = self.arrays.array(np.zeros_like(self.x))
            self.arrays.late(late, x)
            sets = finder.find(late, RADIUS, QUERY)
            late_dx = self.arrays.array(np.zeros_like(self.x))
            self.arrays.late(late_dx, dx)
            out = guard.step(x, late_dx)
        self.assertEqual(sets.cpu().edge_edge.tobytes(), expected.edge_edge.tobytes())
        self.assertEqual(self.arrays.numpy(out).tobytes(), moved.tobytes())

    def test_what_the_default_stream_still_writes_is_waited_for(self):
        expected = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY).edge_edge.tobytes()
        x, late = self.arrays.array(self.x), self.arrays.array(np.zeros_like(self.x))
        self.arrays.late(late, x)
        self.assertEqual(ogc.find_contacts(self.mesh, late, RADIUS, QUERY, backend="cuda").cpu().edge_edge.tobytes(),
                         expected)

    def test_what_another_stream_still_reads_is_not_overwritten(self):
        x, dx = self.arrays.array(self.x), self.arrays.array(self.dx)
        copy = self.arrays.array(np.zeros_like(self.x))
        with self.arrays.stream():
            self.arrays.late(copy, x)
            self.guard().step(x, dx, out=x)
        self.assertEqual(self.arrays.numpy(copy).tobytes(), self.x.tobytes())

    def test_contacts_that_another_stream_still_reads_are_not_freed(self):
        finder, x = ogc.ContactFinder(self.mesh, backend="cuda"), self.arrays.array(self.x)
        expected = finder.find(x, RADIUS, QUERY).cpu().bound
        copy = self.arrays.array(np.zeros_like(expected))
        with self.arrays.stream():
            self.arrays.late(copy, self.arrays.view(finder.find(x, RADIUS, QUERY).bound))
            gc.collect()
            for _ in range(3):
                finder.find(self.arrays.array(self.x * np.float32(0.5)), RADIUS, QUERY)
        self.assertEqual(self.arrays.numpy(copy).tobytes(), expected.tobytes())


class TorchOnHost(OfArrays, unittest.TestCase):
    backend, library = "cpu", Torch


class WarpOnHost(OfArrays, unittest.TestCase):
    backend, library = "cpu", Warp


class TorchOnDevice(OnDevice, unittest.TestCase):
    library = Torch


class CuPyOnDevice(OnDevice, unittest.TestCase):
    library = CuPy


class WarpOnDevice(OnDevice, unittest.TestCase):
    library = Warp


if __name__ == "__main__":
    main()
