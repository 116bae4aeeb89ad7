"""Makes the report's site, and checks it as a reader would without a browser: its verdicts are those of the claims, its
first page counts them, every link and every file resolves inside the folder, every picture has a text, every kept
picture and movie is shown. browser.sh opens the same pages in a browser.

Usage: report.py SOURCE_DIR. Exit status 77: skipped, matplotlib or another package is missing.
"""

import csv
import functools
import hashlib
import json
import re
import subprocess
import sys
import tempfile
import unittest
from datetime import datetime
from html.parser import HTMLParser
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import jinja2  # noqa: F401
    import markdown_it  # noqa: F401
    import matplotlib  # noqa: F401
    import yaml  # noqa: F401
    from PIL import Image
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(77)
from paper_figures.site import claims, curves, documents, figures, files, origins  # noqa: E402
from paper_figures.workflow import recipes, report, verdicts  # noqa: E402
from paper_figures.workflow.evidence import MEMBRANES, RESULTS, manifest_at  # noqa: E402

VOID = {"img", "br", "hr", "meta", "link", "input", "wbr"}
WORDS = 3  # of a text for a picture, at least
COMMIT = r"\b[0-9a-f]{10,}\b"
KEPT_PICTURES = (*files.PICTURES, files.MOVIE)


class Page(HTMLParser):
    """What a page holds: ids, links, files with their texts, verdicts as marked and as shown, titles, text."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.sources, self.scripts, self.texts = [], [], [], [], {}
        self.marked, self.shown, self.late, self.titles, self.text = {}, {}, set(), [], []
        self.stack, self.row = [], None
        self.feed(text)
        assert not self.stack, f"not closed: {self.stack}"

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        classes = attributes.get("class", "").split()
        self.ids += [attributes["id"]] if "id" in attributes else []
        if "data-verdict" in attributes:
            self.row = attributes["id"]
            self.marked[self.row] = attributes["data-verdict"]
        if tag == "a":
            self.links.append(attributes["href"])
        if tag == "script":
            self.scripts.append(attributes.get("src", "inline"))
        for key in ("src", "poster"):
            if key in attributes:
                self.sources.append(attributes[key])
        if tag == "link":
            self.sources += [attributes["href"]] if not attributes["href"].startswith("data:") else []
        if tag in ("img", "video") and "src" in attributes:
            self.texts[attributes["src"]] = attributes.get("alt" if tag == "img" else "aria-label", "")
        if "late" in classes and self.row:
            self.late.add(self.row)
        if tag not in VOID:
            self.stack.append((tag, classes))

    def handle_endtag(self, tag):
        assert self.stack and self.stack[-1][0] == tag, f"</{tag}> ends {self.stack[-1:]}"
        self.stack.pop()
        if tag == "tr":
            self.row = None

    def handle_data(self, data):
        tags = [tag for tag, _ in self.stack]
        if {"title", "h1", "h2", "h3", "caption"} & set(tags):
            self.titles.append(data)
        if self.row and self.stack[-1][0] == "span" and "verdict" in self.stack[-1][1]:
            self.shown[self.row] = data.strip()
        self.text.append(data)

    @property
    def words(self):
        return re.sub(r"\s+", " ", "".join(self.text))


parsed = functools.cache(Page)  # pages are read once for each planted fault


def pages_of(site):
    return {path.relative_to(site).as_posix(): parsed(path.read_text(encoding="utf-8"))
            for path in sorted(site.rglob("*.html"))}


def kept_verdicts():
    """Returns the rows of results/verdicts.csv: another way to the verdicts than the site's."""
    with verdicts.KEPT.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@functools.cache
def readable(path, changed):
    """Returns whether a file is what its name says; `changed`: when it was."""
    if path.suffix in files.PICTURES:
        try:
            with Image.open(path) as image:
                image.load()
                return image.format.lower() == path.suffix[1:] and min(image.size) > 50
        except (SyntaxError, OSError, ValueError):
            return False
    if path.suffix == files.MOVIE:
        return path.read_bytes()[4:8] == b"ftyp"
    return path.stat().st_size > 0 and (path.suffix != ".svg" or "<svg" in path.read_text(encoding="utf-8"))


