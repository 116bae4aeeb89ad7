"""Asks every law at its least size, as CI does: no row is broken but those below, each of which is, and what the
program prints is what its schema says.

Usage: laws.py OGC. Without jsonschema the schema is not looked at, and that is said.
"""

import json
import subprocess
import sys

try:
    import jsonschema
except ImportError:
    jsonschema = None

# (law, solver) that are broken today, and what of. One that holds must go from here.
OPEN = {
    ("pinned_sheet", "vbd"): "sweeps that end early leave forces that would have taken energy (method.md §7.8)",
}


def ogc(program, *arguments):
    done = subprocess.run([program, "laws", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    return done.returncode, json.loads(done.stdout)


def check(program):
    status, found = ogc(program, "--quick", "--json")
    assert status == (1 if found["broken"] else 0), (status, found["broken"])
    broken = {(row["law"], row["solver"]): row for row in found["rows"] if row["verdict"] == "broken"}
    for key, row in broken.items():
        assert key in OPEN, (key, row["why"], [each for each in row["readings"] if each["verdict"] == "broken"])
    assert not set(OPEN) - set(broken), f"these hold: take them from OPEN: {sorted(set(OPEN) - set(broken))}"
    if jsonschema is None:
        print("jsonschema is missing: the schema was not looked at")
        return found
    _, schema = ogc(program, "--schema")
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    errors = [f"{'/'.join(map(str, error.absolute_path))}: {error.message}" for error in validator.iter_errors(found)]
    assert not errors, errors[:5]
    for change in ({"format": "ogc laws 0"}, {"surprise": 1}, {"rows": [{}]}):
        assert not validator.is_valid({**found, **change}), change
    return found


if __name__ == "__main__":
    document = check(sys.argv[1])
    verdicts = [row["verdict"] for row in document["rows"]]
    print(", ".join(f"{verdicts.count(verdict)} {verdict}" for verdict in ("holds", "limit", "broken", "not asked")))
