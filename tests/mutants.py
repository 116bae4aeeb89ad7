#!/usr/bin/env python3
"""Mechanical mutants of the CPU kernels before the judge: what share it catches, and which survive.

Every comparison, sum, product, sign, index, coordinate, number and condition of the given kernels is rewritten to one that can be switched
(tests/mutants/switch.hpp), so that one build holds all mutants. Each is then judged on the same cases, whose exact answers are found once; what the judge
lets through meets the tests of kernels, of detections and of their lists with a skin (tests/fast/kernels, tests/fast/stages).

    tests/mutants.py BUILD [--kernels a,b,…] [--stages a,b,…] [--cases N] [--limit N] [--minutes M] [--only IDS] [--since COMMIT] [--flags F] [--out FILE]

BUILD is a folder in which `ogc` was built by ninja. Not a part of tests/run: it takes minutes. FILE gets one line a mutant, and the survivors go to standard output.
"""

import argparse
import collections
import concurrent.futures
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOT_MATHEMATICS = {"qualifiers", "atomic"}
KERNELS = sorted(path.stem for path in (ROOT / "fast/kernels").glob("*.hpp") if path.stem not in NOT_MATHEMATICS)
STAGES = ("closest_face closest_points activation truncate membrane bending spring bound block detect_vertex_facet detect_edge_edge contact_force "
          "friction_force initial_guess rest_state sweep step").split()
REWRITTEN = ["tests/mutants/contestant.cpp", "fast/stages/rest_state.cpp", *(str(path.relative_to(ROOT)) for path in sorted(ROOT.glob("tests/fast/kernels/*.cpp"))),
             "tests/fast/stages/detection.cpp", "tests/fast/stages/skin.cpp"]
AS_THEY_ARE = ["tests/mutants/judge.cpp", "tests/mutants/kernel_tests.cpp"]

BINARY = {  # operator -> (struct, what its alternatives are)
    "<": ("Less", ("<=", ">=")), ">": ("Greater", (">=", "<=")), "<=": ("LessEqual", ("<", ">")), ">=": ("GreaterEqual", (">", "<")),
    "==": ("Equal", ("!=",)), "!=": ("Unequal", ("==",)),
    "+": ("Plus", ("-", "left term alone")), "-": ("Minus", ("+", "left term alone")),
    "*": ("Times", ("/", "left factor alone")), "/": ("Over", ("*", "left factor alone")),
}
OPERATOR = re.compile(r"(?<=[\w)\]}] )(<=|>=|==|!=|[-+*/<>])(?= [\w(\-!*&~{:])")
SIGN = re.compile(r"(?:(?<=[(,=?:{] )|(?<=[({])|(?<=return ))-(?=[A-Za-z(])")
COORDINATE = re.compile(r"(?<![\w.\])>])((?:\w+\.)*[A-Za-z_]\w*)\.([xyz])\b(?!\()")
INDEX = re.compile(r"(?<=\[)([012])(?=\])")
LITERAL = re.compile(r"(?:(?<=[-+*/<>=(,] )|(?<=[(]))((?:\d+\.\d*f?|0x1p-?\d+f?|\d+))(?=[ ;),])")
CHOICE = re.compile(r"(?<![\w:.])(smaller|larger)\(")
CONDITION = re.compile(r"\b(?:if|while) \(")
NEXT = {"x": "y", "y": "z", "z": "x"}

Mutant = collections.namedtuple("Mutant", "id kernel line kind text")


def code_of(line):
    """The line without its comment."""
    return line.split("//")[0]


def closing(text, opened):
    """Position of the parenthesis that closes the one at `opened`; None where it is not on the line."""
    depth = 0
    for at in range(opened, len(text)):
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        if depth == 0:
            return at
    return None


