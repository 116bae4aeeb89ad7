"""Judges a kernel in Python against the exact reference, as `ogc compare STAGE --plugin FILE.py` does."""

import ast
import dis
import inspect
import json
import os
import shutil
import subprocess
import sys
import tempfile
import textwrap
import types
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Case:
    """A failing case.

    `problem` is its problem string. `inputs` are by name. `given` and `exact` are the kernel's answer and the
    reference's, by name; they are empty if there is no answer. `messages` say what is wrong.
    """

    problem: str
    messages: list
    inputs: dict = field(default_factory=dict)
    given: dict = field(default_factory=dict)
    exact: dict = field(default_factory=dict)

    def __str__(self):
        lines = [self.problem, *(f"  {message}" for message in self.messages)]
        lines += [f"  {name} = {value}" for name, value in self.inputs.items()]
        lines += [f"  {name}: given {value}, exact {self.exact[name]}" for name, value in self.given.items()]
        return "\n".join(lines)


@dataclass
class Verdict:
    """What the judge says of one stage.

    `first` is the first failing case, made smaller if it is a mesh; None if no case fails. `mistakes` maps the names of
    known mistakes that explain the failing cases to what they mean. `counts` has numbers of cases and `times` the
    seconds of the kernel and of the C++ kernel for the same questions (`kernel`, `ours`). `failures` lists failing
    cases of each generator. `log` is what the kernel printed, and `result` all of `ogc compare --json`.
    """

    stage: str
    passed: bool
    first: Case | None
    mistakes: dict
    counts: dict
    times: dict
    failures: list
    log: str = field(repr=False)
    result: dict = field(repr=False)

    def __str__(self):
        each = 1e9 * self.times["kernel"] / max(1, self.counts["cases"])
        lines = [
            f"{self.stage}: {'passed' if self.passed else 'mismatch'}, {self.counts['mismatches']} of "
            f"{self.counts['cases']} cases fail, {each:.3g} ns a case"
        ]
        lines += [f"your answer equals `{name}`: {meaning}" for name, meaning in self.mistakes.items()]
        return "\n".join(lines + ([str(self.first)] if self.first else []))


def judge(function, stage=None, cases=100_000, seed=1, program=None, time_limit=10):
    """Judges a kernel, which `@kernel(stage)` has marked, and returns its verdict.

    `stage` is needed only if the kernel has several marks. `program` is the program `ogc` or `ogc-judge`; without it,
    the environment's OGC_PROGRAM, the `ogc-judge` that ogc-testbed[judge] installs, `ogc` on the PATH or beside Python,
    and build/default/ogc of a checkout are tried. A call of the kernel may take `time_limit` seconds, and so may the
    import of its file. Raises ValueError for what is no kernel, and RuntimeError if there is no program or no verdict.

    The kernel runs in a process of its own, which runs the file that defines it down to the first call of judge, where
    this function is another one. A kernel of a notebook has no file: its source is saved with the functions, modules
    and constants that it names. What has no source there, such as an array, is refused.
    """
    stages = getattr(function, "ogc_stages", ())
    if stage is None and len(stages) == 1:
        stage = stages[0]
    if stage not in stages:
        name, known = getattr(function, "__name__", repr(function)), ", ".join(stages)
        if stages:
            raise ValueError(f"{name} is a kernel of {known}, not of {stage}; give one of them as stage")
        raise ValueError(f'{name} is no kernel; write @kernel("{stage or "truncate"}") above it')
    program = find_program(program)
    with tempfile.TemporaryDirectory(prefix="ogc-judge-") as folder:
        file = file_of(function) or saved(function, stage, Path(folder))
        command = [program, "compare", stage, "--plugin", file, "--cases", cases, "--seed", seed]
        command += ["--time-limit", time_limit, "--report", Path(folder) / "report", "--json"]
        environment = {**os.environ, "OGC_PYTHON": sys.executable}
        done = subprocess.run(list(map(str, command)), env=environment, capture_output=True, text=True, check=False)
    if not done.stdout.strip():
        said = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
        raise (ValueError if done.returncode == 2 else RuntimeError)(said.removeprefix(f"{Path(program).name}: "))
    return verdict_of(json.loads(done.stdout), done.returncode, done.stderr)