def faults(site):
    """Sentences about what is wrong with the site; none where all is well."""
    pages, rows, found = pages_of(site), kept_verdicts(), []
    expected = {row["claim"]: row["verdict"] for row in rows}
    found += faults_of_first_page(pages["index.html"].words, rows)
    whole = pages["claims.html"]
    if whole.marked != expected:
        found.append("claims.html: the verdicts are not those of the claims")
    late = {row["claim"] for row in rows if row["band set after a run"]}
    if whole.late != late:
        found.append(f"claims.html: not marked as judged by a band set after a run, or marked without reason: "
                     f"{', '.join(sorted(whole.late ^ late))}")
    seen = set()
    for name, page in pages.items():
        here = (site / name).parent
        found += [f"{name}: {row} shows '{page.shown.get(row)}', not '{expected.get(row)}'"
                  for row, verdict in page.marked.items() if not page.shown.get(row) == verdict == expected.get(row)]
        twice = sorted({one for one in page.ids if page.ids.count(one) > 1})
        found += [f"{name}: the id {one} is there twice" for one in twice]
        found += [f"{name}: the link {link} leads nowhere" for link in page.links
                  if not resolves(link, here, site, pages)]
        for source in page.sources:
            path = (here / source).resolve()
            if not path.is_relative_to(site) or not path.is_file():
                found.append(f"{name}: {source} is not in the site")
            elif not readable(path, path.stat().st_mtime_ns):
                found.append(f"{name}: {source} can't be read")
            seen.add(path)
        found += [f"{name}: no text for {source}" for source, text in page.texts.items() if len(text.split()) < WORDS]
        found += [f"{name}: a script that is none of ours: {one}" for one in page.scripts
                  if not one.endswith("assets/extras.js")]
        found += [f"{name}: a commit in the title '{title.strip()}'" for title in page.titles
                  if re.search(COMMIT, title)]
        if str(SOURCE) in page.words or "{{" in page.words or "None" in page.words.split():
            found.append(f"{name}: shows a path of this machine, or an empty value")
    shown = {hashlib.sha256(path.read_bytes()).digest() for path in seen if path.is_file()}
    found += [f"{path.relative_to(RESULTS)} is shown nowhere" for path in sorted(RESULTS.rglob("*"))
              if path.suffix in KEPT_PICTURES and hashlib.sha256(path.read_bytes()).digest() not in shown]
    return found


def faults_of_first_page(words, rows):
    results = [row for row in rows if row["kind"] == "result"]
    own, studies = ([row for row in results if row["of"] == name] for name in ("paper", "study"))
    count = lambda verdict, among=own: sum(row["verdict"] == verdict for row in among)  # noqa: E731
    wanted = [f"Of the paper's own {len(own)} claims about results {count('reproduced')} are reproduced",
              f"for {sum(r['verdict'] == 'reproduced' and r['band set after a run'] != '' for r in own)} of them",
              f"{count('refuted')} are refuted", f"{count('not comparable')} are not comparable",
              f"{count('not yet run')} are not yet run", f"stand {len(rows) - len(results)} settings",
              f"Of {len(studies)} claims of our own studies {count('reproduced', studies)} are reproduced and "
              f"{count('refuted', studies)} refuted"]
    return [f"index.html does not say '{each}'" for each in wanted if each not in words]


def resolves(link, here, site, pages):
    if re.match("https?:", link):
        return True
    target, _, anchor = link.partition("#")
    path = (here / target).resolve() if target else None
    if path and not (path.is_relative_to(site) and path.is_file()):
        return False
    name = path.relative_to(site).as_posix() if path else None
    page = pages.get(name) if name else next(p for p in pages.values() if link in p.links)
    return not anchor or page is not None and anchor in page.ids


