#!/usr/bin/env python3
"""Checks the shape of the house: who includes whom, no cycles, no folders that include each other, short files, lines
of at most 120 columns, no strangers at the top, no paths of a machine. C, C++ and CUDA are laid out by .clang-format
(version 14; comments by hand), all else by hand; rows of tables in documents, what programs print there, and data may
be longer.

The tables below are the include rules of CONTRIBUTING.md; a room is named by its folder, the longest that fits. Usage:

    tests/includes.py ROOT         the self-test, then ROOT; one line for each finding, exit status 1 where there is any
    tests/includes.py --self-test  only the self-test: violations planted in a temporary tree must be found, and nothing
      else
"""

import re
import tempfile
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

from house import run

SOURCE_SUFFIXES = {".hpp", ".h", ".cpp", ".cu", ".cuh"}
LINE_LIMITED_SUFFIXES = SOURCE_SUFFIXES | {".py", ".sh", ".cmake", ".txt"}
LONGEST_FILE = 800
MOST_COLUMNS = 120
COLUMN_LIMITED_SUFFIXES = SOURCE_SUFFIXES | {".c", ".py", ".sh", ".cmake", ".yaml", ".md", ".in", ".toml", ""}
# Matches blocks of a document (with their language), rows of its tables, and lines indented by four spaces.
PART = re.compile(r"^ *```(?P<language>\w*)\n.*?^ *```$|^ *\|[^\n]*$|^ {4}[^\n]*$", re.M | re.S)

# Names that are allowed at the top, beside names that begin with a dot.
TOP = {"compare", "reference", "fast", "experiments", "plots", "paper_figures", "tests", "README.md", "CHANGELOG.md",
       "CONTRIBUTING.md", "LICENSE", "CITATION.cff", "CMakeLists.txt", "CMakePresets.json", "pyproject.toml"}

PROBLEM = ("compare/problem/", "compare/stages/")
FILES = PROBLEM + ("compare/files/", "compare/record/")
CONTESTANT = ("compare/contestant.hpp", "compare/way.hpp")
CASES = FILES + CONTESTANT + ("compare/judge/cases/",)
ENGINE = CASES + ("compare/judge/engine/",)
REPORT = ENGINE + ("compare/judge/report/",)

# Beginnings of the project includes that are allowed, by room.
PROJECT = {
    "compare/problem": PROBLEM,
    "compare/stages": PROBLEM,
    "compare/contestant.hpp": PROBLEM,
    "compare/way.hpp": CONTESTANT,
    "compare/files": FILES,
    "compare/record": FILES + CONTESTANT,
    "compare/laws": PROBLEM + CONTESTANT + ("compare/laws/",),
    # Each of these may include the ones before it. None may include a stage, which the list in cases/ points to.
    "compare/judge/cases": CASES,
    "compare/judge/engine": ENGINE,
    "compare/judge/report": REPORT,
    "compare/judge/stages": REPORT + ("compare/judge/stages/",),
    "compare/oracle": PROBLEM + ("compare/oracle/",),
    "compare/plugin.h": ("compare/plugin/",),
    "compare/plugin": ("compare/plugin/",),
    "reference": PROBLEM + CONTESTANT + ("reference/",),
    # The truth of this stage is an exact decision, which the oracle makes.
    "reference/ipc/ccd.cpp": PROBLEM + CONTESTANT + ("reference/", "compare/oracle/first_meeting.hpp"),
    "fast": PROBLEM + CONTESTANT + ("fast/",),
    "experiments": ("compare/", "experiments/", "reference/contestant.hpp", "fast/contestant.hpp"),
    # What the modules link: the fast path, scenes, and the oracle.
    "experiments/python": PROBLEM + CONTESTANT + ("compare/oracle/", "experiments/python/", "experiments/scenes/",
                                                  "fast/contact_forces.hpp", "fast/contact_sets.hpp",
                                                  "fast/contestant.hpp", "fast/guard.hpp", "fast/mesh.hpp",
                                                  "fast/resident_state.hpp", "fast/worlds.hpp"),
    "experiments/examples": ("compare/", "fast/contact_sets.hpp", "fast/contestant.hpp", "fast/guard.hpp"),
    "experiments/program/commands/contacts.cpp": ("compare/", "experiments/", "reference/contestant.hpp",
                                                  "fast/contestant.hpp", "fast/contact_sets.hpp"),
    "experiments/bench/worlds_benchmarks.cpp": ("compare/", "experiments/", "fast/worlds.hpp"),
    "experiments/program/runs/worlds_run.cpp": ("compare/", "experiments/", "fast/worlds.hpp"),
    "tests": ("",),
}

