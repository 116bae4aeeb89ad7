#!/usr/bin/env python3
"""Mechanical mutants of the fast path on the CPU before the judge: what share is found, and which survive.

Every comparison, sum, product, sign, index, coordinate, number and condition of the given files is rewritten to one
that can be switched (tests/mutants/switch.hpp), so that one build holds all mutants. Each is then judged on the same
cases, whose exact answers are computed once; mutants that the judge does not find go through the unit tests of these
files. Each stage and each test may take ten times as long as without a mutant; a mutant on which something takes
longer, while all else is right, counts as ten times slower.

    tests/mutants.py BUILD [--of kernels|stages] [--files a,b,…] [--stages a,b,…] [--cases N] [--limit N]
                     [--minutes M] [--jobs J] [--only IDS] [--since COMMIT] [--flags F] [--out FILE]
    tests/mutants.py BUILD --keep DIR …, and later --answers FILE …

BUILD is a folder in which `ogc` was built by ninja. `--of kernels` are fast/kernels, `--of stages` fast/stages and
fast/cpu. With --keep the program is left in DIR, with a command for a machine with more cores; --answers reads its
output. It is not a part of tests/run, because it takes minutes. FILE gets one line for each mutant; standard output
gets those that survive, are slow or not decided.
"""

import argparse
import collections
import concurrent.futures
import contextlib
import io
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOT_MATHEMATICS = {"fast/kernels/arithmetic/qualifiers.hpp", "fast/kernels/arithmetic/atomic.hpp"}


def files(*patterns):
    return sorted(str(path.relative_to(ROOT)) for pattern in patterns for path in ROOT.glob(pattern))


# By set: the files that are rewritten, and the sources that are compiled over them.
SETS = {
    "kernels": ([name for name in files("fast/kernels/**/*.hpp") if name not in NOT_MATHEMATICS],
                ["fast/stages/rest_state.cpp", *files("tests/fast/kernels/**/*.cpp"),
                 "tests/fast/stages/detection.cpp"]),
    "stages": (files("fast/stages/*.?pp", "fast/probes/*.?pp", "fast/cpu/*.?pp"),
               files("fast/stages/*.cpp", "fast/probes/*.cpp", "fast/cpu/*.cpp", "fast/*.cpp",
                     "tests/fast/stages/*.cpp", "tests/fast/probes/*.cpp", "tests/fast/cpu/*.cpp",
                     "tests/fast/*.cpp")),
}
FOR_AVX2 = "fast/cpu/packed_sweep.cpp"  # compiled a second time
STAGES = ("closest_face closest_points activation truncate membrane bending spring tetrahedron rod orientation bound "
          "plane block "
          "volume_depth detect_vertex_facet detect_edge_edge contact_force "
          "friction_force volume_force initial_guess rest_state sweep step").split()
AS_THEY_ARE = ["tests/mutants/judge.cpp", "tests/mutants/unit_tests.cpp"]

BINARY = {  # operator -> (struct, its alternatives)
    "<": ("Less", ("<=", ">=")), ">": ("Greater", (">=", "<=")), "<=": ("LessEqual", ("<", ">")),
            ">=": ("GreaterEqual", (">", "<")),
    "==": ("Equal", ("!=",)), "!=": ("Unequal", ("==",)),
    "+": ("Plus", ("-", "left term alone")), "-": ("Minus", ("+", "left term alone")),
    "*": ("Times", ("/", "left factor alone")), "/": ("Over", ("*", "left factor alone")),
}
OPERATOR = re.compile(r"(?<=[\w)\]}] )(<=|>=|==|!=|[-+*/<>])(?= [\w(\-!*&~{:])")
SIGN = re.compile(r"(?:(?<=[(,=?:{] )|(?<=[({])|(?<=return ))-(?=[A-Za-z(])")
COORDINATE = re.compile(r"(?<![\w.\])>])((?:\w+\.)*[A-Za-z_]\w*)\.([xyz])\b(?!\()")
INDEX = re.compile(r"(?<=\[)([012])(?=\])")
NUMBER = r"0x1p-?\d+[fF]?|\d+(?:\.\d*)?(?:e-?\d+)?[fF]|\d+\.\d*(?:e-?\d+)?|\d+(?:e-?\d+)?"
LITERAL = re.compile(rf"(?:(?<=[-+*/<>=(,] )|(?<=[(]))({NUMBER})(?=[ ;),])")
CHOICE = re.compile(r"(?<![\w:.])(smaller|larger)\(")
CONDITION = re.compile(r"\b(?:if|while) \(")
NEXT = {"x": "y", "y": "z", "z": "x"}

