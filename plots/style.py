"""Defines the look of all figures: colours that colour-blind readers tell apart and that differ in grey print, units on
all axes, vector text, titles, and captions."""

import json
import textwrap
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # the backend is chosen before this import, so that no display is needed

# Okabe and Ito's palette, ordered so that the lightness differs from neighbour to neighbour.
COLOURS = ["#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7", "#000000"]
DASHES = ["-", "--", "-.", ":"]
OURS, PAPER, BASELINE = "#0072B2", "#000000", "#D55E00"  # our numbers, the paper's, and another method's

# Sides of sheets: blue in front and sand behind, in three shades each for neighbouring sheets, and bodies in grey.
FRONTS = ("#4C86B8", "#7FB0D4", "#2F6393")
BACKS = ("#E2B458", "#EFD08C", "#C9952F")
BODY = "#B9BDC4"
YARNS = ("#2F6FA8", "#C9772B", "#5A5F66")
MARK = "#D1462F"  # what a picture points at
RIM = "#24303C"  # rims and seams
GROUND, FLOOR = "#F6F7F9", "#D9DCE1"  # background, and the floor that fades into it

# Simulation of vision without the middle cones, severity 1, by Machado, Oliveira and Fernandes (2009), on linear RGB.
DEUTERANOPIA = ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881))
# A page [inches]: its width, its edge, the gaps between pictures and below one; heights of the title, of a line below
# it, and of the title of a panel; what a plot leaves free to the left, right and below.
WIDTH, EDGE, GAP, LOW, HEAD, LINE, TITLE, ROOM = 11.5, 0.12, 0.1, 0.02, 0.36, 0.17, 0.27, (0.66, 0.78, 0.46)
CAPTION = ".caption.json"  # end of the name of the file beside a picture


def use():
    """Applies the style to all figures drawn afterwards."""
    plt.rcParams.update({
        "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
        "axes.grid": True, "grid.alpha": 0.25, "axes.spines.top": False, "axes.spines.right": False,
        "font.size": 9, "axes.titlesize": 9.5, "axes.titlelocation": "left", "legend.fontsize": 8,
        "legend.frameon": False, "figure.titlesize": 12, "figure.constrained_layout.use": True, "figure.dpi": 100,
        "savefig.dpi": 160, "pdf.fonttype": 42, "svg.fonttype": "none",
    })
    return plt


def save(figure, out, title="", alt="", source=""):
    """Writes `figure` as PNG and, beside it, as PDF, and closes it. With a title it also writes the caption,
    OUT.caption.json: the title, `alt`, which says in words what the picture shows, and `source`, the runs and the
    commit behind it, which stand in no title."""
    out = Path(out)
    # Matplotlib gives a figure without a layout the default one as soon as it is written.
    with plt.rc_context({"figure.constrained_layout.use": figure.get_layout_engine() is not None}):
        figure.savefig(out, metadata={"Title": title, "Description": alt, "Source": source} if title else None)
        figure.savefig(out.with_suffix(".pdf"), metadata={"Title": title, "Subject": alt} if title else None)
    plt.close(figure)
    if title:
        caption = {"title": title, "alt": alt, "source": source}
        out.with_suffix(CAPTION).write_text(json.dumps(caption, indent=1, ensure_ascii=False) + "\n")


def pictures(count, size, share=1.0):
    """Returns a row of `page` for so many pictures of this size (width, height), side by side on a share of it."""
    each = (WIDTH - 2 * EDGE) * share / count
    return (each - GAP) * size[1] / size[0] + TITLE + LOW, [(share / count, "picture")] * count


def page(rows, title, below=""):
    """Returns (figure, axes of each row) of a page. `rows`: (height [inches], cells); a cell is its share of the width
    and its kind, "picture", which fills it, or "plot", which leaves room for labels and for names at the ends of
    lines. Above them stand the title, a clause, and, smaller, what a reader compares: our numbers and the paper's."""
    lines = textwrap.wrap(below, int(WIDTH * 13.5))
    head = HEAD + LINE * len(lines) + 0.08
    high = head + sum(height for height, _ in rows) + EDGE
    with plt.rc_context({"figure.constrained_layout.use": False}):
        figure, found, top = plt.figure(figsize=(WIDTH, high)), [], high - head
    for height, cells in rows:
        left, axes = EDGE, []
        for share, kind in cells:
            wide = share * (WIDTH - 2 * EDGE)
            inner = (GAP / 2, GAP / 2, LOW) if kind == "picture" else ROOM
            axes.append(figure.add_axes([(left + inner[0]) / WIDTH, (top - height + inner[2]) / high,
                                         (wide - inner[0] - inner[1]) / WIDTH, (height - inner[2] - TITLE) / high]))
            left += wide
        top -= height
        found.append(axes)
    figure.text(EDGE / WIDTH, 1 - 0.08 / high, title, va="top", fontsize=12, fontweight="bold")
    figure.text(EDGE / WIDTH, 1 - HEAD / high, "\n".join(lines), va="top", fontsize=9, color="0.25", linespacing=1.25)
    return figure, found