class Rewriter:
    """Rewrites kernels, and remembers which mutant stands where. Lines in `excluded` (kernel, line, kinds) do not compile when rewritten."""

    def __init__(self, excluded):
        self.excluded = excluded
        self.mutants = []
        self.next = 1

    def take(self, kernel, number, kind, text, alternatives):
        first = self.next
        for what in alternatives:
            self.mutants.append(Mutant(self.next, kernel, number, kind, f"{text} -> {what}"))
            self.next += 1
        return first

    def line(self, kernel, number, line):
        code = code_of(line)
        if not code.strip() or code.lstrip().startswith(("#", "static_assert", "template", "using", "}")) or "constexpr" in code:
            return line
        edits = []  # (begin, end, text)

        def allowed(kind):
            return (kernel, number, kind) not in self.excluded

        def around(match, name):
            return code[max(0, match.start() - 12):match.end() + 12].strip()

        def operators():
            for match in OPERATOR.finditer(code):
                struct, alternatives = BINARY[match[1]]
                id = self.take(kernel, number, "operator", around(match, match[1]), alternatives)
                edits.append((match.end(), match.end(), f" ::ogc_mutant::{struct}{{{id}}} {match[1]}"))

        def signs():
            for match in SIGN.finditer(code):
                id = self.take(kernel, number, "sign", around(match, "-"), ("no minus",))
                edits.append((match.start(), match.start(), f"::ogc_mutant::Sign{{{id}}} * "))

        def coordinates():
            for match in COORDINATE.finditer(code):
                other = NEXT[match[2]]
                id = self.take(kernel, number, "coordinate", match[0], (f"{match[1]}.{other}",))
                edits.append((match.start(), match.end(), f"(::ogc_mutant::on({id}) ? {match[1]}.{other} : {match[0]})"))

        def indices():
            for match in INDEX.finditer(code):
                id = self.take(kernel, number, "index", around(match, match[1]), ("another index",))
                edits.append((match.start(), match.end(), f"::ogc_mutant::index({id}, {match[1]})"))

        def literals():
            for match in LITERAL.finditer(code):
                id = self.take(kernel, number, "number", around(match, match[1]), ("twice, or one more", "half, or one less"))
                edits.append((match.start(1), match.end(1), f"::ogc_mutant::literal({id}, {match[1]})"))

        def choices():
            for match in CHOICE.finditer(code):
                if code.lstrip().startswith("OGC_HD"):
                    continue
                id = self.take(kernel, number, "choice", around(match, match[1]), ("the other one",))
                edits.append((match.start(), match.end(), f"::ogc_mutant::{match[1]}({id}, "))

        def conditions():
            for match in CONDITION.finditer(code):
                end = closing(code, match.end() - 1)
                if end is None or ";" in code[match.end():end]:
                    continue
                id = self.take(kernel, number, "condition", code[match.start():end + 1], ("negated",))
                edits.append((match.end(), match.end(), f"::ogc_mutant::negated({id}, "))
                edits.append((end, end, ")"))

        for kind, collect in (("operator", operators), ("sign", signs), ("coordinate", coordinates), ("index", indices), ("number", literals),
                              ("choice", choices), ("condition", conditions)):
            if allowed(kind):
                collect()
        for begin, end, text in sorted(edits, reverse=True):
            code = code[:begin] + text + code[end:]
        return code

    def kernel(self, name):
        lines = (ROOT / "fast/kernels" / f"{name}.hpp").read_text(encoding="utf-8").splitlines()
        rewritten, device = [], False
        for number, line in enumerate(lines, 1):
            word = line.strip()
            if word.startswith("#if") and "__CUDA_ARCH__" in word and "!" not in word:
                device = True
            elif word.startswith(("#else", "#endif")):
                device = False
            rewritten.append(line if device else self.line(name, number, line))
            if word == "#pragma once":
                rewritten[-1] += ' \n#include "tests/mutants/switch.hpp"\n' + f"#line {number + 1} \"fast/kernels/{name}.hpp\""
        return "\n".join(rewritten) + "\n"


FLAGS = "-std=c++20 -O1 -fPIC -w -ffp-contract=off -fno-tree-slp-vectorize".split()
KIND_ORDER = ("number", "coordinate", "condition", "choice", "sign", "index", "operator")


def compile_all(sources, folder, flags):
    """Compiles two at a time; returns what the compiler said of those that failed, and the objects."""
    objects = [folder / (source.replace("/", "_") + ".o") for source in sources]

    def one(source, target):
        return subprocess.run(["g++", *FLAGS, *flags, f"-I{folder}", f"-I{ROOT}", str(ROOT / source), "-o", str(target)], capture_output=True, text=True)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = list(pool.map(one, sources, objects))
    return "".join(r.stderr or f"the compiler ended with {r.returncode}" for r in results if r.returncode != 0), objects


def compile_rewritten(kernels, folder, log):
    """Rewrites and compiles until what does not compile is left out; returns the mutants and the objects."""
    excluded = set()
    target = folder / "fast/kernels"
    target.mkdir(parents=True)
    while True:
        rewriter = Rewriter(excluded)
        for name in kernels:
            (target / f"{name}.hpp").write_text(rewriter.kernel(name), encoding="utf-8")
        errors, _ = compile_all(REWRITTEN, folder, ["-fsyntax-only"])
        if not errors:
            errors, objects = compile_all(REWRITTEN, folder, ["-c"])
        if not errors:
            return rewriter.mutants, objects
        found = {(name, int(line)) for name, line in re.findall(r"fast/kernels/(\w+)\.hpp:(\d+):\d+: error", errors)}
        found |= {(name, int(line)) for name, line in re.findall(r"In instantiation of.*\nfast/kernels/(\w+)\.hpp:(\d+):\d+:   required from", errors)}
        before = len(excluded)
        present = {(m.kernel, m.line, m.kind) for m in rewriter.mutants}
        for name, line in found:
            for kind in KIND_ORDER:
                if (name, line, kind) in present:
                    excluded.add((name, line, kind))
                    break
        if len(excluded) == before:
            sys.exit("the rewritten kernels do not compile:\n" + errors[:4000])
        log(f"{len(excluded)} lines left as they are, in part")


