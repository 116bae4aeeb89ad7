"""The report: a site of static files that a browser opens from disk, from index.html. It has a page for each figure of
the paper and for each scene, and one each for Table 1, all claims, ablations, the judge, other people's programs, what
the paper does not have, deviations, and each machine. It needs neither a network nor, to be read, JavaScript; pictures
and cited files lie in its folder, so that it can be zipped and sent.

It is generated from claims, accepted results, captions and recipes, and never edited: its verdicts are those of
verdicts.py, which a test checks. New runs are shown beside the accepted ones: their numbers, judged if they have the
size that the claim needs, their pictures and their curves. Templates and styles are in paper_figures/site.
"""

import argparse
import shutil
import subprocess
import sys
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import jinja2

from paper_figures.site import claims as words
from paper_figures.site import curves, figures, tables
from paper_figures.site.documents import Documents, documents_of_site
from paper_figures.site.files import MOVIE, Files
from paper_figures.site.origins import Origins, seconds_between
from paper_figures.workflow import recipes, verdicts
from paper_figures.workflow.contents import TRIED
from paper_figures.workflow.evidence import MEMBRANES, RESULTS, ROOM, Evidence, EvidenceError, command_of
from plots.progress import Progress

SITE = ROOM / "site"
OUT = ROOM / "report"
PAGES = {"index.html": "Figures", "table1.html": "Table 1", "claims.html": "Claims", "ablations.html": "Ablations",
         "judge.html": "Judge", "peers.html": "Other programs", "more.html": "Beyond the paper",
         "scenes.html": "Scenes", "deviations.html": "Deviations"}
ASSETS = ("style.css", "extras.js")
MARK = "made-by-report"  # a file in the site's folder: only such a folder is emptied


class ReportError(Exception):
    """Raised for a folder that the site may not replace; the message says what to do."""


@dataclass(frozen=True)
class JustMade:
    """Holds the run folders of the workflow, and the scale and backend of the call."""

    folder: Path
    scale: str
    backend: str
    evidence: Evidence

    def made(self, recipe):
        """Returns the picture and the movie of a figure, those that exist."""
        paths = (self.folder / path for path in recipe.outputs(self.scale, self.backend))
        return [path for path in paths if path.suffix in (".png", MOVIE) and path.is_file()]

    def about(self, claim):
        """Returns in words what these runs show about a claim; empty if nothing."""
        if "measure" not in claim:
            return ""
        judged = verdicts.judge(claim, self.evidence)
        if judged.measured:
            return f"{words.number(judged.measured.value, claim['unit'])}, {judged.verdict}"
        found = verdicts.at_another_scale(claim, self.evidence, self.scale)
        return f"{words.number(found.value, claim['unit'])} at {self.scale}, not judged" if found else ""


@dataclass(frozen=True)
class Run:
    """Holds a run as a scene's page shows it."""

    source: str
    manifest: dict
    steps: int
    membranes: str
    audit: str
    time: str
    curves: tuple
    is_new: bool

    @property
    def bounds(self):
        """Returns the bounds in words, empty for solvers that have none."""
        settings = self.manifest["settings"]
        return {"ball": "balls"}.get(settings["bounds"]["value"], settings["bounds"]["value"]) \
            if self.manifest["solver"] == "vbd" and "bounds" in settings else ""


def audit_in_words(run):
    ways = "" if run.is_certified else "; the ways between them were not looked at"
    return {True: f"exact audit of {run.audited_states:,} states: no intersection{ways}",
            False: "the exact audit failed", None: "not audited"}[run.guarantee_kept]