Mutant = collections.namedtuple("Mutant", "id file line kind text")


def code_of(line):
    """Returns the line without its comment."""
    return line.split("//")[0]


def closing(text, opened):
    """Returns the position of the parenthesis that closes the one at `opened`; None if it is not on the line."""
    depth = 0
    for at in range(opened, len(text)):
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        if depth == 0:
            return at
    return None


class Rewriter:
    """Rewrites files, and remembers the place of each mutant. Places in `excluded` (file, line, kind) do not compile
    when rewritten."""

    def __init__(self, excluded):
        self.excluded = excluded
        self.mutants = []
        self.next = 1

    def take(self, file, number, kind, text, alternatives):
        first = self.next
        for what in alternatives:
            self.mutants.append(Mutant(self.next, file, number, kind, f"{text} -> {what}"))
            self.next += 1
        return first

    def line(self, file, number, line):
        code = code_of(line)
        if not code.strip() or code.lstrip().startswith(("#", "static_assert", "template", "using",
                                                         "}")) or "constexpr" in code:
            return line
        edits = []  # (begin, end, text)

        def allowed(kind):
            return (file, number, kind) not in self.excluded

        def around(match, name):
            return code[max(0, match.start() - 12):match.end() + 12].strip()

        def operators():
            for match in OPERATOR.finditer(code):
                struct, alternatives = BINARY[match[1]]
                id = self.take(file, number, "operator", around(match, match[1]), alternatives)
                edits.append((match.end(), match.end(), f" ::ogc_mutant::{struct}{{{id}}} {match[1]}"))

        def signs():
            for match in SIGN.finditer(code):
                id = self.take(file, number, "sign", around(match, "-"), ("no minus",))
                edits.append((match.start(), match.start(), f"::ogc_mutant::Sign{{{id}}} * "))

        def coordinates():
            for match in COORDINATE.finditer(code):
                other = NEXT[match[2]]
                id = self.take(file, number, "coordinate", match[0], (f"{match[1]}.{other}",))
                edits.append((match.start(), match.end(),
                              f"(::ogc_mutant::on({id}) ? {match[1]}.{other} : {match[0]})"))

        def indices():
            for match in INDEX.finditer(code):
                id = self.take(file, number, "index", around(match, match[1]), ("another index",))
                edits.append((match.start(), match.end(), f"::ogc_mutant::index({id}, {match[1]})"))

        def literals():
            for match in LITERAL.finditer(code):
                alternatives = ("twice, or one more", "half, or one less")
                id = self.take(file, number, "number", around(match, match[1]), alternatives)
                edits.append((match.start(1), match.end(1), f"::ogc_mutant::literal({id}, {match[1]})"))

        def choices():
            for match in CHOICE.finditer(code):
                if code.lstrip().startswith("OGC_HD"):
                    continue
                id = self.take(file, number, "choice", around(match, match[1]), ("the other one",))
                edits.append((match.start(), match.end(), f"::ogc_mutant::{match[1]}({id}, "))

        def conditions():
            for match in CONDITION.finditer(code):
                end = closing(code, match.end() - 1)
                if end is None or ";" in code[match.end():end]:
                    continue
                id = self.take(file, number, "condition", code[match.start():end + 1], ("negated",))
                edits.append((match.end(), match.end(), f"::ogc_mutant::negated({id}, "))
                edits.append((end, end, ")"))

        for kind, collect in (("operator", operators), ("sign", signs), ("coordinate", coordinates), ("index", indices),
                              ("number", literals),
                              ("choice", choices), ("condition", conditions)):
            edits_before, mutants_before = len(edits), len(self.mutants)
            collect()
            if not allowed(kind):  # its numbers stay taken, so that those of others do not change
                del edits[edits_before:], self.mutants[mutants_before:]
        for begin, end, text in sorted(edits, reverse=True):
            code = code[:begin] + text + code[end:]
        return code

    def file(self, name):
        """Rewrites a whole file; code for devices is not changed."""
        lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
        rewritten, device = [], False
        if name.endswith(".cpp"):
            rewritten.append(f'#include "tests/mutants/switch.hpp"\n#line 1 "{name}"')
        for number, line in enumerate(lines, 1):
            word = line.strip()
            if word.startswith("#if") and "__CUDA_ARCH__" in word and "!" not in word:
                device = True
            elif word.startswith(("#else", "#endif")):
                device = False
            rewritten.append(line if device else self.line(name, number, line))
            if word == "#pragma once":
                rewritten[-1] += f'\n#include "tests/mutants/switch.hpp"\n#line {number + 1} "{name}"'
        return "\n".join(rewritten) + "\n"