# Headers of CGAL under the LGPL, as their SPDX lines and those of all that they include state. The oracle uses no
# others, because it may audit any contestant; nor does the reference, as its answers are in the Python package's judge.
LESSER_CGAL = {"CGAL/Exact_predicates_inexact_constructions_kernel.h", "CGAL/Exact_rational.h", "CGAL/Gmpq.h",
               "CGAL/Interval_nt.h", "CGAL/Mpzf.h", "CGAL/Segment_3.h", "CGAL/Triangle_3.h", "CGAL/intersections.h"}

# Rooms that may have a foreign include (besides tests), by the beginning of the include.
FOREIGN = {
    "CGAL/": ("compare/oracle", "reference"),
    "boost/multiprecision/": ("compare/oracle", "reference"),
    "gmp": ("compare/oracle", "reference"),
    "mpfr": ("compare/oracle", "reference"),
    "Eigen/": ("reference",),
    "cholmod": ("reference",),
    "immintrin.h": ("reference", "fast/cpu"),
    "emmintrin.h": ("fast/cpu",),
    "suitesparse/": ("reference",),
    "nlohmann/": ("compare/files", "compare/record", "compare/judge", "experiments"),
    "hdf5": ("compare/files", "compare/record"),
    "H5": ("compare/files", "compare/record"),
    "zlib.h": ("compare/files",),
    "expat.h": ("compare/files",),
    "unzip.h": ("compare/files",),
    "glob.h": ("experiments/program/audits",),
    "tbb/": ("compare/oracle", "reference", "fast/cpu", "fast/worlds", "experiments"),
    "oneapi/tbb": ("compare/oracle", "reference", "fast/cpu", "experiments"),
    "cuda": ("fast/cuda",),
    "cub/": ("fast/cuda",),
    "cxxabi.h": ("fast/cuda",),
    "thrust/": ("fast/cuda",),
    "cooperative_groups": ("fast/cuda",),
    "CLI/": ("experiments",),
    "benchmark/": ("experiments",),
    "nanobind/": ("experiments/python",),
    "dlfcn.h": ("experiments/plugins",),
    "pthread.h": ("experiments/plugins",),
    "poll.h": ("experiments/plugins",),
    "signal.h": ("experiments/plugins", "experiments/program/python_program.cpp"),
    "spawn.h": ("experiments/plugins", "experiments/bench", "experiments/program/python_program.cpp"),
    "stdint.h": ("compare/plugin",),
    "catch2/": (),
    "unistd.h": ("compare/files", "compare/record", "fast/cpu", "experiments"),
    "fcntl.h": ("compare/files", "compare/record", "experiments"),
    "sys/": ("compare/files", "compare/record", "experiments"),
}

STANDARD = re.compile(r"[a-z_]+")  # headers of the standard library have no suffix
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
MACHINE_PATH = re.compile(r"(?<![\w.~$}\-])/(?:home|root|work|Users)/[\w.]")
# `.git` is a file in a linked worktree.
SKIPPED = {".git", "build", "ogc-compare", "__pycache__", ".venv", "venv", ".cache", ".snakemake",
           ".pytest_cache"}


