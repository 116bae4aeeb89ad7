#!/usr/bin/env python3
"""Checks that no choice between named variants can be forgotten. Every object is compiled with -Wswitch and -Werror, so
that a `switch` without `default` names whoever misses a new enumerator. What the compiler can't see is checked here:

- each enumeration of a choice is asked by a `switch`;
- nothing compares a policy with one of its enumerators: a trait beside the enumeration says what the code needs;
- a `switch` over enumerators has no `default`.

    tests/choices.py ROOT         the self-test, then ROOT; one line for each finding, exit status 1 where there is any
    tests/choices.py --self-test  only the self-test
"""

import re
import tempfile
from pathlib import Path

from house import run

ROOMS = ("compare", "reference", "fast", "experiments")
SUFFIXES = {".hpp", ".cpp", ".cu", ".cuh"}
# Files that declare choices.
HEADERS = ("compare/problem/bounds.hpp", "compare/problem/settings.hpp", "compare/problem/scene.hpp",
           "compare/judge/cases/stage.hpp", "experiments/program/runs/solvers.hpp",
           "reference/solvers/newton/settings.hpp", "reference/solvers/variants/settings.hpp")
# Choices that may be compared: the code tests for an absence (none), for a default with a path of its own, or for the
# stage, solver or kind of setting that something belongs to.
COMPARED = {"MembraneModel", "BendingModel", "ContactActivation", "Stage", "Solver", "SettingKind"}
ENUMERATION = re.compile(r"\benum class (\w+)(?: : std::(?:int64|uint8)_t)? \{")
COMPARISON = re.compile(r"[=!]= *(?:\w+::)*(\w+)::\w+|\b(?:\w+::)*(\w+)::\w+ *[=!]=")
LABEL = re.compile(r"\bcase ([\w:]+)(?=:)|^ *(default):", re.M)
COMMENT = re.compile(r"//[^\n]*")


def sources(root):
    """Returns {path: code without comments}."""
    files = sorted(path for room in ROOMS for path in (root / room).rglob("*") if path.suffix in SUFFIXES)
    return {path.relative_to(root).as_posix(): COMMENT.sub("", path.read_text(encoding="utf-8")) for path in files}


def line_of(code, place):
    return code.count("\n", 0, place) + 1


def findings(root):
    code = sources(root)
    missing = [header for header in HEADERS if header not in code]
    yield from (f"{header} is gone: correct HEADERS of tests/choices.py" for header in missing)
    choices = {name for header in HEADERS if header in code for name in ENUMERATION.findall(code[header])}
    yield from (f"{name} is no choice: correct COMPARED of tests/choices.py" for name in sorted(COMPARED - choices))
    switched = set()
    for file, text in code.items():
        before = ""
        for label in LABEL.finditer(text):
            names = (label[1] or "").split("::")
            switched.update(names[-2:-1])
            if label[2] and "::" in before:
                yield f"{file}:{line_of(text, label.start())}: `default` beside `case {before}` hides what is missing"
            before = label[1] or ""
        for found in COMPARISON.finditer(text):
            name = found[1] or found[2]
            if name in choices - COMPARED:
                yield f"{file}:{line_of(text, found.start())}: compares a {name}; ask a trait, from a `switch`"
    yield from (f"{name} stands in no `switch`: nothing tells whoever adds an enumerator"
                for name in sorted(choices - switched - COMPARED))


def self_test():
    """Returns sentences about planted files that are judged wrongly."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for header in HEADERS:
            (root / header).parent.mkdir(parents=True, exist_ok=True)
            (root / header).write_text("")
        kinds = "".join(f"enum class {name} {{ one }};\n" for name in sorted(COMPARED))
        (root / HEADERS[0]).write_text(kinds + "enum class Way : std::int64_t { on, off };  // == Way::on\n")
        user = root / "fast/user.cu"
        user.parent.mkdir()
        asked = "switch (way) {\n  case compare::Way::on: return 1;\n  case compare::Way::off: break;\n}\n"
        wrong = []
        for code, expected in ((asked, None), ("", "stands in no"),
                               (asked + "a != room::Way::on", "user.cu:5: compares"),
                               (asked + "Way::off == a", "user.cu:5: compares"), (asked + "a == Stage::one", None),
                               (asked.replace("case compare::Way::off", "default"), "user.cu:3: `default`"),
                               (asked + "case 1: ;\n default: ;", None)):
            user.write_text(code)
            found = list(findings(root))
            if (len(found) != 1 or expected not in found[0]) if expected else found:
                wrong.append(f"self-test: {expected or 'nothing'} expected of\n{code}\nfound {found}")
        return wrong


if __name__ == "__main__":
    run(__doc__, self_test, lambda root: findings(Path(root)))
