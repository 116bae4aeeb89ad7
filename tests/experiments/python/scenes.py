"""Simulations by the Python package: the program's bits, metrics, snapshots, and errors that say what to mend.

Usage: scenes.py BUILD_DIR RUN, a run of `ogc run cloth_on_sphere --scale smoke`. Exit status 77: skipped, a Python
package is missing.
"""

import csv
import gc
import signal
import sys
import tempfile
import threading
import unittest
from pathlib import Path

from package import counts_during, grid, main, prepare

_, (RUN,) = prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

try:
    import h5py
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)


def falling(**settings):
    """Returns a scene of a cloth above a fixed triangle, and the cloth."""
    x, faces = grid(8, 0.2, 0.01)
    scene = ogc.Scene(dt=1 / 100, iterations=10, radius=5e-3, **settings)
    cloth = scene.add_cloth(x, faces, density=0.2, young=100, bending=1e-6)
    floor = np.array([[-1, 0, -1], [0, 0, 2], [2, 0, -1]], dtype=np.float32)
    scene.add_fixed_body(floor, np.array([[0, 1, 2]], dtype=np.int32))
    return scene, cloth


class Worlds(unittest.TestCase):
    def test_each_world_ends_where_its_scene_ends_alone(self):
        scenes = [falling()[0], falling(bounds="planes")[0], falling(friction_velocity=1e-3)[0]]
        worlds = ogc.worlds(scenes)
        self.assertEqual(len(worlds), 3)
        rows = worlds.advance([20, 20, 5])
        self.assertEqual([len(of_world) for of_world in rows], [20, 20, 5])
        self.assertGreater(sum(rows[1].vertex_facet_contacts) + sum(rows[1].edge_edge_contacts), 0)
        for w, (scene, steps) in enumerate(zip(scenes, (20, 20, 5))):
            alone = scene.start()
            own = alone.advance(steps)
            self.assertEqual(worlds.snapshot(w).positions.tobytes(), alone.positions.cpu().tobytes(), w)
            self.assertEqual(own.elastic_energy.tolist(), rows[w].elastic_energy.tolist(), w)

    def test_copies_are_the_same_and_one_that_is_reset_repeats_its_bits(self):
        worlds = falling()[0].worlds(4)
        begin = worlds.snapshot(2)
        worlds.advance(7)
        self.assertEqual(worlds.failures, {})
        ends = [worlds.snapshot(w).positions.tobytes() for w in range(4)]
        self.assertEqual(len(set(ends)), 1)
        worlds.reset(2, begin)
        self.assertEqual(worlds.snapshot(2).positions.tobytes(), begin.positions.tobytes())
        worlds.advance([0, 3, 7, 0])
        self.assertEqual(worlds.snapshot(2).positions.tobytes(), ends[0])
        self.assertNotEqual(worlds.snapshot(1).positions.tobytes(), ends[1])

    def test_bad_words_are_named(self):
        scene, _ = falling()
        worlds, other = scene.worlds(2), ogc.Scene(dt=1 / 100, iterations=2, radius=5e-3)
        other.add_cloth(*grid(3, 0.2, 0.01))
        for words, call in (("count: 0 came", lambda: scene.worlds(0)),
                            ("numbers came for 2 worlds", lambda: worlds.advance([1, 2, 3])),
                            ("-1 came; give at least 0", lambda: worlds.advance(-1)),
                            ("world: 2 came; there are 2", lambda: worlds.snapshot(2)),
                            ("world: -1 came", lambda: worlds.snapshot(-1)),
                            ("snapshot: it has 9 vertices", lambda: worlds.reset(0, other.start().snapshot()))):
            with self.assertRaises(ValueError, msg=words) as found:
                call()
            self.assertIn(words, str(found.exception))
        with self.assertRaises(ValueError):
            ogc.worlds([])
        with self.assertRaises(TypeError):
            ogc.worlds([scene, "scene"])
        with self.assertRaisesRegex(TypeError, "None came"):
            ogc.worlds([scene, None])
        with self.assertRaisesRegex(RuntimeError, "run at most"):
            scene.worlds(1 << 40)


