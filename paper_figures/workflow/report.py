"""The report: index.html with every figure, table and claim, and a page a scene with its curves; each file contains its
pictures and style and needs no network.

It is generated from claims, accepted results and recipes, and never edited: its verdicts are those of verdicts.py,
which a test checks. New runs are shown beside the accepted ones: their numbers, judged if they have the size that the
claim needs, their pictures and their curves.
"""

import argparse
import base64
import csv
import html
import io
import re
import shlex
import sys
from dataclasses import dataclass
from pathlib import Path

from paper_figures.workflow import captions, recipes, verdicts
from paper_figures.workflow.evidence import RESULTS, Evidence, EvidenceError

DEVIATIONS = recipes.ROOT / "compare/deviations.md"
STYLE = """
body { font: 15px/1.45 sans-serif; max-width: 78em; margin: 1.5em auto; padding: 0 1em; color: #111; }
table { border-collapse: collapse; margin: .6em 0 1.4em; }
td, th { border-bottom: 1px solid #ccc; padding: .25em .6em; text-align: left; vertical-align: top; }
img, video { max-width: 100%; } h2 { margin-top: 2em; } code { background: #f2f2f2; }
.number { text-align: right; min-width: 6em; } td small { color: #444; }
.verdict { white-space: nowrap; font-weight: bold; }
.reproduced { color: #005a87; } .refuted, .not-as-printed, .late { color: #a33d00; }
.fresh { color: #005a87; } figure.fresh { border-left: .3em solid #005a87; padding-left: .7em; }
.as-printed, .not-comparable, .not-yet-run { color: #555; font-weight: normal; }
"""
LATE = ' <b class="late">set after a run</b>'
PAPER_ORDER = [f"fig{number:02d}" for number in range(1, 23)]


@dataclass(frozen=True)
class JustMade:
    """Holds the run folders of the workflow, and the scale and backend of the call."""

    folder: Path
    scale: str
    backend: str
    evidence: Evidence

    def picture(self, recipe):
        """Returns the picture of a figure if it exists, or None."""
        path = self.folder / recipe.picture(self.scale, self.backend)
        return path if path.suffix == ".png" and path.is_file() else None

    def about(self, claim):
        """Returns what these runs show about a claim, as HTML; empty if nothing."""
        judged = verdicts.judge(claim, self.evidence) if "measure" in claim else None
        if judged and judged.measured:
            return f'{judged.measured.value:.4g}<br><small class="fresh">{escape(judged.verdict)}</small>'
        found = verdicts.at_another_scale(claim, self.evidence, self.scale) if "measure" in claim else None
        return f"{found.value:.4g}<br><small>{escape(self.scale)}, not judged</small>" if found else ""


def escape(text):
    return html.escape(str(text))


def page(title, body):
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}\n</body></html>\n'


def embedded(data, words, kind="png"):
    return f'<img alt="{escape(words)}" src="data:image/{kind};base64,{base64.b64encode(data).decode()}">'


def shown(path, words):
    """Returns a picture or a movie as HTML."""
    if path.suffix != ".mp4":
        return embedded(path.read_bytes(), words, path.suffix[1:])
    data = base64.b64encode(path.read_bytes()).decode()
    return f'<video controls title="{escape(words)}" src="data:video/mp4;base64,{data}"></video>'


def claim_row(judgement, fresh=None):
    claim, m, mark = judgement.claim, judgement.measured, LATE if judgement.late else ""
    also = "".join(f"<br><small>also {other['value']:g} ({escape(other['place'])})</small>"
                   for other in claim.get("also", []))
    ours = f"{m.value:.4g}" if m else ""
    origin = f"{escape(m.device)}; commit {escape(m.commit)}; <code>{escape(m.source)}</code>" if m else ""
    instead = ""
    if "instead" in claim and judgement.verdict == "not comparable":
        instead = f'comparable: <a href="index.html#{escape(claim["instead"])}">{escape(claim["instead"])}</a>'
    notes = "; ".join(filter(None, [escape(judgement.note), instead, origin]))
    unit = escape(claim["unit"]) if claim["unit"] != "1" else ""
    return (f'<tr class="claim" id="{escape(claim["id"])}" data-verdict="{judgement.verdict}">'
            f'<td>{escape(claim["says"])}<br><small>{escape(claim["place"])}</small></td>'
            f'<td class="number">{claim["value"]:g} {unit}{also}</td><td class="number">{ours}</td>'
            f'<td>{escape(verdicts.band_in_words(claim))}{mark}<br><small>{escape(claim["why"])}</small></td>'
            f'<td class="verdict {judgement.verdict.replace(" ", "-")}">{judgement.verdict}</td>'
            + (f'<td class="number">{fresh.about(claim)}</td>' if fresh else "")
            + f"<td><small>{notes}</small></td></tr>")