def commit_of_sources():
    """Returns the commit of the sources, empty outside a repository."""
    asked = ["git", "-C", str(recipes.ROOT), "rev-parse", "--short=10", "HEAD"]
    try:
        return subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def templates():
    """Returns the environment of the templates; a name that a template misspells is an error."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(SITE / "templates"), autoescape=True,
                                     undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    environment.filters.update(slug=words.slug, command=command_of)
    return environment


class Site:
    """Collects what the pages show, and writes them to a folder."""

    def __init__(self, out, evidence=None, fresh=None):
        self.out, self.fresh = Path(out), fresh
        self.evidence = evidence or Evidence()
        self.book, self.files = recipes.load(), Files(out)
        self.origins = Origins(self.evidence.runs)
        self.claims = words.all_claims(verdicts.judge_all(self.evidence), self.origins, self.book, fresh)
        self.figures = figures.all_figures(self.book)
        self.documents = Documents(self.files, documents_of_site())
        self.drawing = curves.Drawing()
        self.environment = templates()
        shown = {run.manifest["scene"]["name"] for run in self.runs} | {r.scene for r in self.book.values()} - {""}
        self.scenes = sorted(shown)
        self.environment.globals.update(
            pages=PAGES, commit=commit_of_sources(), meaning=words.MEANING, number=words.number, fresh=fresh,
            scenes=set(self.scenes), machine=self.origins.title_of_machine, figure_page=self.figure_page,
            result=lambda name: self.files.result(RESULTS / name))

    @property
    def runs(self):
        return [*(self.fresh.evidence.runs if self.fresh else ()), *self.evidence.runs]

    def figure_page(self, name):
        """Returns the page, and the place in it, that shows a figure or a study."""
        if name in figures.PAPER_ORDER:
            return f"figures/{name}.html"
        if name in (figures.TABLE, figures.PEERS):
            return f"{name}.html"
        return f"{'ablations' if self.figures[name].is_study else 'more'}.html#{name}"

    def shown(self, figure):
        """Returns the pictures of a figure: accepted ones, then those just made."""
        made = [(recipe, path) for recipe in figure.recipes for path in (self.fresh.made(recipe) if self.fresh else ())]
        return {"pictures": [self.files.picture(path) for path in figure.pictures],
                "movies": [self.files.picture(path) for path in figure.movies],
                "new": [self.files.picture(path, new=True) for _, path in made]}

    def claims_of(self, *names):
        return [claim for claim in self.claims if claim.figure in names]

    def provenance(self, picture):
        """Returns the origin of an accepted picture; None for one that was just made."""
        return self.origins.of_file(picture.path.relative_to(RESULTS).as_posix()) \
            if picture.path.is_relative_to(RESULTS) else None

    def parts(self):
        """Returns path below the site -> function that returns the page's text."""
        parts = {"claims.html": self.all_claims, "table1.html": self.table1,
                 "ablations.html": self.ablations, "judge.html": self.judge, "peers.html": self.peers,
                 "more.html": self.more, "scenes.html": self.list_of_scenes, "deviations.html": self.deviations}
        parts |= {f"{path.parent.name}.html": partial(self.machine, path) for path in RESULTS.glob("*/README.md")}
        parts |= {f"figures/{name}.html": partial(self.figure, name) for name in figures.PAPER_ORDER}
        parts |= {f"scenes/{name}.html": partial(self.scene, name) for name in self.scenes}
        return parts | {"index.html": self.index}

    def render(self, template, path, **values):
        up = "../" * path.count("/")
        return self.environment.get_template(template).render(path=path, up=up, provenance=self.provenance, **values)

    def index(self):
        cards = [(figure, self.shown(figure), self.claims_of(figure.name))
                 for figure in self.figures.values() if figure.name != figures.PEERS]
        paper = [card for card in cards if card[0].name in figures.PAPER_ORDER or card[0].name == figures.TABLE]
        studies = [card for card in cards if card[0].is_study]
        others = [card for card in cards if card not in paper and card not in studies]
        return self.render("index.html", "index.html", counts=words.summary(self.claims), paper=paper, studies=studies,
                           others=others, verdicts=verdicts.VERDICTS)

    def all_claims(self):
        groups = [(name, [claim for claim in self.claims if claim.is_result and claim.verdict == name])
                  for name in verdicts.VERDICTS]
        settings = [claim for claim in self.claims if not claim.is_result]
        return self.render("claims.html", "claims.html", groups=groups, settings=settings)

    def figure(self, name):
        figure, order = self.figures[name], figures.PAPER_ORDER
        place = order.index(name)
        scenes = sorted({*figure.scenes, *(claim.about["scene"] for claim in self.claims_of(name))} & set(self.scenes))
        return self.render("figure.html", f"figures/{name}.html", figure=figure, shown=self.shown(figure),
                           claims=self.claims_of(name), scenes=scenes,
                           before=order[place - 1] if place else None,
                           after=order[place + 1] if place + 1 < len(order) else None)

    def table1(self):
        figure = self.figures[figures.TABLE]
        here = [claim for claim in self.claims if figures.TABLE in claim.about["figures"]]
        (recipe,) = figure.recipes
        made = self.fresh and self.fresh.folder / recipe.picture(self.fresh.scale, self.fresh.backend)
        new = self.table(tables.just_made(made)) if made and made.is_file() else None
        return self.render("table1.html", "table1.html", figure=figure, table=self.table(tables.paper_table()), new=new,
                           shown=self.shown(figure), claims=self.claims_of(figures.TABLE), all=here)

    def table(self, table):
        """Returns a table with the places of its files in the site."""
        return table, [(path.relative_to(RESULTS).as_posix(), self.files.result(path))
                       if path.is_relative_to(RESULTS) else (path.name, self.files.copy(path, f"files/new/{path.name}"))
                       for path in table.files]

    def studies(self):
        return {figure.name: (figure, self.shown(figure), self.claims_of(figure.name))
                for figure in self.figures.values() if figure.is_study}

    def ablations(self):
        sections = self.documents.sections(ROOM / "ablations.md")
        studies = self.studies()
        named = [(section, next((studies[name] for name in studies if f"<code>{name}</code>" in section.title), None))
                 for section in sections]
        found = {study[0].name for _, study in named if study}
        return self.render("ablations.html", "ablations.html", sections=named,
                           without=[study for name, study in studies.items() if name not in found])

    def judge(self):
        on_gpu = tables.judged(tables.GPU / "judge_cuda.csv", "the GPU")
        on_processor = tables.judged(tables.CORES / "judge_cpu.csv", "processors")
        return self.render("judge.html", "judge.html", on_gpu=self.table(on_gpu),
                           on_processor=self.table(on_processor), agreement=self.table(tables.agreement()))

    def peers(self):
        found = [self.table(make()) for make in (tables.peers_kernels, tables.peers_sets, tables.peers_scenes)]
        sections = self.documents.sections(recipes.ROOT / "experiments/peers/README.md")
        return self.render("peers.html", "peers.html", tables=found, sections=sections,
                           shown=self.shown(self.figures[figures.PEERS]))

    def more(self):
        found = [(figure, self.shown(figure), self.claims_of(figure.name)) for figure in self.figures.values()
                 if not figure.is_study and figure.name not in (*figures.PAPER_ORDER, figures.TABLE, figures.PEERS)]
        return self.render("more.html", "more.html", figures=found)

    def deviations(self):
        path = recipes.ROOT / "compare/deviations.md"
        return self.render("document.html", "deviations.html", sections=self.documents.sections(path),
                           title="Deviations from the paper, and its errata", name="compare/deviations.md")

    def machine(self, path):
        name = path.parent.name
        title = self.origins.title_of_machine(name)
        return self.render("document.html", f"{name}.html", sections=self.documents.sections(path),
                           title=title if name == TRIED else f"Results on {title}",
                           name=path.relative_to(recipes.ROOT).as_posix())

    def runs_of(self, scene):
        """Returns the runs of a scene: new ones first, then the latest accepted."""
        mine = [run for run in self.runs if run.manifest["scene"]["name"] == scene]
        made = set(map(id, self.fresh.evidence.runs)) if self.fresh else set()
        return sorted(mine, key=lambda run: (id(run) in made, run.manifest["ended"]), reverse=True)

    def list_of_scenes(self):
        rows = []
        for name in self.scenes:
            runs = self.runs_of(name)
            shown = [figure for figure in self.figures.values() if name in figure.scenes]
            vertices = sorted({run.manifest["scene"]["vertices"] for run in runs})
            rows.append((name, runs, shown, vertices))
        return self.render("scenes.html", "scenes.html", rows=rows)

    def scene(self, name):
        made = set(map(id, self.fresh.evidence.runs)) if self.fresh else set()
        found = []
        for number, run in enumerate(self.runs_of(name)):
            seconds = seconds_between(run.manifest)
            drawn = self.drawing.draw(run, f"media/curves/{name}_{number}", self.out) if curves.are_drawn(run) else ()
            membranes = " and ".join(MEMBRANES.get(name, name) for name in sorted(run.membranes))
            found.append(Run(run.source, run.manifest, run.step_count, membranes, audit_in_words(run),
                             "" if seconds is None else recipes.in_words(seconds), tuple(drawn), id(run) in made))
        shown = [figure for figure in self.figures.values() if name in figure.scenes]
        return self.render("scene.html", f"scenes/{name}.html", scene=name, runs=found, figures=shown,
                           claims=[claim for claim in self.claims if claim.about["scene"] == name])

    def write(self, progress):
        """Writes all pages; returns their paths."""
        prepare(self.out)
        for name in ASSETS:
            self.files.copy(SITE / name, f"assets/{name}")
        parts, written = self.parts(), []
        for done, (path, make) in enumerate(parts.items()):
            progress(done, len(parts))
            to = self.out / path
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_text(make(), encoding="utf-8")
            written.append(to)
        progress(len(parts), len(parts))
        return written


