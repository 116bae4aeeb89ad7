"""The captions of kept pictures: results/MACHINE/captions.csv has for each its title, a text for readers who don't see
it, and its source (commands and commit). A figure's script writes them beside the picture (plots/style.py)."""

import csv
import json

TABLE, COLUMNS = "captions.csv", ("file", "title", "alt", "source")


def rows_of(folder):
    """Returns file -> row of a folder of results."""
    path = folder / TABLE
    if not path.is_file():
        return {}
    with path.open(newline="", encoding="utf-8") as file:
        return {row["file"]: row for row in csv.DictReader(file)}


def alt_of(path):
    """Returns the text of a kept picture; its name if there is none."""
    return rows_of(path.parent).get(path.name, {}).get("alt", path.stem)


def keep(folder, drawn, outdated=()):
    """Keeps the captions of pictures, and drops those of `outdated`. `drawn`: name of the kept file -> the picture that
    the script wrote, beside which its caption lies; without one nothing changes."""
    from plots.style import CAPTION  # imported here, because it needs matplotlib

    rows = {name: row for name, row in rows_of(folder).items() if name not in outdated}
    for name, path in drawn.items():
        caption = path.with_suffix(CAPTION)
        if caption.is_file() and not name.endswith(".mp4"):
            rows[name] = {"file": name, **json.loads(caption.read_text(encoding="utf-8"))}
    if rows:
        write(folder, rows)


def write(folder, rows):
    with (folder / TABLE).open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[name] for name in sorted(rows))
