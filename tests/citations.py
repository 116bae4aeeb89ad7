#!/usr/bin/env python3
"""Every document that the repository cites is in it, with the section that is cited; so is every source file.

    tests/citations.py SOURCE_DIR     one line for each citation that leads nowhere; exit status 1 where there is any
    tests/citations.py --self-test    only whether planted citations are found

Looked at are all text files that git tracks. A citation is a name that ends in .md, in the text of a document, in a
comment or in a string, and what follows it: "X.md §4.2", "X.md §1, §3", "X.md, 5b." or 'X.md, "Title"'. A link of a
Markdown file, [text](file#title), names any file, relative to the document. A name is looked for beside the file that
cites it, then from the root, then, if one document alone has it, anywhere.

A section is the number of a heading ("## 4. Energies", "### 4.2 Contact"), or of a row of a table that begins with it
("| §5.1.3 | ..."), as the rows of deviations.md do. A title is a heading, or words in bold at the start of a paragraph;
its beginning is enough.

A source file is cited by its path from the root, in documents and in sources; one named in capitals stands for many
(compare/stages/STAGE.hpp). A test is cited in a document by its file and its title, `tests/a.cpp`: *a title …*, where …
stands for words that are left out.
"""

import re
from pathlib import Path

from house import run, tracked

HISTORY = {"CHANGELOG.md"}  # describes the past
# Documents that programs write, by the code that names them. An entry that nothing cites is a finding itself.
WRITTEN = {"table1_paper.md": "python3 -m paper_figures.figures.table1"}
SKIPPED = {".png", ".gif", ".mp4", ".gz", ".csv", ".h5", ".json", ".obj", ".ply", ".pdf", ".npz"}

CITING = (".md", ".h", ".hpp", ".cpp", ".cu", ".cuh")  # files in which source files are cited
SOURCE_FILE = re.compile(r"(?<![\w/.-])(([a-z_]+)/(?:\w+/)*(\w+)\.(?:hpp|cpp|cuh?|py))\b")

TESTS = re.compile(r"`(tests/[\w/]+\.\w+)`: ((?:\*[^*]+\*(?:, |; (?=\*))?)+)")
JOINED = re.compile(r'"\s*\n\s*"')  # a string that continues in the next line

COMMENT = re.compile(r"\n[ \t]*(?://[/<!]*|#+(?![#\w])|\*(?!\*))?[ \t]*")  # a citation may continue in the next line
NAME = r"(?<![\w/.$-])((?:\.{1,2}/)*(?:[\w-]+/)*[\w-]+\.md)\b(?!\.)"
NUMBER = r"\d+[a-z]?(?:\.\d+)*"
SECTIONS = rf"(?:,? ?§ ?{NUMBER})(?:(?:,| and| to| or) §{NUMBER})*|, {NUMBER}\.(?= |$)"
CITATION = re.compile(rf"{NAME}[`)]?((?:{SECTIONS})|,? \"[^\"]+\"|)")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(rf"^#+ +(?:§?({NUMBER})\.? )?(.*)$", re.M)
ROW = re.compile(rf"^\| *[^|\n]*?§({NUMBER})[^|\n]*\|", re.M)
BOLD = re.compile(r"^(?:[-*] )?\*\*(.+?)\*\*", re.M | re.S)


def plain(title):
    """Returns a title in the form in which it is compared: without markup and trailing punctuation."""
    return re.sub(r"\s+", " ", re.sub(r"[`*]", "", title)).strip(" .:").lower()


def anchor(title):
    """Returns the anchor of a title in rendered Markdown."""
    return re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", title.strip().lower()))