class House:
    """Holds all files below a root, their includes, and the findings about them."""

    def __init__(self, root):
        self.root = Path(root)
        self.findings = []
        self.includes = {}  # file -> [(line number, included file)], project includes that exist
        files = sorted(self.files())
        for path in files:
            self.read(path)
        self.check_top(files)
        self.check_cycles()
        self.check_folder_pairs()

    def files(self):
        for path in self.root.rglob("*"):
            parts = path.relative_to(self.root).parts
            is_made = parts[0] == "runs" or parts[0].startswith("build")
            if path.is_file() and not SKIPPED.intersection(parts) and not is_made:
                yield path

    def report(self, file, line, message):
        self.findings.append(f"{file}:{line}: {message}")

    def read(self, path):
        file = path.relative_to(self.root).as_posix()
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            return  # pictures and binary results
        lines = text.splitlines()
        self.check_columns(file, path, text)
        for number, text in enumerate(lines, 1):
            if MACHINE_PATH.search(text):
                self.report(file, number, "contains an absolute path of a machine; write it relative to the repository")
        if path.suffix in LINE_LIMITED_SUFFIXES and len(lines) > LONGEST_FILE:
            self.report(file, len(lines), f"has {len(lines)} lines; split it, {LONGEST_FILE} is the limit")
        if path.suffix in SOURCE_SUFFIXES:
            self.read_includes(file, lines)

    def check_columns(self, file, path, text):
        if path.suffix not in COLUMN_LIMITED_SUFFIXES and path.name != "CMakeLists.txt":
            return
        if path.suffix == ".md":
            text = PART.sub(lambda part: part[0] if part["language"] else "\n" * part[0].count("\n"), text)
        do = f"run clang-format -i {file}" if path.suffix in SOURCE_SUFFIXES else "wrap it"
        for number, line in enumerate(text.split("\n"), 1):
            if len(line) > MOST_COLUMNS:
                self.report(file, number, f"{len(line)} columns, {MOST_COLUMNS} are allowed; {do}")

    def read_includes(self, file, lines):
        self.includes[file] = []
        room = longest(PROJECT, file)
        for number, text in enumerate(lines, 1):
            match = INCLUDE.match(text)
            if not match:
                continue
            project, foreign = match.groups()
            if room is None:
                self.report(file, number, "stands in no room that may include anything; add its folder to "
                                          "tests/includes.py")
            elif project is not None:
                self.check_project(file, number, room, project)
            else:
                self.check_foreign(file, number, room, foreign)

    def check_project(self, file, number, room, included):
        if not (self.root / included).is_file():
            self.report(file, number, f'"{included}" does not exist; write includes from the root of the repository')
            return
        self.includes[file].append((number, included))
        if not included.startswith(PROJECT[room]):
            self.report(file, number, f'{room} may not include "{included}"')

    def check_foreign(self, file, number, room, included):
        if STANDARD.fullmatch(included) or room == "tests":
            return
        header = longest_beginning(FOREIGN, included)
        if header is None:
            self.report(file, number, f"<{included}> is neither standard nor in the table of tests/includes.py")
        elif not any(below(file, allowed) for allowed in FOREIGN[header]):
            self.report(file, number, f"<{included}> is allowed only in {', '.join(FOREIGN[header]) or 'tests'}")
        elif header == "CGAL/" and included not in LESSER_CGAL:
            self.report(file, number, f"<{included}> is not among CGAL's headers under the LGPL (tests/includes.py)")

    def check_top(self, files):
        names = {path.relative_to(self.root).parts[0] for path in files}
        for name in sorted(name for name in names - TOP if not name.startswith(".")):
            self.report(name, 1, "does not belong at the top; move it into its room, or leave it out")

    def check_cycles(self):
        graph = {file: {other for _, other in included} for file, included in self.includes.items()}
        try:
            TopologicalSorter(graph).prepare()
        except CycleError as error:  # one cycle, from the included file to the including one
            cycle = error.args[1][::-1]
            self.report(cycle[0], 1, "is in an include cycle: " + " -> ".join(cycle))

    def check_folder_pairs(self):
        """Finds folders that include each other. A .cpp at the top of a room and the program's main.cpp assemble their
        parts, which include the headers beside them: these do not count as a pair, two headers do."""
        edges = {}
        for file, included in self.includes.items():
            for number, other in included:
                assembles = "/" not in folder(file) and file.endswith(".cpp") or file.endswith("/main.cpp")
                if not assembles:
                    edges.setdefault((folder(file), folder(other)), (file, number, other))
        for (one, two), (file, number, other) in sorted(edges.items()):
            if one < two and (two, one) in edges:
                back, back_number, _ = edges[(two, one)]
                self.report(file, number, f'"{other}": the folders {one} and {two} include each other (the other way: '
                                          f'{back}:{back_number})')


def folder(file):
    return file.rpartition("/")[0]


def below(file, *folders):
    return any(file == name or file.startswith(name + "/") for name in folders)


def longest(table, file):
    return max((room for room in table if below(file, room)), key=len, default=None)


def longest_beginning(table, name):
    return max((beginning for beginning in table if name.startswith(beginning)), key=len, default=None)


SOUND = {
    "compare/problem/mesh.hpp": "#include <vector>\n",
    "compare/contestant.hpp": '#include "compare/stages/bound.hpp"\n',
    "compare/stages/bound.hpp": '#include "compare/problem/mesh.hpp"\n',
    "compare/files/scene.cpp": "#include <nlohmann/json.hpp>\n#include <fcntl.h>\n",
    "compare/oracle/audit.cpp": '#include <CGAL/Gmpq.h>\n#include "compare/problem/mesh.hpp"\n',
    "reference/contestant.hpp": '#include "compare/contestant.hpp"\n',
    "fast/contestant.hpp": '#include "compare/contestant.hpp"\n',
    "fast/contact_sets.hpp": "#include <span>\n",
    "fast/cpu/cpu.hpp": '#include "fast/contestant.hpp"\n',
    "fast/contestant.cpp": '#include "fast/cpu/cpu.hpp"\n',
    "fast/cuda/backend.cu": "#include <cub/cub.cuh>\n#include <cuda_runtime.h>\n",
    "experiments/run.cpp": '#include <CLI/CLI.hpp>\n#include "fast/contestant.hpp"\n#include '
                           '"reference/contestant.hpp"\n',
    "experiments/program/commands/contacts.cpp": '#include "fast/contact_sets.hpp"\n',
    "tests/fast/all.cpp": '#include <catch2/catch.hpp>\n#include "fast/contact_sets.hpp"\n',
    "README.md": "See https://example.org/work/page and ../work/notes.\n",
}

