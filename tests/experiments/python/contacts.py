"""Contact sets by the Python package: the program's bits, no copies, no leaks, threads, and errors that name what came.

Usage: contacts.py BUILD_DIR PROGRAM. Exit status 77: skipped, a Python package is missing.
"""

import ctypes
import gc
import json
import resource
import subprocess
import tempfile
import threading
import unittest
import weakref
from pathlib import Path

from package import counts_during, grid, main, prepare, two_layers

_, (PROGRAM,) = prepare(__doc__)
import numpy as np  # noqa: E402

from device_array import ExchangeApi, Tensor, VersionedTensor, capsule_of  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

KINDS = ["vertex", "edge", "triangle"]
RADIUS, QUERY = 5e-3, 1e-2


def bits(sets):
    """Returns all that a detection found, as bytes."""
    names = ("vertex_facet", "vertex_facet_kind", "edge_edge", "edge_edge_kind", "bound", "distance_vertex",
             "distance_edge", "distance_triangle")
    return b"".join(getattr(sets, name).tobytes() for name in names)


def by_program(x, faces):
    """Returns what `ogc contacts --engine cpu --json` says of the mesh."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder) / "mesh.obj"
        lines = [f"v {a:.9g} {b:.9g} {c:.9g}" for a, b, c in x.tolist()]
        lines += [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
        mesh.write_text("\n".join(lines) + "\n")
        return json.loads(subprocess.check_output(
            [PROGRAM, "contacts", str(mesh), "--engine", "cpu", "--radius", str(RADIUS), "--query-radius", str(QUERY),
             "--json"], stderr=subprocess.DEVNULL))


def exchanging(x, major=1, fails=False, requires_grad=False, device=1, stream=0):
    """Returns an object with DLPack's C interface to x, whose `calls` say what it was asked for."""
    calls, shape = [], (ctypes.c_int64 * 2)(*x.shape)

    @ExchangeApi.GIVE
    def give(_, tensor):
        calls.append("give")
        if fails:
            return -1
        tensor[0] = ctypes.pointer(managed)
        return 0

    @ExchangeApi.STREAM
    def current_stream(_, __, found):
        calls.append("stream")
        found[0] = stream or None
        return 0

    @VersionedTensor.DELETER
    def let_go(_):
        calls.append("let go")

    managed = VersionedTensor(1, 1, None, let_go, 0,
                              Tensor(x.ctypes.data, device, 0, 2, 2, 32, 1, shape, (ctypes.c_int64 * 2)(3, 1), 0))
    api = ExchangeApi(major, 3, None, None, give, None, None, current_stream)

    class Offers:
        __dlpack_c_exchange_api__ = capsule_of(ctypes.addressof(api), b"dlpack_exchange_api")

        def __dlpack__(self, **_):
            calls.append("dlpack")
            return x.__dlpack__()

    offers = Offers()
    offers.calls, offers.requires_grad, offers.kept = calls, requires_grad, (managed, api, shape)
    return offers


