"""Every command that a document prints is understood by the program that it calls, and those that take seconds are run
as printed.

Usage: documents.py SOURCE_DIR OGC. Exit status 77: skipped, a package that plots need is missing.

Commands are the lines of shell blocks, and code in the text that begins like one. `ogc` and our scripts parse them
without running anything (OGC_PARSE_ONLY), Python's own parser does so for ours; blocks of Python are run. What a
document says is tried where it says it: in a folder that looks like the repository after `tests/run`, with a run, a
mesh and a scene of the names that documents use.
"""

import ast
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
del sys.argv[1:3]
try:
    import h5py  # lines of Python in documents use it
    import matplotlib  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

HISTORY = "CHANGELOG.md"  # describes the past
FOLDERS = ("experiments", "paper_figures", "plots", "tests", "compare")
# Programs of others, whose options no program of ours parses.
FOREIGN = {"cmake", "cd", "ctest", "g++", "ninja", "nvcc", "pip", "sudo", "docker"}
OPERATORS = {"&&", "||", "|", ";", "&"}
# Commands of shell blocks that are parsed but not run, with the reason. A rule that matches nothing is a finding.
NOT_RUN = {
    r"^(experiments/reproduce|tests/run)\b": "installs and builds; CI runs the one, tests the other's workflow",
    r"^experiments/peers/run\b": "installs packages of others, which are large",
    r"--backend cuda": "needs a GPU",
    r"--scale (paper|small)\b": "minutes",
    r"--cases \d{6,}|ogc compare( |$)(?!.*(--problem|truncate))": "minutes; the judge's own tests ask every stage",
    r"data=input": "a data set that is not part of this repository",
    r"ogc laws --quick": "a test of its own asks them, and knows which are broken today",
    r"ogc view runs/my_run$": "a window, which needs a display",
    r"--format usd": "needs usd-core, which is optional; tests/plots/view.py exports where it is",
    r"ogc bench": "seconds a repetition, and it wants a machine for itself",
    r"^pip install (\.|.?ogc-testbed)": "minutes; tests/experiments/python/wheel.py builds the wheel",
    r"^experiments/python/wheels": "minutes, and one wheel needs nvcc",
    r"somewhere": "installs; a test builds and runs these examples (tests/experiments/examples)",
    r"mine\.(cpp|so|py)": "the reader's own file; a test builds and judges those of this page",
}
SPANS = re.compile(r"(?:[\w./]*\bogc|experiments/\w+|tests/\w+(?:\.py)?|python3|\.venv/bin/python)(?: |$)")

MESH = "".join(f"v {x} {y} {z}\n" for z in (0, 0.001) for x, y in ((0, 0), (0.01, 0), (0, 0.01))) + "f 1 2 3\nf 4 5 6\n"

# Runs a Python program up to its parser of options, which prints PARSED.
AS_FAR_AS_ITS_PARSER = """
import argparse, runpy, sys
def stopping(parse):
    def stop(self, *words, **more):
        parse(self, *words, **more)
        print("PARSED")
        raise SystemExit(0)
    return stop
for name in ("parse_args", "parse_intermixed_args"):
    setattr(argparse.ArgumentParser, name, stopping(getattr(argparse.ArgumentParser, name)))
kind, name = sys.argv[1:3]
sys.argv = sys.argv[2:]
if kind == "module":
    runpy.run_module(name, run_name="__main__", alter_sys=True)
runpy.run_path(name, run_name="__main__")
"""


def blocks(text):
    """Returns (language, content) of each fenced block."""
    return re.findall(r"^ *```(\w*)\n(.*?)^ *```", text, re.S | re.M)


def without_blocks(text):
    return re.sub(r"^ *```.*?^ *```", "", text, flags=re.S | re.M)


def lines_of(block):
    """Returns the lines of a shell block without comments, joining a line that ends with \\ to the next."""
    joined = block.replace("\\\n", " ")
    return [line for line in (re.sub(r"(^|\s)#.*$", "", raw).strip() for raw in joined.splitlines()) if line]


def commands_of(line):
    """Returns the commands of a line as words, without the operators between them and without redirections."""
    parser = shlex.shlex(line, posix=True, punctuation_chars="|&;<>")
    parser.whitespace_split, commands, skip = True, [[]], False
    for word in parser:
        if skip or word in OPERATORS or set(word) <= set("<>"):
            skip = set(word) <= set("<>")
            if word in OPERATORS:
                commands.append([])
        elif not re.fullmatch(r"[A-Z_]+=.*", word) or commands[-1]:
            commands[-1].append(word)
    return [words for words in commands if words]


def spans_of(text):
    """Returns the code in the text that begins like a command of ours and has more than its name, unless it has "…" or
    alternatives in brackets, which no parser understands."""
    found = (span for span in re.findall(r"`([^`\n]+)`", without_blocks(text)) if SPANS.match(span) and " " in span)
    return [re.sub(r"\s*…", "", span) for span in found if not re.search(r"[\[\]|]", span)]