class House:
    """Holds the files of a repository, and the citations in them that lead nowhere."""

    def __init__(self, files):
        self.files = files
        self.documents = {name for name in files if name.endswith(".md")}
        self.used = set()
        self.findings = [finding for name in sorted(files) if name not in HISTORY for finding in self.of_file(name)]

    def of_file(self, name):
        text = self.files[name]
        found = []
        if name.endswith(".md"):
            found += self.of_links(name, text) + self.of_tests(name, text)
            text = LINK.sub(lambda link: self.as_citation(name, link[1]), text)
        if name.endswith(CITING):
            found += self.of_source_files(name, text)
        flat, starts = self.flattened(text)
        for match in CITATION.finditer(flat):
            fault = self.fault(name, match[1], match[2])
            if fault:
                found.append(f"{name}:{self.line(starts, match.start())}: {fault}")
        return found

    def of_source_files(self, name, text):
        found = []
        for match in SOURCE_FILE.finditer(text):
            is_ours = any(file.startswith(match[2] + "/") for file in self.files)
            if is_ours and not match[3].isupper() and match[1] not in self.files:
                found.append(f"{name}:{text.count(chr(10), 0, match.start()) + 1}: there is no file {match[1]}")
        return found

    def of_tests(self, name, text):
        """Returns findings about titles of tests that their files do not have."""
        found = []
        for match in TESTS.finditer(text):
            source = JOINED.sub("", self.files.get(match[1], ""))
            for title in re.findall(r"\*([^*]+)\*", match[2]):
                words = ".*?".join(re.escape(part.strip()) for part in title.split("…"))
                if source and not re.search(words, source, re.S):
                    line = text.count("\n", 0, match.start()) + 1
                    found.append(f"{name}:{line}: {match[1]} has no test '{title}'")
        return found

    def as_citation(self, name, target):
        """Returns a link to a document as its path, so that the text after it is read; nothing for other links."""
        here = name.rpartition("/")[0]
        path = normal(f"{here}/{target}" if here else target)
        return path if path in self.documents else ""

    @staticmethod
    def flattened(text):
        """Returns the text in one line, and the place in it where each line begins."""
        starts, flat, last = [0], [], 0
        length = 0
        for match in COMMENT.finditer(text):
            part = text[last:match.start()] + " "
            flat.append(part)
            length += len(part)
            starts += [length] * match[0].count("\n")
            last = match.end()
        return "".join(flat) + text[last:], starts

    @staticmethod
    def line(starts, place):
        return sum(start <= place for start in starts)

    def resolved(self, name, cited):
        """Returns the cited document, or nothing."""
        here = name.rpartition("/")[0]
        for base in (here, ""):
            path = normal(f"{base}/{cited}" if base else cited)
            if path in self.documents:
                return path
        same = [document for document in self.documents if document.endswith("/" + cited)]
        return same[0] if len(same) == 1 else None

    def fault(self, name, cited, where):
        made = cited.rpartition("/")[2]
        if made in WRITTEN:
            self.used.add(made)
            return ""
        document = self.resolved(name, cited)
        if document is None:
            return f"there is no document {cited}"
        title = re.search(r'"([^"]+)"', where)
        if title:
            known = any(known.startswith(plain(title[1])) for known in self.titles(document))
            return "" if known else f'{document} has no section "{title[1]}"'
        missing = [number for number in re.findall(NUMBER, where) if number not in self.numbers(document)]
        return f"{document} has no section {', '.join(missing)}" if missing else ""

    def of_links(self, name, text):
        here = name.rpartition("/")[0]
        found = []
        for match in LINK.finditer(text):
            target, _, part = match[1].partition("#")
            if re.match(r"[a-z]+:", match[1]):
                continue
            path = normal(f"{here}/{target}" if here else target) if target else name
            line = text.count("\n", 0, match.start()) + 1
            if not any(file == path or file.startswith(path + "/") for file in self.files):
                found.append(f"{name}:{line}: there is no file {match[1]}")
            elif part and part not in {anchor(title) for title in self.headings(path)}:
                found.append(f"{name}:{line}: {path} has no section #{part}")
        return found

    def headings(self, document):
        return [match[0].lstrip("#").strip() for match in HEADING.finditer(self.files[document])]

    def numbers(self, document):
        text = self.files[document]
        return {match[1] for match in HEADING.finditer(text) if match[1]} | {match[1] for match in ROW.finditer(text)}

    def titles(self, document):
        text = self.files[document]
        titles = {plain(match[2]) for match in HEADING.finditer(text)} | {plain(t) for t in self.headings(document)}
        bold = {plain(match[1]) for match in BOLD.finditer(text)}
        return titles | bold


