"""Copies into the site what its pages show: pictures, movies, small pictures for cards, and the files of results that
claims name; so that the folder is whole and can be sent. A file is copied once, when a page first asks for it."""

import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from paper_figures.workflow import captions
from paper_figures.workflow.evidence import RESULTS

PICTURES, MOVIE = (".png", ".webp"), ".mp4"
CARD = (720, 480)  # pixels of a small picture


@dataclass(frozen=True)
class Picture:
    """Holds a picture or a movie of the site. `path`: of the original; `src` and `card`: files below the site."""

    path: Path
    src: str
    width: int
    height: int
    title: str
    alt: str
    source: str
    card: str = ""

    @property
    def is_movie(self):
        return self.src.endswith(MOVIE)


def window(image, high):
    """Returns the first row of the part of a picture, so many rows high, that has most colour: the subject, since
    curves and texts have little."""
    pixels = np.asarray(image.convert("RGB").reduce(4), int)
    colour = (pixels.max(axis=2) - pixels.min(axis=2) > 60).sum(axis=1)
    rows = min(high // 4, len(colour))
    sums = np.convolve(colour, np.ones(rows, int), "valid")
    return 4 * int(sums.argmax())


def card_of(path, out):
    """Writes the small picture of a card."""
    with Image.open(path) as image:
        image = image.convert("RGB")
    high = round(image.width * CARD[1] / CARD[0])
    if high < image.height:
        top = min(window(image, high), image.height - high)
        image = image.crop((0, top, image.width, top + high))
    image.thumbnail(CARD, Image.LANCZOS)
    out.parent.mkdir(parents=True, exist_ok=True)
    image.save(out, quality=82)


class Files:
    """Copies files to a site at `out`."""

    def __init__(self, out):
        self.out, self.copied = Path(out), set()

    def copy(self, path, to):
        """Copies a file to a place below the site, and returns that."""
        if to not in self.copied:
            (self.out / to).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, self.out / to)
            self.copied.add(to)
        return to

    def result(self, path):
        """Copies a file of the accepted results."""
        return self.copy(path, f"files/{path.relative_to(RESULTS).as_posix()}")

    def picture(self, path, new=False):
        """Copies a picture, with a small one for cards, or a movie; `new`: of a run just made."""
        to = f"media/{'new/' if new else ''}{path.parent.name}/{path.name}"
        caption = captions.just_made(path) if new else captions.kept(path)
        width = height = 0
        if path.suffix != MOVIE:
            with Image.open(path) as image:
                width, height = image.size
        small = f"{to.rpartition('.')[0]}_card.webp" if path.suffix != MOVIE else ""
        if small and small not in self.copied:
            card_of(path, self.out / small)
            self.copied.add(small)
        title = caption.get("title") or path.stem
        return Picture(path, self.copy(path, to), width, height, title, caption.get("alt") or title,
                       caption.get("source", ""), small)