class OfSite(unittest.TestCase):
    """The site of the accepted results."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = Path(cls.scratch.name).resolve() / "site"
        cls.site = report.Site(cls.folder)
        cls.steps = []
        cls.written = cls.site.write(lambda done, of: cls.steps.append((done, of)))

    def page(self, name):
        return Page((self.folder / name).read_text(encoding="utf-8"))

    def test_all_is_well(self):
        self.assertEqual(faults(self.folder), [])
        written = {path.relative_to(self.folder).as_posix() for path in self.written}
        self.assertEqual(written, set(pages_of(self.folder)))
        self.assertEqual(self.steps[-1], (len(self.written),) * 2)

    def test_planted_faults_are_found(self):
        """Otherwise the test above could not fail."""
        figure, first = "figures/fig12.html", "index.html"
        plants = [(first, lambda t: re.sub(r">\d+ are refuted", ">0 are refuted", t, count=1), "does not say"),
                  ("claims.html", lambda t: t.replace('class="late"', "", 1), "not marked"),
                  ("claims.html", lambda t: t.replace('data-verdict="refuted"', 'data-verdict="reproduced"', 1),
                   "not those"),
                  (figure, lambda t: t.replace(">reproduced</span><p", ">refuted</span><p", 1), "shows 'refuted'"),
                  (figure, lambda t: t.replace('href="../judge.html"', 'href="../judges.html"', 1), "leads nowhere"),
                  (figure, lambda t: t.replace('href="../judge.html"', 'href="../judge.html#no"', 1), "leads nowhere"),
                  (figure, lambda t: t.replace('src="../media/', 'src="../nowhere/', 1), "is not in the site"),
                  (figure, lambda t: t.replace('src="../media/', f'src="{SOURCE}/', 1), "is not in the site"),
                  (figure, lambda t: re.sub('(<img[^>]*) alt="[^"]*"', r'\1 alt=""', t, count=1), "no text for"),
                  (figure, lambda t: t.replace("<main", "<script>alert()</script><main", 1), "none of ours"),
                  (figure, lambda t: t.replace("<h1>", "<h1>a5d5867163 ", 1), "a commit in the title"),
                  (figure, lambda t: t.replace("<h1>", '<p id="content"></p><h1>', 1), "is there twice"),
                  (figure, lambda t: t.replace("<h1>", f"<h1>{SOURCE}", 1), "a path of this machine"),
                  (figure, lambda t: t.replace("<video", "<object", 1).replace("</video", "</object", 1)
                   .replace("media/h200/fig12_paper.mp4", "assets/style.css"), "fig12_paper.mp4 is shown nowhere")]
        for name, plant, words in plants:
            path = self.folder / name
            good = path.read_text(encoding="utf-8")
            self.assertNotEqual(plant(good), good, f"could not plant: {words}")
            path.write_text(plant(good), encoding="utf-8")
            found = faults(self.folder)
            path.write_text(good, encoding="utf-8")
            self.assertTrue(any(words in fault for fault in found), f"not found: {words} among {found}")
        picture = self.folder / "media/h200/fig17_paper.png"
        good = picture.read_bytes()
        picture.write_bytes(good[:1000])
        self.assertTrue(any("can't be read" in fault for fault in faults(self.folder)))
        picture.write_bytes(good)

    def test_six_sentences_say_what_there_is(self):
        summary = re.search(r'<div id="summary">(.*?)</div>', (self.folder / "index.html").read_text(), re.S)[1]
        words = Page(summary).words.strip()
        self.assertEqual(len(re.findall(r"[a-z]\. |[a-z]\.$", words)), 6, words)

    def test_each_claim_stands_on_the_page_of_its_figure(self):
        for claim in self.site.claims:
            page = self.site.figure_page(claim.figure).partition("#")[0]
            self.assertIn(claim.id, self.page(page).marked)

    def test_a_claim_has_its_command_time_hardware_band_and_file(self):
        """Those of the provenance, of a row that a run measured."""
        claim = next(c for c in self.site.claims if c.id == "twist.cuda_average")
        (origin,) = claim.origins
        with (RESULTS / "h200/provenance.csv").open(newline="") as file:
            row = next(row for row in csv.DictReader(file) if row["file"] == "twist_run.json")
        self.assertEqual((origin.file, origin.command, origin.commit),
                         ("h200/twist_run.json", row["redo"], row["commit"][:10]))
        run = json.loads((RESULTS / "h200/twist_run.json").read_text())
        passed = datetime.fromisoformat(run["ended"]) - datetime.fromisoformat(run["started"])
        self.assertEqual(origin.time, f"{passed.seconds} s")
        text = (self.folder / "claims.html").read_text()
        (cells,) = re.findall(r'<tr[^>]*id="twist.cuda_average".*?</tr>', text, re.S)
        place = f"files/{origin.file}"
        for words in (origin.command.split()[-1], origin.time, origin.hardware, claim.band, place):
            self.assertIn(words, cells)

    def test_every_verdict_has_words(self):
        self.assertEqual(set(claims.MEANING), {*verdicts.VERDICTS, *verdicts.AS_SET})
        for claim in self.site.claims:
            self.assertTrue(claim.sentence or claim.note, claim.id)
            said = re.sub(r"\S+\.(json|csv)", "", claim.note)
            self.assertFalse([name for name in MEMBRANES if name in said], claim.id)
            self.assertNotIn("not printed", claim.paper + claim.ours + claim.sentence, claim.id)

    def test_a_figure_without_a_picture_says_the_command_that_makes_it(self):
        self.site.figures["fig11"], kept = figures.Figure("fig11", self.site.figures["fig11"].recipes, (), ()), \
            self.site.figures["fig11"]
        words = Page(self.site.figure("fig11")).words
        self.assertIn("Not run.", words)
        self.assertIn("experiments/reproduce fig11 --scale paper --backend cuda", words)
        self.assertRegex(self.site.index(), r'fig11.html">\s*<span class="empty">not run')
        self.site.figures["fig11"] = kept
        self.assertNotIn("Not run.", Page(self.site.figure("fig11")).words)

    def test_table_1_is_a_table_with_a_row_for_each_of_the_paper(self):
        from paper_figures.figures import table1_picture

        text = (self.folder / "table1.html").read_text()
        for row in table1_picture.ROWS:
            self.assertIn(f'<th scope="row">{row[0]}</th>', text)
        missing = sum(texts.count("NA") for texts, _ in table1_picture.table())
        self.assertEqual(text.count("NA</td>"), missing)

    def test_the_page_of_the_judge_adds_up_its_rows(self):
        shown = re.findall(r"<tr><th scope=\"row\">tetrahedron</th>(.*?)</tr>",
                           (self.folder / "judge.html").read_text(), re.S)
        kept = ("two_cores/judge_cpu.csv", "h200/judge_cuda.csv")
        self.assertEqual(len(shown), len(kept))
        for cells, name in zip(shown, kept):
            with (RESULTS / name).open(newline="") as file:
                rows = [row for row in csv.DictReader(file) if row["stage"] == "tetrahedron"]
            self.assertIn(f">{sum(int(row['cases']) for row in rows):,}<", cells)
            self.assertIn(f">{len(rows)}<", cells)


class Parts(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name).resolve()

    def test_a_new_picture_appears_with_its_figure_by_its_name(self):
        (self.folder / "machine").mkdir()
        for name in ("fig12_small.webp", "fig12_paper.mp4", "fig12_paper.png", "new_thing_small.png",
                     "ablation_policy_paper.png"):
            (self.folder / "machine" / name).touch()
        found = figures.all_figures(folder=self.folder)
        names = lambda paths: [path.name for path in paths]  # noqa: E731
        self.assertEqual(names(found["fig12"].pictures), ["fig12_paper.png", "fig12_small.webp"])
        self.assertEqual(names(found["fig12"].movies), ["fig12_paper.mp4"])
        self.assertEqual(names(found["new_thing"].pictures), ["new_thing_small.png"])
        self.assertEqual(names(found["ablation_policy"].pictures), ["ablation_policy_paper.png"])
        self.assertEqual(list(found)[:22], [f"fig{n:02d}" for n in range(1, 23)])

    def test_the_small_picture_shows_where_the_colour_is(self):
        image = Image.new("RGB", (720, 2400), "white")
        image.paste((40, 90, 160), (0, 1500, 720, 1900))
        top = files.window(image, 480)
        self.assertTrue(1900 - 480 <= top <= 1500, top)

    def test_a_document_s_links_lead_into_the_site_or_are_text(self):
        pages = {RESULTS / "h200/README.md": "h200.html"}
        made = documents.Documents(files.Files(self.folder), pages)
        text = ("[a](results/h200/steady_paper.csv) [b](results/h200/README.md#the-mat) [c](../CMakePresets.json) "
                "[d](https://example.org) ![e](results/h200/fig17_paper.png) <script>")
        html = made.html(text, RESULTS.parent / "ablations.md")
        self.assertIn('<a href="files/h200/steady_paper.csv">a</a>', html)
        self.assertEqual((self.folder / "files/h200/steady_paper.csv").read_bytes(),
                         (RESULTS / "h200/steady_paper.csv").read_bytes())
        self.assertIn('<a href="h200.html#the-mat">b</a> c <a href="https://example.org">d</a>', html)
        self.assertNotIn("<img", html)
        self.assertIn("&lt;script&gt;", html)

    def test_curves_say_in_words_what_they_show(self):
        run = next(run for run in report.Evidence(RESULTS).runs if run.source == "h200/cloth_on_sphere_run.json")
        self.assertTrue(curves.are_drawn(run))
        found = curves.Drawing().draw(run, "media/one", self.folder)
        self.assertEqual(len(found), 4)
        wall = run.column("wall")
        self.assertIn(f"from {min(wall):.3g} to {max(wall):.3g}, at the end {wall[-1]:.3g}", found[0].alt)
        self.assertTrue(all(readable(self.folder / curve.src, 0) for curve in found))

    def test_a_folder_with_other_files_is_refused(self):
        (self.folder / "mine.txt").touch()
        with self.assertRaisesRegex(report.ReportError, "no report wrote: choose an empty folder with --out"):
            report.prepare(self.folder)
        self.assertTrue((self.folder / "mine.txt").is_file())
        report.prepare(self.folder / "new")
        (self.folder / "new/old.html").touch()
        report.prepare(self.folder / "new")
        self.assertEqual([path.name for path in (self.folder / "new").iterdir()], [report.MARK])
        done = subprocess.run([sys.executable, "-m", "paper_figures.workflow.report", "--out", self.folder],
                              cwd=SOURCE, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("report: ", done.stderr)
        self.assertIn("choose an empty folder", done.stderr)


def light(colour):
    """Returns the relative luminance of a colour #rrggbb (WCAG 2.2)."""
    parts = (int(colour[place:place + 2], 16) / 255 for place in (1, 3, 5))
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


