"""Parts side by side on several devices, and archives in pieces: each device has one job at a time, jobs of one group
never overlap, what times processors comes last and alone, a limit ends the waiting.

Usage: side_by_side.py SOURCE_DIR. The standard library is enough.
"""

import os
import sys
import tarfile
import tempfile
import threading
import time
import unittest
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import jobs, packing, parts, side_by_side, steady  # noqa: E402
from paper_figures.workflow.jobs import CORE, CORES, DEVICE, FINISHED, PLACE, STOPPED, Limit, Place  # noqa: E402

SECONDS = 0.05  # of a job


class Log:
    """Notes which jobs are at work, with their places."""

    def __init__(self):
        self.lock, self.now, self.seen = threading.Lock(), {}, []

    def work(self, name):
        with self.lock:
            self.now[name] = PLACE.get()
            self.seen.append((name, PLACE.get(), dict(self.now)))
        time.sleep(SECONDS)
        with self.lock:
            del self.now[name]


@dataclass(frozen=True)
class Task:
    name: str
    log: Log
    on_device: bool = False

    def done(self, _root):
        return True  # no memory is sampled

    def make(self, _program, _root, limit=Limit(), _shown=False):
        if limit.left() == 0:
            return STOPPED
        self.log.work(self.name)
        return FINISHED


def part_of(*tasks):
    return parts.Part("folder", tuple((task,) for task in tasks))


class Made(unittest.TestCase):
    def make(self, chosen, groups=None, cards=2, limit=None):
        with tempfile.TemporaryDirectory() as out:
            maker = side_by_side.SideBySide("ogc", Path(out), limit or Limit(), cards=cards)
            ends = {}
            maker.make_all(chosen, groups or [[name] for name in chosen],
                           lambda name, end, seconds: ends.update({name: (end, seconds)}))
        return ends

    def test_each_device_has_one_job_and_all_are_used(self):
        log = Log()
        chosen = {f"p{n}": part_of(*(Task(f"{n}.{k}", log, on_device=True) for k in range(3))) for n in range(4)}
        begun = time.monotonic()
        ends = self.make(chosen)
        passed = time.monotonic() - begun
        self.assertEqual({end for end, _ in ends.values()}, {FINISHED})
        self.assertEqual(len(log.seen), 12)
        self.assertEqual({place.device for _, place, _ in log.seen}, {"0", "1"})
        for _, _, now in log.seen:
            self.assertEqual(len({place.device for place in now.values()}), len(now))
        self.assertLessEqual(sum(seconds for _, seconds in ends.values()), 2 * passed, "waiting is no work")

    def test_jobs_of_processors_go_on_beside_those_of_devices(self):
        log = Log()
        ends = self.make({"p": part_of(*(Task(f"d{k}", log, on_device=True) for k in range(4))),
                          "q": part_of(*(Task(f"c{k}", log) for k in range(4)))})
        self.assertEqual(len(ends), 2)
        self.assertTrue(any({name[0] for name in now} == {"c", "d"} for _, _, now in log.seen))

    def test_parts_of_a_group_never_overlap(self):
        log = Log()
        chosen = {name: part_of(Task(f"{name}1", log), Task(f"{name}2", log)) for name in "abcd"}
        self.make(chosen, groups=[["a", "c"], ["b"], ["d"]])
        for _, _, now in log.seen:
            self.assertFalse({"a", "c"} <= {name[0] for name in now})
        self.assertTrue(any(len({name[0] for name in now}) > 1 for _, _, now in log.seen))

    def test_what_times_processors_comes_last_and_alone_with_all_of_them(self):
        log = Log()
        chosen = {"windows_x": part_of(Task("w1", log), Task("w2", log)), "threads": part_of(Task("t", log)),
                  "a": part_of(Task("a", log, on_device=True)), "b": part_of(Task("b", log))}
        self.make(chosen)
        self.assertEqual([name for name, _, _ in log.seen[2:]], ["w1", "w2", "t"])
        for _, place, now in log.seen[2:]:
            self.assertEqual((place, len(now)), (Place(), 1))

    def test_a_free_place_goes_to_the_part_that_was_named_first(self):
        places, got = side_by_side.Places(["place"]), []
        held = places.take(0, Limit())

        def wait(rank):
            place = places.take(rank, Limit())
            got.append(rank)
            places.give(place)

        threads = [threading.Thread(target=wait, args=(rank,)) for rank in (2, 0, 1)]
        for thread in threads:
            thread.start()
        while len(places.waiting) < 3:
            time.sleep(0.01)
        places.give(held)
        for thread in threads:
            thread.join()
        self.assertEqual(got, [0, 1, 2])

    def test_what_the_reference_measures_holds_no_device(self):
        run = lambda *words: jobs.Job("x", ("twist", "--backend", "cuda", *words))  # noqa: E731
        self.assertEqual([run().needs, run("--residual").needs, run("--iterations", "--repeats", 5).needs],
                         [DEVICE, CORE, DEVICE])
        self.assertEqual(jobs.Job("x", ("twist", "--residual")).needs, CORES)
        self.assertEqual(steady.Timed("x", ("twist", "--backend", "cuda")).needs, DEVICE)

    def test_a_limit_ends_the_waiting_for_a_place(self):
        log = Log()
        limit = Limit(1.5 * SECONDS)
        chosen = {f"p{n}": part_of(*(Task(f"{n}.{k}", log, on_device=True) for k in range(9))) for n in range(4)}
        ends = self.make(chosen, cards=1, limit=limit)
        self.assertEqual({end for end, _ in ends.values()}, {STOPPED})
        self.assertLess(len(log.seen), 36)

    def test_processors_are_shared_without_overlap_and_not_at_all_where_there_are_few(self):
        found = side_by_side.places(["0", "1"], list(range(9)))
        self.assertEqual([place.cores for place in (*found[DEVICE], *found[CORES])],
                         [(0, 1), (0, 1), (2, 3, 4), (5, 6, 7)])
        self.assertEqual([place.device for place in found[CORE]], ["0", "1"])
        self.assertEqual([place.cores for place in sum(side_by_side.places(["0", "1"], [0, 1]).values(), [])],
                         [()] * 6)
        self.assertEqual(len(side_by_side.places(["0", "1"], list(range(32)))[CORE]), 4)
        with mock.patch.dict(os.environ, {"CUDA_VISIBLE_DEVICES": "3,5,6"}):
            self.assertEqual(side_by_side.devices(2), ["3", "5"])

    def test_a_command_sees_its_device_and_its_processors(self):
        with tempfile.TemporaryDirectory() as folder:
            core, log = min(os.sched_getaffinity(0)), Path(folder) / "log"
            said = "import os; print(os.environ['CUDA_VISIBLE_DEVICES'], os.sched_getaffinity(0))"
            before = PLACE.set(Place("7", (core,)))
            try:
                jobs.command_in([sys.executable, "-c", said], log=log)
            finally:
                PLACE.reset(before)
            self.assertEqual(log.read_text().strip(), f"7 {{{core}}}")


