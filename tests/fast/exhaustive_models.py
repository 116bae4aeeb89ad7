#!/usr/bin/env python3
"""Checks that a model which the kernels do not know does not compile.

    tests/fast/exhaustive_models.py SOURCE_DIR BUILD_DIR    one line for each finding; exit status 1 where there is any

For each enumeration of models a copy of its header gets one enumerator more, and the kernels that dispatch on it are
compiled over this copy with the flags of the build: the compiler must refuse each `switch` over the enumeration. Over the
copy as it is they must compile, or the refusal would say nothing.
"""

import json
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

KERNELS = "".join(f'#include "fast/kernels/{name}.hpp"\n' for name in ("contact_stream", "metrics", "sweep_models"))
FLAGS_OF = "fast/cpu/pack_kernels.cpp"  # a file of the build that compiles these kernels
# Enumeration -> its header, and a file whose `switch` must be refused.
ENUMERATIONS = {
    "MembraneModel": ("compare/problem/scene.hpp", "fast/kernels/models/membrane_models.hpp"),
    "BendingModel": ("compare/problem/scene.hpp", "fast/kernels/models/bending_models.hpp"),
    "ContactActivation": ("compare/problem/settings.hpp", "fast/kernels/models/activation.hpp"),
    "DampingForm": ("compare/problem/settings.hpp", "fast/kernels/sweep_models.hpp"),
}


def flags(source, build):
    """The compiler and its flags, without input, output and what a launcher adds."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if Path(entry["file"]) == source / FLAGS_OF:
            words = shlex.split(entry["command"])
            words = words[next(i for i, word in enumerate(words) if re.search(r"(\+\+|clang)[\d.-]*$", word)):]
            at = words.index("-o")
            return [word for word in words[:at] + words[at + 2:] if word != "-c" and not word.endswith(FLAGS_OF)]
    sys.exit(f"{build}/compile_commands.json does not name {FLAGS_OF}: configure with CMAKE_EXPORT_COMPILE_COMMANDS")


def errors_over(header, text, command, source):
    """What the compiler says about the kernels over this text of the header."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / header
        copy.parent.mkdir(parents=True)
        copy.write_text(text)
        unit = Path(folder) / "kernels.cpp"
        unit.write_text(KERNELS)
        done = subprocess.run([command[0], "-I" + folder, "-I" + str(source), *command[1:], "-fsyntax-only", str(unit)],
                              capture_output=True, text=True)
        return done.stderr if done.returncode != 0 else ""


def findings(source, build):
    command = flags(source, build)
    found = []
    for header in sorted({header for header, _ in ENUMERATIONS.values()}):
        said = errors_over(header, (source / header).read_text(), command, source)
        if said:
            found.append(f"{header}: the kernels do not compile over a copy as it is:\n{said[:2000]}")
    for name, (header, switch) in ENUMERATIONS.items():
        text = (source / header).read_text()
        planted, times = re.subn(rf"(enum class {name}\b[^{{;]*\{{[^}}]*?)\s*\}}", r"\1, planted }", text)
        if times != 1:
            found.append(f"{header}: enum class {name} stands there {times} times, not once")
            continue
        said = errors_over(header, planted, command, source)
        if not re.search(rf"{re.escape(switch)}:\d+:\d+: error: enumeration value .planted. not handled in switch", said):
            found.append(f"{switch}: a model that {name} has more compiles; handle each by name, without `default`")
    return found


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    found = findings(*(Path(argument).resolve() for argument in arguments))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
