"""Tests the museum of public bugs: each exhibit builds, and the judge catches it, names it as README.md does, and
prints a whole case.

Without its mistake an exhibit passes, so the mistake alone is caught. Usage: museum.py SOURCE_DIR OGC
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]), sys.argv[2]
MUSEUM = SOURCE / "experiments/plugins/museum"
ROW = re.compile(r"^\| \[(\w+)\]\((\w+)\.cpp\) \|.*\| `(\w+)` \| `([\w-]+)` \|$", re.MULTILINE)

# Corrections: text of the exhibit -> corrected text.
MENDED = {
    "eq19_as_printed": ("tau * k * (tau - r) * (tau - r)", "tau * k * (r - tau)"),
    "half_logarithm": ("right / 2", "right"),
    "barrier_twice_too_stiff": ("2 * in->stiffness[i]", "in->stiffness[i]"),
    "absolute_epsilon": ("1e-5f", "0.0f"),
    "hessian_counted_twice": ("in->cases[i].damping, 2,", "in->cases[i].damping, 1,"),
    "damping_on_approach_alone": ("now.length < start.length ? c.damping : 0", "c.damping"),
    "end_point_by_threshold": ("epsilon = 1e-5", "epsilon = 0"),
    "contacts_beyond_a_cap": ("slots = 4", "slots = 1 << 30"),
    "signs_choose": ("positive(w) == 1)", "false)"),
    "weights_rotated": ("std::rotate(w, w + 1, w + 3)", "std::rotate(w, w, w + 3)"),
    "nan_of_needles": ("w.of[0] <= 0 || w.of[1] <= 0 || w.of[2] <= 0", "positive(w) < 3"),
    "near_pairs_left_out": ("< 1e-10", "< 0"),
    "early_crossings_left_out": ("t < 1e-10 ? 1 : t", "t"),
    "free_without_separator": ("return 1;", "return 0;"),
    "ones_for_identity": ("off_diagonal = 1", "off_diagonal = 0"),
}


def check(condition, message):
    if not condition:
        sys.exit(message)


def judged(source, stage, folder):
    library = source.with_suffix(".so")
    flags = ["-O1", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-I", SOURCE]
    subprocess.run(["g++", *flags, source, "-o", library], check=True)
    command = [OGC, "compare", stage, "--plugin", library, "--cases", "3000", "--report", folder, "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    check(done.returncode in (0, 1), f"{source.name}: exit status {done.returncode}: {done.stderr}")
    return done.returncode, json.loads(done.stdout)


def check_explained(name, result):
    """Checks that a failing case is printed whole, and that an audit accepts its mesh."""
    explained = result["explained"]
    check(len(explained) == 1 and explained[0]["messages"], f"{name}: not one failing case is told: {explained}")
    case = explained[0]
    inputs = case["inputs"]
    is_whole = all({"name", "unit", "value"} <= set(row) for row in inputs) and any(row["unit"] for row in inputs)
    check(is_whole, f"{name}: {inputs}")
    differing = [row["name"] for row in case["answers"] if row["given"] != row["exact"]]
    check(differing, f"{name}: both answers are said to be equal: {case['answers']}")
    if "mesh" in case:
        done = subprocess.run([OGC, "audit", case["mesh"]], capture_output=True, text=True, check=False)
        is_read = done.returncode in (0, 1) and "1 state " in done.stdout
        check(is_read, f"{name}: an audit does not take {case['mesh']}: {done.stderr}")
    return "mesh" in case


def main():
    table = ROW.findall((MUSEUM / "README.md").read_text())
    rows = {name: (stage, form) for name, file, stage, form in table if name == file}
    exhibits = {path.stem for path in MUSEUM.glob("*.cpp")}
    same = bool(rows) and set(rows) == exhibits == set(MENDED)
    check(same, f"exhibits {sorted(exhibits)}, rows of README.md {sorted(rows)}, mended {sorted(MENDED)}")
    meshes = 0
    with tempfile.TemporaryDirectory() as scratch:
        for name, (stage, form) in sorted(rows.items()):
            text = (MUSEUM / f"{name}.cpp").read_text()
            exhibit, mended = Path(scratch) / f"{name}.cpp", Path(scratch) / f"{name}_mended.cpp"
            exhibit.write_text(text)
            status, result = judged(exhibit, stage, Path(scratch) / name)
            diagnosis = result["stages"][0].get("diagnosis")
            check(status == 1 and result["stages"][0]["mismatches"] > 0, f"{name}: not caught")
            is_named = diagnosis and diagnosis["name"] == form and not diagnosis["as_well"]
            check(is_named, f"{name}: `{form}` expected: {diagnosis}")
            meshes += check_explained(name, result)
            wrong, right = MENDED[name]
            check(text.count(wrong) == 1, f"{name}: '{wrong}' does not stand there once")
            mended.write_text(text.replace(wrong, right))
            check(judged(mended, stage, Path(scratch) / "mended")[0] == 0, f"{name}: without its mistake it fails, too")
    check(meshes >= 3, f"only {meshes} exhibits have a mesh to audit")


main()