class Bits(unittest.TestCase):
    def test_a_built_in_scene_ends_where_the_program_ends(self):
        scene = ogc.scene("cloth_on_sphere", scale="smoke")
        sim = scene.start()
        rows = sim.advance(int(scene.settings["steps"]))
        with open(Path(RUN) / "steps.csv", newline="") as file:
            program = list(csv.DictReader(file))
        self.assertEqual(len(program), len(rows))
        for column in ("vertex_facet_contacts", "edge_edge_contacts", "iterations"):
            self.assertEqual([int(row[f"{column} [1]"]) for row in program], rows[column].tolist(), column)
        self.assertEqual([float(row["elastic_energy [J]"]) for row in program], rows.elastic_energy.tolist())
        last = sorted((Path(RUN) / "frames").iterdir())[-1]
        with h5py.File(last) as frame:
            state = sim.snapshot()
            self.assertEqual(state.step, len(rows))
            for found, name in ((state.positions, "positions"), (state.velocities, "velocities"),
                                (state.bound, "bounds"), (sim.positions.cpu(), "positions")):
                self.assertEqual(found.tobytes(), frame[name][:].tobytes(), name)

    def test_a_scene_of_its_arrays_is_the_same_scene(self):
        """The built-in scene, rebuilt from arrays and constants, gives its bits."""
        built_in = ogc.scene("cloth_on_sphere", scale="smoke")
        cloth, sphere = built_in.bodies
        x, faces = built_in.positions, built_in.faces
        scene = ogc.Scene(dt=float(built_in.settings["time_step"]), iterations=40,
                          radius=float(built_in.settings["contact_radius"]))
        # E and ν of λ = μ = 10 N/m: ν = λ/(λ + 2μ) = 1/3, E = 2μ(1 + ν)
        scene.add_cloth(x[cloth.vertices], faces[cloth.triangles], density=0.2, young=20 * (1 + 1 / 3), poisson=1 / 3,
                        bending=5e-7, friction=0.5, contact_stiffness=10, damping=2e-6, bending_damping=2e-6)
        scene.add_fixed_body(x[sphere.vertices], faces[sphere.triangles] - np.int32(sphere.vertices.start),
                             friction=0.5, contact_stiffness=10)
        sims = [built_in.start(), scene.start()]
        for sim in sims:
            sim.advance(15)
        self.assertEqual(sims[0].positions.cpu().tobytes(), sims[1].positions.cpu().tobytes())

    def test_division_into_calls_changes_no_bit(self):
        scene, _ = falling()
        one, two = scene.start(bounds="planes"), scene.start(bounds="planes")
        one.advance(20)
        self.assertEqual([step.step for step in two.run(seconds=0.2, every=3)], list(range(1, 21)))
        self.assertEqual(one.positions.cpu().tobytes(), two.positions.cpu().tobytes())

    def test_a_snapshot_goes_on_to_the_same_bits(self):
        sim = falling()[0].start()
        sim.advance(10)
        state = sim.snapshot()
        sim.advance(10)
        end = sim.positions.cpu()
        sim.restore(state)
        self.assertEqual(sim.positions.cpu().tobytes(), state.positions.tobytes())
        self.assertEqual(sim.advance(10).step.tolist(), list(range(11, 21)))
        self.assertEqual(sim.positions.cpu().tobytes(), end.tobytes())
        self.assertEqual(len(sim.metrics), 10)


