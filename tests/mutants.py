#!/usr/bin/env python3
"""Mutates a line, builds, runs the tests, and lists the mutants that survive: each is a missing test, or code that does
nothing.

    tests/mutants.py FILE[:FIRST-LAST] … [--build COMMAND] --test COMMAND [--limit N] [--seed N] [--out FILE]
    tests/mutants.py FILE … --list

Example: tests/mutants.py fast/kernels/bound.hpp --build 'ninja -C build/cpu tests_fast' \
             --test 'build/cpu/tests_fast "bound*"' --limit 50

A mutant changes one comparison, sum, product, sign, index, coordinate, number, condition or truth value, or leaves out
one statement. It is written in place of the file, which must not differ from the commit, and which comes back whatever
happens. A test that takes ten times as long as without a mutant finds it, too. FILE of --out gets a line a mutant.
"""

import argparse
import collections
import contextlib
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

Mutant = collections.namedtuple("Mutant", "file line kind begin end text")  # `text` stands for line[begin:end]

OTHERS = {"<": "<=", ">": ">=", "<=": "<", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
          "&&": "||", "||": "&&", "and": "or", "or": "and", "x": "y", "y": "z", "z": "x", "0": "1", "1": "2", "2": "0",
          "true": "false", "false": "true", "True": "False", "False": "True"}
NUMBER = r"0x1p-?\d+|\d+\.\d*(?:e-?\d+)?|\d+(?:e-?\d+)?"
SWAPPED = (  # (kind, what one of OTHERS stands for)
    ("operator", re.compile(r"(?<=[\w)\]}] )(<=|>=|==|!=|&&|\|\||and|or|[-+*/<>])(?= [\w(\-!*&~{:.])")),
    ("coordinate", re.compile(r"(?<=[\w\])]\.)([xyz])\b(?!\()")),
    ("index", re.compile(r"(?<=\[)([012])(?=\])")),
    ("truth", re.compile(r"\b(true|false|True|False)\b")),
)
SIGN = re.compile(r"(?:(?<=[(,=?:{] )|(?<=[({])|(?<=return ))(-)(?=[A-Za-z(])")
LITERAL = re.compile(rf"(?:(?<=[-+*/<>=(,] )|(?<=\())({NUMBER})(?=[fF]?[ ;),])")
CONDITION = re.compile(r"\b(?:if|while) \((.*)\)")
STATEMENT = re.compile(r"^\s*((?!return|using|const|auto|break|continue|namespace|static|typename|template)"
                       r"[\w:.\->\[\]]+ ?(?:[-+*/|&]?= |\().*;)$")
DIRECTIVE = ("#", "//", "static_assert", "template", "using", "import", "from")


def mutants_of(name, lines, first=1, last=10**9):
    """All mutants of these lines of a file; comments, directives and texts stay as they are."""
    for number, line in enumerate(lines, 1):
        code = re.sub(r'"(?:[^"\\]|\\.)*"', lambda text: "\0" * len(text[0]), line.split("//")[0])
        if not first <= number <= last or not code.strip() or code.lstrip().startswith(DIRECTIVE):
            continue
        for kind, pattern in SWAPPED:
            yield from (Mutant(name, number, kind, *at.span(1), OTHERS[at[1]]) for at in pattern.finditer(code))
        yield from (Mutant(name, number, "sign", *at.span(1), "") for at in SIGN.finditer(code))
        for at in LITERAL.finditer(code):
            whole = at[1].isdigit()
            yield Mutant(name, number, "number", *at.span(1), f"({at[1]} + 1)" if whole else f"2 * {at[1]}")
            yield Mutant(name, number, "number", *at.span(1), f"({at[1]} - 1)" if whole else f"0.5 * {at[1]}")
        yield from (Mutant(name, number, "condition", *at.span(1), f"!({line[slice(*at.span(1))]})")
                    for at in CONDITION.finditer(code) if ";" not in at[1])
        yield from (Mutant(name, number, "statement", *at.span(1), ";") for at in STATEMENT.finditer(code.rstrip()))


def changed(lines, mutant):
    line = lines[mutant.line - 1]
    other = line[:mutant.begin] + mutant.text + line[mutant.end:]
    return "\n".join([*lines[:mutant.line - 1], other, *lines[mutant.line:]]) + "\n"


@contextlib.contextmanager
def in_place(path):
    """The file's text, which stands there again afterwards."""
    before = path.read_text(encoding="utf-8")
    try:
        yield before
    finally:
        path.write_text(before, encoding="utf-8")


