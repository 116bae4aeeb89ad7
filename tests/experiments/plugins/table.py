"""Tests that the table of `ogc compare --list --json` covers every function, structure and member of compare/plugin.h,
in the header's order, with its types, lengths and offsets.

This reads the headers by itself and lays the structures out by C's rules. Usage: table.py SOURCE_DIR OGC
"""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]), sys.argv[2]
del sys.argv[1:3]

# Size and alignment [bytes] of C's types, and the names that the table has for them.
TYPES = {
    "float": (4, 4, "float32"),
    "double": (8, 8, "float64"),
    "uint8_t": (1, 1, "uint8"),
    "int32_t": (4, 4, "int32"),
    "int64_t": (8, 8, "int64"),
}
POINTER = (8, 8)
VECTOR, DESCRIPTION = "ogc_vec3", "ogc_plugin_info"  # a vector is float[3]; a library describes itself by the other
DECLARATION = re.compile(r"(const )?(\w+) (.*)", re.S)
DECLARATOR = re.compile(r"\(?(\*?)(\w+)\)?((?:\[\d+\])*)")


def header():
    text = "\n".join(path.read_text() for path in sorted((SOURCE / "compare/plugin").glob("*.h")))
    return re.sub(r"/\*.*?\*/|^#[^\n]*", "", text, flags=re.S | re.M)


def members_of(body):
    """Returns (name, type, is pointer, is constant, lengths) of each member."""
    members = []
    for line in (" ".join(part.split()) for part in body.split(";")):
        if line:
            constant, kind, declarators = DECLARATION.fullmatch(line).groups()
            if declarators.startswith("* "):
                declarators = "*" + declarators[2:]
            if kind.endswith("*"):
                raise ValueError(line)
            for declarator in re.split(r",\s*", declarators):
                star, name, lengths = DECLARATOR.fullmatch(declarator.replace("* ", "*").strip()).groups()
                lengths = [int(length) for length in re.findall(r"\d+", lengths)]
                members.append((name, kind, bool(star), bool(constant), lengths))
    return members


def structures():
    text = re.sub(r"(\w)\* ", r"\1 *", header())  # "float* x" as "float *x"
    found = re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, re.S)
    return {name: members_of(body) for name, body in found}


def functions():
    return re.findall(r"OGC_PLUGIN_EXPORT int (\w+)\(const (\w+)\* in, (\w+)\* out\);", header())


def layouts():
    """Returns for each structure its size, its alignment and the offsets of its members."""
    laid = {}
    for name, members in structures().items():
        at, widest, offsets = 0, 1, []
        for _, kind, is_pointer, _, lengths in members:
            size, align = POINTER if is_pointer else TYPES[kind][:2] if kind in TYPES else laid[kind][:2]
            if not is_pointer:
                for length in lengths:
                    size *= length
            elif kind == "void":
                size *= lengths[0]
            at = (at + align - 1) // align * align
            offsets.append(at)
            at, widest = at + size, max(widest, align)
        laid[name] = ((at + widest - 1) // widest * widest, widest, offsets)
    return laid


class Table(unittest.TestCase):
    def setUp(self):
        done = subprocess.run([OGC, "compare", "--list", "--json"], capture_output=True, text=True, check=True)
        self.printed = json.loads(done.stdout)
        self.table = self.printed["plugin"]

    def test_every_function_is_a_stage(self):
        found = [(stage["function"], stage["in"], stage["out"]) for stage in self.table["stages"]]
        self.assertEqual(sorted(found), sorted(functions()))
        self.assertGreater(len(found), 20)
        words = {stage["name"] for stage in self.printed["stages"]}
        self.assertLessEqual({stage["name"] for stage in self.table["stages"]}, words)

    def test_the_version_is_the_header_s(self):
        version = re.search(r"OGC_PLUGIN_VERSION (\d+)", (SOURCE / "compare/plugin/base.h").read_text())[1]
        self.assertEqual(self.table["version"], int(version))

    def test_every_member_is_there_with_its_type_and_place(self):
        here, laid = structures(), layouts()
        self.assertEqual({s["name"] for s in self.table["structures"]}, set(here) - {VECTOR, DESCRIPTION})
        for structure in self.table["structures"]:
            name = structure["name"]
            self.assertEqual([m["name"] for m in structure["members"]], [m[0] for m in here[name]], name)
            self.assertEqual(structure["bytes"], laid[name][0], name)
            for member, declared, offset in zip(structure["members"], here[name], laid[name][2]):
                with self.subTest(structure=name, member=member["name"]):
                    self.assertEqual(member["offset"], offset)
                    self.check(member, *declared[1:])

    def check(self, member, kind, is_pointer, is_constant, lengths):
        if kind == "void":
            self.assertEqual(member["role"], "reserved")
            return
        right, lengths = (TYPES["float"][2], [*lengths, 3]) if kind == VECTOR else (kind, lengths)
        self.assertEqual(member["type"], TYPES[kind][2] if kind in TYPES else right)
        shape = member["shape"]
        self.assertEqual(shape[len(shape) - len(lengths) :], lengths)
        outer = shape[: len(shape) - len(lengths)]
        if is_pointer:
            self.assertEqual(member["role"], "input" if is_constant else "output")
            self.assertTrue(outer)
        else:
            self.assertIn(member["role"], ("field", "value", "nested", "capacity", "count"))
            self.assertEqual(outer, [])

    def test_lists_are_counted_beside_their_arrays(self):
        for structure in self.table["structures"]:
            counters = {m["list"]: m["name"] for m in structure["members"] if m["role"] == "count"}
            for member in structure["members"]:
                if "list" in member and member["role"] == "output":
                    self.assertEqual(member["shape"][0], counters[member["list"]], structure["name"])

    def test_lengths_are_those_of_the_comments(self):
        """The comment behind a member, where it gives a length, gives the one of the table."""
        text = "\n".join(path.read_text() for path in sorted((SOURCE / "compare/plugin").glob("*.h")))
        compared = 0
        for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, re.S):
            members = {m["name"]: m for s in self.table["structures"] if s["name"] == name for m in s["members"]}
            for line, comment in re.findall(r"^ *([^;/]*);\s*/\* (\[.*?\])(?:[^\]]*)\*/", body, re.M):
                lengths = re.findall(r"\[([^\]]*)\]", comment)
                for member in (members[m[0]] for m in members_of(re.sub(r"(\w)\* ", r"\1 *", line)) if m[0] in members):
                    if len(lengths) == 1 and member["role"] in ("input", "output"):
                        of_table = [str(word) for word in member["shape"]]
                        due = lengths[0].split(" * ")
                        self.assertEqual(of_table[: len(due)], due, f"{name}.{member['name']}")
                        compared += 1
        self.assertGreater(compared, 80)


unittest.main(verbosity=1)