def prepare(folder):
    """Empties the folder of an earlier site. Throws ReportError for a folder with other content."""
    if folder.is_dir() and any(folder.iterdir()) and folder != OUT and not (folder / MARK).is_file():
        raise ReportError(f"{folder} holds files that no report wrote: choose an empty folder with --out")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / MARK).write_text("paper_figures/workflow/report.py makes this folder, and empties it before.\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", default=OUT, type=Path, metavar="FOLDER",
                        help="folder of the site; an earlier site in it is replaced (default: paper_figures/report)")
    parser.add_argument("--runs", type=Path, metavar="FOLDER",
                        help="run folders just made, to stand beside the accepted")
    parser.add_argument("--scale", default="small", choices=recipes.SCALES, help="of these runs")
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"), help="of these runs")
    options = parser.parse_args()
    progress = Progress("page")
    try:
        runs = options.runs and options.runs.resolve()
        fresh = JustMade(runs, options.scale, options.backend, Evidence(runs, changed=True)) if runs else None
        pages = Site(options.out, fresh=fresh).write(progress)
    except (EvidenceError, recipes.RecipeError, ReportError) as error:
        sys.exit(f"report: {error}")
    finally:
        progress.end()
    files = [path for path in options.out.rglob("*") if path.is_file()]
    print(f"Open {options.out.resolve() / 'index.html'} in a browser: {len(pages)} pages, {len(files)} files, "
          f"{sum(path.stat().st_size for path in files) / 2**20:.1f} MiB")


if __name__ == "__main__":
    main()
