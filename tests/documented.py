#!/usr/bin/env python3
"""Public declarations carry a comment that says what they mean: the share that does, room by room, against a threshold.

    tests/documented.py SOURCE_DIR             one line for each room below its threshold; exit status 1 for any
    tests/documented.py SOURCE_DIR --list ROOM the declarations of a room that have none
    tests/documented.py --self-test            only whether planted declarations are told apart

Counted are, in headers, at namespace scope or public in a class: types, functions, constants and members. A declaration
is documented by `///` above it, `///<` behind it, or as part of a group: declarations in consecutive lines below one
`///`. Left out is what has no meaning of its own: constructors, destructors, operators, overriding functions, friends,
aliases, forward declarations, and what stands in a namespace without a name.
"""

import re
import sys

from house import run, tracked

# The least share by room.
THRESHOLDS = {"compare": 0.98, "reference": 0.90, "fast": 0.75, "experiments": 0.95}
HEADERS = (".hpp", ".cuh")

TYPE = re.compile(r"^(?:template\s*<.*>\s*)?(?:struct|class|union|enum\s+class|enum)\s+(?:\[\[.*?\]\]\s*)?"
                  r"(?:alignas\(.*?\)\s*)?(\w+)?[^()=]*$", re.S)
IGNORED = re.compile(r"^(?:(?:struct|class|enum class) \w+$|using|typedef|friend|static_assert|extern\s+template|"
                     r"public|private|protected|#|requires\b.*;$)")
NAME = re.compile(r"(~?\w+|operator\S+)\s*\($")


class Declaration:
    """One public declaration: its place, its name, and whether it has a comment."""

    def __init__(self, line, last, name):
        self.line, self.last, self.behind, self.name = line, last, last, name
        self.documented = self.in_group = self.is_type = False


