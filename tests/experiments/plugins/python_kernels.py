"""Tests kernels in Python before the judge: those of experiments/plugins/README.md, kernels that break, files that are
refused, every stage of the table, C kernels that are called through arrays of Python, and ogc_testbed.judge.

Usage: python_kernels.py SOURCE_DIR OGC PLUGINS_DIR. Exit status 77: skipped, NumPy is missing.
"""

import json
import linecache
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

SOURCE, OGC, PLUGINS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
del sys.argv[1:4]
sys.path.insert(0, str(SOURCE / "experiments/python"))
import ogc_testbed

PAGE = (SOURCE / "experiments/plugins/README.md").read_text()
ROUNDED, RIGHT = re.findall(r"<!-- mine.py -->\n```python\n(.*?)```", PAGE, re.S)
HEAD = "def mine(previous, position, bound):\n"
ONE_CASE = ("--problem", "stage=truncate gen=uniform seed=1 index=5")

# Python that calls the C functions of a plug-in with the arrays that a kernel gets.
THROUGH = '''
import ctypes, json, os
import numpy as np
import ogc_testbed as ogc

TABLE = json.load(open(os.environ["OGC_TABLE"]))
LIBRARY = ctypes.CDLL(os.environ["OGC_LIBRARY"])
MEMBERS = {s["name"]: s["members"] for s in TABLE["structures"]}
BYTES = {s["name"]: s["bytes"] for s in TABLE["structures"]}

def dtype(name):
    if name not in MEMBERS:
        return np.dtype(name)
    parts = [m for m in MEMBERS[name] if m["role"] != "reserved"]
    return np.dtype({"names": [m["name"] for m in parts], "offsets": [m["offset"] for m in parts],
                     "formats": [(dtype(m["type"]), tuple(m["shape"])) for m in parts], "itemsize": BYTES[name]})

def numbers(values, found):
    for name, value in values.items():
        if hasattr(value, "__dict__"):
            numbers(vars(value), found)
        elif isinstance(value, int):
            found.setdefault(name, value)
    return found

def put(memory, place, value, kind, shape):
    array = np.zeros(1, np.dtype((dtype(kind), tuple(shape))))
    if hasattr(value, "__dict__"):
        for name, part in vars(value).items():
            array[name] = part
    else:
        array[0] = value
    memory[place:place + array.nbytes] = array.tobytes()

class Call:
    def __init__(self, stage, values, room):
        self.numbers, self.room, self.keep, self.outputs, self.counts = numbers(values, {}), room, [], {}, {}
        self.memory = [bytearray(BYTES[stage[side]]) for side in ("in", "out")]
        self.fill(self.memory[0], 0, stage["in"], values)
        self.fill(self.memory[1], 0, stage["out"], {})
        pointers = [(ctypes.c_char * len(m)).from_buffer(m) for m in self.memory]
        assert LIBRARY[stage["function"]](*pointers) == 0

    def fill(self, memory, base, structure, values):
        for m in MEMBERS[structure]:
            place, role, value = base + m["offset"], m["role"], values.get(m["name"])
            if role == "nested":
                self.fill(memory, place, m["type"], vars(value) if value is not None else {})
            elif role in ("capacity", "count"):
                put(memory, place, self.room if role == "capacity" else -1, "int64", ())
                if role == "count":
                    self.counts[m["list"]] = place
            elif role == "value":
                put(memory, place, value, m["type"], m["shape"])
            elif role == "input":
                put(memory, place, value.ctypes.data, "int64", ())
                assert value.dtype == dtype(m["type"]) and not value.flags.writeable
            elif role == "output":
                shape = [self.room if k == 0 and "list" in m else self.numbers.get(n, n)
                         for k, n in enumerate(m["shape"])]
                self.keep.append(np.zeros(shape, dtype(m["type"])))
                self.outputs[m["name"]] = m.get("list"), self.keep[-1]
                put(memory, place, self.keep[-1].ctypes.data, "int64", ())

    def answer(self):
        count = {k: int(np.frombuffer(self.memory[1], np.int64, 1, at)[0]) for k, at in self.counts.items()}
        if max(count.values(), default=0) > self.room:
            return None
        return {name: a if which is None else a[:count[which]] for name, (which, a) in self.outputs.items()}

def kernel_of(stage):
    def call(**values):
        room = 64 + max(numbers(values, {}).values())  # a list of rest data has at most so many entries
        while True:
            answer = Call(stage, values, room).answer()
            if answer is not None:
                return answer
            room *= 8
    return call

for stage in TABLE["stages"]:
    if hasattr(LIBRARY, stage["function"]):
        globals()[stage["name"]] = ogc.kernel(stage["name"])(kernel_of(stage))
'''