def planned(text):
    """Returns what a document declares as not implemented yet."""
    section = re.search(r"^## What is not there yet$(.*?)(^## |\Z)", text, re.S | re.M)
    return re.findall(r"`([^`\n]+)`", section[1]) if section else []


class Place:
    """A folder that looks like the repository after `tests/run`; finds what is wrong with a command in it."""

    def __init__(self, folder):
        self.folder = Path(folder)
        for name in FOLDERS:
            (self.folder / name).symlink_to(SOURCE / name)
        for name, target in (("build/default/ogc", OGC), (".venv/bin/python", sys.executable)):
            path = self.folder / name
            path.parent.mkdir(parents=True)
            path.write_text(f'#!/bin/sh\nexec "{target}" "$@"\n')
            path.chmod(0o755)
        for name in ("my.obj", "shirt.obj", "mesh.obj", "MESH"):
            (self.folder / name).write_text(MESH)
        shutil.copy(self.folder / "build/default/ogc", self.folder / "PROGRAM")  # name used in documents

    def run(self, words, limit=100, **variables):
        environment = {**os.environ, "OGC_PYTHON": sys.executable, **variables}
        environment["PATH"] = f"{self.folder / 'build/default'}:{environment['PATH']}"
        done = subprocess.run(list(map(str, words)), cwd=self.folder, env=environment, capture_output=True, text=True,
                              timeout=limit, check=False)
        return done.returncode, done.stdout, done.stderr

    def fault(self, words):
        """Returns in words what is wrong with a command; empty if its program understands it."""
        program = Path(words[0]).name
        if program == "ogc":
            return self.fault_of_ogc(words)
        if program in ("python3", "python"):
            return self.fault_of_python(words)
        if (SOURCE / words[0]).is_file():
            return self.fault_of_script(words)
        return "" if program in FOREIGN else "nobody parses this: a program that is neither ours nor in FOREIGN"

    def fault_of_ogc(self, words):
        if len(words) == 2 and not words[1].startswith("-"):  # the name of a command, not a call of it
            words = [*words, "--help"]
        status, _, said = self.run([OGC, *words[1:]], OGC_PARSE_ONLY="1")
        return "" if status == 0 else (said.strip().splitlines() or [f"exit status {status}"])[-1]

    def fault_of_python(self, words):
        kind, name, rest = ("module", words[2], words[3:]) if words[1] == "-m" else ("file", words[1], words[2:])
        path = SOURCE / (name.replace(".", "/") + ".py" if kind == "module" else name)
        if not path.is_file():
            return f"there is no {kind} {name}"
        interpreter = [shutil.which("python3") if words[0] == "python3" else self.folder / words[0]]
        return self.fault_by_parser(interpreter, kind, name, rest or ["--help"], path.read_text())  # a name alone

    def fault_by_parser(self, interpreter, kind, name, rest, text):
        # without a parser it takes words by position
        if not re.search(r"argparse|baseline_arguments|(parser|options)_of_figure|common import main", text):
            if any(word.startswith("-") for word in rest if rest != ["--help"]):
                return f"{name} takes no options"
            status, _, said = self.run([*interpreter, "-c", f"import {name}"]) if kind == "module" else (0, "", "")
            return "" if status == 0 else said.strip().splitlines()[-1]
        status, out, said = self.run([*interpreter, "-c", AS_FAR_AS_ITS_PARSER, kind, name, *rest])
        if status == 0 and ("PARSED" in out or "usage:" in out):
            return ""
        return (said.strip().splitlines() or ["its parser was not asked"])[-1]

    def fault_of_script(self, words):
        text = (SOURCE / words[0]).read_text()
        if "python" in text.splitlines()[0] or words[0].endswith(".py"):
            return self.fault_by_parser(["python3"], "file", words[0], words[1:], text)
        if "OGC_PARSE_ONLY" in text:
            status, _, said = self.run(words, OGC_PARSE_ONLY="1")
            return "" if status == 0 else said.strip()
        _, out, said = self.run([words[0], "--help"])
        unknown = [word for word in words[1:] if word.startswith("-") and word.partition("=")[0] not in out + said]
        return f"{words[0]} --help names no {', '.join(unknown)}" if unknown else ""


def faults(place, text):
    """Returns (command, what is wrong) for the commands of a document."""
    shell = (block for language, block in blocks(text) if language in ("sh", "bash", "shell", "console"))
    lines = [line for block in shell for line in lines_of(block)]
    spans = [span for span in spans_of(text) if span not in planned(text)]
    found, seen = [], set()
    for words in (words for line in [*lines, *spans] for words in commands_of(line)):
        if tuple(words) not in seen:
            seen.add(tuple(words))
            fault = place.fault(words)
            found += [(" ".join(words), fault)] if fault else []
    return found


def documents():
    command = ["git", "-C", SOURCE, "ls-files", "*.md"]
    names = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    return {name: (SOURCE / name).read_text() for name in names if name != HISTORY and (SOURCE / name).is_file()}