class Bits(unittest.TestCase):
    def test_they_are_those_of_the_program(self):
        x, faces = two_layers(12, 4e-3)
        expected = by_program(x, faces)
        sets = ogc.find_contacts(ogc.Mesh(faces), x, RADIUS, QUERY)
        found = [(int(v), KINDS[kind], int(face), int(owner))
                 for (v, face, owner), kind in zip(sets.vertex_facet, sets.vertex_facet_kind)]
        self.assertGreater(len(found), 100)
        self.assertEqual(found, [(contact["vertex"], contact["face"]["kind"], contact["face"]["index"],
                                  contact["owner"]) for contact in expected["vertex_facet"]])
        found = [(KINDS[p_kind], int(p), KINDS[q_kind], int(q))
                 for (p, q, *_), (p_kind, q_kind) in zip(sets.edge_edge, sets.edge_edge_kind)]
        self.assertGreater(len(found), 100)
        self.assertEqual(found, [(contact["first"]["kind"], contact["first"]["index"], contact["second"]["kind"],
                                  contact["second"]["index"]) for contact in expected["edge_edge"]])
        for name, key in (("bound", "bound"), ("distance_vertex", "d_min_vertex"), ("distance_edge", "d_min_edge"),
                          ("distance_triangle", "d_min_triangle")):
            self.assertEqual(getattr(sets, name).tolist(), np.float32(expected[key]).tolist(), name)

    def test_smallest_distance_is_that_of_all_pairs(self):
        x, faces = two_layers(8, 4e-3)
        sets = ogc.find_contacts(ogc.Mesh(faces), x, RADIUS, QUERY)
        smallest = min(sets.distance_vertex.min(), sets.distance_edge.min(), sets.distance_triangle.min())
        self.assertEqual(sets.smallest_distance, smallest)
        self.assertLess(smallest, QUERY)
        alone, face = np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], dtype=np.int32)
        self.assertEqual(ogc.find_contacts(ogc.Mesh(face), alone, RADIUS, QUERY).smallest_distance, np.float32(QUERY))

    def test_groups_and_loose_edges_are_those_of_the_mesh(self):
        x, faces = two_layers(6, 4e-3)
        together = np.zeros(len(x), dtype=np.int32)
        self.assertEqual(len(ogc.find_contacts(ogc.Mesh(faces, groups=together), x, RADIUS, QUERY).edge_edge), 0)
        edges = np.array([[0, 36], [40, 41]], dtype=np.int32)
        mesh = ogc.Mesh(np.zeros((0, 3), dtype=np.int32), edges=edges, vertex_count=len(x))
        self.assertEqual(mesh.edges.tolist(), edges.tolist())
        self.assertEqual(len(ogc.find_contacts(mesh, x, RADIUS, QUERY).distance_edge), 2)


class Memory(unittest.TestCase):
    def test_results_lie_in_their_object_and_keep_it_alive(self):
        x, faces = two_layers(8, 4e-3)
        sets = ogc.find_contacts(ogc.Mesh(faces), x, RADIUS, QUERY)
        address = sets.bound.__array_interface__["data"]
        self.assertEqual(address, sets.bound.__array_interface__["data"])
        self.assertTrue(address[1], "read-only")
        bound, expected = sets.bound, sets.bound.copy()
        del sets
        gc.collect()
        self.assertEqual(bound.__array_interface__["data"], address)
        self.assertEqual(bound.tolist(), expected.tolist())
        with self.assertRaises(ValueError):
            bound[0] = 1

    def test_positions_are_read_where_they_lie(self):
        """A buffer that the test itself exports counts how often it is asked for, and where it lies."""
        x, faces = two_layers(8, 4e-3)
        asked = []

        class Watched:
            def __dlpack__(self, **options):
                asked.append(options)
                return x.__dlpack__()

            def __dlpack_device__(self):
                return x.__dlpack_device__()

        mesh = ogc.Mesh(faces)
        expected = bits(ogc.find_contacts(mesh, x, RADIUS, QUERY))
        self.assertEqual(bits(ogc.find_contacts(mesh, Watched(), RADIUS, QUERY)), expected)
        self.assertEqual(len(asked), 1)
        self.assertFalse(any(options.get("copy") for options in asked))
        frozen = x.copy()
        frozen.setflags(write=False)
        self.assertEqual(bits(ogc.find_contacts(mesh, frozen, RADIUS, QUERY)), expected)

    def test_nothing_leaks_in_ten_thousand_calls(self):
        """The peak of memory after the first 1,000 calls is that of all. A leak of one bound or one set a call would
        add more than 9,000 · 36 · 4 bytes."""
        x, faces = two_layers(6, 4e-3)
        mesh = ogc.Mesh(faces)
        for _ in range(1000):
            ogc.find_contacts(mesh, x, RADIUS, QUERY).bound.sum()
        gc.collect()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(9000):
            ogc.find_contacts(mesh, x, RADIUS, QUERY).bound.sum()
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 9000 * 36 * 4 // 1024)

    def test_a_finder_keeps_its_mesh(self):
        x, faces = two_layers(6, 4e-3)
        finder = ogc.ContactFinder(ogc.Mesh(faces))
        gc.collect()
        self.assertEqual(bits(finder.find(x, RADIUS, QUERY)),
                         bits(ogc.find_contacts(ogc.Mesh(faces), x, RADIUS, QUERY)))

    def test_an_argument_is_let_go(self):
        x, faces = two_layers(6, 4e-3)

        class Array(np.ndarray):
            pass

        mine = x.view(Array)
        gone = weakref.ref(mine)
        ogc.find_contacts(ogc.Mesh(faces), mine, RADIUS, QUERY)
        del mine
        gc.collect()
        self.assertIsNone(gone())