# Kernels of all stages that check each array of the question against the table, and answer with zeros.
ECHO = '''
import json, os
import numpy as np
import ogc_testbed as ogc

TABLE = json.load(open(os.environ["OGC_TABLE"]))
MEMBERS = {s["name"]: s["members"] for s in TABLE["structures"]}
BYTES = {s["name"]: s["bytes"] for s in TABLE["structures"]}

def length(word, values, whole):
    if word.endswith("]"):
        name, at = word[:-1].split("[")
        return int(values[name][values[at]])
    name, _, more = word.partition(" + ")
    return values.get(name, whole.get(name)) + int(more or 0)

def check(structure, values, whole):
    for m in MEMBERS[structure]:
        if m["role"] == "reserved":
            continue
        value = values[m["name"]]
        if m["role"] == "nested":
            inner = vars(value)
            if m["type"] == "ogc_rows":
                rows = whole["edge_count" if m["name"].startswith("edge_") else "vertex_count"]
                inner = {**inner, "rows": rows}
            check(m["type"], inner, whole)
        elif m["role"] == "value" and m["type"] in MEMBERS:
            assert set(vars(value)) == {part["name"] for part in MEMBERS[m["type"]]}, m
        elif m["role"] == "value":
            assert np.dtype(m["type"]) == (np.asarray(value).dtype if m["type"] != "int32" else np.int32), m
        else:
            shape = tuple(w if isinstance(w, int) else length(w, values, whole) for w in m["shape"])
            assert value.shape == shape, (structure, m, value.shape, shape)
            bytes_of_one = BYTES[m["type"]] if m["type"] in BYTES else np.dtype(m["type"]).itemsize
            assert value.dtype.itemsize == bytes_of_one, m
            assert value.flags.c_contiguous and not value.flags.writeable, m

def outputs(structure):
    for m in MEMBERS[structure]:
        if m["role"] == "nested":
            yield from outputs(m["type"])
        elif m["role"] == "output":
            yield m

def numbers(values, found):
    for name, value in values.items():
        if hasattr(value, "__dict__"):
            numbers(vars(value), found)
        elif isinstance(value, int):
            found.setdefault(name, value)
    return found

def kernel_of(stage):
    def echo(**values):
        known, answer = numbers(values, {}), {}
        check(stage["in"], values, known)
        for m in outputs(stage["out"]):
            shape = [0 if k == 0 and "list" in m else known.get(n, n) for k, n in enumerate(m["shape"])]
            if m["type"] in MEMBERS:
                parts = MEMBERS[m["type"]]
                answer[m["name"]] = {p["name"]: np.zeros((0, *p["shape"]), p["type"]) for p in parts}
            else:
                answer[m["name"]] = np.zeros(shape, m["type"])
        print("asked", stage["name"])
        return answer
    return echo

for stage in TABLE["stages"]:
    globals()[stage["name"]] = ogc.kernel(stage["name"])(kernel_of(stage))
'''