# Documents with one fault each, and the message about it.
PLANTED = {
    "```sh\nbuild/default/ogc run twist --scael smoke\n```": "--scael",
    "```sh\nogc audit my.obj && ogc contacts my.obj --radius\n```": "--radius",
    "`ogc runs twist`": "subcommand",
    "`ogc compare --cases many`": "cases",
    "```sh\npython3 -m paper_figures.workflow.verdicts --writes\n```": "--writes",
    "```sh\npython3 -m paper_figures.workflow.check runs --all\n```": "takes no options",
    "`python3 -m paper_figures.nothing --x`": "no module",
    "```sh\nexperiments/reproduce fig12 --scal smoke\n```": "--scal",
    "`experiments/reproduce fig99`": "fig99",
    "`python3 -m paper_figures.workflow.runner --windw 3`": "--windw",
    "`experiments/bundle --strip`": "--strip",
    "`tests/mutants.py FILE --stagez a`": "--stagez",
    "```sh\nfrobnicate --all\n```": "nobody parses this",
}
SOUND = (
    "```sh\nX=1 ogc audit my.obj > out.txt   # words --nonsense\nogc run twist \\\n  --scale smoke\n```",
    "`ogc run`", "`ogc audit …`", "`ogc run SCENE --solver newton`",
         "`python3 -m paper_figures.workflow.runner --window 3 twist`",
    "`python3 -m paper_figures.workflow.verdicts --write`", "`python3 -m paper_figures.workflow.runner`",
    "## What is not there yet\n\n`ogc view my.obj`\n",
)


class Scratch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # The viewer of `ogc run --view-png` may still draw its last picture into the folder.
        holder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(holder.cleanup)
        cls.place = Place(holder.name)


class Understood(Scratch):
    def test_every_command_of_every_document_is_understood(self):
        for name, text in documents().items():
            for command, fault in faults(self.place, text):
                with self.subTest(document=name, command=command):
                    self.fail(fault)

    def test_planted_faults_are_found(self):
        for planted, words in PLANTED.items():
            found = faults(self.place, planted)
            self.assertEqual(len(found), 1, planted)
            self.assertIn(words, found[0][1], planted)

    def test_what_is_right_is_not_called_wrong(self):
        for sound in SOUND:
            self.assertEqual(faults(self.place, sound), [], sound)

    def test_parsing_runs_nothing(self):
        before = sorted(path.name for path in self.place.folder.iterdir())
        self.assertEqual(self.place.fault(["ogc", "run", "cloth_on_sphere", "--scale", "smoke"]), "")
        self.assertEqual(sorted(path.name for path in self.place.folder.iterdir()), before)


class AsPrinted(Scratch):
    """Runs commands that take seconds as printed."""

    def test_commands_of_shell_blocks_and_lines_of_python(self):
        texts = documents()
        self.assertIn("`ogc scenes cloth_on_sphere --write my_scene`", texts["experiments/README.md"])
        for words in (["run", "cloth_on_sphere", "--scale", "smoke", "--out", "runs/my_run"],
                      ["scenes", "cloth_on_sphere", "--write", "my_scene"],
                      ["export", "runs/my_run", "--format", "ply", "--out", "their_run"]):
            status, _, said = self.place.run([OGC, *words])
            self.assertEqual(status, 0, said)
        used = set()
        for name, text in texts.items():
            for language, block in blocks(text):
                for command in lines_of(block) if language == "sh" else [block] if language == "python" else []:
                    if language == "python" and "import ogc_testbed" in command:
                        continue  # tests/experiments/python/programs.py runs these
                    if language == "python" and name.startswith("experiments/peers/reports/"):
                        continue  # `experiments/peers/run PEER reports` runs these with the packages of others
                    rules = {rule for rule in NOT_RUN if language == "sh" and re.search(rule, command)}
                    used |= rules
                    if not rules:
                        with self.subTest(document=name, command=command):
                            self.check(language, command)
        self.assertEqual(used, set(NOT_RUN), "these rules of NOT_RUN match nothing: remove them")

    def check(self, language, command):
        time.sleep(1 - time.time() % 1)  # two runs that begin in the same second would have the same folder name
        program = [".venv/bin/python", "-c"] if language == "python" else ["bash", "-euc"]
        status, _, said = self.place.run([*program, command], PYTHONPATH=str(SOURCE / "experiments/python"))
        self.assertEqual(status, 0, said[-1500:])

    def test_planted_lines_are_found(self):
        for language, command in (("python", "from ogc_testbed.runs import Runs\n"),
                                  ("sh", "build/default/ogc audit nothing.obj"),
                                  ("sh", "build/default/ogc run twist --set iteration=3 --scale smoke")):
            with self.assertRaises(AssertionError, msg=command):
                self.check(language, command)


class Parts(unittest.TestCase):
    def test_lines_and_words_of_a_block(self):
        self.assertEqual(lines_of("a b  # c\n\n# d\ne \\\n f\n"), ["a b", "e   f"])
        self.assertEqual(commands_of("V=1 a 'b c' > d && e | f"), [["a", "b c"], ["e"], ["f"]])

    def test_the_harness_is_python(self):
        ast.parse(AS_FAR_AS_ITS_PARSER)


if __name__ == "__main__":
    unittest.main()