# Without `flatten`, because the compiler takes minutes for it in a function with hundreds of switches. An index beyond
# an array ends the process, as under the `sanitize` preset: whether it shows in an answer is chance.
FLAGS = ("-std=c++20 -O1 -fPIC -w -ffp-contract=off -fno-tree-slp-vectorize -Dflatten=used -D_GLIBCXX_ASSERTIONS "
         "-fsanitize=bounds-strict -fsanitize-undefined-trap-on-error").split()
KIND_ORDER = ("number", "coordinate", "condition", "choice", "sign", "index", "operator")


def compile_all(sources, folder, flags, jobs):
    """Compiles (source, flags), with a rewritten source in place of the original, `jobs` at a time. Returns the
    compiler's messages for each (empty if it succeeded) and the objects."""
    objects = [folder / (source.replace("/", "_") + "".join(own) + ".o") for source, own in sources]

    def one(source, target):
        name, own = source
        place = (folder if (folder / name).exists() else ROOT) / name
        command = ["g++", *FLAGS, *flags, *own, f"-I{folder}", f"-I{ROOT}", str(place), "-o", str(target)]
        done = subprocess.run(command, capture_output=True, text=True)
        return "" if done.returncode == 0 else done.stderr or f"the compiler ended with {done.returncode}"
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, sources, objects)), objects


def compile_rewritten(names, folder, options, log):
    """Rewrites and compiles, leaving out mutants that do not compile, until all compile; returns the mutants and the
    objects."""
    excluded = set()
    sources = [("tests/mutants/contestant.cpp", ()), *((source, ()) for source in SETS[options.of][1])]
    if options.of == "stages":
        sources.insert(0, (FOR_AVX2, ("-mavx2",)))  # takes longest
    wrong = sources
    while wrong:
        rewriter = Rewriter(excluded)
        for name in names:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(rewriter.file(name), encoding="utf-8")
        said, _ = compile_all(wrong, folder, ["-fsyntax-only"], options.jobs)
        errors = "".join(said)
        if errors and not exclude(errors, rewriter.mutants, excluded):
            sys.exit("the rewritten files do not compile:\n" + errors[:4000])
        wrong = [source for source, error in zip(wrong, said) if error]
        log(f"{len(excluded)} lines left as they are, in part; {len(wrong)} sources to go")
    said, objects = compile_all(sources, folder, ["-c"], options.jobs)
    if any(said):
        sys.exit("the rewritten files do not compile:\n" + "".join(said)[:4000])
    return rewriter.mutants, objects


def exclude(errors, mutants, excluded):
    """Leaves out one kind of mutants on each line that the compiler names; returns whether there was any."""
    place = r"(fast/(?:kernels|stages|probes|cpu)/(?:\w+/)?\w+\.[ch]pp):(\d+)"
    found = re.findall(place + r":\d+: (?:fatal )?error", errors) + re.findall(place + r":\d+:   required from", errors)
    present = {(m.file, m.line, m.kind) for m in mutants} - excluded
    before = len(excluded)
    for name, line in {(name, int(line)) for name, line in found}:
        kinds = [kind for kind in KIND_ORDER if (name, line, kind) in present]
        excluded.update((name, line, kind) for kind in kinds[:1])
    return len(excluded) > before