def label_ends(axes, fontsize=7.5):
    """Names each line at its right end, outside the data, in its colour; names that would touch are moved apart, and
    are smaller where they are too many for the height of the panel, which they do not leave."""
    lines = [line for line in axes.get_lines() if not line.get_label().startswith("_") and len(line.get_xdata())]
    named = []
    for line in lines:
        x, y = np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)
        known = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
        if len(known):
            place = axes.transAxes.inverted().transform(axes.transData.transform((x[known[-1]], y[known[-1]])))
            named.append([float(np.clip(place[1], 0, 1)), line])
    inches = axes.get_position().height * axes.figure.get_size_inches()[1]
    named.sort(key=lambda pair: pair[0])
    tall = {line: 1 + line.get_label().count("\n") for _, line in named}
    most = inches * 72 / 1.24 / max(1, sum(tall.values()))  # size of names that fill the height
    fontsize = min(fontsize, most)
    apart = fontsize * 0.62 / 72 / inches  # half of a line of text
    for _ in range(50):  # neighbours push one another apart until all names are readable
        for low, high in zip(named, named[1:]):
            overlap = apart * (tall[low[1]] + tall[high[1]]) - (high[0] - low[0])
            if overlap > 0:
                low[0], high[0] = low[0] - overlap / 2, high[0] + overlap / 2
        for pair in named:
            inside = apart * tall[pair[1]]
            pair[0] = min(max(pair[0], inside), 1 - inside)
    for height, line in named:
        axes.annotate(line.get_label(), (1.015, height), xycoords="axes fraction", va="center", ha="left",
                      fontsize=fontsize, color=line.get_color(), annotation_clip=False)


def key(axes, lines, columns=4, fontsize=8):
    """Names lines in a cell of their own, a picture of `page`, for panels that share them."""
    axes.axis("off")
    axes.legend(handles=list(lines), loc="center", ncol=columns, fontsize=fontsize, frameon=False)


def not_run(axes, words="not run"):
    """Says in an empty panel that no run is behind it."""
    axes.set(xticks=[], yticks=[])
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set(visible=True, color="0.8", linestyle=":")
    axes.text(0.5, 0.5, words, ha="center", va="center", color="0.45", wrap=True, transform=axes.transAxes)


def picture(axes, image, title=""):
    """Shows a rendered picture without axes."""
    axes.imshow(image, aspect="equal", interpolation="antialiased")
    axes.axis("off")
    if title:
        axes.set_title(title)


def paper_line(axes, value, words, dash="--"):
    """Marks the paper's number across a panel; `label_ends` names it."""
    axes.axhline(value, color=PAPER, linestyle=dash, linewidth=0.9, zorder=3, label=words)


def rgb(colour):
    """Returns the RGB [3] of a colour such as #0072B2, from 0 to 1."""
    return matplotlib.colors.to_rgb(colour)


def table(axes, head, body):
    """Draws rows of texts under a head; a column is as wide as its longest text, the first begins at the left."""
    wide = [max(len(str(row[k])) for row in (head, *body)) + (5 if k == 0 else 2) for k in range(len(head))]
    drawn = axes.table(body, colLabels=head, colWidths=[w / sum(wide) for w in wide], loc="center", cellLoc="center",
                       edges="horizontal")
    drawn.auto_set_font_size(False)
    drawn.set_fontsize(8.5)
    drawn.scale(1, 1.75)
    for (row, column), cell in drawn.get_celld().items():
        cell.set_edgecolor("0.85")
        cell.set_text_props(fontweight="bold" if row == 0 or column == 0 else None,
                            ha="left" if column == 0 else "center")
