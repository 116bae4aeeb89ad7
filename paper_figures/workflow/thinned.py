"""Thins the rows of a long run for results: of each hundred steps it keeps the last row, and mean, smallest, median and
largest of every column (`X_hundreds.csv`), with the statistics of the whole run, computed from every row, in its
manifest (`whole_run`). Short runs keep every row.

A statistic of the first N steps is available if N is a multiple of a hundred, or the whole run.
"""

import csv
import io
import math
import statistics

from ogc_testbed.columns import FORMER_COLUMNS, column_and_unit

BLOCK = 100  # steps
LONGEST = 200  # rows; longer runs are thinned
QUANTITIES = ("row", "mean", "smallest", "median", "largest")
HEAD = ("of", "rows [1]")  # columns before those of steps.csv: one of QUANTITIES, and the number of rows


def is_long(text):
    """Returns whether the rows (the text of steps.csv) are more than results keep."""
    return text.count("\n") > LONGEST + 1


def parsed(text):
    """Returns (titles, rows as texts) of steps.csv; a truncated row is left out."""
    titles, *rows = [row for row in csv.reader(io.StringIO(text)) if row]
    return titles, [row for row in rows if len(row) == len(titles)]


def hundreds(text):
    """Returns the text of X_hundreds.csv for the text of steps.csv."""
    titles, rows = parsed(text)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*HEAD, *titles])
    for begin in range(0, len(rows), BLOCK):
        block = rows[begin:begin + BLOCK]
        columns = [_quantities([float(cell or "nan") for cell in column]) for column in zip(*block)]
        for name, values in zip(QUANTITIES, [block[-1], *zip(*columns)]):
            writer.writerow([name, len(block), *values])
    return out.getvalue()


def _quantities(values):
    """Returns mean, smallest, median and largest as texts, with the nine digits that distinguish numbers of single
    precision."""
    if any(map(math.isnan, values)):
        return ("nan",) * 4
    found = (statistics.fmean(values), min(values), statistics.median(values), max(values))
    return tuple(f"{value:.9g}" for value in found)


def whole_run(text):
    """Returns statistics of all rows, and the program that computed them, for the manifest."""
    titles, rows = parsed(text)
    columns = {column_and_unit(name)[0]: [float(cell or "nan") for cell in column]
               for name, column in zip(titles, zip(*rows))}
    known = {name: values for name, values in columns.items() if not any(map(math.isnan, values))}
    return {"program": "paper_figures.workflow.thinned", "rows": len(rows),
            "mean": {name: statistics.fmean(values) for name, values in known.items()},
            "largest": {name: max(values) for name, values in known.items()}}


def _by_name_of_today(values):
    return {FORMER_COLUMNS.get(name, name): value for name, value in values.items()}


class Hundreds:
    """Holds statistics of the first `steps` steps of a thinned run, by the names of columns without their units. Throws
    ValueError if `steps` ends between two hundreds, KeyError if no column of that name is kept."""

    def __init__(self, columns, whole, steps=None):
        """Reads `columns`, those of X_hundreds.csv, as texts by name, and `whole`, the manifest's `whole_run`."""
        self._columns, self._whole = columns, {"rows": whole["rows"], **{kind: _by_name_of_today(whole[kind])
                                                                         for kind in ("mean", "largest")}}
        self.count = whole["rows"] if steps is None else min(steps, whole["rows"])
        if self.count % BLOCK and self.count != whole["rows"]:
            raise ValueError(f"the first {steps} steps end between two hundreds; every row is not kept")

    def first(self, steps):
        return Hundreds(self._columns, self._whole, steps)

    def __contains__(self, name):
        return name in self._columns and name not in ("of", "rows")

    def of(self, quantity, name):
        """Returns this quantity (one of QUANTITIES) of the column, a number for each hundred steps."""
        cells = [(kind, cell) for kind, cell in zip(self._columns["of"], self._columns[name]) if kind == quantity]
        return [float(cell or "nan") for _, cell in cells[:math.ceil(self.count / BLOCK)]]

    def of_rows(self):
        """Returns the number of rows of each hundred; the last may have fewer."""
        return [int(n) for kind, n in zip(self._columns["of"], self._columns["rows"]) if kind == QUANTITIES[0]]

    def mean(self, name):
        if self.count == self._whole["rows"]:
            return self._whole["mean"].get(name, math.nan)
        return statistics.fmean(self.of("mean", name))  # of whole hundreds

    def largest(self, name):
        if self.count == self._whole["rows"]:
            return self._whole["largest"].get(name, math.nan)
        return max(self.of("largest", name))