def rows_table(judgements, band, evidence, fresh):
    titles = ("the paper says", "paper", "ours, accepted", band, "verdict", *(["just made"] if fresh else []), evidence)
    head = "".join(f"<th>{words}</th>" for words in titles)
    rows = "\n".join(claim_row(judgement, fresh) for judgement in judgements)
    return f"<table><tr>{head}</tr>\n{rows}\n</table>" if rows else ""


def claim_table(judgements, fresh=None):
    """Returns a table of results, and below them the settings that the experimenter chose."""
    results, given = verdicts.apart(judgements)
    below = rows_table(given, "as printed where within, and why", "run", fresh)
    heading = "<h3>Settings and counts of meshes</h3>" if below else ""
    return rows_table(results, "band, and why", "evidence", fresh) + heading + below


def numbered(text):
    """Returns fig02 for fig02_x and fig2 alike."""
    found = re.match(r"fig(\d+)", text)
    return f"fig{int(found[1]):02d}" if found else text


def pictures_of(figure, folder=RESULTS):
    """Returns the accepted pictures of a figure, and then its movies."""
    return [path for suffix in ("png", "webp", "mp4") for path in sorted(folder.rglob(f"*.{suffix}"))
            if numbered(path.stem) == figure]


def origin_of(path):
    """Returns in words what the provenance beside an accepted file states about it."""
    table = path.parent / "provenance.csv"
    if table.is_file():
        with table.open(newline="") as file:
            for row in csv.DictReader(file):
                if row["file"] == path.name:
                    by = f"made by <code>{escape(row['redo'])}</code>"
                    return f"{escape(row['device'])}, commit {escape(row['commit'][:10])}, {by}"
    return "see the README beside it for machine and commit"


def pictures_just_made(figure, mine, fresh):
    """Returns what the workflow just drew of a figure, for display beside the accepted pictures."""
    if not fresh:
        return ""
    how = f"{escape(fresh.scale)}, {escape(fresh.backend)}</small></figcaption></figure>"
    found = ((recipe.name, fresh.picture(recipe)) for recipe in mine)
    images = ((name, shown(path, f"{figure}, just made")) for name, path in found if path)
    return "".join(f'<figure class="fresh">{image}<figcaption><small>just made: {escape(name)}, {how}'
                   for name, image in images)


def commands_of(evidence, scene):
    """Returns the commands that made the accepted runs of a scene, each once, with machine and commit."""
    lines = dict.fromkeys((run.manifest["command"], run.manifest["device"], run.manifest["commit"][:10])
                          for run in evidence.runs if run.manifest["scene"]["name"] == scene)
    return "".join(f"<li><code>{escape(command)}</code> – {escape(device)}, commit {escape(commit)}</li>"
                   for command, device, commit in lines)


def how_to_redo(recipe):
    """Returns the command that makes a figure, and the place of its parameters."""
    scale = "" if "illustration" in recipe.body else " --scale paper"
    options = shlex.join(map(str, recipe.body.get("run", recipe.body.get("options", [])))) or "those of the scene"
    return (f"<li><code>experiments/reproduce {escape(recipe.name)}{scale}</code> (parameters: "
            f"<code>paper_figures/figures/{recipe.file}</code>: {escape(options)})</li>")


def accepted_picture(figure, path):
    words = f"{escape(path.relative_to(RESULTS).as_posix())}: {origin_of(path)}"
    image = shown(path, f"{figure}, ours: {captions.alt_of(path)}")
    return f"<figure>{image}<figcaption><small>{words}</small></figcaption></figure>"


def what_it_says(mine, claims):
    """Returns the text for a figure that has no claims or is not implemented."""
    words = "" if claims else "No claim in numbers."
    if mine and "illustration" in mine[0].body:
        words = "Drawn from the exact reference; it makes no claim in numbers."
    lacks = (escape(recipe.body["missing"]) for recipe in mine if "missing" in recipe.body)
    return words + "".join(f" Not there yet: the program has no {what}." for what in lacks)


