#!/usr/bin/env python3
"""Finds code that nothing uses: functions, types and constants whose name stands nowhere outside tests but where it is
declared and defined, and, in Python, functions that nothing names.

    tests/dead_code.py SOURCE_DIR     one line for each; exit status 1 where there is any
    tests/dead_code.py --self-test    only whether planted dead code is found

It compares words, not meanings: a name that two things share counts as used where either is.
"""

import ast
import collections
import re

from house import run, tracked

ROOMS = ("compare", "reference", "fast", "experiments")
COMMENTS_AND_TEXTS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)
WORD = re.compile(r"\b[A-Za-z_]\w*\b")
# Words that begin a line which is not a declaration of a function.
STATEMENTS = "default|return|else|throw|delete|new|case|using|typedef|if|while|for|switch|goto|co_return"
TYPE = rf"^(?![ \t]*(?:{STATEMENTS})\b)[\w:<>,*& \t]*?\w>*[*&]*[ \t]+"
FUNCTION = re.compile(rf"{TYPE}(?:\w+(?:<\w+>)?::)*(?!alignas)([a-z]\w*)\(", re.M)
# The name of a plain enum need not be used: its enumerators are.
NAMED = re.compile(r"\b(?:struct|(?<!enum )class|enum class|union|concept|using)\s+([A-Za-z_]\w*)\s*(?=[{=:;]|final\b)")
CONSTANT = re.compile(r"\bconstexpr\s+[\w:<>, ]+?\s([A-Za-z_]\w*)\s*(?=[={\[])")

PAPER = "a definition or an equation of the paper, which tests of its theorems use (reference/README.md)"
ORACLE = "tests hold faster code against it"
WINDOW = "tests look through it into what is private"
CALLED = "a library or the system calls it by this name"
# Names that are unused on purpose, each with its reason. An entry whose name does not exist is a finding itself.
KEPT = {
    **dict.fromkeys(("boundary_paths", "has_normals", "in_edge_only_block", "is_hull_edge", "locate", "part_contacts",
                     "penetration_depths", "solid_angle", "surface_topology", "volumetric_contacts"), PAPER),
    **dict.fromkeys(("edge_edge_by_definition", "edge_edge_over_all_pairs", "reference_sweep",
                     "sensitivity", "stencil_derivatives", "vertex_facet_by_definition"), ORACLE),
    "step_columns": WINDOW,
    "read_mesh": "meshes alone, without where their elements come from: what tests read",
    "declaration": "an object whose constructor adds rows to the table of settings",
    **dict.fromkeys(("main", "ogc_activation", "ogc_barrier", "ogc_ccd", "ogc_closest_face",
                     "ogc_closest_points", "ogc_detect_vertex_facet", "ogc_friction_force", "ogc_spring",
                     "ogc_tetrahedron", "ogc_truncate", "ogc_volume_force"), CALLED),
}


def without_comments(text):
    return COMMENTS_AND_TEXTS.sub(" ", text)


def dead_names(files, kept=()):
    """Returns names of C++ code that nothing uses; `files`: {path: text} of what is built into programs, without
    tests."""
    uses, introduced = collections.Counter(), collections.Counter()
    for text in map(without_comments, files.values()):
        uses.update(WORD.findall(text))
        for pattern in (FUNCTION, NAMED, CONSTANT):
            introduced.update(match[1] for match in pattern.finditer(text))
    dead = {name for name, times in introduced.items() if uses[name] <= times}
    return sorted(dead - set(kept)), sorted(set(kept) - set(introduced))


def dead_functions(files):
    """Returns functions and classes of Python that nothing names, including tests and templates; `files`: {path:
    text}."""
    uses, defined = collections.Counter(), {}
    for path, text in files.items():
        uses.update(WORD.findall(text))
        if not path.endswith(".py"):
            continue
        kinds = (ast.FunctionDef, ast.ClassDef)
        defined.update({node.name: path for node in ast.walk(ast.parse(text)) if isinstance(node, kinds)})
    called_by_name = re.compile(r"__\w+__|test_\w+|setUp(Class)?|tearDown|handle_\w+")
    found_by_unittest = {name for name, path in defined.items() if path.startswith("tests/") and name[0].isupper()}
    alone = {name for name in defined if uses[name] == 1} - found_by_unittest
    return sorted(name for name in alone if not called_by_name.fullmatch(name))


def self_test():
    """Returns sentences about planted code that is judged wrongly."""
    used = {"a.hpp": "int used(int x);\nstruct Used {\n  int member() const;\n};\nconstexpr int limit = 3;\n",
            "a.cpp": "int used(int x) { return x + limit; }\nint Used::member() const { return 1; }\n",
            "b.cpp": "int main() {\n  Used one;\n  return used(one.member());\n}\nint main(int);\nauto m = main;\n"}
    declared = {"c.hpp": "int idle(int);\n", "c.cpp": "int idle(int x) { return x; }\n"}
    member = {"c.hpp": "struct Used {\n  bool idle() const;\n};\n", "c.cpp": "bool Used::idle() const { return 1; }\n"}
    commented = {"c.cpp": 'int idle() { return 0; }  // idle\nauto t = "idle";\nauto n = t;\n'}
    plants = {"a declared and defined function": (declared, "idle"), "a member": (member, "idle"),
              "an inline function": ({"c.hpp": "template <class T>\nOGC_HD T idle(const T& x) {\n  return x;\n}\n"},
                                     "idle"),
              "one that a comment and a text name": (commented, "idle"),
              "a type": ({"c.hpp": "struct Idle {\n  int x;\n};\n"}, "Idle"),
              "an alias": ({"c.hpp": "using Idle = int;\n"}, "Idle"),
              "a constant": ({"c.hpp": "inline constexpr double idle = 2.;\n"}, "idle")}
    wrong = [f"sound code is called dead: {name}" for name in dead_names(used)[0]]
    for words, (files, name) in plants.items():
        if dead_names({**used, **files})[0] != [name]:
            wrong.append(f"{words} is not found: {dead_names({**used, **files})[0]}")
    if dead_names(used, {"used": "", "gone": ""})[1] != ["gone"]:
        wrong.append("an entry of KEPT whose name is gone is not found")
    python = {"m.py": "def used():\n    return 1\n\n\ndef idle():\n    return used()\n\n\ndef shown():\n    pass\n",
              "t.html": "{{ shown() }}",
              "tests/t.py": "class Cases:\n    pass\n"}
    if dead_functions(python) != ["idle"]:
        wrong.append(f"Python: {dead_functions(python)}")
    return [f"self-test: {words}" for words in wrong]


def findings(root):
    files = tracked(root, *(f"{room}/*.{end}" for room in ROOMS for end in ("cpp", "hpp", "cu", "cuh", "in")))
    dead, stale = dead_names(files, KEPT)
    words = "nothing but tests uses it: remove it, or say in KEPT (tests/dead_code.py) what it is for"
    yield from (f"{name}: {words}" for name in dead)
    yield from (f"{name}: in KEPT, but gone: remove it there" for name in stale)
    named = dead_functions(tracked(root, "*.py", "*.html"))
    yield from (f"{name}: nothing names this function: remove it" for name in named)
    if not files:
        yield f"{root}: no source files there"


if __name__ == "__main__":
    run(__doc__, self_test, findings)