def normal(path):
    parts = []
    for part in path.split("/"):
        if part == ".." and parts:
            parts.pop()
        elif part not in ("", "."):
            parts.append(part)
    return "/".join(parts)


SOUND = {
    "README.md": "See [the method](compare/method.md), [its energies](compare/method.md#4-energies), `method.md` §4.\n",
    "compare/method.md": "# Method\n\n## 4. Energies\n\n### 4.2 Contact\n\n## 5b. Planes\n\n**In bold.** Words.\n",
    "compare/deviations.md": "| where | why |\n|---|---|\n"
                             "| §5.1.3 | the body, `tests/a.cpp`: *a body …*, *… pushes* |\n",
    "tests/a.cpp": 'TEST_CASE("a body that is "\n          "pushed pushes")\n',
    "fast/kernels/a.hpp": "// Of a contact (method.md §4.2, §4), as the\n// rule of method.md\n// §5b says; "
                          "compare/deviations.md, §5.1.3.\n",
    "fast/a.py": '# method.md, 4. And method.md, "Contact": README.md is the start.\n',
    "reference/README.md": "In `compare/method.md`, \"In bold\", and [a](../compare/method.md).\n",
    "experiments/counts": 'writes "table1_paper.md"\n',
}
# The file that changes, its text, the place of the finding and its message.
PLANTED = (
    ("fast/kernels/a.hpp", "// Of a contact\n// (method.md §9).\n", 2, "compare/method.md has no section 9"),
    ("fast/kernels/a.hpp", "// The rule of method.md\n// §4.3.\n", 1, "compare/method.md has no section 4.3"),
    ("fast/kernels/a.hpp", "// (method.md §4, §6)\n", 1, "compare/method.md has no section 6"),
    ("fast/kernels/a.hpp", "// As in fast/kernels/a.hpp,\n// and fast/kernels/b.hpp.\n", 2,
     "there is no file fast/kernels/b.hpp"),
    ("README.md", "a\nSee `tests/a.cpp`: *a body …*, *a body pulls …*.\n", 2,
     "tests/a.cpp has no test 'a body pulls …'"),
    ("README.md", "Each fast/NAME.hpp, other/c.cpp and `fast/a.cpp`.\n", 1, "there is no file fast/a.cpp"),
    ("fast/a.py", "# method.md, 7. And so on.\n", 1, "compare/method.md has no section 7"),
    ("fast/a.py", '# method.md, "Forces".\n', 1, 'compare/method.md has no section "Forces"'),
    ("fast/a.py", "x = 'see nothing.md'\n", 1, "there is no document nothing.md"),
    ("fast/a.py", "# compare/deviations.md, §5.1.4\n", 1, "compare/deviations.md has no section 5.1.4"),
    ("README.md", "a\n[b](compare/nothing.hpp)\n", 2, "there is no file compare/nothing.hpp"),
    ("README.md", "[b](compare/method.md#5-energies)\n", 1, "compare/method.md has no section #5-energies"),
    ("reference/README.md", "a\n\n`design.md` §2\n", 3, "there is no document design.md"),
    ("reference/README.md", "[the method](../compare/method.md) §8\n", 1, "compare/method.md has no section 8"),
)


def self_test():
    """Returns messages about planted citations that were not found, or found beside others."""
    failures = [f"self-test: a sound tree is refused: {finding}" for finding in House(SOUND).findings]
    for name, text, line, message in PLANTED:
        found = House({**SOUND, name: text}).findings
        if found != [f"{name}:{line}: {message}"]:
            failures.append(f"self-test: expected {name}:{line}: {message}; got {found}")
    return failures


def findings(root):
    own = "tests/citations.py"  # has planted citations
    house = House({name: "" if Path(name).suffix in SKIPPED or name == own else text
                   for name, text in tracked(root).items()})
    unused = sorted(set(WRITTEN) - house.used)
    return [*house.findings, *(f"{own}: nothing cites {name}: remove it" for name in unused),
            *([] if house.documents else [f"{root}: no documents there"])]


if __name__ == "__main__":
    run(__doc__, self_test, findings)
