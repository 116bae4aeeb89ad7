"""Writes the tables of documents: README's counts of claims and times, the table of an ablation (`ablation_tables.py`),
and chosen rows and columns of accepted files. A document marks the place of each by `<!-- table NAME -->` and
`<!-- end -->`.

results/tables.json lists the last kind by document and name: `files`; `where`, what cells of a row must be; `label`,
the columns whose cells name a row; `rows`, the names in their order, or all; `columns`, the titles with their columns;
`given`, a column of numbers that no file has, as floors. Where several rows have one name, a cell prints their range.

Usage: python3 -m paper_figures.workflow.page_tables [--write]: checks whether the tables of all documents are those of
the files, with exit status 1 if they are not, or writes them. The standard library is enough.
"""

import argparse
import csv
import json
import re
import sys

from paper_figures.workflow import ablation_tables, headline
from paper_figures.workflow.evidence import RESULTS, ROOM, opened

LISTED = json.loads((RESULTS / "tables.json").read_text())
README = ROOM.parent / "README.md"
OF_RESULTS = {(RESULTS / name).resolve(): tables for name, tables in LISTED.items()}
DOCUMENTS = [README, *OF_RESULTS]  # ablations.md among them
PLACE = re.compile(r"<!-- table (\w+) -->\n.*?<!-- end -->", re.S)
NOTHING = ("", "nan", "inf")


def name_of(row, label):
    """Returns the cells of a row that name it; a whole number has no decimals, another has four digits."""
    cells = [row[column] for column in label]
    return ", ".join(f"{float(cell):.4g}" if re.fullmatch(r"\d+\.\d+", cell) else cell for cell in cells if cell)


def cell(texts):
    """Returns the number or word that the texts share, or the range of their numbers."""
    texts = [text for text in texts if text not in NOTHING]
    try:
        numbers = sorted(float(text) for text in texts)
    except ValueError:
        return " or ".join(dict.fromkeys(texts))
    ends = dict.fromkeys(ablation_tables.rounded(number) for number in numbers[:1] + numbers[-1:])
    return " to ".join(ends) or "–"


def chosen(listed, folder):
    """Returns name -> rows of the files that a listed table chooses, in its order."""
    named = {}
    for file_name in listed["files"]:
        with opened(folder / file_name) as file:
            for row in csv.DictReader(file):
                if all(row[column] == value for column, value in listed.get("where", {}).items()):
                    named.setdefault(name_of(row, listed["label"]), []).append(row)
    return {name: named[name] for name in listed.get("rows", named)}


def table(listed, folder):
    """Returns the lines in Markdown of a table that tables.json lists."""
    columns, given = listed["columns"], listed.get("given", {})
    lines = [f"| {' | '.join([listed['title'], *given, *columns])} |", "|---" * (1 + len(given) + len(columns)) + "|"]
    return lines + [f"| {' | '.join([name, *(numbers[name] for numbers in given.values()), *of_files])} |"
                    for name, rows in chosen(listed, folder).items()
                    for of_files in [[cell([row[column] for row in rows]) for column in columns.values()]]]


def rewritten(path, text):
    """Returns the text of a document with its tables rebuilt."""
    listed = OF_RESULTS.get(path.resolve(), {})

    def made(place):
        name = place[1]
        if path == README:
            return f"<!-- table {name} -->\n\n" + headline.PARTS[name](place[0]) + "\n\n<!-- end -->"
        lines = table(listed[name], path.parent) if name in listed else ablation_tables.table(name)
        return f"<!-- table {name} -->\n\n" + "\n".join(lines) + "\n\n<!-- end -->"

    return PLACE.sub(made, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write them into the documents")
    options = parser.parse_args()
    for path in DOCUMENTS:
        before = path.read_text()
        after = rewritten(path, before)
        if options.write:
            path.write_text(after)
        elif after != before:
            sys.exit(f"{path.relative_to(ROOM.parent)}: its tables are not those of the files: write them with --write")


if __name__ == "__main__":
    main()
