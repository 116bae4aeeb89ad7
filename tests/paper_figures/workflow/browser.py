"""Opens a report's site in headless Chromium as readers would: in both colour schemes, on a desktop and on a phone of
360 pixels, with the keyboard, without scripts. Each check must find a planted fault, or the test fails.

Usage: browser.py SITE CHROMIUM [SCREENSHOTS]   (browser.sh makes the site and the environment)
"""

import shutil
import sys
import tempfile
import time
from pathlib import Path

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Error, sync_playwright

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))
from plots.progress import Progress  # noqa: E402

DESKTOP, PHONE = {"width": 1280, "height": 900}, {"width": 360, "height": 740}
SCHEMES = ("light", "dark")
RULES = ["wcag2a", "wcag2aa", "wcag21aa"]  # of axe-core, on success criteria of WCAG at level AA
# Pages of each kind, for screenshots, the keyboard, and what is repeated on all of a kind.
KINDS = ("index.html", "figures/fig12.html", "claims.html", "table1.html", "ablations.html", "judge.html", "peers.html",
         "scenes/twist.html", "deviations.html")

LOAD_ALL = """async () => {
  for (const i of document.images) i.loading = 'eager';
  const wait = (target, good, bad) => new Promise(done => {
    target.addEventListener(good, done); target.addEventListener(bad, done); setTimeout(done, 15000); });
  await Promise.all([...document.images].map(i => i.complete || wait(i, 'load', 'error')));
  await Promise.all([...document.images].map(i => i.decode().catch(() => 0)));
  await Promise.all([...document.querySelectorAll('video')].map(v => v.readyState || v.error ||
    wait(v, 'loadedmetadata', 'error')));
  return [...[...document.images].filter(i => !i.naturalWidth), ...[...document.querySelectorAll('video')]
    .filter(v => !v.videoWidth)].map(e => e.getAttribute('src')); }"""
# What reaches beyond the window, unless a part that scrolls by itself holds it.
WIDE = """() => [...document.querySelectorAll('main *, header *, footer *')].filter(e => {
  for (let p = e.parentElement; p; p = p.parentElement)
    if (['auto', 'scroll', 'hidden'].includes(getComputedStyle(p).overflowX)) return false;
  const box = e.getBoundingClientRect();
  return box.width && box.right > innerWidth + 1; }).map(e => `${e.tagName}.${e.className}`)"""
FOCUSABLE = "a[href], button, input, select, summary, video[controls], [tabindex='0']"
# The elements that a reader must reach: those that are shown. Browsers leave out what closed details hold.
TO_REACH = f"""() => [...document.querySelectorAll("{FOCUSABLE}")].filter(e => e.checkVisibility()).map((e, n) => {{
  e.dataset.reach = n; return e.outerHTML.slice(0, 90); }})"""
# Keeps for each of them whether its focus was seen when it had it.
LISTEN = """() => { window.seen = {}; document.addEventListener('focusin', event => {
  const e = event.target, s = getComputedStyle(e);
  if (e.dataset.reach) window.seen[e.dataset.reach] = e.tagName === 'VIDEO' ||
    s.outlineStyle !== 'none' && parseFloat(s.outlineWidth) >= 2; }); }"""
PRESSES = 25  # between two looks at what was reached