def passes(command, seconds=None):
    """Whether a shell's command ends well, in so long."""
    try:
        return subprocess.run(command, shell=True, timeout=seconds, stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def verdict(path, mutant, options, seconds):
    with in_place(path) as before:
        path.write_text(changed(before.splitlines(), mutant), encoding="utf-8")
        if options.build and not passes(options.build):
            return "does not compile"
        return "survives" if passes(options.test, seconds) else "found"


def drawn(options):
    """The mutants that were asked for, at random by the seed, as many as --limit says."""
    found = []
    for word in options.files:
        name, _, span = word.partition(":")
        first, _, last = span.partition("-")
        lines = Path(name).read_text(encoding="utf-8").splitlines()
        found += mutants_of(name, lines, int(first or 1), int(last or first or 10**9))
    random.Random(options.seed).shuffle(found)
    return found[:options.limit]


def words_of(mutant):
    line = Path(mutant.file).read_text(encoding="utf-8").splitlines()[mutant.line - 1]
    return f"{mutant.file}:{mutant.line}\t{mutant.kind}\t{line[mutant.begin:mutant.end]} -> {mutant.text}"


def judged(options):
    """Judges all and prints those that survive; how many there are of each verdict. Exits where the tests fail without
    a mutant."""
    begin = time.monotonic()
    if options.build and not passes(options.build) or not passes(options.test):
        sys.exit("mutants: without a mutant the build or the tests fail")
    seconds = 10 * (time.monotonic() - begin) + 1
    counts = collections.Counter()
    with open(options.out or os.devnull, "w", encoding="utf-8") as out:
        for number, mutant in enumerate(mutants := drawn(options), 1):
            said = verdict(Path(mutant.file), mutant, options, seconds)
            counts[said] += 1
            print(f"{said}\t{words_of(mutant)}", file=out, flush=True)
            if said == "survives":
                print(words_of(mutant), flush=True)
            print(f"{number} of {len(mutants)}: {said}", file=sys.stderr)
    if options.build:
        passes(options.build)  # of the files as they are
    print(", ".join(f"{count} {said}" for said, count in counts.most_common()) or "no mutants")
    return counts


def self_test():
    """Mutants of a program whose test sees all of one function and nothing of another."""
    texts = [changed(["  if (a < b[0]) x = -p.y * 2.5f;"], mutant).strip() for mutant in
             mutants_of("", ["  if (a < b[0]) x = -p.y * 2.5f;"])]
    expected = ["if (a <= b[0]) x = -p.y * 2.5f;", "if (a < b[0]) x = -p.y / 2.5f;", "if (a < b[0]) x = -p.z * 2.5f;",
                "if (a < b[1]) x = -p.y * 2.5f;", "if (a < b[0]) x = p.y * 2.5f;",
                "if (a < b[0]) x = -p.y * 2 * 2.5f;", "if (a < b[0]) x = -p.y * 0.5 * 2.5f;",
                "if (!(a < b[0])) x = -p.y * 2.5f;", ";"]
    assert texts == expected, texts
    assert [changed(["  list.add(1);"], m) for m in mutants_of("", ["  list.add(1);"])][-1] == "  ;\n"
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "program.py"
        program.write_text("def seen(a, b):\n    return a + b\ndef unseen(a, b):\n    return a * b\n")
        test = f"cd {folder} && {sys.executable} -B -c 'import program; assert program.seen(2, 1) == 3'"
        options = argparse.Namespace(files=[str(program)], build="", test=test, limit=9, seed=1, out=None)
        counts, before = judged(options), program.read_text()
        assert counts == {"found": 1, "survives": 1} and "a + b" in before, counts
    print("mutants are made, judged and taken back")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", metavar="FILE[:FIRST-LAST]")
    parser.add_argument("--build", default="", help="command that builds what --test runs; without it nothing is")
    parser.add_argument("--test", help="command that fails where a test does")
    parser.add_argument("--limit", type=int, default=10**9, help="so many mutants, drawn at random")
    parser.add_argument("--seed", type=int, default=1, help="of the draw")
    parser.add_argument("--out", help="gets a line a mutant, with its verdict")
    parser.add_argument("--list", action="store_true", help="print the mutants and judge none")
    parser.add_argument("--self-test", action="store_true", help="only see whether all this works")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    if not options.files or not (options.test or options.list):
        parser.error("give files, and --test or --list")
    names = [word.partition(":")[0] for word in options.files]
    if options.list:
        print("\n".join(map(words_of, drawn(options))))
    elif subprocess.run(["git", "diff", "--quiet", "HEAD", "--", *names], check=False).returncode != 0:
        parser.error("a file differs from the commit: commit it first, so that nothing can be lost")
    else:
        judged(options)


if __name__ == "__main__":
    main()