class Views(unittest.TestCase):
    def setUp(self):
        self.sim = falling()[0].start()
        self.sim.advance(3)

    def test_lie_where_the_simulation_computes(self):
        sim, state = self.sim, self.sim.snapshot()
        for name in ("positions", "velocities"):
            view = getattr(sim, name)
            self.assertEqual((view.shape, len(view)), ((67, 3), 67))
            self.assertEqual((view.device, view.__dlpack_device__()), (None, (1, 0)))
            here, again, there = np.asarray(view), np.asarray(getattr(sim, name)), np.from_dlpack(view)
            for array in (here, there, view.cpu()):
                self.assertEqual((array.dtype, array.tobytes()), (np.float32, getattr(state, name).tobytes()), name)
            self.assertEqual(len({array.__array_interface__["data"][0] for array in (here, again, there)}), 1)
            self.assertFalse(here.flags.writeable or there.flags.writeable)
            self.assertFalse(np.shares_memory(view.cpu(), here))
        self.assertNotEqual(np.asarray(sim.positions).ctypes.data, np.asarray(sim.velocities).ctypes.data)

    def test_are_read_by_our_own_calls(self):
        x, mesh = self.sim.positions, ogc.Mesh(self.sim.faces)
        self.assertEqual(ogc.find_contacts(mesh, x, 5e-3, 1e-2).bound.tobytes(),
                         ogc.find_contacts(mesh, x.cpu(), 5e-3, 1e-2).bound.tobytes())
        guard = ogc.Guard(mesh, x, 1e-2)
        before = x.cpu()
        with self.assertRaisesRegex(TypeError, "out: .*a StateView, which is read-only"):
            guard.step(before, np.zeros_like(before), out=x)
        self.assertEqual(x.cpu().tobytes(), before.tobytes())

    def test_refuse_what_a_later_call_has_overwritten(self):
        sim, state = self.sim, self.sim.snapshot()
        for overwrite in (lambda: sim.advance(1), lambda: sim.restore(state), lambda: next(sim.run(steps=1))):
            views = [sim.positions, sim.velocities]
            kept = [view.cpu().tobytes() for view in views]
            sim.advance(0)
            self.assertEqual([view.cpu().tobytes() for view in views], kept, "no step, nothing is overwritten")
            overwrite()
            for view in views:
                for read in (view.cpu, view.__dlpack__, lambda: np.asarray(view), lambda: np.from_dlpack(view),
                             lambda: np.stack([view]), lambda: ogc.Guard(ogc.Mesh(sim.faces), view, 1e-2)):
                    with self.assertRaisesRegex(BufferError, r"overwritten.*cpu\(\)"):
                        read()
                self.assertIn("overwritten", repr(view))
                self.assertEqual(view.shape, (67, 3))
            self.assertNotIn("overwritten", repr(sim.positions))
        self.assertEqual(sim.positions.cpu().tobytes(), sim.snapshot().positions.tobytes())

    def test_keep_their_simulation(self):
        alone, expected = sys.getrefcount(self.sim), self.sim.positions.cpu().tobytes()
        self.assertEqual(sys.getrefcount(self.sim), alone, "a copy does not")
        for hold in (lambda: self.sim.positions, lambda: np.asarray(self.sim.positions),
                     lambda: self.sim.positions.__dlpack__(), lambda: np.from_dlpack(self.sim.positions)):
            held = hold()
            self.assertEqual(sys.getrefcount(self.sim), alone + 1)
            del held
            self.assertEqual(sys.getrefcount(self.sim), alone)
        here = np.asarray(self.sim.positions)
        del self.sim
        gc.collect()
        falling()[0].start().advance(5)
        self.assertEqual(here.tobytes(), expected)

    def test_are_cast_or_copied_only_where_that_is_asked(self):
        view = self.sim.positions
        here = np.asarray(view)
        self.assertTrue(np.shares_memory(view.__array__(np.float32, copy=False), here))
        self.assertFalse(np.shares_memory(view.__array__(copy=True), here))
        self.assertEqual(view.__array__(float).tolist(), here.tolist())
        with self.assertRaisesRegex(ValueError, "float32"):
            view.__array__(float, copy=False)
        with self.assertRaisesRegex(BufferError, "copy"):
            view.__dlpack__(copy=True)

    def test_wait_for_a_step_of_another_thread(self):
        """Each view that is not refused has the state after a whole step."""
        sim = ogc.scene("cloth_on_sphere", "smoke").start()
        states, found, done = {sim.positions.cpu().tobytes()}, [], threading.Event()

        def read():
            while not done.is_set() or not found:
                try:
                    found.append(sim.positions.cpu().tobytes())
                except BufferError:
                    pass

        thread = threading.Thread(target=read)
        thread.start()
        for _ in range(20):
            sim.advance(1)
            states.add(sim.positions.cpu().tobytes())
        done.set()
        thread.join()
        self.assertEqual(set(found) - states, set())