def link(build, folder, rewritten):
    """The judge of the mutants, with the libraries of `ogc`."""
    program = folder / "mutant_judge"
    rules = (build / "build.ninja").read_text(encoding="utf-8")
    libraries = re.search(r"^build ogc: .*?^  LINK_LIBRARIES = (.*?)$", rules, re.DOTALL | re.MULTILINE)[1].split()
    errors, objects = compile_all(AS_THEY_ARE, folder, ["-c"])
    if errors:
        sys.exit("the judge of the mutants does not compile:\n" + errors[:4000])
    subprocess.run(["g++", *FLAGS, *map(str, rewritten + objects), *libraries, "-o", str(program)], check=True, cwd=build)
    return program


def lines_since(commit, kernels):
    """The lines (kernel, number) that `commit` did not have, as they stand in the working tree."""
    lines = set()
    for name in kernels:
        diff = subprocess.run(["git", "-C", str(ROOT), "diff", "--unified=0", commit, "--", f"fast/kernels/{name}.hpp"], capture_output=True, text=True)
        if diff.returncode != 0:
            sys.exit(f"--since {commit}: {diff.stderr.strip()}")
        for first, count in re.findall(r"^@@ -\S+ \+(\d+)(?:,(\d+))? @@", diff.stdout, re.MULTILINE):
            lines |= {(name, int(first) + i) for i in range(int(count or 1))}
    return lines


def numbers_after(word, line):
    """The mutants that a line of the judge names after its first word."""
    words = line.split()
    if not words or words[0] != word or not all(w.isdigit() for w in words[1:]):
        sys.exit("the kernels as they are do not pass: " + " ".join(words[:40]))
    return set(map(int, words[1:]))


def judge(program, mutants, options, log):
    """Pairs of a mutant and what was found (empty: it survives), the mutants that neither a case nor a test reaches, and the number of the others."""
    command = [str(program), str(options.cases), str(options.seed), str(options.seconds), str(ROOT / "tests/experiments/corpus.txt"), *options.stages.split(",")]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
    reached = numbers_after("tests", process.stdout.readline()) | numbers_after("right", process.stdout.readline())
    unreached = [m for m in mutants if m.id not in reached]
    wanted = [m for m in mutants if m.id in reached]
    random.Random(options.seed).shuffle(wanted)
    log(f"{len(wanted)} mutants are reached")
    results, start = [], time.monotonic()
    for mutant in wanted[:options.limit]:
        if time.monotonic() - start > 60 * options.minutes:
            break
        process.stdin.write(f"{mutant.id}\n")
        process.stdin.flush()
        results.append((mutant, process.stdout.readline().strip()))
        if len(results) % 100 == 0:
            log(f"{len(results)} judged, {sum(found == 'test' for _, found in results)} left to the kernels' tests, {sum(not found for _, found in results)} survive")
    process.stdin.close()
    process.wait()
    return results, unreached, len(wanted)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--kernels", default=",".join(KERNELS))
    parser.add_argument("--stages", default=",".join(STAGES))
    parser.add_argument("--cases", type=int, default=2000, help="of a stage; of a mesh stage a quarter")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=int, default=60, help="time limit of one mutant")
    parser.add_argument("--limit", type=int, default=None, help="only so many, drawn at random")
    parser.add_argument("--minutes", type=float, default=25)
    parser.add_argument("--only", default="", help="only these ids, separated by commas: to see whether a survivor is caught by more cases")
    parser.add_argument("--since", metavar="COMMIT", help="only in lines that this commit did not have")
    parser.add_argument("--flags", default="", help="for the compiler, such as -fsanitize=address,undefined")
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    FLAGS.extend(options.flags.split())

    def log(text):
        print(text, file=sys.stderr, flush=True)

    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        mutants, rewritten = compile_rewritten(options.kernels.split(","), folder, log)
        if options.only:
            ids = set(map(int, options.only.split(",")))
            mutants = [m for m in mutants if m.id in ids]
        if options.since:
            lines = lines_since(options.since, options.kernels.split(","))
            mutants = [m for m in mutants if (m.kernel, m.line) in lines]
        log(f"{len(mutants)} mutants of {len(options.kernels.split(','))} kernels compiled")
        results, unreached, wanted = judge(link(options.build, folder, rewritten), mutants, options, log)
    judged = sum(found not in ("", "test") for _, found in results)
    tested = sum(found == "test" for _, found in results)
    if options.out:
        rows = [f"{m.id}\t{m.kernel}.hpp:{m.line}\t{m.kind}\t{m.text}\t{found or 'SURVIVES'}" for m, found in sorted(results)]
        rows += [f"{m.id}\t{m.kernel}.hpp:{m.line}\t{m.kind}\t{m.text}\tnot reached" for m in unreached]
        options.out.write_text("\n".join(rows) + "\n", encoding="utf-8")
    share = 100 / max(1, len(results))
    print(f"{len(mutants)} mutants; {len(unreached)} that neither a case nor a test reaches; {len(results)} of the other {wanted} judged; "
          f"{judged} caught by the judge ({share * judged:.1f} %), {tested} more by the kernels' tests (together {share * (judged + tested):.1f} %)")
    for mutant, found in sorted(results):
        if not found:
            print(f"{mutant.id}\t{mutant.kernel}.hpp:{mutant.line}\t{mutant.kind}\t{mutant.text}")
    return 0


if __name__ == "__main__":
    os.nice(10)
    sys.exit(main())
