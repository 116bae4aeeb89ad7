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


def kept(path):
    """Returns the caption of a kept picture; that of a movie is its picture's. Empty if there is none."""
    rows = rows_of(path.parent)
    return next((rows[name] for name in (path.name, f"{path.stem}.webp", f"{path.stem}.png") if name in rows), {})


def just_made(path):
    """Returns the caption that a script wrote beside a picture; that of a movie is its picture's. Empty if there is
    none."""
    from plots.style import CAPTION  # imported here, because it needs matplotlib

    caption = path.with_suffix(CAPTION)
    return json.loads(caption.read_text(encoding="utf-8")) if caption.is_file() else {}


def keep(folder, drawn, outdated=()):
    """Keeps the captions of pictures, and drops those of `outdated`. `drawn`: name of the kept file -> the picture that
    the script wrote, beside which its caption lies; without one nothing changes."""
    rows = {name: row for name, row in rows_of(folder).items() if name not in outdated}
    for name, path in drawn.items():
        caption = just_made(path)
        if caption and not name.endswith(".mp4"):
            rows[name] = {"file": name, **caption}
    if rows:
        write(folder, rows)


def write(folder, rows):
    with (folder / TABLE).open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[name] for name in sorted(rows))