def link(folder, rewritten, options):
    """Links the judge of the mutants with the libraries of `ogc`."""
    program = folder / "mutant_judge"
    rules = (options.build / "build.ninja").read_text(encoding="utf-8")
    libraries = re.search(r"^build ogc: .*?^  LINK_LIBRARIES = (.*?)$", rules, re.DOTALL | re.MULTILINE)[1].split()
    said, objects = compile_all([(source, ()) for source in AS_THEY_ARE], folder, ["-c"], options.jobs)
    if any(said):
        sys.exit("the judge of the mutants does not compile:\n" + "".join(said)[:4000])
    command = ["g++", *FLAGS, *map(str, rewritten + objects), *libraries, "-o", str(program)]
    subprocess.run(command, check=True, cwd=options.build)
    return program


def lines_since(commit, names):
    """Returns the lines (file, number) of the working tree that `commit` did not have."""
    lines = set()
    for name in names:
        command = ["git", "-C", str(ROOT), "diff", "--unified=0", commit, "--", name]
        diff = subprocess.run(command, capture_output=True, text=True)
        if diff.returncode != 0:
            sys.exit(f"--since {commit}: {diff.stderr.strip()}")
        for first, count in re.findall(r"^@@ -\S+ \+(\d+)(?:,(\d+))? @@", diff.stdout, re.MULTILINE):
            lines |= {(name, int(first) + i) for i in range(int(count or 1))}
    return lines


def arguments(options, corpus):
    """Returns the arguments for the judge of the mutants."""
    numbers = (options.cases, options.seed, 60 * options.minutes, corpus, options.jobs)
    return [*map(str, numbers), *options.stages.split(",")]


def drawn(mutants, options):
    """Returns all mutants in the order in which they are judged: at random, by the seed."""
    order = list(mutants)
    random.Random(options.seed).shuffle(order)
    return order


def category(found):
    """Returns the category of the program's message about a mutant: what finds it, or why nothing does."""
    for beginning, name in (("not reached", "not reached"), ("not decided", "not decided"),
                            ("ten times slower", "slow"), ("test ", "test")):
        if found.startswith(beginning):
            return name
    return "judge" if found else "survives"


def answers_of(lines, mutants, options, log):
    """Returns what was found of each mutant, in the order in which they were drawn, as far as the judge came. A mutant
    that was begun and has no answer, because the program was stopped, is not decided."""
    said = iter(lines)
    first = next(said, "").strip()
    if first != "right":
        sys.exit("the files as they are do not pass: " + first[:400])
    found, counts = {}, collections.Counter()
    for line in said:
        id, tab, what = line.rstrip("\n").partition("\t")
        if not tab or not line.endswith("\n"):
            break  # cut off
        found[int(id)] = what
        counts[category(what)] += 1
        reached = len(found) - counts["not reached"]
        if reached and reached % 50 == 0:
            log(f"{reached} judged: " + ", ".join(f"{name} {count}" for name, count in sorted(counts.items())))
        if reached >= options.limit:
            break
    order = drawn(mutants, options)
    last = max((i for i, m in enumerate(order) if m.id in found), default=-1)
    return [(m, found.get(m.id, "not decided: stopped")) for m in order[:last + 1]]


def judge(program, mutants, options, log):
    """Yields each mutant with what was found of it (empty: it survives)."""
    command = [str(program), *arguments(options, str(ROOT / "tests/experiments/corpus.txt"))]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    process = subprocess.Popen(command, **pipes, text=True, start_new_session=True)
    process.stdin.write("".join(f"{m.id}\n" for m in drawn(mutants, options)))
    process.stdin.close()
    try:
        return answers_of(process.stdout, mutants, options, log)
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def keep(program, mutants, options):
    """Keeps the program, its mutants in the order in which they are judged, and the command."""
    options.keep.mkdir(parents=True, exist_ok=True)
    shutil.copy(program, options.keep)
    shutil.copy(ROOT / "tests/experiments/corpus.txt", options.keep)
    ids = "".join(f"{m.id}\n" for m in drawn(mutants, options))
    (options.keep / "ids").write_text(ids, encoding="utf-8")
    (options.keep / "mutants").write_text("".join("\t".join(map(str, m)) + "\n" for m in mutants), encoding="utf-8")
    print(f"in {options.keep}: ./mutant_judge {' '.join(arguments(options, 'corpus.txt'))} < ids > answers")


def kept(options):
    """Returns the mutants of a folder that --keep filled."""
    rows = (options.keep / "mutants").read_text(encoding="utf-8").splitlines()
    return [Mutant(int(row[0]), row[1], int(row[2]), *row[3:]) for row in (line.split("\t") for line in rows)]


