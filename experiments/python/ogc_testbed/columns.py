"""Names columns by their titles in steps.csv and iterations.csv."""

# Columns that have other names in run format 1.
FORMER_COLUMNS = {"vertices_at_bound": "vertices_cut", "share_at_bound": "share_cut"}


def column_and_unit(title):
    """Returns ("wall", "ms") for the title "wall [ms]". A column of run format 1 gets its current name."""
    name, _, unit = title.partition("[")
    name = name.strip()
    return FORMER_COLUMNS.get(name, name), unit.rstrip("] ").strip()