# By name: (files that change, the only finding, its place).
PLANTED = {
    "compare includes a contestant": (
        {"compare/files/x.cpp": '\n#include "fast/contact_sets.hpp"\n'},
        "compare/files may not include", "compare/files/x.cpp:2",
    ),
    "fast includes reference": (
        {"fast/contact_sets.hpp": '#include "reference/contestant.hpp"\n'},
        "fast may not include", "fast/contact_sets.hpp:1",
    ),
    "the engine of the judge includes a stage": (
        {"compare/judge/stages/x.hpp": "", "compare/judge/engine/x.cpp": '#include "compare/judge/stages/x.hpp"\n'},
        "compare/judge/engine may not", "compare/judge/engine/x.cpp:1",
    ),
    "experiments includes the inside, below a folder called runs": (
        {"fast/kernels/x.hpp": "", "experiments/runs/x.cpp": '#include "fast/kernels/x.hpp"\n'},
        "experiments may not", "experiments/runs/x.cpp:1",
    ),
    "CGAL in fast": ({"fast/x.cpp": "#  include <CGAL/Kernel.h>\n"}, "<CGAL/Kernel.h> is allowed only in",
                     "fast/x.cpp:1"),
    "CGAL under the GPL in the reference": ({"reference/x.cpp": "#include <CGAL/AABB_tree.h>\n"},
                                            "is not among CGAL's headers under the LGPL", "reference/x.cpp:1"),
    "CGAL under the GPL in the oracle": ({"compare/oracle/x.cpp": "#include <CGAL/AABB_tree.h>\n"},
                                         "is not among CGAL's headers under the LGPL", "compare/oracle/x.cpp:1"),
    "an unknown library": ({"fast/x.cpp": "#include <fmt/format.h>\n"}, "neither standard nor", "fast/x.cpp:1"),
    "not from the root": ({"fast/x.cpp": '#include "contestant.hpp"\n'}, "does not exist", "fast/x.cpp:1"),
    "a file in no room": ({"plots/x.cpp": "#include <vector>\n"}, "stands in no room", "plots/x.cpp:1"),
    "a cycle": (
        {"fast/a.hpp": '#include "fast/b.hpp"\n', "fast/b.hpp": '#include "fast/c.hpp"\n',
         "fast/c.hpp": '#include "fast/a.hpp"\n'},
        "is in an include cycle: fast/", "fast/",
    ),
    "folders that include each other": (
        {"fast/cpu/a.hpp": "", "fast/cpu/b.hpp": '#include "fast/stages/b.hpp"\n',
         "fast/stages/a.hpp": '#include "fast/cpu/a.hpp"\n', "fast/stages/b.hpp": ""},
        "the folders fast/cpu and fast/stages include each other", "fast/cpu/b.hpp:1",
    ),
    "a room's header that includes a part which includes it": (
        {"fast/cpu/x.hpp": "", "fast/x.hpp": '#include "fast/cpu/x.hpp"\n'},
        "the folders fast and fast/cpu include each other", "fast/x.hpp:1",
    ),
    "a long file": ({"fast/x.cpp": "\n" * (LONGEST_FILE + 1)}, "has 801 lines", "fast/x.cpp:801"),
    "a long line": ({"fast/x.cpp": "/" * MOST_COLUMNS + "\n" + "/" * (MOST_COLUMNS + 1)},
                    "121 columns, 120 are allowed; run clang-format", "fast/x.cpp:2"),
    "a long line of a document, outside of tables and what is printed": (
        {"README.md": "| {0} |\n```\n{0}\n```\n{0}\n".format("x" * (MOST_COLUMNS + 1))},
        "121 columns", "README.md:5"),
    "a path of a machine": ({"README.md": "first\nrun /" + "home/me/ogc\n"}, "absolute path of a machine",
                            "README.md:2"),
    "a stranger at the top": ({"failures/case.txt": ""}, "does not belong at the top", "failures:1"),
}


def findings_of(files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = Path(root) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return House(root).findings


def self_test():
    """Returns messages about planted violations that were not found, or found beside others."""
    failures = [f"self-test: a sound tree is refused: {finding}" for finding in findings_of(SOUND)]
    for name, (changes, message, where) in PLANTED.items():
        found = findings_of({**SOUND, **changes})
        if len(found) != 1 or message not in found[0] or not found[0].startswith(where):
            failures.append(f"self-test: {name}: expected one finding at {where}, '{message}', got {found}")
    return failures


def findings(root):
    house = House(root)
    return house.findings if house.includes else [f"{root}: no source files there"]


if __name__ == "__main__":
    run(__doc__, self_test, findings)
