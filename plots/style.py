"""Defines the style of all figures: colours that differ in colour-blindness and in grey print, units on all axes,
vector text."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # the backend is chosen before this import, so that no display is needed

# Okabe and Ito's palette, ordered so that the lightness differs from neighbour to neighbour.
COLOURS = ["#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7", "#000000"]
DASHES = ["-", "--", "-.", ":"]


def use():
    """Applies the style to all figures drawn afterwards."""
    plt.rcParams.update({
        "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
        "axes.grid": True, "grid.alpha": 0.25, "axes.spines.top": False, "axes.spines.right": False,
        "font.size": 9, "axes.titlesize": 9, "legend.fontsize": 8, "legend.frameon": False,
        "figure.constrained_layout.use": True, "figure.dpi": 100, "savefig.dpi": 160, "pdf.fonttype": 42,
                         "svg.fonttype": "none",
    })
    return plt


def save(figure, out):
    """Writes `figure` as PNG and, beside it, as PDF, and closes it."""
    figure.savefig(out)
    figure.savefig(Path(out).with_suffix(".pdf"))
    plt.close(figure)