def figure_section(figure, book, judgements, evidence, fresh=None):
    """Returns pictures, claims, parameters and commands of one figure."""
    mine = [recipe for recipe in book.values() if numbered(recipe.name) == figure]
    claims = [j for j in judgements if j.claim["figures"][0] == figure]
    scenes = sorted({j.claim["scene"] for j in claims} | {recipe.scene for recipe in mine} - {""})
    title = mine[0].title if mine else "no recipe yet"
    images = "".join(accepted_picture(figure, path) for path in pictures_of(figure))
    images += pictures_just_made(figure, mine, fresh)
    redo = "".join(map(how_to_redo, (recipe for recipe in mine if "missing" not in recipe.body)))
    links = ", ".join(f'<a href="{scene}.html">{scene}</a>' for scene in scenes)
    made = "".join(commands_of(evidence, scene) for scene in scenes)
    words = what_it_says(mine, claims)
    return (f'<h2 id="{figure}">{figure.replace("fig0", "Fig. ").replace("fig", "Fig. ")}: {escape(title)}</h2>'
            + (f"<p>{words}</p>" if words else "")
            + f"{images}{claim_table(claims, fresh)}"
            + (f"<p>Scene: {links}</p>" if links else "")
            + (f"<p>To redo it:</p><ul>{redo}</ul>" if redo else "")
            + (f"<p>Accepted runs:</p><ul>{made}</ul>" if made else ""))


def table1_section(judgements):
    """Returns the section of Table 1, whose claims are shown with the figures' scenes: here a row for each scene, with
    a link to them; results first."""
    scenes = dict.fromkeys(j.claim["scene"] for j in judgements if "table1" in j.claim["figures"])
    rows, columns = "", (verdicts.VERDICTS, verdicts.AS_SET)
    for scene in scenes:
        groups = verdicts.apart([j for j in judgements if j.claim["scene"] == scene])
        found = [verdicts.counts(group, names)[name] for group, names in zip(groups, columns) for name in names]
        cells = "".join(f'<td class="number">{n or ""}</td>' for n in found)
        rows += f'<tr><td><a href="{scene}.html">{scene}</a></td>{cells}</tr>\n'
    own = claim_table([j for j in judgements if j.claim["figures"][0] == "table1"])
    above = zip(("results", "settings and counts of meshes"), columns)
    above = "".join(f'<th colspan="{len(names)}">{words}</th>' for words, names in above)
    head = "".join(f"<th>{name}</th>" for names in columns for name in names)
    return ('<h2 id="table1">Table 1: performance and parameters</h2>'
            f"<table><tr><th></th>{above}</tr><tr><th>scene</th>{head}</tr>{rows}</table>{own}")


def inline(text):
    """Returns a text of the list of deviations as HTML, with its inline markup: code and emphasis."""
    return re.sub(r"\*([^*]+)\*", r"<em>\1</em>", re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text)))


def deviations_section(path=DEVIATIONS):
    rows = [[cell.strip() for cell in line.strip().strip("|").split(" | ")] for line in path.read_text().splitlines()
            if line.startswith("|") and not line.startswith("|---")]
    head, *body = rows
    cells = "\n".join("<tr>" + "".join(f"<td>{inline(cell)}</td>" for cell in row) + "</tr>" for row in body)
    titles = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    return f'<h2 id="deviations">Deviations and errata</h2><table><tr>{titles}</tr>{cells}</table>'


def curves(run):
    """Returns a PNG of a run's time, detections, contacts and smallest distance over its steps."""
    from plots import style

    plt = style.use()
    # a computed layout doubles the time of the report
    figure, axes = plt.subplots(2, 2, figsize=(10, 5.2), layout="none")
    figure.subplots_adjust(left=0.07, right=0.98, bottom=0.09, top=0.98, wspace=0.18, hspace=0.25)
    panels = (("wall", "time a step [ms]", 1), ("discrete_detections", "detections a step", 1),
              ("edge_edge_contacts", "edge–edge contacts", 1), ("smallest_distance", "smallest distance [mm]", 1e3))
    for panel, (name, label, factor) in zip(axes.flat, panels):
        steps, values = run.course(name)
        panel.plot(steps, [factor * value for value in values], linewidth=0.9)
        panel.set(xlabel="step", ylabel=label, ylim=(0, None))
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=90)
    plt.close(figure)
    return out.getvalue()


def from_the_start(run):
    """Returns whether a run's curves are worth drawing; those of a window or of a single step are not."""
    return run.step_count > 1 and run.first_step == 1


