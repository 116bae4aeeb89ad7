"""Titles of columns in steps.csv and iterations.csv."""

# Columns that run format 1 calls otherwise.
FORMER_COLUMNS = {"vertices_at_bound": "vertices_cut", "share_at_bound": "share_cut"}


def column_and_unit(title):
    """("wall", "ms") of the title "wall [ms]"; a column of run format 1 by its name of today."""
    name, _, unit = title.partition("[")
    name = name.strip()
    return FORMER_COLUMNS.get(name, name), unit.rstrip("] ").strip()
