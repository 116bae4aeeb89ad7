#!/usr/bin/env python3
"""A model that nobody handles must not compile: headers with one enumerator more are put before the real ones, and each
file that dispatches on these enumerations is compiled again, once for all of them.

    tests/planted_enumerators.py SOURCE_DIR BUILD_DIR     the self-test, then one line for each file that takes it; exit
                                                          status 1 for any

With unchanged copies in the same place every file must compile, so that an error is an enumerator's.
"""

import json
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FAST_KERNELS = "fast/cpu/pack_kernels.cpp"  # compiles the sweep with every model

# Enumeration, its header, and what must handle each of its values.
DISPATCHES = (
    ("Stage", "compare/judge/cases/stage.hpp", ("compare/judge/cases/stage.cpp",)),
    ("MembraneModel", "compare/problem/scene.hpp",
     ("reference/energies/membrane.cpp", "reference/solvers/vertex_system.cpp", "reference/solvers/potential.cpp",
      FAST_KERNELS)),
    ("BendingModel", "compare/problem/scene.hpp",
     ("reference/energies/bending.cpp", "reference/energies/rest_state.cpp", "reference/solvers/vertex_system.cpp",
      FAST_KERNELS)),
    ("ContactActivation", "compare/problem/settings.hpp",
     ("reference/energies/activation.cpp", "reference/energies/meeting.cpp", "reference/solvers/potential.cpp",
      FAST_KERNELS)),
    ("DampingForm", "compare/problem/settings.hpp",
     ("reference/energies/membrane.cpp", "reference/energies/bending.cpp", "reference/energies/spring.cpp",
      "reference/solvers/potential.cpp", FAST_KERNELS)),
    ("Bounds", "compare/problem/settings.hpp",
     ("reference/solvers/feasible_regions.cpp", "fast/cpu/probes.cpp", "experiments/program/audits/auditor.cpp")),
    ("Solver", "experiments/program/runs/solvers.hpp", ("experiments/program/runs/solvers.cpp",)),
)
UNHANDLED = r"enumeration value .planted_{}. not handled in switch"


def with_enumerator(text, enumeration):
    """The header with `planted_ENUMERATION` behind the last enumerator."""
    changed, count = re.subn(rf"(enum class {enumeration}\b[^{{}};]*{{[^}}]*?)(,?\s*}};)",
                             rf"\1, planted_{enumeration}\2", text)
    if count != 1:
        sys.exit(f"tests/planted_enumerators.py: {count} definitions of {enumeration}; correct DISPATCHES")
    return changed


def commands(build):
    """File, relative to the source, -> (folder, compiler and options) that it is compiled with."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        start = next(i for i, word in enumerate(words) if re.search(r"(\+\+|cc|clang)[-\d.]*$", word) and
                     "ccache" not in word)
        words = words[start:]
        at = words.index("-o")
        del words[at:at + 2]
        found.setdefault(entry["file"], (entry["directory"], [word for word in words if word != "-c"]))
    return found


def compiled(command, folder):
    """What the compiler says of a file with `folder` before every other place of headers."""
    directory, words = command
    line = [words[0], f"-I{folder}", *words[1:], "-fsyntax-only"]
    return subprocess.run(line, cwd=directory, capture_output=True, text=True, check=False)


def faults(source, build, file, headers):
    """Sentences about one file, which dispatches on each of these: enumeration -> its header."""
    command = commands(build).get(str(source / file))
    if command is None:
        return [f"{file} is not compiled in {build}: correct DISPATCHES"]
    outcomes = []
    for kind, plants in (("same", False), ("planted", True)):
        place = build / "planted_enumerators" / file.replace("/", "_") / kind
        for header in set(headers.values()):
            text = (source / header).read_text()
            for enumeration in (name for name in headers if plants and headers[name] == header):
                text = with_enumerator(text, enumeration)
            (place / header).parent.mkdir(parents=True, exist_ok=True)
            (place / header).write_text(text)
        outcomes.append(compiled(command, place))
    same, planted = outcomes
    if same.returncode != 0:
        return [f"{file} does not compile with a copy of {', '.join(set(headers.values()))}:\n{same.stderr}"]
    return [f"{file} compiles with a {enumeration} that it does not handle, or fails otherwise: write a `switch` "
            f"without `default`\n{planted.stderr}" for enumeration in headers
            if not re.search(UNHANDLED.format(enumeration), planted.stderr)]


SELF_TEST = {
    "room/kinds.hpp": "enum class Kind { one, two };\n",
    "src/handled.cpp": '#include "room/kinds.hpp"\nint f(Kind s) {\n  switch (s) {\n    case Kind::one: return 1;\n'
                   "    case Kind::two: break;\n  }\n  return 0;\n}\n",
    "src/default.cpp": '#include "room/kinds.hpp"\nint f(Kind s) {\n  switch (s) {\n    case Kind::one: return 1;\n'
                   "    default: return 0;\n  }\n}\n",
    "src/broken.cpp": '#include "room/kinds.hpp"\nint f(Kind s) { return s; }\n',
}


def self_test(compiler):
    """Sentences about planted files that are judged wrongly."""
    with tempfile.TemporaryDirectory() as folder:
        place, entries = Path(folder).resolve(), []
        for name, text in SELF_TEST.items():
            (place / name).parent.mkdir(exist_ok=True)
            (place / name).write_text(text)
            command = f"{compiler} -I{place} -Wall -Werror -o x.o -c {place / name}"
            entries.append({"file": str(place / name), "directory": str(place), "command": command})
        (place / "compile_commands.json").write_text(json.dumps(entries))
        wrong = []
        for name, expected in (("src/handled.cpp", ""), ("src/default.cpp", "compiles with a Kind"),
                               ("src/broken.cpp", "does not compile with a copy"), ("src/gone.cpp", "is not compiled")):
            found = faults(place, place, name, {"Kind": "room/kinds.hpp"})
            if bool(found) != bool(expected) or not all(expected in sentence for sentence in found):
                wrong.append(f"self-test: {name}: {found}")
        return wrong


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    source, build = (Path(argument).resolve() for argument in arguments)
    compiler = next(iter(commands(build).values()))[1][0]
    wrong = self_test(compiler)
    if wrong:
        print("\n".join(wrong))
        return 1
    files = {}
    for name, header, handlers in DISPATCHES:
        for file in handlers:
            files.setdefault(file, {})[name] = header
    with ThreadPoolExecutor() as pool:
        found = sum(pool.map(lambda file: faults(source, build, file, files[file]), files), [])
    dispatches = sum(map(len, files.values()))
    print("\n".join(found) if found else f"{dispatches} places refuse an enumerator that they do not handle")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
