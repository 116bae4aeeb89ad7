"""Sorts recipes and accepted pictures into the site's figures: those of the paper, the studies, Table 1, and what the
paper does not have. A picture belongs to the figure whose name its own begins with, so a new one appears by itself."""

import re
from dataclasses import dataclass

from paper_figures.site.claims import command
from paper_figures.site.files import MOVIE, PICTURES
from paper_figures.workflow import recipes
from paper_figures.workflow.evidence import RESULTS

SCALES = ("paper", "small", "smoke")  # the largest first
PAPER_ORDER = [f"fig{number:02d}" for number in range(1, 23)]
TABLE, PEERS = "table1", "peers"


@dataclass(frozen=True)
class Making:
    """Holds one way to make a figure: command, measured time and machine; empty where nobody measured it."""

    command: str
    time: str
    machine: str


@dataclass(frozen=True)
class Figure:
    """Holds a figure: its recipes, its accepted pictures (the paper's size first) and movies as paths."""

    name: str
    recipes: tuple
    pictures: tuple
    movies: tuple

    @property
    def label(self):
        found = re.fullmatch(r"fig(\d+)", self.name)
        return f"Fig. {int(found[1])}" if found else "Table 1" if self.name == TABLE else ""

    @property
    def title(self):
        return self.recipes[0].title.removesuffix(" (not in the paper)") if self.recipes else self.name

    @property
    def is_study(self):
        return any("study" in recipe.body for recipe in self.recipes)

    @property
    def scenes(self):
        return sorted({recipe.scene for recipe in self.recipes} - {""})

    @property
    def missing(self):
        return [recipe.body["missing"] for recipe in self.recipes if "missing" in recipe.body]

    @property
    def is_drawing(self):
        return bool(self.recipes) and all("illustration" in recipe.body for recipe in self.recipes)

    def makings(self):
        """Returns every way in which the figure was timed, and the way to the paper's size if it was not."""
        times = recipes.measured_times()
        for recipe in (recipe for recipe in self.recipes if "missing" not in recipe.body):
            drawn = "illustration" in recipe.body
            timed = {(scale, backend): times[recipe.name, scale, backend] for name, scale, backend in times
                     if name == recipe.name}
            largest = ("-", "-") if drawn else ("paper", recipe.backends[-1])
            for scale, backend in sorted({*timed, largest}, key=lambda way: (way[0] == "paper", way)):
                seconds, machine = timed.get((scale, backend), (None, ""))
                yield Making(command(recipe, scale, backend), recipes.in_words(seconds) if machine else "", machine)


def numbered(text):
    """Returns fig02 for fig02_x and fig2 alike."""
    found = re.match(r"fig(\d+)", text)
    return f"fig{int(found[1]):02d}" if found else text


def scale_of(path):
    """Returns the place of a picture's scale in SCALES; what has none comes last."""
    return next((place for place, scale in enumerate(SCALES) if path.stem.endswith(f"_{scale}")), len(SCALES))


def owner(path, names):
    """Returns the name among `names` that a picture's own begins with, the longest; its own if there is none."""
    stem = numbered(path.stem)
    mine = [name for name in names if stem == name or stem.startswith(f"{name}_")]
    return max(mine, key=len, default=re.sub(r"_(paper|small|smoke)$", "", stem))


def all_figures(book=None, folder=RESULTS):
    """Returns name -> Figure: of the paper in its order, then the others by name."""
    book = recipes.load() if book is None else book
    mine = {}
    for recipe in book.values():
        mine.setdefault(numbered(recipe.name), []).append(recipe)
    pictures, movies = {}, {}
    for path in sorted(folder.rglob("*"), key=lambda path: (scale_of(path), path.name, path.parent.name)):
        if path.suffix in (*PICTURES, MOVIE):
            of = movies if path.suffix == MOVIE else pictures
            of.setdefault(owner(path, {*mine, *PAPER_ORDER, PEERS}), []).append(path)
    names = {*mine, *pictures, *movies, *PAPER_ORDER}
    order = [*PAPER_ORDER, *sorted(names - set(PAPER_ORDER))]
    return {name: Figure(name, tuple(mine.get(name, ())), tuple(pictures.get(name, ())), tuple(movies.get(name, ())))
            for name in order}
