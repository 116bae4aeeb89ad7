"""Each number of a document's table of measurements, and of a sentence that names its rows, is in the file that it
names, rounded as it is printed.

Usage: printed_numbers.py SOURCE_DIR. Exit status 77: skipped, numpy is missing.

A table is held to a file where the paragraph above it links to a CSV of the accepted results. The rows of the file are
those whose cells name what the table's row is about; columns whose title says `floor` (counted) or `quoted` (another's
measurement) are left out. A sentence is held to a file where it ends with `([rows](FILE.csv))`.
"""

import csv
import re
import sys
import unittest
from decimal import Decimal
from pathlib import Path
from unittest import mock

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import numpy  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow import contents, headline, page_tables, verdicts, whole_runs  # noqa: E402
from paper_figures.workflow.evidence import RESULTS  # noqa: E402

DOCUMENTS = ("README.md", "fast/PERFORMANCE.md", "reference/README.md", "paper_figures/ablations.md",
             "paper_figures/results/h200/README.md", "paper_figures/results/two_cores/README.md",
             "tests/mutants/README.md")
SHORT = {"sphere": "cloth_on_sphere"}  # names of scenes in documents, where they are not the scenes' own
NOT_OURS = ("floor", "quoted")
LINK = re.compile(r"\[[^\]]*\]\(([^)#]*\.csv)\)")
POWER = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
NUMBER = re.compile(rf"(?<![\w.,^/{POWER}])-?(?:\d{{1,3}}(?:,\d{{3}})+|\d+)(?:\.\d+)?"
                    rf"(?:e-?\d+|·10[{POWER}]+)?(?![\w{POWER}/])")
UPRIGHT = str.maketrans(POWER, "-0123456789")
# What a sentence's number may be times the file's: the same, s of ms, %.
SCALES = [Decimal(1), Decimal("0.001"), Decimal(100)]


def printed(text):
    """(value, half a unit of its last digit) of a number as documents print it."""
    mantissa, _, exponent = text.replace(",", "").replace("·10", "e").translate(UPRIGHT).partition("e")
    value = Decimal(mantissa).scaleb(int(exponent or 0))
    return value, Decimal(1).scaleb(Decimal(mantissa).as_tuple().exponent + int(exponent or 0)) / 2


def numbers(text):
    """All numbers in a cell of a file: "0: 15.81; 2400: 88.31" has four."""
    return [Decimal(found) for found in re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d{1,3})?(?![\w.])", text)]


def is_among(text, values, scales=SCALES[:1]):
    value, half = printed(text)
    return any(abs(number * scale - value) <= half for number in values for scale in scales)


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def tables(text):
    """(paragraph above, titles, rows) of each Markdown table."""
    for found in re.finditer(r"((?:^[^|\n].*\n)+)\n((?:^\|.*\n)+)", text, re.M):
        lines = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]
                 for line in found[2].splitlines()]
        yield found[1], lines[0], lines[2:]


def about(label, rows):
    """The rows of a file that a table's row is about."""
    quoted = re.search(r"`([^`]+)`", label)
    name = quoted[1] if quoted else label
    name = SHORT.get(name, name)
    return [row for row in rows if name in row.values()]


def faults_of_table(titles, lines, rows):
    for line in lines:
        values = [number for row in about(line[0], rows) for cell in row.values() for number in numbers(cell or "")]
        for title, cell in zip(titles[1:], line[1:]):
            if not any(word in title for word in NOT_OURS):
                yield from ((line[0], title, found) for found in NUMBER.findall(cell) if not is_among(found, values))


def sentences(text):
    """(words, file) of each sentence that ends with a link to rows."""
    flat = re.sub(r"^\|.*$|^ *```.*?^ *```", "", text, flags=re.M | re.S if "```" in text else re.M).replace("\n", " ")
    for found in re.finditer(r"\(\[rows\]\(([^)]*\.csv)\)", flat):
        before = flat[:found.start()]
        begin = max(before.rfind(mark) + len(mark) for mark in (". ", ": ", "; ", "]", "|", "  "))
        yield before[begin:], found[1]


def faults(text, folder):
    """What a document says that its files do not: (of what, where, number)."""
    for above, titles, lines in tables(text):
        link = LINK.search(above)
        if link:
            yield from faults_of_table(titles, lines, rows_of(folder / link[1]))
    for words, name in sentences(text):
        values = [number for row in rows_of(folder / name) for cell in row.values() for number in numbers(cell or "")]
        bare = re.sub(r"`[^`]*`|§[\d.]+|Eq\. \d+|Table \d+|RTX \d+|Fig\. \d+|\b1/\d+ s", "", words)
        yield from ((words.strip()[:40], name, found) for found in NUMBER.findall(bare)
                    if not is_among(found, values, SCALES))


def held(text):
    """(place in the text, number) of each number of a table that is held to a file."""
    for above, titles, lines in tables(text):
        if not LINK.search(above):
            continue
        for line in lines:
            at = text.index("| " + " | ".join(line))
            for title, cell in zip(titles[1:], line[1:]):
                at = text.index("| " + cell, at + 1)
                if not any(word in title for word in NOT_OURS):
                    yield from ((at + 2 + found.start(), found[0]) for found in NUMBER.finditer(cell))