class Reader:
    """One browser."""

    def __init__(self, browser):
        self.browser, self.axe = browser, Axe()

    def open(self, address, window=DESKTOP, scheme="light", scripts=True):
        context = self.browser.new_context(viewport=window, color_scheme=scheme, java_script_enabled=scripts,
                                           reduced_motion="reduce")
        page, heard = context.new_page(), []
        page.on("console", lambda message: message.type in ("error", "warning")
                and heard.append(f"says {message.text}"))
        page.on("pageerror", lambda error: heard.append(f"its script ends with {error.message}"))
        page.on("request", lambda request: request.url.startswith(("file:", "data:", "blob:"))
                or heard.append(f"asks the network for {request.url}"))
        page.on("requestfailed", lambda request: "ERR_ABORTED" in (request.failure or "")
                or heard.append(f"does not get {request.url}"))
        page.goto(address)
        return page, heard

    def faults(self, address):
        """Returns sentences about a page: what its scripts say, files that are missing, what is too wide, and what
        axe-core objects to, which includes contrast below 4.5 in either scheme."""
        page, heard = self.open(address)
        found = [f"does not show {source}" for source in page.evaluate(LOAD_ALL)]
        found += self.objections(page, RULES)
        page.emulate_media(color_scheme="dark")
        found += [f"in the dark scheme {each}" for each in self.objections(page, ["color-contrast"])]
        for window in (DESKTOP, PHONE):
            page.set_viewport_size(window)
            width = page.evaluate("document.documentElement.scrollWidth")
            if width > window["width"]:
                found.append(f"is {width} pixels wide in a window of {window['width']}")
            found += [f"{name} reaches beyond a window of {window['width']}" for name in page.evaluate(WIDE)[:5]]
        page.context.close()
        return heard + found

    def objections(self, page, rules):
        # Without preload, as axe-core would ask for styles by a request that a page from disk may not make.
        asked = {"runOnly": rules, "resultTypes": ["violations"], "preload": False}
        for each in self.axe.run(page, options=asked).response["violations"]:
            node = each["nodes"][0]
            yield f"{each['id']}, {len(each['nodes'])} times: {node['html'][:120]}: {node['failureSummary'][:200]}"

    def faults_of_keyboard(self, address):
        """Returns sentences about what the tab key does not reach, and where the focus is not seen."""
        page, _ = self.open(address)
        reach, seen, before = page.evaluate(TO_REACH), {}, -1
        page.evaluate(LISTEN)
        while len(seen) < len(reach) and len(seen) > before:  # a video has buttons of its own, which keep it focused
            before = len(seen)
            for _ in range(PRESSES):
                page.keyboard.press("Tab")
            seen = page.evaluate("window.seen")
        page.context.close()
        found = [f"the tab key does not reach {what}" for n, what in enumerate(reach) if str(n) not in seen]
        return (found + [f"the focus is not seen on {reach[int(n)]}" for n, well in seen.items() if not well])[:5]

    def check_dialog(self, address):
        """A picture opens in a dialog by the keyboard, Escape closes it, and the focus returns."""
        page, _ = self.open(address)
        link = page.locator("a.zoom").first
        link.focus()
        page.keyboard.press("Enter")
        assert page.locator("dialog.large[open] img").count() == 1, "Enter on a picture does not enlarge it"
        page.keyboard.press("Escape")
        assert page.locator("dialog.large[open]").count() == 0, "Escape does not close the enlarged picture"
        assert page.evaluate("document.activeElement.className") == "zoom", "the focus does not return"
        page.context.close()

    def check_filter(self, address):
        """The filter of claims leaves those that have all words, and says how many there are."""
        page, _ = self.open(address)
        everything = [text.lower() for text in page.locator("tr.claim").all_text_contents()]
        page.fill("input[name=words]", "Table 1 knot gpu")
        texts = [text.lower() for text in page.locator("tr.claim:visible").all_text_contents()]
        expected = [text for text in everything if all(word in text for word in ("table", "1", "knot", "gpu"))]
        assert 0 < len(expected) < len(everything) and texts == expected, texts
        assert page.locator("output").inner_text() == f"{len(texts)} of {len(everything)} claims"
        page.context.close()

    def check_without_scripts(self, site):
        """All text is there without scripts, and pictures lead to their files."""
        page, _ = self.open((site / "index.html").as_uri(), scripts=False)
        assert "are reproduced" in page.locator("#summary").inner_text()
        assert page.locator("ul.cards li.card").count() > 30
        page.goto((site / "claims.html").as_uri())
        assert page.locator("tr.claim").count() > 200 and not page.locator("#filter").is_visible()
        page.goto((site / "figures/fig12.html").as_uri())
        page.locator("a.zoom").first.click()
        assert "/media/" in page.url, page.url
        page.context.close()

    def shoot(self, site, out):
        """Keeps screenshots to look at."""
        out.mkdir(parents=True, exist_ok=True)
        for name in KINDS:
            for window in (DESKTOP, PHONE):
                for scheme in SCHEMES:
                    page, _ = self.open((site / name).as_uri(), window, scheme)
                    page.evaluate(LOAD_ALL)
                    page.screenshot(path=out / f"{name.replace('/', '_')[:-5]}_{window['width']}_{scheme}.png",
                                    clip={"x": 0, "y": 0, "width": window["width"], "height": 4000}, full_page=True)
                    page.context.close()


