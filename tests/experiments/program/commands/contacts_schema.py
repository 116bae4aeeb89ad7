"""Checks the output of `ogc contacts --json` against the schema that `ogc contacts --schema` prints, and the schema
against the output: every key of the schema occurs.

Usage: contacts_schema.py OGC SOURCE_DIR. Exit status 77: skipped because jsonschema is missing (a message says so).
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import jsonschema
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(77)

# Two sheets that cross above each other, a third triangle on one edge, and a thread: all kinds of contacts, and all
# kinds of edges except those of closed surfaces.
MESH = """
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.1\nv 0.5 0.4 -0.6
v 0.1 0.2 0.05\nv 1.1 0.3 0.06\nv 0.3 1.2 0.04
v 0.2 0.9 0.12\nv 0.9 0.15 0.13
f 1 2 3\nf 2 4 3\nf 2 3 5\nf 6 7 8\nl 9 10
"""


def ogc(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def keys_of_schema(schema, inside=()):
    """Yields the paths of the keys in the schema's objects, through arrays and references."""
    if "$ref" in schema:
        return keys_of_schema(DEFINITIONS[schema["$ref"].rsplit("/", 1)[1]], inside)
    found = set()
    for key, inner in schema.get("properties", {}).items():
        found |= {(*inside, key)} | keys_of_schema(inner, (*inside, key))
    return found | (keys_of_schema(schema["items"], inside) if "items" in schema else set())


def keys_of(document, inside=()):
    if isinstance(document, list):
        return set().union(*[keys_of(item, inside) for item in document])
    if not isinstance(document, dict) or inside == ("filters",):  # its keys are names of predicates
        return set()
    return set().union(*[{(*inside, key)} | keys_of(inner, (*inside, key)) for key, inner in document.items()])


def check(program, folder):
    mesh = folder / "all.obj"
    mesh.write_text(MESH.lstrip())
    schema = ogc(program, "contacts", "--schema")
    DEFINITIONS.update(schema["$defs"])
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    exact = ogc(program, "contacts", mesh, "--radius", 0.25, "--ipc", "--sdf", "--squares", "--json")
    for document in (exact, ogc(program, "contacts", mesh, "--engine", "cpu", "--json")):
        errors = [f"{'/'.join(map(str, error.absolute_path))}: {error.message}"
                  for error in validator.iter_errors(document)]
        assert not errors, errors[:5]
    assert keys_of(exact) == keys_of_schema(schema), keys_of(exact) ^ keys_of_schema(schema)
    assert set(exact["vertex_place"]) == {"boundary", "non_manifold", "loose"}, exact["vertex_place"]
    for change in ({"format": "ogc contacts 1"}, {"surprise": 1}, {"bound": [-1]}):
        assert not validator.is_valid({**exact, **change}), change
    return exact


DEFINITIONS = {}

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        document = check(sys.argv[1], Path(name))
    print(f"{len(document['vertex_facet'])} vertex-facet and {len(document['edge_edge'])} edge-edge contacts as the "
          "schema says")