class Colours(unittest.TestCase):
    def test_every_text_has_a_contrast_of_at_least_four_and_a_half(self):
        """In both schemes, on every ground on which it stands; browser.sh measures what a browser shows."""
        style = (report.SITE / "style.css").read_text()
        schemes = [dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", each))
                   for each in re.findall(":root {(.*?)}", style, re.S)]
        self.assertEqual(len(schemes), 2)
        grounds = ("ground", "sheet", "code")
        pairs = [(text, ground) for text in ("ink", "soft", "link", "good", "bad") for ground in grounds]
        pairs += [(verdict, f"{verdict}-ground") for verdict in ("good", "bad", "apart", "open")]
        pairs += [("ink", shade) for shade in ("faster", "slower-1", "slower-2", "slower-3", "printed", "open-ground")]
        for colours in schemes:
            self.assertEqual(set(colours), set(schemes[0]))
            for text, ground in pairs:
                high, low = sorted((light(colours[text]), light(colours[ground])), reverse=True)
                self.assertGreaterEqual((high + 0.05) / (low + 0.05), 4.5, f"{text} on {ground}: {colours[text]}")
        self.assertAlmostEqual((light("#ffffff") + 0.05) / (light("#767676") + 0.05), 4.54, places=2)  # WCAG's example


class JustMade(unittest.TestCase):
    """Runs just made stand beside the accepted ones: number and verdict where they are of the claim's size, else the
    number alone; picture; curves."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.runs, self.out = Path(scratch.name).resolve() / "runs", Path(scratch.name).resolve() / "site"
        for scale, scene in (("paper", "cloth_on_sphere"), ("small", "knot")):
            run = self.runs / f"{'fig18' if scale == 'paper' else 'fig11'}-{scale}-cuda/run"
            run.mkdir(parents=True)
            manifest = manifest_at(RESULTS / "h200/cloth_on_sphere_run.json")
            manifest.update(scale=scale, dirty=True, audit="every", audited_states=100, guarantee_kept=True,
                            scene={**manifest["scene"], "name": scene},
                            command=f"/of/a/machine/ogc run {scene} --out /of/a/machine/runs/run")
            (run / "run.json").write_text(json.dumps(manifest))
            (run / "steps.csv").write_bytes((RESULTS / "h200/cloth_on_sphere_steps.csv").read_bytes())
        picture = self.runs / "fig18-paper-cuda/fig18.png"
        picture.write_bytes((RESULTS / "h200/fig17_paper.png").read_bytes())
        picture.with_suffix(".caption.json").write_text(
            json.dumps({"title": "A new title", "alt": "A new picture in words", "source": "ogc run"}))

    def site(self, scale):
        return report.Site(self.out, fresh=report.JustMade(self.runs, scale, "cuda",
                                                           report.Evidence(self.runs, changed=True)))

    def test_numbers_are_judged_at_the_size_of_the_claim_alone(self):
        site = self.site("paper")
        fresh = {claim.id: claim.fresh for claim in site.claims}
        judgement = verdicts.judge(next(c.about for c in site.claims if c.id == "cloth_on_sphere.cuda_steady"),
                                   site.fresh.evidence)
        self.assertEqual(fresh["cloth_on_sphere.cuda_steady"], f"{judgement.measured.value:.4g}, {judgement.verdict}")
        self.assertEqual(fresh["dress.cuda_steady"], "", "no run is about it")
        self.assertRegex(self.site("small").fresh.about(
            next(c.about for c in site.claims if c.id == "knot.cuda_steady")), "at small, not judged")
        self.assertIn(f"now: {fresh['cloth_on_sphere.cuda_steady']}", Page(site.figure("fig18")).words)

    def test_pictures_and_curves_are_shown(self):
        site = self.site("paper")
        page = Page(site.figure("fig18"))
        self.assertIn("A new picture in words", page.texts["../media/new/fig18-paper-cuda/fig18.png"])
        self.assertIn("Made in this reproduction", page.words)
        page = Page(site.scene("cloth_on_sphere"))
        self.assertEqual(page.words.count("Just made:"), 1)
        self.assertIn("ogc run cloth_on_sphere --out run", page.words)
        self.assertNotIn("/of/a/machine", page.words)
        self.assertIn("with uncommitted changes", page.words)
        self.assertIn("2 runs that were just made, asked for at scale paper on the GPU", Page(site.index()).words)

    def test_table_1_is_shown_where_it_was_made(self):
        self.assertNotIn("just made", Page(self.site("paper").table1()).words)
        made = self.runs / "table1-smoke-cuda/table1_smoke.csv"
        made.parent.mkdir()
        made.write_bytes((RESULTS / "two_cores/table1_smoke.csv").read_bytes())
        page = Page(self.site("smoke").table1())
        self.assertIn("Table 1 at scale smoke, just made", page.words)
        self.assertIn("files/new/table1_smoke.csv", page.links)

    def test_the_time_of_a_table_is_that_of_its_rows_steps_or_is_said_to_be_not_measured(self):
        (self.runs / "t").mkdir(parents=True)
        for text, seconds in (("step [ms]\n1500\n2500\n", 4), ("step [ms]\n1500\nnan\n", None),
                              ("mean [ms],first step,last step,status\n2,1,1000,finished\n,,,not run\n", 2),
                              ("median\n3\n", None), ("step [ms]\n", None),
                              ("study,scene,metric,median\ns,a,time_of_all_runs,3\ns,a,m,1\n", 3),
                              ("study,scene,metric,median\ns,a,time_of_all_runs,3\ns,b,m,1\n", None)):
            path = self.runs / "t/t.csv"
            path.write_text(text)
            self.assertEqual(origins.seconds_by_rows(path), seconds, text)
        found = origins.Origins([])
        times = {name: found.of_file(name).time for name in
                 ("two_cores/fig17_newton_paper.csv", "two_cores/radius_smoke.csv", "two_cores/fig21_paper.csv")}
        self.assertRegex(times["two_cores/fig17_newton_paper.csv"], r"^\d+ min, by its rows$")
        self.assertRegex(times["two_cores/radius_smoke.csv"], "^not measured: the file has no times")
        self.assertRegex(times["two_cores/fig21_paper.csv"], r"^[\d.]+ (min|h)$", "the figure was timed")

    def test_what_an_audit_did_not_look_at_is_said(self):
        unseen = "the ways between them were not looked at"
        (run,) = [run for run in self.site("paper").fresh.evidence.runs if "fig18" in run.source]
        self.assertNotIn(unseen, report.audit_in_words(run), "the run's own certificate holds")
        path = self.runs / "fig18-paper-cuda/run/run.json"
        path.write_text(json.dumps({**json.loads(path.read_text()), "solver": "ipc"}))
        (run,) = [run for run in self.site("paper").fresh.evidence.runs if "fig18" in run.source]
        self.assertIn(unseen, report.audit_in_words(run), "IPC has no certificate of motion")


class Commands(unittest.TestCase):
    def test_what_a_claim_needs_is_made_by_a_command_that_is_understood(self):
        """Of claims without a run: the command's figure exists, with its backend."""
        book = recipes.load()
        for claim in verdicts.load():
            name, *options = claims.redo_of(claim, book).split()[1:]
            backend = "cuda" if "cuda" in options else "cpu"
            self.assertTrue(recipes.choose([name], book, backend), claim["id"])


if __name__ == "__main__":
    unittest.main()
