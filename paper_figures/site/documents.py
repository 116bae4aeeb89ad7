"""Renders documents of the repository as parts of the site: pictures and files of results are copied, links to other
documents of the repository, which the site has not, become their paths."""

import re
from dataclasses import dataclass

from markdown_it import MarkdownIt

from paper_figures.site.files import MOVIE, PICTURES
from paper_figures.workflow.evidence import RESULTS, ROOM
from paper_figures.workflow.recipes import ROOT

GENERATED = re.compile(r"<!--.*?-->\n?", re.S)  # marks of generated tables


@dataclass(frozen=True)
class Section:
    """Holds a section: its anchor, title (HTML), and body (HTML). The first has what stands above all headings."""

    anchor: str
    title: str
    body: str


def anchor_of(title):
    """Returns the anchor that GitHub gives a heading, so that links between sections hold."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


class Documents:
    """Renders documents for pages in the root of a site. `pages`: document of the repository -> page of the site."""

    def __init__(self, files, pages):
        self.files, self.pages = files, pages
        self.markdown = MarkdownIt("commonmark", {"html": False}).enable("table")

    def sections(self, path):
        """Returns the sections of a document, by its headings of the second level."""
        text = GENERATED.sub("", path.read_text(encoding="utf-8"))
        parts = re.split(r"^## +(.+)\n", text, flags=re.M)
        above = re.sub(r"^# .*\n", "", parts[0])
        named = [("", "", above), *((anchor_of(title), title, body) for title, body in zip(parts[1::2], parts[2::2]))]
        return [Section(anchor, self.markdown.renderInline(title), self.html(body, path))
                for anchor, title, body in named]

    def html(self, text, path):
        """Returns a text as HTML; `path`: the document in which it stands."""
        tokens = self.markdown.parse(text)
        for token in tokens:
            if token.type == "heading_open":
                token.attrs["id"] = anchor_of(tokens[tokens.index(token) + 1].content)
            if token.children:
                token.children = self._linked(token.children, path)
        html = self.markdown.renderer.render(tokens, self.markdown.options, {})
        html = re.sub(r"<table>(.*?)</table>", r'<div class="scroll" role="region" aria-label="Table" tabindex="0">'
                      r"<table>\1</table></div>", html, flags=re.S)
        return html.replace("<pre>", '<pre tabindex="0">')

    def _linked(self, tokens, path):
        """Returns inline tokens whose links hold in the site; a picture is left out, since pages show it themselves."""
        found, dropped = [], []
        for token in tokens:
            if token.type == "link_open":
                to = self.target(token.attrs["href"], path)
                dropped.append(to is None)
                if to is None:
                    continue
                token.attrs["href"] = to
            elif token.type == "link_close" and dropped.pop():
                continue
            elif token.type == "image":
                continue
            found.append(token)
        return found

    def target(self, link, path):
        """Returns where a link of a document leads in the site, or None if the site has not what it names."""
        if re.match(r"https?:|#", link):
            return link
        name, _, anchor = link.partition("#")
        there = (path.parent / name).resolve()
        if there in self.pages:
            return self.pages[there] + (f"#{anchor}" if anchor else "")
        if there.is_file() and there.is_relative_to(RESULTS) and there.suffix not in (".md", MOVIE, *PICTURES):
            return self.files.result(there)
        return None


def documents_of_site():
    """Returns document -> page of those that the site shows."""
    machines = {path: f"{path.parent.name}.html" for path in sorted(RESULTS.glob("*/README.md"))}
    return {ROOM / "ablations.md": "ablations.html", ROOT / "experiments/peers/README.md": "peers.html",
            ROOT / "compare/deviations.md": "deviations.html", **machines}