class Threads(unittest.TestCase):
    def test_finders_in_threads_give_the_bits_of_one(self):
        states = [two_layers(10, 4e-3, seed) for seed in range(2)]
        expected = [bits(ogc.find_contacts(ogc.Mesh(faces), x, RADIUS, QUERY)) for x, faces in states]
        shared = ogc.Mesh(states[0][1])  # one mesh for both, and a finder for each
        finders = [ogc.ContactFinder(ogc.Mesh(faces)) for _, faces in states]
        wrong = []

        def work(i):
            x, _ = states[i]
            for _ in range(50):
                if bits(finders[i].find(x, RADIUS, QUERY)) != expected[i]:
                    wrong.append(i)
                if bits(ogc.find_contacts(shared, x, RADIUS, QUERY)) != expected[i]:
                    wrong.append(i)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_other_threads_run_during_a_call(self):
        x, faces = two_layers(120, 4e-3)
        mesh = ogc.Mesh(faces)
        self.assertGreater(counts_during(lambda: ogc.find_contacts(mesh, x, RADIUS, QUERY)), 0)
        self.assertGreater(counts_during(lambda: ogc.Mesh(faces)), 0)


class Errors(unittest.TestCase):
    def setUp(self):
        self.x, self.faces = two_layers(6, 4e-3)
        self.mesh = ogc.Mesh(self.faces)

    def expect(self, kind, words, call, *arguments, **named):
        with self.assertRaises(kind) as raised:
            call(*arguments, **named)
        for word in words:
            self.assertIn(word, str(raised.exception))

    def test_of_arrays_name_argument_what_came_and_remedy(self):
        x, n = self.x, len(self.x)
        for bad, came, remedy in (
                (x.astype(np.float64), f"float64 ({n}, 3)", "x.astype(np.float32)"),
                (x.astype(np.float16), f"float16 ({n}, 3)", "x.astype(np.float32)"),
                (x.astype(">f4"), "of >f4", "x.astype(np.float32)"),
                (x.astype(np.complex64), f"complex64 ({n}, 3)", "x.astype(np.float32)"),
                (x[:, :2], f"float32 ({n}, 2)", "shape (V, 3)"),
                (x.ravel(), f"float32 ({3 * n},)", "shape (V, 3)"),
                (x[None], f"float32 (1, {n}, 3)", "shape (V, 3)"),
                (x[::2], "in another order", "np.ascontiguousarray(x)"),
                (np.asfortranarray(x), "in another order", "np.ascontiguousarray(x)"),
                (np.zeros((n, 4), np.float32)[:, :3], "in another order", "np.ascontiguousarray(x)"),
                (x.tolist(), "type list", "np.asarray(x, dtype=np.float32)"),
                ("x", "type str", "np.asarray(x, dtype=np.float32)"),
                (None, "type NoneType", "np.asarray(x, dtype=np.float32)")):
            with self.subTest(came):
                self.expect(TypeError, ("x: float32 (V, 3)", came, remedy), ogc.find_contacts, self.mesh, bad, RADIUS,
                            QUERY)
        self.expect(TypeError, ("triangles: int32 (T, 3)", "int64 (50, 3)", "triangles.astype(np.int32)"), ogc.Mesh,
                    self.faces[:50].astype(np.int64))
        self.expect(TypeError, ("edges: int32 (E, 2)", "edges.astype(np.int32)"), ogc.Mesh, self.faces,
                    edges=np.zeros((1, 2)))
        self.expect(TypeError, ("groups: int32 (V,)", "np.asarray(groups"), ogc.Mesh, self.faces, groups=[1, 2])

    def test_of_arrays_that_lie_or_raise(self):
        """Each of these once ended the process, or would have read what is not there."""
        x, n = self.x, len(self.x)
        odd = np.frombuffer(b"\0" + x.tobytes(), np.uint8)[1:].view(np.float32).reshape(x.shape)

        class Raises:
            __module__ = "\udc80"  # has no UTF-8
            dtype = requires_grad = property(lambda self: 1 / 0)

            def __dlpack__(self, **_):
                raise MemoryError

        class Changes:
            """Offers less the second time."""

            def __init__(self):
                self.given = [x.copy(), x[:1].copy()]

            def __dlpack__(self, **_):
                return self.given.pop(0).__dlpack__()

            def __dlpack_device__(self):
                return 1, 0

        for bad, words in (
                ((ctypes.c_float * 9)(), ("float32 (9,)", "shape (V, 3)")),
                (odd, ("at an odd address", "x.copy()")), (Raises(), ("type Raises",)), (np.ndarray, ("type type",)),
                (np.zeros((2**40, 0, 3), np.float32), (f"({2**40}, 0, 3)",))):
            with self.subTest(words=words):
                self.expect(TypeError, ("x: float32 (V, 3)", *words), ogc.find_contacts, self.mesh, bad, RADIUS, QUERY)
        guard = ogc.Guard(self.mesh, x, QUERY)
        self.assertEqual(len(guard.step(x, np.zeros_like(x), out=Changes()).given), 1, "it is asked once")
        frozen = x.copy()
        frozen.setflags(write=False)
        self.expect(TypeError, ("out:", "read-only", "can be written"), guard.step, x, x, out=frozen)
        capsule = x.__dlpack__()
        self.assertEqual(len(ogc.find_contacts(self.mesh, capsule, RADIUS, QUERY).bound), n)
        self.expect(TypeError, ("type PyCapsule",), ogc.find_contacts, self.mesh, capsule, RADIUS, QUERY)
        last = np.array([[0, 1, 2**31 - 1]], np.int32)
        self.expect(ValueError, (str(2**31 - 1),), ogc.Mesh, last)
        self.expect(ValueError, ("vertex 2147483647", "72 vertices"), ogc.Mesh, last, vertex_count=72)

    def test_a_device_is_told_the_stream(self):
        """Our streams synchronise with CUDA's legacy default stream, which DLPack numbers 1."""
        asked = []

        class There:
            def __init__(self, takes_version):
                self.takes_version = takes_version

            def __dlpack__(self, **options):
                asked.append(options)
                if not self.takes_version and "max_version" in options:
                    raise TypeError("an argument of later versions")
                return np.zeros((3, 3), np.float32).__dlpack__()

            def __dlpack_device__(self):
                return 2, 0

        for there in (There(True), There(False)):
            with self.assertRaises((TypeError, ValueError)):
                ogc.find_contacts(self.mesh, there, RADIUS, QUERY)
        self.assertEqual(asked, [{"stream": 1, "max_version": (1, 0)}] * 2 + [{"stream": 1}])

    def test_the_c_interface_of_dlpack_is_asked_first(self):
        """As torch's tensors offer it. Where it cannot serve, __dlpack__ is asked."""
        expected = ogc.find_contacts(self.mesh, self.x, RADIUS, QUERY).bound.tobytes()
        for change, calls in (({}, ["give", "let go"]), ({"major": 2}, ["dlpack"]),
                              ({"fails": True}, ["give", "dlpack"]), ({"requires_grad": True}, ["dlpack"]),
                              ({"device": 2, "stream": 7}, ["give", "stream", "let go", "dlpack"])):
            with self.subTest(change):
                offers = exchanging(self.x, **change)
                self.assertEqual(ogc.find_contacts(self.mesh, offers, RADIUS, QUERY).bound.tobytes(), expected)
                self.assertEqual(offers.calls, calls)
        there = exchanging(self.x, device=2, stream=0)
        self.expect(TypeError, ("on the host is needed", "on a device"), ogc.find_contacts, self.mesh, there, RADIUS,
                    QUERY)
        self.assertEqual(there.calls, ["give", "stream", "let go"])

    def test_of_numbers_name_them(self):
        find = ogc.find_contacts
        self.expect(ValueError, ("x: 71", "72 vertices"), find, self.mesh, self.x[:-1], RADIUS, QUERY)
        bad = self.x.copy()
        bad[7, 1] = np.nan
        self.expect(ValueError, ("x: vertex 7", "nan"), find, self.mesh, bad, RADIUS, QUERY)
        for radius in (QUERY, 0, -1, np.nan, 2.0**-41):
            self.expect(ValueError, ("radius is ", "a length from 9.094947e-13 to 0.005 m"), find, self.mesh, self.x,
                        radius, RADIUS)
        for query in (3e38, 2e19, 1048577, 2.0**-41):  # squares of the first overflow, or nearly
            for call in (lambda: find(self.mesh, self.x, RADIUS, query), lambda: ogc.Guard(self.mesh, self.x, query)):
                self.expect(ValueError, ("query_radius is ", "a length from 9.094947e-13 to 1048576 m"), call)
        far = self.x.copy()
        far[7, 1] = -1.0001 * 2**30
        for call in (lambda: find(self.mesh, far, RADIUS, QUERY), lambda: ogc.Guard(self.mesh, far, QUERY)):
            self.expect(ValueError, ("x: vertex 7 has (", "coordinates from -1073741824 to 1073741824 m"), call)
        self.assertEqual(len(find(self.mesh, self.x, 2.0**20, 2.0**20).bound), 72)
        self.expect(ValueError, ("relaxation is 0.5", "between 0 and 0.5"), find, self.mesh, self.x, RADIUS, QUERY,
                    relaxation=0.5)
        self.expect(ValueError, ("backend", "'gpu'", '"cpu"'), find, self.mesh, self.x, RADIUS, QUERY, backend="gpu")
        wrong = self.faces.copy()
        wrong[3, 1] = 72
        self.expect(ValueError, ("triangle 3", "vertex 72", "72 vertices"), ogc.Mesh, wrong, vertex_count=72)
        wrong[3] = wrong[3, 0]
        self.expect(ValueError, ("triangle 3", "twice"), ogc.Mesh, wrong)
        self.expect(ValueError, ("groups", "3 entries", "72"), ogc.Mesh, self.faces, vertex_count=72,
                    groups=np.zeros(3, np.int32))

    def test_of_a_missing_backend_says_why(self):
        info = ogc.backend_info("cuda")
        if not info["usable"]:
            self.expect(RuntimeError, (info["description"],), ogc.ContactFinder, self.mesh, "cuda")

    def test_an_empty_mesh_has_no_contacts(self):
        empty = ogc.Mesh(np.zeros((0, 3), np.int32))
        sets = ogc.find_contacts(empty, np.zeros((0, 3), np.float32), RADIUS, QUERY)
        self.assertEqual((sets.vertex_facet.shape, sets.edge_edge.shape, sets.bound.shape), ((0, 3), (0, 4), (0,)))

    def test_a_grid_in_a_plane_has_none_either(self):
        x, faces = grid(5)
        self.assertEqual(len(ogc.find_contacts(ogc.Mesh(faces), x, 1e-3, 1e-2).vertex_facet), 0)


if __name__ == "__main__":
    main()