class Scenes(unittest.TestCase):
    def test_metrics_are_columns(self):
        sim = falling()[0].start()
        rows = sim.advance(12)
        self.assertIsInstance(rows, np.recarray)
        self.assertEqual(rows.step.tolist(), list(range(1, 13)))
        self.assertEqual((rows.step.dtype, rows.wall_ms.dtype), (np.int64, np.float64))
        self.assertTrue((rows.wall_ms > 0).all())
        self.assertEqual(rows.vertex_facet_contacts[0], 0)
        self.assertGreater(rows.vertex_facet_contacts[-1], 0, "the cloth reached the floor")
        self.assertEqual(len(sim.advance(0)), 0)

    def test_a_moving_body_is_where_its_frames_are(self):
        scene, cloth = falling()
        body_x = np.array([[3, 0, 3], [3, 0, 4], [4, 0, 3]], dtype=np.float32)
        frames = np.stack([body_x, body_x + np.float32([0, 0.25, 0])])
        body = scene.add_moving_body(frames, np.array([[0, 1, 2]], dtype=np.int32), times=np.array([0, 0.1]))
        sim = scene.start()
        sim.advance(5)
        # half of the way, by the same rounding: 0.5 · 0.25 is a number of single precision
        self.assertLess(np.abs(sim.positions.cpu()[body.vertices] - (body_x + np.float32([0, 0.125, 0]))).max(), 1e-7)
        sim.advance(10)
        self.assertEqual(sim.positions.cpu()[body.vertices].tolist(), frames[1].tolist())
        self.assertEqual(len(sim.positions.cpu()[cloth.vertices]), 64)

    def test_held_vertices_stay(self):
        scene, cloth = falling(gravity=(0, 0, -9.81))
        x = scene.positions
        corners = np.array([0, 7], dtype=np.int32)
        scene.move(corners)
        sim = scene.start()
        sim.advance(10)
        self.assertEqual(sim.positions.cpu()[corners].tolist(), x[corners].tolist())
        self.assertNotEqual(sim.positions.cpu()[20].tolist(), x[20].tolist())

    def test_rest_and_velocities_are_used(self):
        x, faces = grid(4, 0.1)
        fast = np.zeros_like(x)
        fast[:, 0] = 1
        scene = ogc.Scene(dt=1e-3, iterations=20, radius=1e-3, gravity=(0, 0, 0))
        scene.add_cloth(x, faces, velocities=fast)
        scene.add_cloth(x + np.float32([0, 1, 0]), faces, rest=x * np.float32(0.9), name="stretched")
        self.assertEqual([body.name for body in scene.bodies], ["cloth_0", "stretched"])
        sim = scene.start()
        sim.advance(1)
        # A free flight moves by h v = 1 mm. Positions below 2⁻³ m are rounded by at most 2⁻²⁸ m; the start of the step
        # and each of its 20 sweeps round them once.
        self.assertLess(np.abs(sim.positions.cpu()[:16, 0] - x[:, 0] - 1e-3).max(), 21 * 2.0**-28)
        self.assertLess(np.ptp(sim.positions.cpu()[16:, 0]), 0.1, "the stretched cloth draws together")

    def test_the_handler_of_a_signal_may_read_the_simulation(self):
        sim = falling()[0].start()
        seen = []
        before = signal.signal(signal.SIGALRM, lambda *_: seen.append(len(sim.positions.cpu())))
        signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
        try:
            while len(seen) < 3:
                sim.advance(20)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(seen[:3], [67] * 3)

    def test_other_threads_run_during_a_step(self):
        sim = ogc.scene("cloth_on_sphere", "smoke").start()
        self.assertGreater(counts_during(lambda: sim.advance(30)), 0)

    def test_it_is_saved_and_read(self):
        sim = falling()[0].start()
        states = [sim.positions.cpu()]
        for _ in range(3):
            sim.advance(5)
            states.append(sim.positions.cpu())
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mine.npz"
            sim.save(path, np.stack(states))
            x, faces = ogc.load(path)
            self.assertEqual((x.tobytes(), faces.tobytes()), (states[0].tobytes(), sim.faces.tobytes()))
            with np.load(path) as arrays:
                self.assertEqual(arrays["positions"].tobytes(), np.stack(states).tobytes())
                self.assertEqual(arrays["metrics"].tobytes(), sim.metrics.tobytes())
                self.assertEqual(arrays["metrics"]["step"].tolist(), list(range(1, 16)))
            sim.save(str(path))
            self.assertEqual(ogc.load(path)[0].tobytes(), states[-1].tobytes())
            with self.assertRaisesRegex(ValueError, r"mine.npz"):
                sim.save(Path(folder) / "mine.obj")
            for wrong in (states[0], np.stack(states).astype(float), np.stack(states)[:, 1:]):
                with self.assertRaisesRegex(TypeError, r"frames: float32 \(F, 67, 3\)"):
                    sim.save(path, wrong)

    def test_built_in_scenes_are_listed(self):
        for name in ogc.scenes():
            self.assertGreater(len(ogc.scene(name, "smoke").positions), 0, name)
        with self.assertRaisesRegex(ValueError, "twist"):
            ogc.scene("twits", "smoke")
        with self.assertRaisesRegex(ValueError, "smoke"):
            ogc.scene("twist", "tiny")


