#!/usr/bin/env python3
"""Asks far more of the random tests than a build does, and keeps how much was asked and what failed: damaged files,
calls of the Python package, runs that are killed again and again, and on a device steps under compute-sanitizer.

    tests/stress.py BUILD --out FILE [--files N] [--calls N] [--kills N]
    tests/stress.py BUILD --out FILE --device [--steps N]

BUILD holds the tests, or with --device at least `ogc`; calls from Python need the environment .venv. FILE is the table,
a row for each kind, in place of an earlier one. A count of 0 leaves a kind out. Exit status 1: something failed; its
words are in FILE.log.
"""

import argparse
import csv
import datetime
import re
import subprocess
import sys
import tempfile
import time
from os import environ
from pathlib import Path
from xml.etree import ElementTree

HERE = Path(__file__).parent
COLUMNS = ("what", "asked", "of", "faults", "seeds", "seconds", "device", "commit")
# The tests check each sample twice: once as it is, and once all its damaged cases together.
CHECKS_A_SAMPLE = 2
FILES = {"damaged mesh files": "damaged mesh files*", "damaged states and scenes": "damaged states and scenes*"}
# Values are a test and how many runs it cuts off: it kills a writer five times, or cuts each of four scenes off by each
# of three signals until it ends.
CUTS = {"a writer killed at any moment": ("kill -9 at any moment*", 5),
        "scenes cut off until they end": ("a run that kill -9*", 12)}
SCENES = ("cloth_on_sphere", "twist", "knot", "fifty_layers", "robot_shirt", "mat_twist", "yarn_stretch")
TOOLS = ("memcheck", "racecheck", "initcheck", "synccheck")
PATHS = {"balls": (), "planes": ("--set", "bounds=planes")}


