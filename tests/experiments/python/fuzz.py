"""Calls the Python package with wrong and right arguments at random: it answers or raises, and never crashes.

Usage: fuzz.py BUILD_DIR [--seed=S] [--cases=N]. A seed gives the same calls again. The calls run in processes of 1,000,
so that a crash costs one of them and is reported with its last call. Before a binding lands, 10⁵ calls pass in a build
with AddressSanitizer:

  cmake -B build/asan -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DOGC_CUDA=OFF -DOGC_PROGRAM=OFF -DOGC_PYTHON=ON
    -DOGC_PYTHON_AUDIT=ON -DCMAKE_CXX_FLAGS="-fsanitize=address,undefined -fno-sanitize-recover=all" &&
  ninja -C build/asan _fast _audit &&
  LD_PRELOAD="$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libstdc++.so)"
    ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 fuzz.py build/asan --cases=100000

So ran 50,000 calls each of the seeds 401 and 402 on 29 November 2026: no crash.

Exit status 77: skipped, a Python package is missing.
"""

import array
import ctypes
import faulthandler
import gc
import random
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

OPTIONS = dict(argument[2:].split("=") for argument in sys.argv[1:] if argument.startswith("--"))
sys.argv = [argument for argument in sys.argv if not argument.startswith("--")]

from package import grid, prepare, two_layers  # noqa: E402

BUILD, _ = prepare(__doc__)
import numpy as np  # noqa: E402
from device_array import DELETER, FLOAT, ManagedTensor, Tensor  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

SEED, CASES, CHUNK = int(OPTIONS.get("seed", 1)), int(OPTIONS.get("cases", 3000)), 1000
# What a call may raise. A message that names nothing would be of no use, so it must not be empty.
EXPECTED = (TypeError, ValueError, RuntimeError, MemoryError, ImportError, BufferError)
INT, CPU = 0, 1
BAD_NUMBERS = (0, -1, 0.0, -0.0, float("nan"), float("inf"), -float("inf"), 1e300, -1e300, 1e-300, 3e38, 1e-45, 10**400,
               2**31, -2**31 - 1, 2**63, True, "x", None, 1j, b"1", [], np.float64(1e39), np.float32("nan"))
BAD_TEXTS = ("", "gpu", "\udc80", "\0", "x" * 10000, b"cpu", 5, None, "CPU", "pläne")


class Lies:
    """Offers a tensor that is not what it says; `made` keeps the memory behind its capsules."""

    made = []

    def __init__(self, random):
        values = np.ones(60, np.float32)
        shape = random.choice([(-1, 3), (20, 3), (2**62, 3), (2**40, 0, 3), (0, 2**62, 3), (3,), (), (-2, -3), (1, 3)])
        strides = random.choice([None, None, (3, 1), (0, 0), (-3, 1), (2**62, 2**62), (1, 3)])
        null = random.random() < 0.3 or max(shape, default=1) > 60
        one_size = ctypes.c_int64 * max(len(shape), 1)
        lengths = one_size(*shape)
        steps = one_size(*strides) if strides and len(strides) == len(shape) else None
        tensor = Tensor(None if null else values.ctypes.data, random.choice([CPU, CPU, CPU, 2, 3, 13, 99, -1]),
                        random.choice([0, 0, 7, -1]), random.choice([len(shape)] * 6 + [-1, 0, 1000]),
                        random.choice([FLOAT, FLOAT, INT, 99]), random.choice([32, 32, 32, 64, 0, 7]),
                        random.choice([1, 1, 1, 4, 0]), lengths, steps, 0)
        deleter = random.choice([DELETER(0), DELETER(lambda tensor: None)])
        self.managed = ManagedTensor(tensor, None, deleter)
        self.name = random.choice([b"dltensor", b"dltensor", b"dltensor", b"used_dltensor", b"other"])
        self.place = random.choice([(CPU, 0), (2, 0), (99, 0), None, "here", (1,), (CPU, "x"), (2**70, 0)])
        Lies.made.append((self.managed, values, lengths, steps, deleter))

    def capsule(self):
        new = ctypes.pythonapi.PyCapsule_New
        new.restype, new.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
        return new(ctypes.addressof(self.managed), self.name, None)

    def __dlpack__(self, **_):
        return self.capsule()

    def __dlpack_device__(self):
        return self.place