def check_that_faults_are_found(reader, site):
    """Plants faults in copies of a page; a check that overlooks one proves nothing."""
    page = (site / "figures/fig12.html").read_text(encoding="utf-8")
    plants = [("</body>", "<script>undefined_function()</script></body>", "its script ends with"),
              ("</body>", '<img alt="a" src="nowhere.png"></body>', "does not show nowhere.png"),
              ("</body>", '<video controls aria-label="a" src="nowhere.mp4"></video></body>', "does not show"),
              ("</body>", '<img alt="a" src="http://127.0.0.1:9/a.png"></body>', "asks the network"),
              ("</main>", '<p style="width: 500px">wide</p></main>', "reaches beyond"),
              ("</body>", '<p style="width: 500px">wide</p></body>', "500 pixels wide"),
              ("</main>", '<p style="color: #999; background: #fff">pale</p></main>', "color-contrast"),
              ('alt="', 'data-alt="', "image-alt")]
    copy = site / "figures/planted.html"
    for old, new, words in plants:
        planted = page.replace(old, new, 1)
        assert planted != page, f"could not plant: {words}"
        copy.write_text(planted, encoding="utf-8")
        found = reader.faults(copy.as_uri())
        assert any(words in fault for fault in found), f"not found: {words} among {found}"
    unseen = "<style>:focus-visible { outline: none !important; }</style></head>"
    for old, new, words in (("</head>", unseen, "not seen"),
                            ('<a href="../claims.html"', '<a tabindex="-1" href="../claims.html"', "does not reach")):
        planted = page.replace(old, new, 1)
        assert planted != page, f"could not plant: {words}"
        copy.write_text(planted, encoding="utf-8")
        found = reader.faults_of_keyboard(copy.as_uri())
        assert any(words in fault for fault in found), f"not found: {words} among {found}"
    # In the dark scheme, too: a colour that is readable on white alone.
    copy.write_text(page.replace("</main>", '<p style="color: #0a5788">dim</p></main>'), encoding="utf-8")
    (found,) = reader.faults(copy.as_uri())
    assert found.startswith("in the dark scheme color-contrast"), found
    copy.unlink()
    return len(plants) + 3


def main():
    site, chromium = Path(sys.argv[1]).resolve(), sys.argv[2]
    began = time.monotonic()
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as scratch:
        here = Path(scratch) / "sent"  # elsewhere than where it was made, as by who gets it
        shutil.copytree(site, here)
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        reader = Reader(browser)
        planted = check_that_faults_are_found(reader, here)
        wrong, pages, progress = [], sorted(here.rglob("*.html")), Progress("page")
        for number, path in enumerate(pages):
            progress(number, len(pages))
            wrong += [f"{path.relative_to(here)}: {fault}" for fault in reader.faults(path.as_uri())]
        progress(len(pages), len(pages))
        progress.end()
        for name in KINDS:
            wrong += [f"{name}: {fault}" for fault in reader.faults_of_keyboard((here / name).as_uri())]
        assert not wrong, "\n".join(wrong)
        reader.check_dialog((here / "figures/fig12.html").as_uri())
        reader.check_filter((here / "claims.html").as_uri())
        reader.check_without_scripts(here)
        if len(sys.argv) > 3:
            reader.shoot(here, Path(sys.argv[3]))
        version = browser.version
        browser.close()
    print(f"Chromium {version}: {len(pages)} pages in two colour schemes and two widths, {len(KINDS)} by keyboard: no "
          f"script error, no missing file, no request, nothing too wide, nothing too pale; {planted} planted faults "
          f"found; {time.monotonic() - began:.0f} s")


if __name__ == "__main__":
    try:
        main()
    except Error as error:
        sys.exit(f"browser: {error}")