class Documents(unittest.TestCase):
    def test_each_number_is_in_the_file_that_is_named(self):
        for name in DOCUMENTS:
            text = (SOURCE / name).read_text()
            self.assertEqual(list(faults(text, (SOURCE / name).parent)), [], name)

    def test_a_wrong_number_is_found_wherever_it_is_planted(self):
        tried = 0
        for name in DOCUMENTS:
            text, folder = (SOURCE / name).read_text(), (SOURCE / name).parent
            found = list(held(text))
            missed = [number for at, number in found if not list(faults(planted(text, at, number), folder))]
            tried += len(found)
            # One digit may make another number of the row.
            self.assertLessEqual(len(missed), 0.1 * len(found), f"{name}: {missed}")
        self.assertGreater(tried, 150)

    def test_a_wrong_number_in_a_sentence_is_found(self):
        folder = RESULTS / "h200"
        mean = f"{float(next(iter(contents.rows_of(folder / 'whole_runs.csv')))['mean [ms]']):.3g}"
        words = f"It takes {mean} ms in `twist` ([rows](whole_runs.csv)).\n"
        self.assertEqual(list(faults(words, folder)), [])
        self.assertEqual([found[2] for found in faults(words.replace(mean, "98.76"), folder)], ["98.76"])

    def test_generated_tables_are_those_of_the_files_and_a_wrong_number_in_them_is_found(self):
        for path in page_tables.DOCUMENTS:
            text = path.read_text()
            self.assertEqual(page_tables.rewritten(path, text), text, path)
            at = re.search(r"<!-- table .*?\| (\d[\d.,e-]*) \|", text, re.S)
            wrong = planted(text, at.start(1), at[1])
            self.assertNotEqual(wrong, text, path)
            self.assertEqual(page_tables.rewritten(path, wrong), text, path)

    def test_each_table_that_is_listed_has_its_place(self):
        studies = [path.stem for path in (SOURCE / "paper_figures/figures/ablations").glob("*.yaml")]
        listed = {page_tables.README: list(headline.PARTS),
                  **{(RESULTS / name).resolve(): list(tables) for name, tables in page_tables.LISTED.items()}}
        listed[page_tables.ROOM / "ablations.md"] += studies
        for path, names in listed.items():
            self.assertEqual(sorted(page_tables.PLACE.findall(path.read_text())), sorted(names), path)

    def test_a_row_that_no_file_has_is_refused(self):
        listed = dict(page_tables.LISTED["h200/README.md"]["quality"], rows=["knot, ball, 1"])
        self.assertRaises(KeyError, page_tables.table, listed, RESULTS / "h200")

    def test_readme_counts_the_papers_claims_apart_and_says_how_many_files_are_old(self):
        """By another way than the one that writes it: the kept verdicts, and each file's commit asked of git."""
        text = (SOURCE / "README.md").read_text()
        rows = [row for row in rows_of(verdicts.KEPT) if row["kind"] == "result"]
        for of, name in (("paper", "the paper's own"), ("study", "our studies'")):
            mine = [row for row in rows if row["of"] == of]
            count = lambda verdict: sum(row["verdict"] == verdict for row in mine)  # noqa: E731
            late = sum(row["verdict"] == "reproduced" and row["band set after a run"] == "yes" for row in mine)
            self.assertIn(f"| {name} | {len(mine)} | {count('reproduced')} ({late}) | {count('refuted')} | "
                          f"{count('not comparable')} | {count('not yet run')} |", text)
        there = sum(len(rows_of(path)) for path in RESULTS.glob("*/provenance.csv") if path.parent.name != "tried")
        self.assertRegex(text, rf"\n\d+ of {there} accepted files are of \[other sources\]")

    def test_where_there_is_no_repository_the_count_of_old_files_stays(self):
        text, path = (SOURCE / "README.md").read_text(), page_tables.README
        with mock.patch.object(contents, "in_words", side_effect=contents.ContentsError("none")):
            self.assertEqual(page_tables.rewritten(path, text), text)

    def test_readme_is_read_in_four_minutes(self):
        self.assertLessEqual(len((SOURCE / "README.md").read_text().split()), 1100)

    def test_the_table_of_whole_runs_is_computed_from_the_runs_that_are_kept(self):
        for path in RESULTS.glob("*/whole_runs.csv"):
            self.assertEqual(whole_runs.table(path.parent), path.read_text(), path.parent.name)


def planted(text, at, number):
    """The text with the last digit of the number's mantissa changed."""
    mantissa = re.match(r"[-\d,.]+", number)[0]
    last = at + len(mantissa) - 1
    return text[:last] + str((int(text[last]) + 3) % 10) + text[last + 1:]


class Parts(unittest.TestCase):
    def test_numbers_as_printed(self):
        for text, value, half in (("1,921", 1921, "0.5"), ("0.93", "0.93", "0.005"), ("2·10⁻¹²", "2e-12", "5e-13"),
                                  ("9.2e-5", "9.2e-5", "5e-7")):
            self.assertEqual(printed(text), (Decimal(value), Decimal(half)))
        self.assertEqual(NUMBER.findall("10⁵ contacts take 3.3 ms, γ_e = 0, 1/60 s"), ["3.3", "0"])

    def test_numbers_of_a_cell(self):
        self.assertEqual(numbers("0: 15.81; 2400: 88.3; a 5e-07"),
                         [Decimal(x) for x in ("0", "15.81", "2400", "88.3", "5e-07")])

    def test_cells_of_generated_tables(self):
        for texts, printed_as in ((["0.0012345"], "0.00123"), (["2", "10", "nan", ""], "2 to 10"), (["3", "3.0"], "3"),
                                  (["yes", "no", "yes"], "yes or no"), (["inf"], "–")):
            self.assertEqual(page_tables.cell(texts), printed_as)
        self.assertEqual(page_tables.name_of({"a": "vbd", "b": "20.0", "c": "1921", "d": ""}, "abcd"), "vbd, 20, 1921")


if __name__ == "__main__":
    unittest.main()