class Judged(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def compare(self, source, *arguments, name="mine.py", **environment):
        """Judges a file with this source; returns exit status, standard output and standard error."""
        file = self.folder / name
        if source is not None:
            file.write_text(source)
        command = [OGC, "compare", *arguments, "--plugin", file]
        environment = {**os.environ, "OGC_PYTHON": sys.executable, **environment}
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def table(self):
        done = subprocess.run([OGC, "compare", "--list", "--json"], capture_output=True, text=True, check=True)
        file, table = self.folder / "table.json", json.loads(done.stdout)["plugin"]
        file.write_text(json.dumps(table))
        return table, str(file)


class OfThePage(Judged):
    def test_the_right_one_passes(self):
        status, out, err = self.compare(RIGHT, "truncate", "--cases", "100000", "--json")
        self.assertEqual(status, 0, out + err)
        result = json.loads(out)
        self.assertEqual(result["stages"][0]["mismatches"], 0)
        self.assertGreaterEqual(result["stages"][0]["cases"], 100000)
        self.assertEqual(result["plugin"]["name"], "mine")
        self.assertGreater(result["plugin"]["times"][0]["plugin_seconds"], 0)

    def test_the_rounded_one_is_named(self):
        status, out, err = self.compare(ROUNDED, "truncate", "--cases", "20000")
        self.assertEqual(status, 1, out + err)
        self.assertIn("your answer equals `rounded_to_nearest`", out)


class ThatBreak(Judged):
    # Line in front of the right kernel's own, and what the judge prints.
    BREAKING = {
        "raise ValueError('a bound is 0')": "no answer: your kernel raised ValueError: a bound is 0, line 9 of mine.py",
        "return numpy_is_not_imported": "no answer: your kernel raised NameError: name 'numpy_is_not_imported' is not",
        "return position.astype(float), bound > 1": "your kernel returned `position` as float64 instead of float32",
        "return position[:, :2], bound > 1": "your kernel returned `position` with shape (1, 2) instead of (1, 3)",
        "return position, np.full(len(bound), 300)": "returned `cut` with the element 300; uint8 has 0 to 255",
        "return (position,)": "your kernel returned 1 array; the stage has position, cut",
        "return position": "your kernel returned one ndarray; the stage has position, cut",
        "return {'position': position}": "your kernel returned no cut; the stage has position, cut",
        "return {'position': position, 'cut': bound > 1, 'z': 0}": "returned z, which the stage does not have",
        "return None": "your kernel returned None; the stage has position, cut",
        "return 'position', bound > 1": "your kernel returned `position` as <U8",
        "return position * np.float32('nan'), bound > 1": "mine returned NaN: 3 elements of truncate.position",
        "position[0] = 0": "your kernel raised ValueError: assignment destination is read-only",
        "import sys; sys.exit(7)": "your kernel raised SystemExit: 7, line 9 of mine.py",
        "import os; os._exit(7)": "no answer: it ended the process, exit status 7",
        "import ctypes; ctypes.string_at(0)": "no answer: it crashed: signal 11",
        "while True: pass": "no answer: it hangs: no answer within 3 seconds",
        "import os; os.close(3)": "no answer: it closed the worker's socket",
        "import os; os.write(3, b'garbage' * 9)": "its worker sent a message that does not begin as its messages do",
        "import os; os.read(3, 0); os.fork() or os._exit(0); os._exit(5)": "it ended the process, exit status 5",
    }
    PASSING = (
        "print('a kernel may print')",
        "import os; os.write(1, b'a kernel may print')",
        "import os; os.fork()",
        "import os, sys; os.fork() or sys.exit(3)",
        "import os; os.fork() or os._exit(3)",
        "import subprocess; subprocess.run(['echo', 'a kernel may print'])",
    )

    def with_line(self, line):
        self.assertEqual(RIGHT.count(HEAD), 1)
        return RIGHT.replace(HEAD, f"{HEAD}    {line}\n")

    def test_each_is_told_what_it_did(self):
        for line, said in self.BREAKING.items():
            with self.subTest(line):
                status, out, err = self.compare(self.with_line(line), *ONE_CASE, "--time-limit", "3")
                self.assertEqual(status, 1, out + err)
                self.assertIn(said, out)

    def test_what_does_no_harm_passes_and_disturbs_no_result(self):
        for line in self.PASSING:
            with self.subTest(line):
                status, out, err = self.compare(self.with_line(line), *ONE_CASE, "--json")
                self.assertEqual(status, 0, out + err)
                self.assertEqual(json.loads(out)["stages"][0]["mismatches"], 0)
                if "print" in line:
                    self.assertIn("a kernel may print", err)

    def test_tensors_of_others(self):
        tensor = "class Tensor:\n    def __init__(self, a): self.a = a\n    def numpy(self):\n        {}\n" + RIGHT
        tensor = tensor.replace("return x, cut", "return Tensor(x), Tensor(cut)")
        status, out, err = self.compare(tensor.format("return self.a"), *ONE_CASE)
        self.assertEqual(status, 0, out + err)
        status, out, err = self.compare(tensor.format("raise TypeError('it is on the device')"), *ONE_CASE)
        self.assertEqual(status, 1, out + err)
        self.assertIn("returned `position` as Tensor, which is no array on the host: it is on the device", out)

    def test_the_failing_case_is_found_in_its_batch(self):
        line = "if (bound == 0).any(): raise ValueError('a bound is 0')"
        said = "your kernel raised ValueError: a bound is 0, line 9 of mine.py"
        status, out, err = self.compare(self.with_line(line), "truncate", "--cases", "3000", "--json")
        self.assertEqual(status, 1, out + err)
        stage = json.loads(out)["stages"][0]
        self.assertEqual({row["message"] for row in stage["listed"]}, {"no answer: " + said})
        self.assertGreaterEqual(stage["mismatches"], 3)
        self.assertGreater(stage["cases"], stage["mismatches"])

    def test_lists(self):
        kernel = "import numpy as np\nimport ogc_testbed as ogc\n@ogc.kernel('detect_vertex_facet')\n"
        kernel += "def f(topology, vertex_count=0):\n    t, v = topology.triangle_count, topology.vertex_count\n"
        kernel += "    d = np.zeros(v, np.float32), np.zeros(t, np.float32)\n    return {}, *d\n"
        case = ("--problem", "stage=detect_vertex_facet gen=lattice seed=3 index=402")
        for contacts, said in {
            "np.zeros((0, 4), int)": "is missing",
            "np.zeros((7, 3), int)": "`contacts` with shape (7, 3) instead of (any, 4)",
            "np.full((7, 4), 2.5)": "`contacts` as float64 instead of int32",
            "np.full((7, 4), 7)": "no answer: a contact names a face of kind 7",
            "{'vertex': [1], 'kind': [1], 'face': [1]}": "it has vertex, kind, face, owner",
            "np.zeros((10**6, 4), int)": "no answer: it counts 1000000 contacts, at most ",
        }.items():
            with self.subTest(contacts):
                status, out, err = self.compare(kernel.format(contacts), *case)
                self.assertEqual(status, 1, out + err)
                self.assertIn(said, out)


class Refused(Judged):
    def refused(self, source, said, *arguments, name="mine.py", status=2, **environment):
        with self.subTest(said):
            found, out, err = self.compare(source, *(arguments or ("--cases", "10")), name=name, **environment)
            self.assertEqual(found, status, out + err)
            self.assertIn(said, err)

    def test_files(self):
        two = RIGHT + RIGHT[RIGHT.index("@ogc") :].replace("def mine", "def other")
        self.refused(None, "there is no such file", name="nowhere.py")
        self.refused("x = 1\n", "it has no kernel; write @ogc_testbed.kernel")
        self.refused(RIGHT.replace('"truncate"', '"truncated"'), "of the stage `truncated`; known: closest_face, ")
        self.refused(two, "two kernels of the stage truncate: `mine` (line 7 of mine.py) and `other` (line")
        self.refused(RIGHT.replace(HEAD, HEAD.replace("bound", "bounds")), "takes `bounds`; the stage has n")
        self.refused(RIGHT.replace('("truncate")', ""), "can't be loaded: TypeError: kernel takes the name of a stage")
        self.refused("x = = 1\n", "it can't be loaded: SyntaxError: invalid syntax, line 1 of mine.py")
        self.refused(RIGHT + "\nodd = ogc.kernel('ccd')(type('Odd', (), {})())\n", "is not a callable object")
        self.refused("\nimport nothing_of_this_name\n", "No module named 'nothing_of_this_name', line 2 of mine.py")
        self.refused("raise SystemExit(3)\n", "it can't be loaded: SystemExit: 3, line 1 of mine.py")
        self.refused(RIGHT, "it has no kernel of bound; its stages: truncate", "bound")
        self.refused("import os; os.abort()\n", "it crashed: signal 6", status=1)
        self.refused("while True: pass\n", "it hangs", "--time-limit", "1", status=1)

    def test_interpreters(self):
        bare = self.folder / "bare"
        bare.write_text(f'#!/bin/sh\nexec "{sys.executable}" -S "$@"\n')
        bare.chmod(0o755)
        self.refused(RIGHT, "has no NumPy", OGC_PYTHON=str(bare), PYTHONPATH="")
        self.refused(RIGHT, "the interpreter /nowhere/python3 can't be started", OGC_PYTHON="/nowhere/python3")


class WhoseJudgeIsKilled(Judged):
    """The worker of a judge that was killed ends, whatever it does, and with it what the kernel has started."""

    def orphans_end(self, plugin, count, problem=ONE_CASE, **environment):
        """Kills the judge once the plug-in has noted `count` processes in the file `child`; all of them end."""
        notes = self.folder / "child"
        judge = subprocess.Popen([OGC, "compare", *problem, "--time-limit", "1000", "--plugin", plugin],
                                 cwd=self.folder, env={**os.environ, "OGC_PYTHON": sys.executable, **environment},
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            self.wait("no number was noted", lambda: notes.exists() and notes.read_text().endswith("\n"))
        finally:
            judge.kill()
            judge.wait()
        numbers = [int(number) for number in notes.read_text().split()]
        self.assertEqual(len(numbers), count)
        self.wait("a process goes on", lambda: not any(self.runs(number) for number in numbers))

    def file(self, source):
        file = self.folder / "mine.py"
        file.write_text("import os, subprocess, time\n"
                        "def note(*numbers): open('child', 'w').write(' '.join(map(str, numbers)) + '\\n')\n"
                        + source)
        return file

    def wait(self, failure, done, seconds=100):
        until = time.monotonic() + seconds
        while not done():
            self.assertLess(time.monotonic(), until, failure)
            time.sleep(0.05)

    @staticmethod
    def runs(number):
        """Returns whether the process runs; one that has ended may wait for its new parent to ask for its status."""
        try:
            return Path(f"/proc/{number}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
        except (FileNotFoundError, ProcessLookupError):
            return False

    def test_in_a_kernel(self):
        begin = "    note(os.getpid(), subprocess.Popen(['sleep', '1000']).pid)\n    time.sleep(1000)\n"
        self.orphans_end(self.file(RIGHT.replace(HEAD, HEAD + begin)), 2)

    def test_while_loading(self):
        self.orphans_end(self.file("note(os.getpid())\ntime.sleep(1000)\n"), 1)

    def test_in_a_shared_library(self):
        problem = ("--problem", "stage=activation gen=ladder.radius seed=1 index=1")
        self.orphans_end(PLUGINS / "libplugin_broken.so", 1, problem, OGC_BROKEN="hang and tell")


class OfEveryStage(Judged):
    def test_questions_are_as_the_table_says(self):
        table, file = self.table()
        for stage in table["stages"]:
            with self.subTest(stage["name"]):
                # Libraries with `tetrahedron` are asked about solids, those with `plane` about half-spaces.
                status, out, err = self.compare(ECHO, stage["name"], "--cases", "400", "--json", OGC_TABLE=file)
                self.assertEqual(status, 1, out + err)
                self.assertIn(f"asked {stage['name']}", err)
                self.assertEqual([row for row in self.unanswered(out) if "raised" in row or "returned" in row], [])

    def unanswered(self, out):
        listed = (row for stage in json.loads(out)["stages"] for row in stage["listed"])
        return [row["message"] for row in listed if "no answer" in row["message"]]

    def test_c_kernels_pass_through_python(self):
        table, file = self.table()
        asked = 0
        for library, count in (("ours", 6), ("our_volumes", 2)):
            path = str(PLUGINS / f"libplugin_{library}.so")
            status, out, err = self.compare(THROUGH, "--cases", "1000", "--json", OGC_TABLE=file, OGC_LIBRARY=path)
            self.assertEqual(status, 0, out[-3000:] + err)
            stages = json.loads(out)["stages"]
            self.assertEqual(len(stages), count)
            for stage in stages:
                self.assertEqual(stage["mismatches"], 0)
                self.assertGreaterEqual(stage["cases"], 1000)


class FromPython(Judged):
    def judged(self, source, **options):
        """Judges the kernel `mine` of a file."""
        file = self.folder / "mine.py"
        file.write_text(source)
        values = {"__name__": "mine_as_a_file"}
        exec(compile(source, str(file), "exec"), values)
        return ogc_testbed.judge(values["mine"], program=OGC, **options)

    def in_notebook(self, source):
        """Returns the names that a notebook's cell defines."""
        name = f"<cell {len(linecache.cache)}>"
        linecache.cache[name] = (len(source), None, source.splitlines(True), name)
        values = {"__name__": "__main__"}
        exec(compile(source, name, "exec"), values)
        return values

    def test_verdicts(self):
        right = self.judged(RIGHT, cases=5000)
        self.assertTrue(right.passed and right.first is None and not right.mistakes)
        self.assertGreaterEqual(right.counts["cases"], 5000)
        self.assertGreater(right.times["kernel"], 0)
        wrong = self.judged(ROUNDED, cases=5000)
        self.assertFalse(wrong.passed)
        self.assertEqual(list(wrong.mistakes), ["rounded_to_nearest"])
        self.assertEqual(set(wrong.first.inputs), {"previous", "position", "bound"})
        self.assertNotEqual(wrong.first.given["position"], wrong.first.exact["position"])
        for part in ("truncate: mismatch", "`rounded_to_nearest`", wrong.first.problem, "bound = "):
            self.assertIn(part, str(wrong))

    def test_a_file_is_read_down_to_its_judge(self):
        script = RIGHT + "\nprint(ogc.judge(mine, cases=2000))\nraise SystemExit(4)\n"
        (self.folder / "script.py").write_text(script)
        environment = {**os.environ, "OGC_PROGRAM": str(OGC), "PYTHONPATH": str(SOURCE / "experiments/python")}
        command = [sys.executable, self.folder / "script.py"]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("truncate: passed, 0 of 200", done.stdout)

    def test_kernels_of_a_notebook(self):
        values = self.in_notebook("eps = 2.0**-50\nsum = object()\n" + RIGHT.replace("2.0**-50", "eps"))
        self.assertTrue(ogc_testbed.judge(values["mine"], cases=2000, program=OGC).passed)
        values = self.in_notebook("import numpy\ntable = numpy.zeros(3)\n" + RIGHT.replace("2.0**-50", "table[0]"))
        with self.assertRaisesRegex(ValueError, "`mine.table` is of type ndarray, which has no source"):
            ogc_testbed.judge(values["mine"], program=OGC)

    def test_what_is_missing_is_named(self):
        with self.assertRaisesRegex(ValueError, "has no kernel|is no kernel"):
            ogc_testbed.judge(len, program=OGC)
        with self.assertRaisesRegex(ValueError, "is a kernel of truncate, not of bound"):
            self.judged(RIGHT, stage="bound")
        with self.assertRaisesRegex(ValueError, "a kernel of the stage `truncated`"):
            self.judged(RIGHT.replace('"truncate"', '"truncated"'))
        with self.assertRaisesRegex(RuntimeError, "/nowhere/ogc, which program names, can't be started"):
            ogc_testbed.judge(self.in_notebook(RIGHT)["mine"], program="/nowhere/ogc")


unittest.main(verbosity=1)
