"""Runs every law at its smallest size, as CI does: no row is broken, and the output matches its schema.

Usage: laws.py OGC. Without jsonschema the schema is not checked, and a message says so.
"""

import json
import subprocess
import sys

try:
    import jsonschema
except ImportError:
    jsonschema = None


def ogc(program, *arguments):
    done = subprocess.run([program, "laws", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    return done.returncode, json.loads(done.stdout)


def check(program):
    status, found = ogc(program, "--quick", "--json")
    broken = [row for row in found["rows"] if row["verdict"] == "broken"]
    assert not broken and status == 0 and not found["broken"], (status, broken)
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