class Pieces(unittest.TestCase):
    """Archives of files that do not fit into one."""

    @dataclass(frozen=True)
    class Files:
        number: int

        def results(self, root, _frames, _last):
            yield from sorted(root.glob("*.bin"))[:self.number]

    def test_a_full_archive_is_closed_and_nothing_is_packed_twice(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            (out / "f").mkdir()
            for number in range(6):
                (out / f"f/{number}.bin").write_bytes(os.urandom(40_000))
            (out / packing.STAMP).write_text("the program")
            with mock.patch.object(packing, "PIECE", 100_000):
                archive = packing.Archive(out / "packed", out, beside=(packing.STAMP,))
                for number in (1, 5, 6):
                    archive.write({"p": parts.Part("f", ((self.Files(number),),))})
            names = []
            for path in sorted((out / "packed").iterdir()):
                self.assertLess(path.stat().st_size, 100_000 + 2 * 41_000)
                self.assertEqual(packing.read(path, packing.STAMP), "the program")
                with tarfile.open(path) as piece:
                    names += [name for name in piece.getnames() if name.endswith(".bin")]
            self.assertEqual(sorted(names), [f"f/{number}.bin" for number in range(6)])
            self.assertGreater(len(list((out / "packed").iterdir())), 1)
            whole = {"p": parts.Part("f", ((self.Files(6),),))}
            self.assertEqual(packing.Archive(out / "packed", out).write(whole), [])


if __name__ == "__main__":
    unittest.main()
