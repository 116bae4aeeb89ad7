"""The paper's drawings (Fig. 3 to 8, 22a) from what `ogc illustrate` computed: nothing here knows any geometry, it only draws points and lines."""

import argparse
import json
import sys
import textwrap
from pathlib import Path

import numpy as np

from plots import style

plt = style.use()
from matplotlib.colors import BoundaryNorm, ListedColormap  # noqa: E402  (after the style has chosen its backend)
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # noqa: E402

TITLES = {
    "fig03": "Fig. 3: contact face sets and the forces that they give",
    "fig04": "Fig. 4: a curve, its offset, and its offset that knows its layers",
    "fig05": "Fig. 5: vertices, their blocks (green) and spherical indicatrices",
    "fig06": "Fig. 6: normals of a triangle and of an edge",
    "fig07": "Fig. 7: blocks of the surface; dashed boundaries are open",
    "fig08": "Fig. 8: Gauss maps and blocks of the edge-only manifold; dashed boundaries are open",
    "fig22a": "Fig. 22a: the force of a facet jumps where its open boundary is entered",
}
SEGMENT_COLOURS = [style.COLOURS[0], style.COLOURS[3], style.COLOURS[2], style.COLOURS[5], style.COLOURS[1]]


def wrapped(text, width=42):
    return "\n".join(textwrap.wrap(text, width))


def layers(panel, name):
    return [layer for layer in panel["layers"] if layer["name"] == name]


def xy(layer, line=None):
    points = np.array(layer["points"], dtype=float).reshape(-1, 3)
    return (points if line is None else points[line])[:, :2]


# Plane drawings ---------------------------------------------------------------------------------------------------------------------------------------


def plane(axes, panel):
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(wrapped(f"({panel['name']}) {panel['caption']}", 50))


def draw_line(axes, layer, **how):
    for line in layer["lines"]:
        axes.plot(*xy(layer, line).T, **how)


def draw_field(axes, layer, most):
    points = xy(layer)
    columns = len(np.unique(points[:, 0]))
    values = np.array(layer["values"]).reshape(-1, columns)
    x, y = points[:columns, 0], points[::columns, 1]
    colours = ListedColormap(["white", "#D8EFD8", "#8CCB8C", "#3C9A3C", "#1B5E1B"][:most + 1])
    return axes.pcolormesh(x, y, values, cmap=colours, norm=BoundaryNorm(np.arange(-0.5, most + 1), colours.N), shading="nearest")


def draw_arrows(axes, layer):
    for k, line in enumerate(layer["lines"]):
        start, end = xy(layer, line)
        segment, whole = int(layer["values"][2 * k]), layer["values"][2 * k + 1] > 0
        colour = SEGMENT_COLOURS[segment % len(SEGMENT_COLOURS)] if whole else "black"
        width = 4.5 - 2.5 * k / max(1, len(layer["lines"]) - 1)  # equal arrows stay visible one in the other
        axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": width, "shrinkA": 0, "shrinkB": 0})


def draw_face_sets(figure, panels):
    """One row for each contact face set, one column for each situation."""
    grid = figure.subplots(3, len(panels))
    for column, panel in enumerate(panels):
        for row, name in enumerate(("IPC", "SDF", "OGC")):
            axes = grid[row, column]
            axes.set_aspect("equal")
            axes.axis("off")
            surface = layers(panel, "surface")[0]
            points = xy(surface)
            for k in range(len(points) - 1):
                axes.plot(*points[k:k + 2].T, color=SEGMENT_COLOURS[k % len(SEGMENT_COLOURS)], linewidth=2.5, solid_capstyle="round")
            draw_line(axes, layers(panel, "radius")[0], color="black", linewidth=0.8)
            axes.plot(*xy(layers(panel, "x")[0]).T, "o", color="black", markersize=4)
            arrows = layers(panel, name)[0]
            draw_arrows(axes, arrows)
            count = len(arrows["lines"])
            title = f"$F_{{{name}}}$: {count} face{'' if count == 1 else 's'}"
            axes.set_title(wrapped(f"({panel['name']}) {panel['caption']}") + "\n" + title if row == 0 else title, fontsize=8)


def draw_offsets(figure, panels):
    for axes, panel in zip(figure.subplots(1, len(panels), sharex=True, sharey=True), panels):
        plane(axes, panel)
        for name in ("inside", "layers"):
            for layer in layers(panel, name):
                most = int(max(layer["values"]))
                shown = draw_field(axes, layer, most)
                if name == "layers":
                    figure.colorbar(shown, ax=axes, ticks=range(most + 1), label="layers", orientation="horizontal", shrink=0.7)
        draw_line(axes, layers(panel, "surface")[0], color="black", linewidth=1.5)


def draw_path(figure, panels):
    left, right = figure.subplots(1, 2)
    plane(left, panels[0])
    field = layers(panels[0], "layers")[0]
    shown = draw_field(left, field, int(max(field["values"])))
    figure.colorbar(shown, ax=left, ticks=range(int(max(field["values"])) + 1), label="layers", orientation="horizontal", shrink=0.7)
    draw_line(left, layers(panels[0], "surface")[0], color="black", linewidth=2.5)
    for facet in (0, 1):
        for layer in layers(panels[0], f"block of facet {facet}"):
            draw_line(left, layer, color=style.COLOURS[facet], linewidth=1.2, linestyle="-" if layer["closed"] else "--")
    draw_line(left, layers(panels[0], "path")[0], color=style.COLOURS[3], linewidth=1.5)
    for layer, dash in zip(panels[1]["layers"], style.DASHES):
        right.plot(*xy(layer).T, dash, label=layer["name"])
    right.set(xlabel="way along the path (0 left, 1 right)", ylabel="force [k_c · length of the drawing]", title=wrapped(panels[1]["caption"], 60))
    right.legend()


