"""Builds the page of the report that compares two settings of an ablation: for every metric both ranges on one axis,
the ratio of medians, and whether the ranges are apart. Its script reads the tables inside the page and needs no
network."""

import csv
import html
import json

from paper_figures.workflow.evidence import RESULTS, opened

NAME = "ablations.html"
TABLES = {"h200/ablations_small.csv.gz": "small, H100s and H200s",
          "h200/ablations_paper.csv.gz": "paper, H100s and one H200",
          "two_cores/ablations_smoke.csv.gz": "smoke, two CPU cores"}
COLUMNS = ("median", "smallest", "largest")
SCRIPT = r"""
const data = JSON.parse(document.getElementById('data').textContent);
const of = id => document.getElementById(id);
const text = n => Number.isFinite(n) ? String(+n.toPrecision(4)) : '';
function offer(id, names, wanted) {
  of(id).replaceChildren(...names.map(name => new Option(name, name)));
  if (names.includes(wanted)) of(id).value = wanted;
}
function pointsHere() { return data[of('table').value][of('study').value][of('scene').value]; }
function tables() { offer('table', Object.keys(data)); studies(); }
function studies() { offer('study', Object.keys(data[of('table').value]), of('study').value); scenes(); }
function scenes() {
  offer('scene', Object.keys(data[of('table').value][of('study').value]), of('scene').value); points();
}
function points() {
  const names = Object.keys(pointsHere());
  offer('first', names, names[0]); offer('second', names, names[1] ?? names[0]); draw();
}
// [median, smallest, largest] each; apart: every run of one lies above, or below, every run of the other
function compared(a, b) {
  const apart = a[1] > b[2] || b[1] > a[2], positive = a[1] > 0 && b[1] > 0;
  if (!apart) return 'not shown';
  return positive ? `${text(b[0] / a[0])} times, ${text(b[1] / a[2])} to ${text(b[2] / a[1])}` : 'apart';
}
function bars(a, b) {
  const all = [...a, ...b].filter(Number.isFinite), low = Math.min(...all), high = Math.max(...all);
  const logarithmic = low > 0 && high / low > 30, at = v => logarithmic ? Math.log(v) : v;
  const x = v => 8 + 284 * (high > low ? (at(v) - at(low)) / (at(high) - at(low)) : 0.5);
  const bar = (v, y, colour) => `<line x1="${x(v[1])}" x2="${x(v[2])}" y1="${y}" y2="${y}" stroke="${colour}"
    stroke-width="5" stroke-opacity="0.35" stroke-linecap="round"/><circle cx="${x(v[0])}" cy="${y}" r="4"
    fill="${colour}"/>`;
  return `<svg width="300" height="26">${bar(a, 8, '#005a87')}${bar(b, 18, '#a33d00')}</svg>`
    + (logarithmic ? '<small>logarithmic</small>' : '');
}
function draw() {
  const both = [of('first').value, of('second').value], [a, b] = both.map(name => pointsHere()[name]);
  const rows = Object.keys(a).filter(metric => metric in b).map(metric => {
    const one = a[metric], two = b[metric], range = v => `${text(v[0])} <small>${text(v[1])} to ${text(v[2])}</small>`;
    return `<tr><td>${metric}</td><td class="number">${range(one)}</td><td class="number">${range(two)}</td>
      <td>${bars(one, two)}</td><td>${compared(one, two)}</td></tr>`; });
  of('rows').innerHTML = rows.join('');
  of('name_first').textContent = both[0]; of('name_second').textContent = both[1];
}
for (const [id, next] of [['table', studies], ['study', scenes], ['scene', points], ['first', draw], ['second', draw]])
  of(id).addEventListener('change', next);
tables();
"""


def tables(folder=RESULTS):
    """Returns {table: {study: {scene: {point: {metric [unit]: [median, smallest, largest]}}}}} of the accepted
    tables."""
    found = {}
    for name, words in TABLES.items():
        with opened(folder / name) as file:
            for row in csv.DictReader(file):
                if row["median"] in ("", "nan"):
                    continue
                points = found.setdefault(words, {}).setdefault(row["study"], {}).setdefault(row["scene"], {})
                metric = row["metric"] + (f" [{row['unit']}]" if row["unit"] != "1" else "")
                points.setdefault(row["point"], {})[metric] = [float(row[column]) for column in COLUMNS]
    return found


def body(folder=RESULTS):
    """Returns the HTML of the page without its frame."""
    # A table is data, not markup: nothing in it may end the script element that holds it.
    data = json.dumps(tables(folder), allow_nan=False).replace("<", "\\u003c")
    chosen = "".join(f'<p><label>{words} <select id="{name}"></select></label></p>' for name, words in
                     (("table", "runs"), ("study", "study"), ("scene", "scene"), ("first", "first setting"),
                      ("second", "second setting")))
    files = " and ".join(f"<code>{html.escape(name)}</code>" for name in TABLES)
    return (f'<p><a href="index.html">All figures</a></p><h1>Two settings over each other</h1>'
            "<p>Point: median of the runs; bar: their range. A ratio, of the second setting to the first, stands where "
            "every run of one lies above every run of the other; elsewhere no difference is shown.</p>"
            f"<noscript><p>This page needs a script to choose; the tables are {files}.</p></noscript>"
            f'{chosen}<table><thead><tr><th>metric</th><th class="fresh" id="name_first"></th>'
            '<th class="late" id="name_second"></th><th></th><th>second over first</th></tr></thead>'
            f'<tbody id="rows"></tbody></table><script type="application/json" id="data">{data}</script>'
            f"<script>{SCRIPT}</script>")