class Errors(unittest.TestCase):
    def test_of_settings_name_the_nearest(self):
        with self.assertRaisesRegex(ValueError, "bounds_relaxation"):
            ogc.Scene(dt=0.01, iterations=1, radius=1e-3, bound_relaxation=0.3)
        with self.assertRaisesRegex(ValueError, "planes"):
            falling()[0].start(bounds="plane")
        with self.assertRaisesRegex(ValueError, "backend"):
            falling()[0].start(backend="gpu")

    def test_of_arrays_name_them(self):
        x, faces = grid(4)
        scene = ogc.Scene(dt=0.01, iterations=1, radius=1e-3)
        for words, call in (
                ("x: float32", lambda: scene.add_cloth(x.astype(float), faces)),
                ("faces: int32", lambda: scene.add_cloth(x, faces.astype(np.int64))),
                (r"frames: float32 \(F, V, 3\)", lambda: scene.add_moving_body(x, faces)),
                ("times: float64", lambda: scene.add_moving_body(np.stack([x, x]), faces, times=[0, 1])),
                ("vertices: int32", lambda: scene.move([1]))):
            with self.assertRaisesRegex(TypeError, words):
                call()
        for words, call in (
                ("faces: triangle 0 names vertex 4", lambda: scene.add_cloth(x[:4], faces)),
                ("rest: 3 rows came for 16", lambda: scene.add_cloth(x, faces, rest=x[:3])),
                ("frames: 1 came", lambda: scene.add_moving_body(x[None], faces)),
                ("times: 3 came for 2", lambda: scene.add_moving_body(np.stack([x, x]), faces, times=np.zeros(3))),
                ("poisson", lambda: scene.add_cloth(x, faces, poisson=1)),
                ("stable_neo_hookean", lambda: scene.add_cloth(x, faces, membrane="stable_neohookean"))):
            with self.assertRaisesRegex(ValueError, words):
                call()
        self.assertEqual(scene.bodies, [], "a refused body leaves the scene as it was")

    def test_of_scenes_list_what_to_mend(self):
        x, faces = grid(4)
        x[5] = np.nan
        scene = ogc.Scene(dt=0.01, iterations=1, radius=1e-3)
        scene.add_cloth(x, faces)
        with self.assertRaisesRegex(ValueError, "cannot be simulated"):
            scene.start()

    def test_of_runs(self):
        sim = falling()[0].start()
        for wrong in ({}, {"seconds": 1, "steps": 1}, {"steps": 1, "every": 0}, {"seconds": float("inf")},
                      {"seconds": float("nan")}, {"seconds": -1}, {"seconds": 1e300}):
            with self.assertRaises(ValueError):
                sim.run(**wrong)
        with self.assertRaisesRegex(ValueError, "steps"):
            sim.advance(-1)
        other = ogc.Scene(dt=0.01, iterations=1, radius=1e-3)
        other.add_cloth(*grid(3))
        with self.assertRaisesRegex(ValueError, "9 vertices"):
            sim.restore(other.start().snapshot())


if __name__ == "__main__":
    main()