# Drawings in space ------------------------------------------------------------------------------------------------------------------------------------


def lines_of(layer):
    points = np.array(layer["points"], dtype=float).reshape(-1, 3)
    return [points[line] for line in layer["lines"]]


def draw_layer(axes, layer, colour, alpha, line_width=1.0, line_colour=None):
    points = np.array(layer["points"], dtype=float).reshape(-1, 3)
    if layer["triangles"]:
        axes.add_collection3d(Poly3DCollection(points[np.array(layer["triangles"])], facecolors=colour, edgecolors="none", alpha=alpha))
    style_of_line = "-" if layer["closed"] else (0, (4, 3))
    axes.add_collection3d(Line3DCollection(lines_of(layer), colors=line_colour or colour, linewidths=line_width, linestyles=[style_of_line]))
    if layer["lines"] and all(len(line) == 1 for line in layer["lines"]):
        axes.scatter(*points.T, color="black", s=18)


def space(axes, panel, points):
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, (high - low).max() / 2
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half), zlim=(middle[2] - half, middle[2] + half))
    axes.set_box_aspect((1, 1, 1), zoom=1.15)
    axes.view_init(elev=22, azim=-62)
    axes.axis("off")
    axes.set_title(wrapped(panel["caption"]), fontsize=8)


def draw_blocks(axes, panel):
    for layer in layers(panel, "surface"):
        draw_layer(axes, layer, "#F4C2CE", 0.55, 0.6, "#A06070")
    for layer in layers(panel, "block"):
        draw_layer(axes, layer, "#7CC97C", 0.28, 0.9, "#1B5E1B")
    for layer in layers(panel, "face"):
        draw_layer(axes, layer, "#1F8F1F", 0.9, 2.5, "#0B5F0B")
    shown = [layer for name in ("surface", "block") for layer in layers(panel, name)]
    space(axes, panel, np.concatenate([np.array(layer["points"], dtype=float).reshape(-1, 3) for layer in shown]))


def draw_sphere(axes, panel):
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 40), np.linspace(0, np.pi, 20))
    axes.plot_wireframe(np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v), color="#C8C8C8", linewidth=0.3)
    for layer in layers(panel, "indicatrix"):
        draw_layer(axes, layer, style.COLOURS[3], 1, 1.8)
    for layer in layers(panel, "corners"):
        points = np.array(layer["points"])
        axes.scatter(*points.T, color=style.COLOURS[0], s=14)
        for k, point in enumerate(points):
            axes.text(*(1.12 * point), str(k + 1), fontsize=7)
    for layer in layers(panel, "gauss_map"):
        points = np.array(layer["points"])
        if layer["lines"]:
            axes.plot(*points.T, color="#1B7F1B", linewidth=2.8)
        else:
            axes.scatter(*points.T, color="#1B7F1B", s=40)
            for point in points:
                axes.plot(*np.stack([0 * point, point]).T, color="#1B7F1B", linewidth=1)
    corners = layers(panel, "corners")
    caption = f"indicatrix (orange), signed area {corners[0]['values'][0]:.3f} sr; $N_a$ green" if corners and corners[0]["values"] else "$N_a$ (green)"
    space(axes, {"caption": caption}, np.array([[-1.05] * 3, [1.05] * 3]))


def draw_space(figure, panels, spheres):
    rows = 2 if spheres else 1
    for column, panel in enumerate(panels):
        draw_blocks(figure.add_subplot(rows, len(panels), 1 + column, projection="3d"), panel)
        if spheres:
            draw_sphere(figure.add_subplot(rows, len(panels), 1 + len(panels) + column, projection="3d"), panel)


DRAWERS = {
    "fig03": (draw_face_sets, (10, 7.5)),
    "fig04": (draw_offsets, (11, 3.6)),
    "fig05": (lambda f, p: draw_space(f, p, True), (10, 7)),
    "fig06": (lambda f, p: draw_space(f, p, True), (7, 7)),
    "fig07": (lambda f, p: draw_space(f, p, False), (13, 3.8)),
    "fig08": (lambda f, p: draw_space(f, p, True), (7, 7)),
    "fig22a": (draw_path, (10, 4)),
}


def draw(path):
    """Draws one file of `ogc illustrate` into a PNG and a PDF beside it; returns the PNG."""
    data = json.loads(Path(path).read_text())
    if data.get("format") != "ogc illustration 1":
        raise ValueError(f"{path} is no illustration of this version (format {data.get('format')!r}); write it again with: ogc illustrate")
    drawer, size = DRAWERS[data["figure"]]
    figure = plt.figure(figsize=size)
    drawer(figure, data["panels"])
    figure.suptitle(TITLES[data["figure"]])
    out = Path(path).with_suffix(".png")
    figure.savefig(out)
    figure.savefig(out.with_suffix(".pdf"))
    plt.close(figure)
    return out


def main():
    parser = argparse.ArgumentParser(description="Draws the illustrations that `ogc illustrate` computed.")
    parser.add_argument("folder", help="folder that `ogc illustrate --out` wrote to")
    arguments = parser.parse_args()
    files = sorted(Path(arguments.folder).glob("fig*.json"))
    if not files:
        sys.exit(f"illustrations: no fig*.json in {arguments.folder}; make them with: ogc illustrate --out {arguments.folder}")
    for path in files:
        try:
            print(draw(path))
        except (ValueError, KeyError) as error:
            sys.exit(f"illustrations: {error}")


if __name__ == "__main__":
    main()