def report(mutants, results, options):
    by = collections.defaultdict(list)
    for mutant, found in results:
        by[category(found)].append((mutant, found))
    if options.out:
        rows = [f"{m.id}\t{m.file}:{m.line}\t{m.kind}\t{m.text}\t{found or 'SURVIVES'}" for m, found in sorted(results)]
        options.out.write_text("\n".join(rows) + "\n", encoding="utf-8")
    crash = sum("crashes: " in found for _, found in by["judge"])
    wrong, slow = len(by["judge"]) + len(by["test"]), len(by["slow"])
    decided = wrong + slow + len(by["survives"])
    share = 100 / max(1, decided)
    print(f"{len(mutants)} mutants, of which the first {len(results)} of a draw with seed {options.seed}: "
          f"{len(by['not reached'])} are reached by neither a case nor a test, {len(by['not decided'])} not decided.")
    print(f"Of the {decided} decided the judge finds {len(by['judge'])} ({crash} of them crash), tests "
          f"{len(by['test'])} more, together {wrong} ({share * wrong:.1f} %); {slow} are right as far as they come and "
          f"ten times slower (with them {share * (wrong + slow):.1f} %); {len(by['survives'])} survive.")
    for name in ("survives", "slow", "not decided"):
        for mutant, found in sorted(by[name]):
            print(f"{found or name}\t{mutant.id}\t{mutant.file}:{mutant.line}\t{mutant.kind}\t{mutant.text}")


SELF_TEST = [  # a line, and its rewritten form (with M for ::ogc_mutant); numbers count from 1
    ("  if (a < b) return -c;", "  if (M::negated(4, a < M::Less{1} < b)) return M::Sign{3} * -c;"),
    ("  x = p.x + 2.0F * q[1];",
     "  x = (M::on(5) ? p.y : p.x) + M::Plus{1} + M::literal(7, 2.0F) * M::Times{3} * q[M::index(6, 1)];"),
    ("  const auto* to = smaller(a, b);  // a < b", "  const auto* to = M::smaller(1, a, b);  "),
    ("  for (int k = 0; k != n; ++k) sum << k;",
     "  for (int k = M::literal(2, 0); k != M::Unequal{1} != n; ++k) sum << k;"),
    ("  a.resize(n * 4), b = &a;", "  a.resize(n * M::Times{1} * M::literal(3, 4)), b = &a;"),
    ("template <class T, int a = 1 + 2>", "template <class T, int a = 1 + 2>"),
    ("  constexpr int most = 1 + 2;", "  constexpr int most = 1 + 2;"),
]


# The output of a stopped program about mutants 1 … 8 (the last line is cut off), and the report on it: with seed 1 they
# are drawn in the order 4 7 2 6 8 1 5 3.
ANSWERS = """right
7\tstep: wrong answers
6\t
2\ttest NAME: fails
4\tten times slower: sweep
5\tsweep: crashes: signal 11
8\tnot reached
3\tstep: wr"""
REPORT = """8 mutants, of which the first 7 of a draw with seed 1: 1 are reached by neither a case nor a test, 1 not \
decided.
Of the 5 decided the judge finds 2 (1 of them crash), tests 1 more, together 3 (60.0 %); 1 are right as far as they \
come and ten times slower (with them 80.0 %); 1 survive.
survives\t6\tx.hpp:6\tsign\tf
ten times slower: sweep\t4\tx.hpp:4\tsign\td
not decided: stopped\t1\tx.hpp:1\tsign\ta
"""


def reported(text, limit):
    """Returns the report on these answers."""
    mutants = [Mutant(i, "x.hpp", i, "sign", "abcdefgh"[i - 1]) for i in range(1, 9)]
    options = argparse.Namespace(seed=1, limit=limit, out=None)
    with contextlib.redirect_stdout(io.StringIO()) as said:
        report(mutants, answers_of(text.splitlines(keepends=True), mutants, options, print), options)
    return said.getvalue()