def scene_page(scene, judgements, evidence, fresh=None):
    claims = claim_table([j for j in judgements if j.claim["scene"] == scene], fresh)
    parts = [f'<p><a href="index.html">All figures</a></p><h1>{escape(scene)}</h1>', claims]
    made = [run for run in fresh.evidence.runs if run.manifest["scene"]["name"] == scene] if fresh else []
    for run in (*made, *(run for run in evidence.runs if run.manifest["scene"]["name"] == scene)):
        m = run.manifest
        settings = ", ".join(f"{escape(name)} {escape(value['value'])}" for name, value in m["settings"].items())
        ways = "" if run.is_certified else "; the ways between them were not looked at"
        audit = {True: f"exact audit of {run.audited_states} states: no intersection{ways}",
                 False: "exact audit FAILED", None: "not audited"}[run.guarantee_kept]
        mark = "Just made: " if run in made else ""
        commit = m["commit"][:10] + (", with uncommitted changes" if m.get("dirty") else "")
        parts.append(f"<h2>{mark}{escape(run.source)}</h2><p><code>{escape(m['command'])}</code><br>"
                     f"{escape(m['device'])}, commit {escape(commit)}, {run.step_count} steps, {audit}</p>"
                     + (embedded(curves(run), f"curves of {run.source}") if from_the_start(run) else "")
                     + f"<details><summary>Settings</summary><p>{settings}</p></details>")
    return page(scene, "\n".join(parts if len(parts) > 2 else [*parts, "<p>No accepted run yet.</p>"]))


def write(out, evidence=None, fresh=None):
    """Writes index.html at `out` and the scenes' pages beside it, with the new runs in `fresh` (JustMade) if given.
    Returns paths."""
    evidence, book, out = evidence or Evidence(), recipes.load(), Path(out)
    judgements = verdicts.judge_all(evidence)
    figures = [f for f in PAPER_ORDER if any(numbered(n) == f for n in book)
               or any(j.claim["figures"][0] == f for j in judgements)]
    figures += [name for name, recipe in book.items() if "study" in recipe.body]
    contents = " · ".join(f'<a href="#{name}">{name}</a>' for name in [*figures, "table1", "deviations"])
    sections = [figure_section(figure, book, judgements, evidence, fresh) for figure in figures]
    beside = (f'<p id="fresh">Beside the accepted results stand {len(fresh.evidence.runs)} finished runs of '
              f"{escape(fresh.folder)}, asked for at scale {escape(fresh.scale)} on {escape(fresh.backend)}.</p>"
              if fresh else "")
    body = (f'<p id="counts">{verdicts.headline(judgements)}</p><h1>Offset Geometric Contact: what the paper says, and '
            'what we measured</h1>'
            "<p>A band is fixed before the run that it judges; "
            f"where a run that answers the claim was known, the row is marked{LATE}. "
            "Nothing here is written by hand: "
            "<code>experiments/reproduce --report</code> makes it from claims, accepted results and recipes.</p>"
            f"{beside}<p>{contents}</p>"
            + "\n".join([*sections, table1_section(judgements), deviations_section()]))
    out.parent.mkdir(parents=True, exist_ok=True)
    scenes = sorted({j.claim["scene"] for j in judgements} | {recipe.scene for recipe in book.values()} - {""})
    pages = {out.with_name(f"{scene}.html"): scene_page(scene, judgements, evidence, fresh) for scene in scenes}
    written = {out: page("OGC Testbed: report", body), **pages}
    for path, text in written.items():
        path.write_text(text)
    return list(written)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", default=recipes.ROOM / "report/index.html",
                        help="the page; the scenes' pages go beside it")
    parser.add_argument("--runs", type=Path, metavar="FOLDER",
                        help="run folders just made, to stand beside the accepted")
    parser.add_argument("--scale", default="small", choices=recipes.SCALES, help="of these runs")
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"), help="of these runs")
    options = parser.parse_args()
    try:
        runs = options.runs and options.runs.resolve()
        fresh = JustMade(runs, options.scale, options.backend, Evidence(runs, changed=True)) if runs else None
        paths = write(options.out, fresh=fresh)
    except (EvidenceError, recipes.RecipeError) as error:
        sys.exit(f"report: {error}")
    print(f"{paths[0]} and {len(paths) - 1} pages beside it, {sum(path.stat().st_size for path in paths) / 2**20:.1f} "
          "MiB")


if __name__ == "__main__":
    main()
