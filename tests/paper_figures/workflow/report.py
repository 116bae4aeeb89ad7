"""Makes the report, and checks it as a reader would: its verdicts are those of the claims, its first line counts them,
every link resolves, every picture is one.

Usage: report.py SOURCE_DIR [--browser CHROMIUM SCREENSHOT.png]: with a browser the pages are opened in it, too. Exit
status 77: skipped, matplotlib is missing.
"""

import base64
import functools
import io
import json
import re
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE))
try:
    import matplotlib  # noqa: F401
    import yaml  # noqa: F401
    from PIL import Image
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(77)
from paper_figures.workflow import report, verdicts  # noqa: E402
from paper_figures.workflow.evidence import manifest_at  # noqa: E402

# Appended to a copy of a page: the browser itself says which pictures it could not show, and what it asked the network
# for.
PROBE = """<script>addEventListener('load', () => {
const bad = [...document.images].filter(i => !i.complete || i.naturalWidth === 0).length;
const asked = performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length;
const first = document.body.innerText.trim().split('\\n')[0];
document.body.innerHTML = `PROBE ${document.images.length} ${bad} ${asked} ${first}`; });</script>"""


class Page(HTMLParser):
    """What a page holds: ids, links, pictures, verdicts as marked and as shown, and its first words."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.late, self.marked, self.shown = set(), set(), {}, {}
        self.links, self.pictures, self.movies, self.words, self.foreign = [], [], [], [], []
        self.row = self.cell = self.head = None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.ids |= {attributes["id"]} if "id" in attributes else set()
        if tag == "a":
            self.links.append(attributes["href"])
        elif tag == "img":
            self.pictures.append(attributes["src"])
        elif tag == "video":
            self.movies.append(attributes["src"])
        elif tag in ("script", "link", "iframe"):
            self.foreign.append(tag if "src" not in attributes else f"{tag} from elsewhere")
        if "data-verdict" in attributes:
            self.row = attributes["id"]
            self.marked[self.row] = attributes["data-verdict"]
        if attributes.get("class") == "late" and self.row:
            self.late.add(self.row)
        self.head = tag in ("title", "style")
        self.cell = tag == "td" and "verdict" in attributes.get("class", "").split()

    def handle_data(self, data):
        if data.strip() and not self.head:
            self.words.append(data.strip())
            if self.cell:
                self.shown[self.row] = data


judged = functools.cache(verdicts.judge_all)


@functools.cache  # the pages are read once for each planted fault
def png(source):
    """Whether a picture, PNG or WebP, can be read as what it says it is."""
    kind, _, data = source.partition(",")
    if kind not in ("data:image/png;base64", "data:image/webp;base64"):
        return False
    try:
        with Image.open(io.BytesIO(base64.b64decode(data))) as image:
            image.load()
            return image.format.lower() in kind and min(image.size) > 50
    except (SyntaxError, OSError, ValueError):
        return False


def mp4(source):
    kind, _, data = source.partition(",")
    return kind == "data:video/mp4;base64" and base64.b64decode(data)[4:8] == b"ftyp"


def faults(folder):
    """Sentences about what is wrong with the report in `folder`; none where all is well."""
    pages = {path.name: Page(path.read_text()) for path in sorted(Path(folder).glob("*.html"))}
    expected = {j.claim["id"]: j.verdict for j in judged()}
    found = []
    if pages["index.html"].words[0] != verdicts.headline(judged()):
        found.append("the first line does not count the claims")
    late = {j.claim["id"] for j in judged() if j.late}
    if pages["index.html"].late != late:
        wrong = ", ".join(sorted(pages["index.html"].late ^ late))
        found.append(f"index.html: not marked as judged by a band set after a run, or marked without reason: {wrong}")
    if pages["index.html"].marked != expected:
        found.append("index.html: the verdicts are not those of the claims")
    for name, page in pages.items():
        found += [f"{name}: {row} shows '{page.shown.get(row)}', not '{expected.get(row)}'"
                  for row, verdict in page.marked.items() if not page.shown.get(row) == verdict == expected.get(row)]
        found += [f"{name}: the link {link} leads nowhere" for link in page.links if not resolves(link, name, pages)]
        found += [f"{name}: picture {number} can't be read"
                  for number, source in enumerate(page.pictures) if not png(source)]
        found += [f"{name}: movie {number} can't be read"
                  for number, source in enumerate(page.movies) if not mp4(source)]
        found += [f"{name}: holds a {tag}" for tag in page.foreign]
    return found


def resolves(link, name, pages):
    target, _, anchor = link.partition("#")
    page = pages.get(target or name)
    return page is not None and (not anchor or anchor in page.ids)


def check_faults_are_found(folder):
    """Each planted fault must be named; otherwise this test could not fail."""
    index = Path(folder) / "index.html"
    good = index.read_text()
    plants = [(lambda t: re.sub(r"\d+ of (\d+ claims)", r"0 of \1", t, count=1), "does not count"),
              (lambda t: t.replace(report.LATE, "", 2), "not marked"),
              (lambda t: t.replace('data-verdict="refuted"', 'data-verdict="reproduced"', 1), "not those"),
              (lambda t: t.replace(">refuted</td>", ">reproduced</td>", 1), "shows 'reproduced'"),
              (lambda t: t.replace('href="twist.html"', 'href="twists.html"', 1), "leads nowhere"),
              (lambda t: t.replace('src="data:image/png;base64,iVBOR', 'src="data:image/png;base64,AAAAA', 1),
               "can't be read"),
              (lambda t: t.replace('src="data:image/', 'src="http://example.org/a.png" title="', 1),
               "can't be read"), (lambda t: t.replace("<body>", "<body><script></script>", 1), "holds a script"),
              (lambda t: t.replace("<body>", '<body><video src="data:video/mp4;base64,AAAAAAAAAAAAAAAA"></video>', 1),
               "movie 0 can't be read")]
    for plant, words in plants:
        planted = plant(good)
        assert planted != good, f"could not plant: {words}"
        index.write_text(planted)
        assert any(words in fault for fault in faults(folder)), f"not found: {words}"
    index.write_text(good)


def check_just_made(folder):
    """Runs just made stand beside the accepted ones: number and verdict where they are of the claim's size, else the
    number alone; picture; curves."""
    runs = Path(folder)
    for scale, scene in (("paper", "cloth_on_sphere"), ("small", "knot")):
        run = runs / f"{'fig18' if scale == 'paper' else 'fig11'}-{scale}-cuda/run"
        run.mkdir(parents=True)
        manifest = manifest_at(report.RESULTS / "h200/sphere_cuda_run.json")
        manifest.update(scale=scale, dirty=True, scene={**manifest["scene"], "name": scene})
        (run / "run.json").write_text(json.dumps(manifest))
        (run / "steps.csv").write_bytes((report.RESULTS / "h200/sphere_cuda_steps.csv").read_bytes())
    picture = next(report.RESULTS.glob("h200/fig17_paper.png"))
    (runs / "fig18-paper-cuda/fig18.png").write_bytes(picture.read_bytes())
    fresh = report.JustMade(runs, "paper", "cuda", report.Evidence(runs, changed=True))
    claims = {j.claim["id"]: j for j in judged()}
    row = report.claim_row(claims["cloth_on_sphere.cuda_steady"], fresh)
    ours = f"{verdicts.judge(claims['cloth_on_sphere.cuda_steady'].claim, fresh.evidence).measured.value:.4g}"
    assert f">{ours}<" in row and '<small class="fresh">reproduced' in row, row
    assert row.count("<td") == report.claim_row(claims["cloth_on_sphere.cuda_steady"]).count("<td") + 1
    smaller = report.JustMade(runs, "small", "cuda", fresh.evidence)
    assert "small, not judged" in report.claim_row(claims["knot.cuda_steady"], smaller)
    assert 'class="number"></td>' in report.claim_row(claims["dress.cuda_steady"], fresh), "no run is about it"
    book = {name: recipe for name, recipe in report.recipes.load().items() if name == "fig18"}
    section = Page(report.figure_section("fig18", book, [], fresh.evidence, fresh))
    assert len(section.pictures) == len(Page(report.figure_section("fig18", book, [], fresh.evidence)).pictures) + 1
    page = report.scene_page("cloth_on_sphere", [], report.Evidence(runs), fresh)
    assert page.count("Just made: fig18-paper-cuda/run") == 1
    assert "with uncommitted changes" in page, "a changed program's run is shown, and said to be so"
    unseen = "the ways between them were not looked at"
    assert unseen not in page, "the run's own certificate holds"
    of_ipc = runs / "fig18-paper-cuda/run/run.json"
    of_ipc.write_text(json.dumps({**json.loads(of_ipc.read_text()), "solver": "ipc"}))
    fresh = report.JustMade(runs, "paper", "cuda", report.Evidence(runs, changed=True))
    page = report.scene_page("cloth_on_sphere", [], report.Evidence(runs), fresh)
    assert unseen in page, "IPC has no certificate of motion"


def browse(browser, folder, screenshot):
    """Opens every page in the browser: all pictures are shown, nothing is asked of the network. Takes a picture of the
    first."""
    base = [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
            "--virtual-time-budget=10000"]
    for path in sorted(Path(folder).glob("*.html")):
        copy = path.with_suffix(".probe.html")
        copy.write_text(path.read_text().replace("</body>", PROBE + "</body>"))
        done = subprocess.run([*base, "--dump-dom", copy.as_uri()], capture_output=True, text=True, check=True)
        found = re.search(r"PROBE (\d+) (\d+) (\d+) (.*)", done.stdout)
        assert found, f"{path.name}: the browser did not load it\n{done.stderr[-2000:]}"
        pictures, bad, asked, first = found.groups()
        words = f"{path.name}: {bad} of {pictures} pictures not shown, {asked} requests"
        assert int(pictures) == len(Page(path.read_text()).pictures) and bad == "0" and asked == "0", words
        if path.name == "index.html":
            assert first.startswith(verdicts.headline(judged())), first
        copy.unlink()
    subprocess.run([*base, "--window-size=1300,2400", f"--screenshot={screenshot}",
                    (Path(folder) / "index.html").as_uri()], capture_output=True, check=True)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        written = report.write(Path(scratch) / "index.html")
        wrong = faults(scratch)
        assert not wrong, "\n".join(wrong)
        check_faults_are_found(scratch)
        check_just_made(Path(scratch) / "runs")
        if "--browser" in sys.argv:
            browse(*sys.argv[sys.argv.index("--browser") + 1:][:1], scratch, sys.argv[-1])
    print(f"{len(written)} pages: verdicts, links and pictures are right")