def work_apart():
    """Returns what is wrong with the separate processes in which mutants are judged."""
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "self_test"
        command = ["g++", "-std=c++20", f"-I{ROOT}", str(ROOT / "tests/mutants/self_test.cpp"), "-o", str(program)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode == 0:
            done = subprocess.run([program], capture_output=True, text=True)
        return "" if done.returncode == 0 else f"{done.stdout}{done.stderr}work apart: exit status {done.returncode}"


def self_test():
    wrong = [text for text in (work_apart(),) if text]
    for limit, expected in ((100, REPORT), (1, "8 mutants, of which the first 2 of a draw")):
        if not reported(ANSWERS, limit).startswith(expected):
            wrong.append(f"with --limit {limit} these answers are reported as\n{reported(ANSWERS, limit)}")
    for line, expected in SELF_TEST:
        got = Rewriter(set()).line("x.hpp", 1, line).replace("::ogc_mutant", "M")
        if got != expected:
            wrong.append(f"{line}\n  becomes  {got}\n  not      {expected}")
    for of, (names, _) in SETS.items():
        rewriter = Rewriter(set())
        for name in names:
            text, before = rewriter.file(name), (ROOT / name).read_text(encoding="utf-8")
            if text.count("\n") != before.count("\n") + 2 or "mutants/switch.hpp" not in text:
                wrong.append(f"{name}: lines are lost or added, or the switch is not included")
        if len(rewriter.mutants) < 1000:
            wrong.append(f"{of}: {len(rewriter.mutants)} mutants only")
    print("\n".join(wrong) or "mutants are rewritten, judged apart and reported as they are to be")
    return 1 if wrong else 0


def build_judge(names, scratch, options, log):
    """Builds the judge of the mutants; returns it and the requested mutants."""
    mutants, rewritten = compile_rewritten(names, scratch, options, log)
    if options.only:
        ids = set(map(int, options.only.split(",")))
        mutants = [m for m in mutants if m.id in ids]
    if options.since:
        lines = lines_since(options.since, names)
        mutants = [m for m in mutants if (m.file, m.line) in lines]
    log(f"{len(mutants)} mutants of {len(names)} files compiled")
    return link(scratch, rewritten, options), mutants


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path, nargs="?")
    parser.add_argument("--self-test", action="store_true", help="only see whether all this works")
    parser.add_argument("--of", choices=sorted(SETS), default="kernels",
                        help="fast/kernels, or fast/stages and fast/cpu")
    parser.add_argument("--files", help="only these, such as fast/cpu/pack.hpp, separated by commas")
    parser.add_argument("--stages", default=",".join(STAGES))
    parser.add_argument("--cases", type=int, default=2000, help="of a stage; of a mesh stage a quarter")
    parser.add_argument("--seed", type=int, default=1, help="of the cases and of the draw; CI's cases have 5")
    parser.add_argument("--jobs", type=int, default=1, help="compilations, then mutants, at a time")
    parser.add_argument("--limit", type=int, default=1 << 30, help="only so many that are reached, drawn at random")
    parser.add_argument("--minutes", type=float, default=25, help="after which no further mutant is begun")
    parser.add_argument("--only", default="",
                        help="only these ids, separated by commas: to see whether more cases find them")
    parser.add_argument("--since", metavar="COMMIT", help="only in lines that this commit did not have")
    parser.add_argument("--flags", default="", help="for the compiler, such as -fsanitize=address,undefined")
    parser.add_argument("--keep", metavar="DIR", type=Path, help="leave the program here and judge nothing")
    parser.add_argument("--answers", metavar="FILE", type=Path, help="of the program in the folder of --keep")
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    if not options.build and not options.self_test:
        parser.error("give the folder in which ogc was built")
    return options


def main():
    options = parsed()
    if options.self_test:
        return self_test()
    FLAGS.extend(options.flags.split())
    names = options.files.split(",") if options.files else SETS[options.of][0]

    def log(text):
        print(text, file=sys.stderr, flush=True)

    if options.answers:
        with options.answers.open(encoding="utf-8") as lines:
            mutants = kept(options)
            report(mutants, answers_of(lines, mutants, options, log), options)
        return 0
    with tempfile.TemporaryDirectory() as scratch:
        program, mutants = build_judge(names, Path(scratch), options, log)
        if options.keep:
            keep(program, mutants, options)
        else:
            report(mutants, judge(program, mutants, options, log), options)
    return 0


if __name__ == "__main__":
    os.nice(10)
    sys.exit(main())