class Stress:
    def __init__(self, build, log):
        self.build, self.log, self.rows = Path(build), log, []
        said = subprocess.run([self.build / "ogc", "--version"], capture_output=True, text=True, check=True).stdout
        self.commit = re.search(r"commit (\S+)", said)[1][:10]
        found = re.search(r"cuda: usable \((.*)\)", said)
        self.devices = {"cpu": re.search(r"cpu: usable \((.*)\)", said)[1], "cuda": found and found[1]}

    def run(self, words, **more):
        """Returns the finished process; what it said goes into the log."""
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False,
                              env={**environ, **more})
        self.log.write(f"$ {' '.join(map(str, words))}\n{done.stdout}{done.stderr}exit status {done.returncode}\n")
        self.log.flush()
        return done

    def add(self, what, asked, of, faults, seeds, begun, device="cpu"):
        self.rows.append(dict(zip(COLUMNS, (what, asked, of, faults, seeds, f"{time.monotonic() - begun:.0f}",
                                            self.devices[device], self.commit))))
        print(f"{what}: {asked} {of}, {faults} faults", flush=True)

    def catch(self, program, test, **more):
        """Returns (checks that held, checks that failed) of tests; a test that ends otherwise counts as one failure."""
        done = self.run([self.build / program, test, "-r", "xml"], **more)
        return results_in(done.stdout, done.returncode)

    def files(self, cases):
        for what, test in FILES.items():
            begun = time.monotonic()
            held, faults = self.catch("tests_compare", test, OGC_FUZZ_CASES=str(cases))
            self.add(what, cases * (held + faults) // CHECKS_A_SAMPLE, "files", faults, f"frozen, {today()}", begun)

    def calls(self, number):
        script = HERE / "experiments/python/fuzz.py"
        for seed in (1, today()):
            begun = time.monotonic()
            done = self.run([sys.executable, script, self.build, f"--seed={seed}", f"--cases={number}"])
            if done.returncode == 77:  # skipped
                sys.exit(f"stress: {done.stdout.strip() or done.stderr.strip()}; call it by .venv/bin/python")
            self.add("calls of the Python package", number, "calls", int(done.returncode != 0), seed, begun)

    def kills(self, times):
        for what, (test, cuts) in CUTS.items():
            begun, faults = time.monotonic(), 0
            program = "tests_compare" if "writer" in what else "tests_experiments"
            for _ in range(times):
                faults += self.catch(program, test)[1]
            self.add(what, times * cuts, "runs", faults, "new each time", begun)

    def sanitized(self, steps):
        """Runs the first steps of each scene under each tool."""
        for tool in TOOLS:
            for name, options in PATHS.items():
                begun, faults = time.monotonic(), 0
                for scene in SCENES:
                    with tempfile.TemporaryDirectory() as folder:
                        done = self.run(["compute-sanitizer", "--tool", tool, "--error-exitcode", "9",
                                         self.build / "ogc", "run", scene, "--scale", "smoke", "--backend", "cuda",
                                         "--audit", "off", "--steps", steps, *options, "--out", f"{folder}/run"])
                    faults += int(done.returncode != 0)
                self.add(f"{tool}, {name}", len(SCENES), f"scenes of {steps} steps", faults, "", begun, "cuda")


def results_in(xml, status):
    """Returns (checks that held, checks that failed) of Catch2's report; one failure where it is no report, or where
    the status tells of one that it does not."""
    try:
        found = ElementTree.fromstring(xml[xml.index("<?xml"):]).find("OverallResults")
        held, faults = int(found.get("successes")), int(found.get("failures"))
    except (ValueError, ElementTree.ParseError, AttributeError):
        return 0, 1
    return held, faults or int(status != 0 or held == 0)


def today():
    return int(datetime.datetime.now(datetime.timezone.utc).strftime("%Y%m%d"))


def merged(path, rows):
    """Returns these rows and those of an earlier table about other things."""
    mine = {row["what"] for row in rows}
    earlier = []
    if path.is_file():
        with path.open(newline="") as file:
            earlier = [row for row in csv.DictReader(file) if row["what"] not in mine]
    return [*earlier, *rows]


def self_test():
    report = '<?xml version="1.0"?>\n<Catch2TestRun><OverallResults successes="{}" failures="{}"/></Catch2TestRun>'
    assert results_in(report.format(4, 0), 0) == (4, 0)
    assert results_in(report.format(3, 1), 1) == (3, 1)
    assert results_in(report.format(4, 0), 139) == (4, 1), "a crash after the report is a fault"
    assert results_in(report.format(0, 0), 0) == (0, 1), "no test of this name is a fault"
    assert results_in("died", 134) == (0, 1)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "t.csv"
        path.write_text("what,asked\na,1\nb,2\n")
        assert merged(path, [{"what": "b", "asked": 3}]) == [{"what": "a", "asked": "1"}, {"what": "b", "asked": 3}]


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of the build")
    parser.add_argument("--out", type=Path, required=True, help="the table")
    parser.add_argument("--files", type=int, default=100_000, help="damaged files of each sample (default: 10⁵)")
    parser.add_argument("--calls", type=int, default=100_000, help="calls from Python a seed (default: 10⁵)")
    parser.add_argument("--kills", type=int, default=5, help="times that runs are killed to their end (default: 5)")
    parser.add_argument("--device", action="store_true", help="steps under compute-sanitizer, and nothing else")
    parser.add_argument("--steps", type=int, default=10, help="of each scene under compute-sanitizer (default: 10)")
    options = parser.parse_args()
    if not (options.build / "ogc").is_file():
        parser.error(f"no program in {options.build}: build it first")
    with options.out.with_name(f"{options.out.name}.log").open("w") as log:
        stress = Stress(options.build, log)
        if options.device:
            if not stress.devices["cuda"]:
                parser.error("no device: ogc --version says why")
            stress.sanitized(options.steps)
        else:
            for number, ask in ((options.files, stress.files), (options.calls, stress.calls),
                                (options.kills, stress.kills)):
                if number:
                    ask(number)
    rows = merged(options.out, stress.rows)
    with options.out.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    sys.exit(any(row["faults"] for row in stress.rows))


if __name__ == "__main__":
    main()