def find_program(program=None):
    """Returns the program `ogc-judge` or `ogc`; raises RuntimeError that names where it was looked for."""
    named = program or os.environ.get("OGC_PROGRAM")
    if named:
        found = shutil.which(named)
        if not found:
            raise RuntimeError(f"{named}, which {'program' if program else 'OGC_PROGRAM'} names, can't be started")
        return found
    installed = Path(__file__).parent / "ogc-judge"  # of the distribution ogc-testbed-judge, in the same folder
    checkout = Path(__file__).resolve().parents[3] / "build/default/ogc"
    beside = Path(sys.executable).parent / "ogc"
    for place in (str(installed), "ogc", str(beside), "build/default/ogc", str(checkout)):
        found = shutil.which(place)
        if found:
            return str(Path(found).resolve())
    raise RuntimeError(
        f"ogc_testbed.judge needs the judge, and {installed} is not there: pip install 'ogc-testbed[judge]'; or build "
        f"the program ogc of a checkout, which is neither on the PATH nor beside {sys.executable}, build/default/ogc "
        f"or {checkout}, and name it by program=… or the environment's OGC_PROGRAM"
    )


def file_of(function):
    """Returns the file from which a worker gets the function; None if there is no such file."""
    file = getattr(getattr(inspect.unwrap(function), "__code__", None), "co_filename", "")
    if not file.endswith(".py") or not os.path.isfile(file) or "<locals>" in getattr(function, "__qualname__", ""):
        return None
    return os.path.abspath(file)


def saved(function, stage, folder):
    """Writes the function with all that it names into a file, and returns the file."""
    parts = {}
    collect(function, function.__name__, parts, function.__name__)
    module = "from ogc_testbed.kernels import kernel as ogc_kernel\n"
    mark = f"\nogc_kernel({stage!r})({function.__name__})\n"
    file = folder / f"{function.__name__}.py"
    file.write_text(module + "\n".join(parts.values()) + mark)
    return file


def collect(value, name, parts, path):
    """Adds the source of a value, after that of what it names, to `parts`."""
    if name in parts:
        return
    if isinstance(value, types.ModuleType):
        parts[name] = f"import {value.__name__} as {name}"
    elif type(value) in (bool, int, float, str, type(None)):
        parts[name] = f"{name} = float('{value!r}')" if isinstance(value, float) else f"{name} = {value!r}"
    elif getattr(value, "__module__", "__main__") not in ("__main__", None) and hasattr(value, "__qualname__"):
        parts[name] = f"from {value.__module__} import {value.__qualname__} as {name}"
    elif isinstance(value, types.FunctionType):
        if value.__closure__:
            raise ValueError(f"`{path}` uses variables of the function around it; define it at the top of a file")
        source = without_marks(value)
        parts[name] = ""  # a recursive function names itself
        for used in sorted(names_in(value.__code__)):
            if used in value.__globals__:
                collect(value.__globals__[used], used, parts, f"{path}.{used}")
        del parts[name]
        parts[name] = source
    else:
        raise ValueError(
            f"`{path}` is of type {type(value).__name__}, which has no source to save; define it in a function of the "
            "kernel, or keep the kernel in a file"
        )


def names_in(code):
    """Returns the global names of a function and of those inside it."""
    inner = (names_in(constant) for constant in code.co_consts if isinstance(constant, types.CodeType))
    return {step.argval for step in dis.get_instructions(code) if step.opname == "LOAD_GLOBAL"}.union(*inner)


def without_marks(function):
    """Returns the source of a function without its decorators."""
    try:
        source = textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError):
        raise ValueError(f"`{function.__name__}` has no source here; keep the kernel in a file") from None
    definition = ast.parse(source).body[0]
    if not isinstance(definition, ast.FunctionDef):
        raise ValueError(f"`{function.__name__}` is not a function by def; write one")
    return "\n".join(source.splitlines()[definition.lineno - 1 :])


def verdict_of(result, status, log):
    report, plugin = result["stages"][0], result["plugin"]
    diagnosis = report.get("diagnosis") or {}
    names = [diagnosis["name"], *diagnosis["as_well"]] if diagnosis.get("name") else []
    failures = [Case(row["problem"], [row["message"]]) for row in report["listed"]]
    first = failures[0] if failures else None
    for told in result["explained"]:
        inputs = {row["name"]: row["value"] for row in told["inputs"]}
        given, exact = ({row["name"]: row[side] for row in told["answers"]} for side in ("given", "exact"))
        first = Case(told["problem"], told["messages"], inputs, given, exact)
    return Verdict(
        stage=report["stage"],
        passed=status == 0,
        first=first,
        mistakes={n: diagnosis["meaning"] if n == names[0] else f"as likely as {names[0]}" for n in names},
        counts={name: report[name] for name in ("cases", "mismatches", "grey", "grey_not_exact", "near")},
        times={"kernel": plugin["times"][0]["plugin_seconds"], "ours": plugin["times"][0]["our_seconds"]},
        failures=failures,
        log=log,
        result=result,
    )