def blanked(text):
    """Returns the text with comments, strings and preprocessor lines replaced by spaces; lines keep their length."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|'
                         r'^[ \t]*#[^\n]*(?:\\\n[^\n]*)*',
                         re.S | re.M)
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def closing(text, at):
    """Returns the place after the bracket that closes the one at `at`."""
    pairs = {"{": "}", "(": ")", "[": "]"}
    depth, opening, closer = 0, text[at], pairs[text[at]]
    for i in range(at, len(text)):
        depth += (text[i] == opening) - (text[i] == closer)
        if depth == 0:
            return i + 1
    return len(text)


def name_of(text):
    """Returns the name that a declaration at namespace or class scope introduces; None if it is not counted."""
    flat = " ".join(text.split())
    flat = re.sub(r"^template ?<.*?> (?=\w)", "", flat) if flat.startswith("template") else flat
    flat = re.sub(r"^requires [^{;]*?\) (?=\w)|^requires [\w:<>, ]+? (?=(?:void|auto|bool|inline|constexpr)\b)", "",
                  flat)
    if not flat or IGNORED.match(flat) or " override" in flat or "operator" in flat:
        return None
    declared = re.split(r"(?<![=!<>])=(?!=)", re.sub(r"\[\[.*?\]\]", "", flat))[0]
    call = declared.find("(")
    if call >= 0:
        words = re.findall(r"~?\w+", declared[:call])
        if len(words) < 2 or words[-1].startswith("~"):  # a constructor or destructor
            return None
        return words[-1]
    words = re.findall(r"\w+", re.sub(r"\{.*|\[.*|:\s*\d+$", "", declared))
    return words[-1] if len(words) > 1 else None


class Header:
    """Reads the declarations of one header."""

    def __init__(self, text):
        self.lines = text.split("\n")
        self.text = blanked(text)
        self.found = []
        self.scope(0, len(self.text), "", True)
        self.found.sort(key=lambda one: (one.line, one.last))
        self.attach_comments()

    def line(self, at):
        return self.text.count("\n", 0, at)

    def scope(self, at, end, owner, public):
        """Collects the declarations between two places of a namespace or class."""
        start = at
        while at < end:
            letter = self.text[at]
            if letter in "([":
                at = closing(self.text, at)
            elif letter == ":" and (access := re.search(r"(public|private|protected)\s*$", self.text[start:at])):
                public = access[1] == "public"
                at += 1
                start = at
            elif letter == ";":
                if public:
                    self.add(start, at, owner)
                at += 1
                start = at
            elif letter == "{":
                at, start = self.braces(start, at, owner, public)
            else:
                at += 1

    def braces(self, start, at, owner, public):
        """Skips the braces that open at `at`; returns the place after them and the start of the next declaration."""
        head, end = self.text[start:at].strip(), closing(self.text, at)
        if re.match(r"^(?:inline\s+)?namespace\b", head):
            if re.match(r"^(?:inline\s+)?namespace\s+\w", head):
                self.scope(at + 1, end - 1, owner, True)
            return end, end
        if (kind := TYPE.match(head)) and not head.startswith("using"):
            if public and kind[1]:
                self.add(start, at, owner, kind[1])
                if "enum" not in head:
                    bare = re.sub(r"^template\s*<.*?>", "", head, flags=re.S)
                    self.scope(at + 1, end - 1, kind[1], not re.search(r"\bclass\b", bare))
            after = re.compile(r"[^;]*;").match(self.text, end)
            end = after.end() if after else end
            return end, end
        behind = self.text[end:end + 200].lstrip()
        if "(" in head and (not behind.startswith((";", ",")) or
                            re.search(r"\)\s*(const|noexcept|->.*)?\s*$", head)):
            if public:
                self.add(start, at, owner, behind=end)
            return end, end
        return end, start  # the braces of an initialiser

    def add(self, start, end, owner, name=None, behind=None):
        is_type, text = name is not None, self.text[start:end]
        name = name or name_of(text)
        if name and name != owner:
            first = start + len(text) - len(text.lstrip())
            self.found.append(Declaration(self.line(first), self.line(end), name))
            self.found[-1].is_type, self.found[-1].behind = is_type, self.line(behind) if behind else self.line(end)

    def attach_comments(self):
        """Finds the comments of declarations: `///` above, `///<` behind or on the lines below, or one of a group."""
        before = None
        for one in self.found:
            above = self.lines[one.line - 1].strip() if one.line > 0 else ""
            behind = any("///<" in self.lines[i] for i in range(one.line, min(one.last + 1, len(self.lines))))
            in_group = before is not None and before.in_group and not before.is_type and before.behind + 1 == one.line
            same_line = before is not None and before.line == one.line
            one.in_group = above.startswith("///") and not above.startswith("///<") or in_group
            one.documented = one.in_group or behind or same_line and before.documented
            before = one


def counts(files):
    """Returns (documented, all) of headers; `files`: {path: text}."""
    declarations = [one for text in files.values() for one in Header(text).found]
    return sum(one.documented for one in declarations), len(declarations)


def headers_of(source, room):
    return {name: text for name, text in tracked(source, room).items() if name.endswith(HEADERS)}


PLANTED = """
namespace a {

/// Said.
struct Told {
  int first = 0;  ///< said
  int second = 0;
  Told() = default;
  explicit Told(int n) : first(n) {}
  /// Said of both.
  void one() const { first; }
  void two() const;

  std::vector<int> list{1, 2};

 private:
  int hidden = 0;
};

class Untold {
 public:
  int value() const { return value_; }
  bool operator==(const Untold&) const = default;

 private:
  int value_ = 0;
};

/// Said.
inline constexpr int limit = 3;
int function(int a,
             int b);  ///< said behind

template <class T>
void generic(T t) {
  if (t) return;
}

namespace {
int local();
}

}  // namespace a
"""
EXPECTED = {"Told": True, "first": True, "second": False, "one": True, "two": True, "list": False, "Untold": False,
            "value": False, "limit": True, "function": True, "generic": False}


def self_test():
    found = {one.name: one.documented for one in Header(PLANTED).found}
    return [] if found == EXPECTED else [f"self-test: expected {EXPECTED}, got {found}"]


def findings(root):
    for room, least in THRESHOLDS.items():
        documented, total = counts(headers_of(root, room))
        share = documented / max(total, 1)
        print(f"{room}: {documented} of {total} public declarations documented, {100 * share:.1f} %", file=sys.stderr)
        if share < least:
            yield (f"{room}: {100 * share:.1f} % of the public declarations are documented, {100 * least:.0f} % are "
                   f"asked for: tests/documented.py SOURCE_DIR --list {room}")


if __name__ == "__main__":
    if sys.argv[2:3] == ["--list"]:
        bare = ((name, one) for name, text in headers_of(sys.argv[1], sys.argv[3]).items()
                for one in Header(text).found if not one.documented)
        print("\n".join(f"{name}:{one.line + 1}: {one.name}" for name, one in bare))
    else:
        run(__doc__, self_test, findings)