class Odd:
    """An object whose attributes raise, or answer with nonsense."""

    def __init__(self, random):
        self.answer = random.choice([None, 5, "\udc80", ValueError("no"), BufferError("no"), RecursionError("deep"),
                                     MemoryError("none"), TypeError("no"), np.ones((4, 3), np.float32)])

    def _answer(self, *_, **__):
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer

    __dlpack__ = __dlpack_device__ = __str__ = __array__ = _answer
    dtype = requires_grad = property(_answer)


class Busy:
    """Offers an array after it has called the package, freed memory and let its own array go."""

    def __init__(self, fuzz, values):
        self.fuzz, self.values = fuzz, values

    def __dlpack__(self, **_):
        values, self.values = self.values, None
        if values is None or not hasattr(values, "__dlpack__"):
            raise BufferError("it was asked before")
        self.fuzz.pool.clear()
        gc.collect()
        x, faces = two_layers(3, 0.01)
        ogc.find_contacts(ogc.Mesh(faces), x, 0.01, 0.02)
        return values.__dlpack__()

    def __dlpack_device__(self):
        return CPU, 0


class Fuzz:
    """Makes the calls of one process. `pool` has the objects that calls returned, by type; `views` arrays of results,
    whose owners may be gone, each with its bytes."""

    def __init__(self, seed):
        self.random, self.pool, self.views, self.refused = random.Random(seed), {}, [], 0

    # Arguments: right with a probability that lets about half of all calls pass.

    def right(self):
        return self.random.random() < 0.93

    def number(self, *good):
        return self.random.choice(good if self.right() else BAD_NUMBERS)

    def text(self, *good):
        return self.random.choice(good if self.right() else BAD_TEXTS)

    def array(self, values):
        return values if self.right() else self.wrong(values)

    def wrong(self, values):
        """Returns `values`, spoiled in one way."""
        pick, numbers = self.random, np.ascontiguousarray(values)
        spoiled = numbers.copy()
        if numbers.size:
            bad = (np.nan, np.inf, -np.inf, 3e38, -3e38, 1e-45, 1e30) if numbers.dtype.kind == "f" else (
                -1, 2**31 - 1, -2**31, len(numbers), 0, 10**5)
            for _ in range(pick.choice([1, 1, 5])):
                spoiled.flat[pick.randrange(numbers.size)] = pick.choice(bad)
        shifted = np.frombuffer(b"\0" + numbers.tobytes(), np.uint8)[1:].view(numbers.dtype).reshape(numbers.shape)
        frozen = numbers.copy()
        frozen.setflags(write=False)
        lies = Lies(pick)
        kinds = [np.float64, np.float16, np.int8, np.int64, np.uint32, np.complex64, bool, object, "S4", "U4", "M8[s]",
                 numbers.dtype.newbyteorder()]
        with np.errstate(all="ignore"):
            other = pick.choice(kinds)
            cast = numbers.astype(other) if other != "M8[s]" else numbers.astype(np.int64).astype(other)
        return pick.choice([
            lambda: spoiled, lambda: spoiled, lambda: spoiled, lambda: cast, lambda: cast, lambda: frozen,
            lambda: shifted, lambda: numbers[:-1], lambda: numbers[:0], lambda: numbers[..., :2], lambda: numbers[None],
            lambda: numbers.ravel(), lambda: np.asfortranarray(numbers), lambda: numbers[::2], lambda: numbers[::-1],
            lambda: numbers.T, lambda: np.broadcast_to(numbers[:1], (2**40, *numbers.shape[1:])),
            lambda: np.zeros((0, 2**40, 3), numbers.dtype), lambda: numbers[:1].sum(axis=0), lambda: numbers.sum(),
            lambda: np.zeros((2,) * 60 if numbers.size == 0 else (1,) * 60, numbers.dtype),
            lambda: np.concatenate([numbers, numbers]), lambda: np.ma.masked_array(numbers), lambda: numbers.tolist(),
            lambda: memoryview(numbers), lambda: bytearray(numbers.tobytes()), lambda: numbers.data.cast("B"),
            lambda: array.array("i", range(9)), lambda: (ctypes.c_float * 9)(), lambda: numbers.view([("a", "f4")]),
            lambda: None, lambda: "x", lambda: 5, lambda: object(), lambda: {}, lambda: iter([1]), lambda: np.ndarray,
            lambda: lies, lambda: lies, lambda: lies, lambda: lies.capsule(), lambda: Odd(pick), lambda: Odd,
            lambda: Busy(self, numbers), lambda: Busy(self, numbers), lambda: numbers.__dlpack__()])()

    def shape(self):
        """Returns positions and faces, often tiny, sometimes none."""
        pick = self.random
        return pick.choice([
            lambda: two_layers(3, 0.01), lambda: two_layers(3, 0.01), lambda: two_layers(3, 0.01, pick.randrange(9)),
            lambda: grid(3), lambda: (np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)),
            lambda: (np.zeros((4, 3), np.float32), np.array([[0, 1, 2]], np.int32)),
            lambda: (np.float32(10.0**pick.randint(-44, 38)) * two_layers(3, 0.01)[0], two_layers(3, 0.01)[1]),
            lambda: (np.zeros_like(grid(3)[0]), grid(3)[1])])()

    def one(self, kind, make):
        """Returns an object of the pool or a new one, rarely another."""
        if not self.right():
            return self.random.choice([None, 5, "x", object.__new__(object), kind, kind.__new__(kind),
                                       *[value for values in self.pool.values() for value in values]])
        known = self.pool.setdefault(kind, [])
        return self.random.choice(known) if known and self.random.random() < 0.8 else make()

    def keep(self, kind, value):
        known = self.pool.setdefault(kind, [])
        known.append(value)
        if len(known) > 6:
            known.pop(self.random.randrange(len(known)))
        return value

    def look(self, value):
        """Reads every array of a result and keeps some of them beyond their owner."""
        for name in dir(type(value)):
            if name.startswith("_") or callable(getattr(type(value), name)):
                continue
            array = getattr(value, name)
            if isinstance(array, ogc.StateView):
                self.keep(ogc.StateView, array)
            if isinstance(array, np.ndarray):
                array.sum() if array.dtype.names is None else array.tobytes()
                if self.random.random() < 0.1 and not isinstance(value, (ogc.Guard, ogc.Simulation, ogc.Scene)):
                    self.views.append((array, array.tobytes()))
        repr(value)

    # Calls

    def mesh(self):
        x, faces = self.shape()
        more = {}
        if self.random.random() < 0.3:
            more["edges"] = self.array(np.array([[0, 1]], np.int32))
        if self.random.random() < 0.3:
            more["groups"] = self.array(np.zeros(len(x), np.int32))
        if self.random.random() < 0.5:
            more["vertex_count"] = self.number(len(x), len(x), len(x) + 1, 10**5)
        return self.keep(ogc.Mesh, ogc.Mesh(self.array(faces), **more))

    def finder(self):
        return self.keep(ogc.ContactFinder, ogc.ContactFinder(self.one(ogc.Mesh, self.mesh), self.text("cpu", "cuda")))

    def query(self):
        radius = self.number(0.005, 0.01, 1.0)
        more = {"relaxation": self.number(0.45, 0.2)} if self.random.random() < 0.2 else {}
        return {"radius": radius, "query_radius": self.number(0.02, 1.0, 0.001, radius), **more}

    def contacts(self):
        x, _ = self.shape()
        if self.random.random() < 0.5:
            return ogc.find_contacts(self.one(ogc.Mesh, self.mesh), self.array(x), **self.query(),
                                     backend=self.text("cpu"))
        return ogc.ContactFinder.find(self.one(ogc.ContactFinder, self.finder), self.array(x), **self.query()).cpu()

    def guard(self):
        x, faces = self.shape()
        return self.keep(ogc.Guard, ogc.Guard(
            self.one(ogc.Mesh, lambda: ogc.Mesh(faces, vertex_count=len(x))), self.array(x), self.number(0.02, 0.2),
            bounds=self.text("planes", "ball", "dat", "off"), radius=self.number(0.0, 0.01),
            relaxation=self.number(0.45), detection_fraction=self.number(0.01, 0.0, 1.0),
            backend=self.text("cpu")))

    def guard_step(self):
        guard = self.one(ogc.Guard, self.guard)
        x = guard.positions.cpu() if isinstance(guard, ogc.Guard) else self.shape()[0]
        dx = np.float32(self.random.choice([0, 1e-3, 1, 1e30])) * np.random.default_rng(3).normal(
            size=x.shape).astype(np.float32)
        action = self.random.random()
        if action < 0.1:
            ogc.Guard.reset(guard, self.array(x))
        elif action < 0.2:
            ogc.Guard.detect(guard)
        elif action < 0.3:
            both = np.zeros((len(x) + 1, 3), np.float32)
            ogc.Guard.step(guard, both[1:], dx, out=both[:-1])
        elif action < 0.5:
            ogc.Guard.step(guard, self.array(x), self.array(dx), out=self.array(x))
        else:
            ogc.Guard.step(guard, self.array(x), self.array(dx))
        return guard

    def scene(self):
        if self.random.random() < 0.1:
            return self.keep(ogc.Scene, ogc.scene(self.text("cloth_on_sphere", "twist", "yarn"), self.text("smoke")))
        more = {}
        if self.random.random() < 0.3:
            more["gravity"] = self.random.choice([(0, 0, 0), (0, -1e30, 0), (0, 1), None, (float("nan"),) * 3, "abc"])
        if self.random.random() < 0.3:
            name = self.random.choice(["bounds", "time_step", "steps", "friction_velocity", "query_radius", "\udc80"])
            more[name] = self.random.choice([*BAD_NUMBERS, *BAD_TEXTS, "planes", 1e-3])
        return self.keep(ogc.Scene, ogc.Scene(dt=self.number(0.01, 0.003), iterations=self.number(1, 3),
                                              radius=self.number(0.005, 0.01), **more))

    def body(self):
        scene = self.one(ogc.Scene, self.scene)
        x, faces = self.shape()
        action = self.random.random()
        if action < 0.5:
            more = {name: self.number(0.3) for name in self.random.sample(
                ["density", "young", "poisson", "bending", "friction", "contact_stiffness", "damping",
                 "bending_damping"], self.random.randrange(3))}
            if self.random.random() < 0.3:
                more["rest"] = self.array(x)
            if self.random.random() < 0.3:
                more["velocities"] = self.array(x)
            if self.random.random() < 0.3:
                name = self.random.choice(["membrane", "bending_model", "name"])
                more[name] = self.text("none", "st_venant_kirchhoff")
            return ogc.Scene.add_cloth(scene, self.array(x), self.array(faces), **more)
        if action < 0.7:
            return ogc.Scene.add_fixed_body(scene, self.array(x), self.array(faces), friction=self.number(0.1))
        if action < 0.9:
            times = {"times": self.array(np.array([0.0, 0.1]))} if self.random.random() < 0.5 else {}
            return ogc.Scene.add_moving_body(scene, self.array(np.stack([x, x])), self.array(faces), **times)
        return ogc.Scene.move(scene, self.array(np.array([0, 2], np.int32)), begin=self.number(0.0),
                              end=self.number(1.0), velocity=(self.number(0.1), 0, 0),
                              angular_velocity=self.number(1.0), axis=(0, self.number(1), 0))

    def started(self):
        scene = self.one(ogc.Scene, self.scene)
        return self.keep(ogc.Simulation, ogc.Scene.start(
            scene, backend=self.text("cpu"), bounds=self.text("planes", "ball", None),
            profile=self.number(True, False)))

    def snapshot(self):
        return self.keep(ogc.Snapshot, ogc.Simulation.snapshot(self.one(ogc.Simulation, self.started)))

    def simulate(self):
        sim = self.one(ogc.Simulation, self.started)
        action = self.random.random()
        if action < 0.5:
            ogc.Simulation.advance(sim, self.random.choice([0, 1, 2, 1, -1, 2**70, "x", None, 1.5]))
        elif action < 0.7:
            seconds = self.number(0.01, 0.02)
            few = seconds in (0.01, 0.02)  # other numbers may legally ask for 10¹¹ steps, which one call must not run
            every = self.random.choice([1, 2, 0, -1, 2**62 if few else 3])
            steps = ogc.Simulation.run(sim, seconds=seconds, every=every)
            for _, _ in zip(range(2), steps):
                pass
        elif action < 0.8:
            ogc.Simulation.restore(sim, self.one(ogc.Snapshot, self.snapshot))
        else:
            return self.snapshot()
        return sim

    def view(self):
        """Reads a view of a state, which may be overwritten, or passes it on."""
        owner = self.random.choice([self.started, self.guard])()
        view = self.one(ogc.StateView, lambda: owner.positions)
        repr(view)
        return self.random.choice([
            lambda: ogc.StateView.cpu(view).sum(), lambda: np.asarray(view).sum(),
            lambda: np.array(view, dtype=self.random.choice([np.float32, float, "S4"])),
            lambda: np.from_dlpack(owner.positions).sum(),
            lambda: ogc.StateView.__dlpack__(view, **self.random.choice(
                [{}, {"copy": True}, {"stream": "x"}, {"max_version": 5}, {"x": 1}])),
            lambda: ogc.StateView.__array__(view, self.random.choice([None, 5, "x"]),
                                            self.random.choice([None, True, False, "x"])),
            lambda: ogc.Guard.reset(self.one(ogc.Guard, self.guard), view),
            lambda: ogc.Guard.step(owner, view, view, out=self.random.choice([None, view]))])()

    def audit(self):
        x, faces = self.shape()
        frames = np.stack([x, x, x + np.float32(0.01)])
        if self.random.random() < 0.3:
            frames = frames.astype(np.float64)
        more = {}
        if self.random.random() < 0.3:
            more["groups"] = self.array(np.zeros(len(x), np.int32))
        if self.random.random() < 0.3:
            more["edges"] = self.array(np.array([[0, 1]], np.int32))
        if self.random.random() < 0.3:
            more["limit"] = self.number(0, 5, 2**40)
        report = ogc.audit(self.array(frames), self.array(faces), motion=self.number(True, False), **more)
        report.describe()
        return report

    def again(self):
        """Initialises an object twice, or uses one that was never initialised."""
        kind = self.random.choice([ogc.Mesh, ogc.Guard, ogc.Scene, ogc.ContactFinder, ogc.Simulation, ogc.Snapshot])
        value = self.one(kind, lambda: kind.__new__(kind))
        if self.random.random() < 0.5:
            kind.__init__(value, *self.random.sample([two_layers(3, 0.01)[1], ogc.Mesh, None, 5, "cpu"], 2))
        return value

    def arrays_of_meshes(self):
        x, faces = self.shape()

        class Mesh:
            vertices = self.array(x)

        Mesh.faces = self.array(faces)
        return ogc.from_mesh(Mesh)

    def other(self):
        return self.random.choice([
            lambda: ogc.backend_info(self.text("cpu", "cuda")), lambda: ogc.scenes(), self.again,
            self.arrays_of_meshes, lambda: ogc.Scene.set(self.one(ogc.Scene, self.scene), iterations=self.number(1, 2)),
            lambda: self.pool.clear()])()

    def both(self):
        """Two threads call at the same time."""
        threads = [threading.Thread(target=lambda: self.tried(self.random.choice(
            [self.contacts, self.guard_step, self.simulate, self.snapshot, self.view]))) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    def tried(self, call):
        try:
            value = call()
            if type(value).__module__.startswith("ogc_testbed"):
                self.look(value)
        except EXPECTED as error:
            self.refused += 1
            assert str(error) or isinstance(error, MemoryError), f"{call.__name__}: {type(error)} without a word"

    def run(self, cases, note):
        calls = [self.mesh] * 3 + [self.finder] + [self.contacts] * 8 + [self.guard] * 3 + [self.guard_step] * 6 + [
            self.scene] * 2 + [self.body] * 6 + [self.started] * 3 + [self.simulate] * 4 + [self.view] * 3 + [
            self.audit] * 4 + [self.other] * 2 + [self.both]
        for case in range(cases):
            call = self.random.choice(calls)
            note(f"call {case}: {call.__name__}")
            self.tried(call)
            if len(self.views) > 40:
                self.views.pop(self.random.randrange(len(self.views)))
            if case % 10 == 0:
                for view, expected in self.views:
                    assert view.tobytes() == expected, f"call {case}: an array of an earlier result has changed"
        return self.refused


def child(seed, cases, path):
    """Makes the calls of one process; `path` gets the last one."""
    faulthandler.enable()
    with open(path, "wb", buffering=0) as file:
        def note(text):
            file.seek(0)
            file.write(text.ljust(80).encode())

        with np.errstate(all="ignore"):
            print(Fuzz(seed).run(cases, note))


def main():
    refused = 0
    for first in range(0, CASES, CHUNK):
        cases, seed = min(CHUNK, CASES - first), SEED * 10**6 + first // CHUNK
        with tempfile.NamedTemporaryFile() as last:
            command = [sys.executable, __file__, str(BUILD), f"--child={seed}", f"--cases={cases}",
                       f"--last={last.name}"]
            try:
                done = subprocess.run(command, capture_output=True, text=True, timeout=600)
            except subprocess.TimeoutExpired:
                sys.exit(f"seed {seed}: no end after 600 s, at {Path(last.name).read_text()}")
            if done.returncode != 0:
                sys.exit(f"{done.stderr}\nexit status {done.returncode} at {Path(last.name).read_text()}\nagain: "
                         + " ".join(command[:-1] + ["--last=/dev/null"]))
        refused += int(done.stdout.split()[-1])
    print(f"seed {SEED}: {CASES} calls, {refused} of them refused, no crash")
    if not 0.2 * CASES < refused < 0.8 * CASES:
        sys.exit("calls that nearly all pass, or nearly all fail, test little")


if __name__ == "__main__":
    if "child" in OPTIONS:
        child(int(OPTIONS["child"]), CASES, OPTIONS["last"])
    else:
        main()
