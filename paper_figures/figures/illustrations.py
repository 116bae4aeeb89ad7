"""Draws the paper's drawings (Fig. 2c to e, 3 to 9, 22) from the data of `ogc illustrate`. Computes no geometry: it
only draws points and lines."""

import argparse
import json
import re
import sys
import textwrap
from pathlib import Path

import numpy as np

from plots import style

plt = style.use()
from matplotlib.colors import BoundaryNorm, ListedColormap  # imported after the style has chosen its backend
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # noqa: E402

TITLES = {
    "fig02_models": "Fig. 2c to e. IPC's offsets push a sheet's own neighbours apart; OGC's blocks do not",
    "fig03": "Fig. 3. OGC's contact face sets give forces along the normals of the faces",
    "fig04": "Fig. 4. OGC's offset of a curve knows its layers where they overlap",
    "fig05": "Fig. 5. A vertex has the normals inside its indicatrix: all, a part, or none",
    "fig06": "Fig. 6. A triangle has two opposite normals, an edge an arc of them",
    "fig07": "Fig. 7. Each face has its block of the offset; dashed boundaries are open",
    "fig08": "Fig. 8. Without faces an edge has a cylinder, a vertex a cut ball",
    "fig09": "Fig. 9. Cut vertex by vertex, an iteration keeps most of its step; cut as a whole, little",
    "fig22": "Fig. 22. Limitations: the force jumps at an open boundary, and a fast fall needs many rounds",
}
ALTS = {
    "fig02_models": "Three drawings of a bent line with a point near it. IPC offsets each segment by a capsule, so "
                    "that the forces at the bend are not orthogonal to the segments; a smaller radius helps; OGC "
                    "offsets each segment along its normals alone, and its forces are orthogonal.",
    "fig03": "Drawings of a line of segments and a point, for IPC's contact sets, signed distance and OGC: arrows show "
             "which segments are pushed, and in which direction.",
    "fig04": "A closed curve whose parts come near, its conventional offset, in which the parts merge, and OGC's "
             "offset, in which overlapping layers are counted.",
    "fig05": "Three vertices, convex, mixed and saddle, with their blocks in green above and the set of their normals "
             "on a sphere below.",
    "fig06": "A triangle whose points have one normal, an edge whose normals form an arc, and both on the sphere of "
             "normals.",
    "fig07": "Blocks of a triangle, a prism; of an edge, a part of a cylinder; of a boundary edge, half a cylinder; of "
             "a vertex, a part of a ball. Closed boundaries are solid, open ones dashed.",
    "fig08": "Normals and blocks of an edge and of a vertex of the edge-only manifold: a circle and a cylinder, a cut "
             "sphere and a cut ball.",
    "fig09": "A chain of vertices that meets an obstacle in one solver iteration: the proposed step, IPC's step, which "
             "stops all vertices at the first collision, the bounds of each vertex, and OGC's step, in which only near "
             "vertices are held back.",
    "fig22": "Left: a point's way past a corner along which the direction of the contact force jumps. Right: two "
             "triangles that fall beside each other, and the number of rounds they need over their speed.",
}
ROOM_OF_TITLE = 0.5  # [inches]
SEGMENT_COLOURS = [style.COLOURS[0], style.COLOURS[3], style.COLOURS[2], style.COLOURS[5], style.COLOURS[1]]


def wrapped(text, width=42):
    """Returns lines of at most `width` characters, with N_v and M^e as mathematics."""
    return re.sub(r"\b([A-Za-z])([_^])(\w+)", r"$\1\2{\\mathrm{\3}}$",
                  "\n".join(textwrap.wrap(text.replace("Eq. ", "Eq.\u00a0"), width)))


def layers(panel, name):
    return [layer for layer in panel["layers"] if layer["name"] == name]


def xy(layer, line=None):
    points = np.array(layer["points"], dtype=float).reshape(-1, 3)
    return (points if line is None else points[line])[:, :2]


# Plane drawings ---


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
    return axes.pcolormesh(x, y, values, cmap=colours, norm=BoundaryNorm(np.arange(-0.5, most + 1), colours.N),
                           shading="nearest")


def draw_arrows(axes, layer):
    starts = [tuple(xy(layer, line)[0]) for line in layer["lines"]]
    for k, line in enumerate(layer["lines"]):
        start, end = xy(layer, line)
        segment, whole = int(layer["values"][2 * k]), layer["values"][2 * k + 1] > 0
        colour = SEGMENT_COLOURS[segment % len(SEGMENT_COLOURS)] if whole else "black"
        width = 0.35 if starts[k] in starts[k + 1:] else 0.12  # two equal arrows stay visible inside each other
        shape = f"simple,head_length={0.5 + width},head_width={0.3 + 2 * width},tail_width={width}"
        axes.annotate("", end, start, zorder=4 + k,
                      arrowprops={"arrowstyle": shape, "mutation_scale": 10, "facecolor": colour, "edgecolor": "none",
                                                                "shrinkA": 0, "shrinkB": 0})


def draw_face_sets(figure, panels):
    """Draws one row for each contact face set, one column for each situation."""
    grid = figure.subplots(3, len(panels))
    for column, panel in enumerate(panels):
        for row, name in enumerate(("IPC", "SDF", "OGC")):
            axes = grid[row, column]
            axes.set_aspect("equal")
            axes.axis("off")
            surface = layers(panel, "surface")[0]
            points = xy(surface)
            for k in range(len(points) - 1):
                axes.plot(*points[k:k + 2].T, color=SEGMENT_COLOURS[k % len(SEGMENT_COLOURS)], linewidth=2.5,
                          solid_capstyle="round")
            draw_line(axes, layers(panel, "radius")[0], color="black", linewidth=0.8)
            axes.plot(*xy(layers(panel, "x")[0]).T, "o", color="black", markersize=4, zorder=6)
            for layer in layers(panel, "bisector"):
                draw_line(axes, layer, color="black", linewidth=1, linestyle="--")
            arrows = layers(panel, name)[0]
            draw_arrows(axes, arrows)
            count = len(arrows["lines"])
            title = f"$F_{{{name}}}$: {count} face{'' if count == 1 else 's'}"
            axes.set_title(title, fontsize=9)
            if row == 0:
                axes.text(0.5, 1.3, wrapped(f"({panel['name']}) {panel['caption']}"), transform=axes.transAxes,
                          ha="center", va="bottom", fontsize=9)


def draw_models(figure, panels):
    row = figure.subplots(1, len(panels))
    for axes, panel in zip(row, panels):
        plane(axes, panel)
        points = xy(layers(panel, "surface")[0])
        for k in range(len(points) - 1):
            colour = SEGMENT_COLOURS[k % len(SEGMENT_COLOURS)]
            axes.plot(*points[k:k + 2].T, color=colour, linewidth=2.5, solid_capstyle="round")
            for layer in (*layers(panel, f"capsule of facet {k}"), *layers(panel, f"block of facet {k}")):
                draw_line(axes, layer, color=colour, linewidth=1, linestyle="--")
        for layer in layers(panel, "arrows"):
            draw_arrows(axes, layer)
        axes.plot(*xy(layers(panel, "points")[0]).T, "o", color="black", markersize=4, zorder=6)


def draw_offsets(figure, panels):
    row = figure.subplots(1, len(panels), sharex=True, sharey=True)
    for axes, panel in zip(row, panels):
        plane(axes, panel)
        for name in ("inside", "layers"):
            for layer in layers(panel, name):
                most = int(max(layer["values"]))
                shown = draw_field(axes, layer, most)
                if name == "layers":
                    figure.colorbar(shown, ax=row, ticks=range(most + 1), label="number of layers",
                                    orientation="horizontal", shrink=0.3, aspect=30)
        draw_line(axes, layers(panel, "surface")[0], color="black", linewidth=1.5)


def draw_path(figure, left, right, panels):
    plane(left, panels[0])
    left.set_title(wrapped("(a) " + panels[0]["caption"], 60))
    field = layers(panels[0], "layers")[0]
    shown = draw_field(left, field, int(max(field["values"])))
    figure.colorbar(shown, ax=left, ticks=range(int(max(field["values"])) + 1), label="number of layers", shrink=0.7)
    draw_line(left, layers(panels[0], "surface")[0], color="black", linewidth=2.5)
    for facet in (0, 1):
        for layer in layers(panels[0], f"block of facet {facet}"):
            draw_line(left, layer, color=style.COLOURS[facet], linewidth=1.2,
                      linestyle="-" if layer["closed"] else "--")
    path = xy(layers(panels[0], "path")[0])
    left.annotate("", path[-1], path[0], arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1.5,
                                                     "shrinkA": 0, "shrinkB": 0})
    for layer, colour, dash in zip(panels[1]["layers"], style.COLOURS, style.DASHES):
        right.plot(*xy(layer).T, dash, color=colour, label=layer["name"].replace("force of the ", ""))
    right.set(xlabel="way along the path (0: its start, 1: its end)", ylabel="force / $k_c$ [lengths of the drawing]",
              title=wrapped(panels[1]["caption"], 60))
    right.legend(loc="upper center")


# Truncated steps. Lengths are in metres and drawn in millimetres ---


def millimetres(layer):
    return 1000 * xy(layer)


def in_percent(shares):
    least, mean, most = (f"{100 * share:.0f} %" for share in (shares.min(), shares.mean(), shares.max()))
    if least == most:
        return f"{mean} of it, everywhere alike"
    return f"{mean} of the step on average, from {least} to {most}"


def draw_one_iteration(figure, panels):
    column = figure.subplots(4, 1, sharex=True, sharey=True)
    for axes, panel in zip(column, panels):
        axes.set_aspect("equal")
        axes.set(ylim=(-13, 8), ylabel="y [mm]")
        axes.grid(False)
        before, target, obstacle = (millimetres(layers(panel, name)[0]) for name in ("before", "target", "obstacle"))
        axes.fill(*obstacle.T, facecolor="#F6C6C6", edgecolor="#C00000", linewidth=1.5)
        axes.plot(*target.T, "--", color="grey", linewidth=1.2)
        caption = panel["caption"]
        for layer in layers(panel, "bounds"):
            for centre, radius in zip(before, layer["values"]):
                axes.add_patch(plt.Circle(centre, 1000 * radius, facecolor="#9FD0EE80", edgecolor=style.COLOURS[0],
                                          linewidth=0.8))
                axes.text(centre[0], 6.4, f"{1000 * radius:.2f}", ha="center", fontsize=7)
            caption += " [mm]"
        shown = before
        for layer in layers(panel, "after"):
            axes.plot(*before.T, color="#B0B0B0", linewidth=0.8)
            shown = millimetres(layer)
            caption += f": {in_percent(np.array(layer['values']))}"
        axes.plot(*shown.T, color="black", linewidth=1.8)
        axes.plot(*shown.T, "o", color="#1B9E3A", markersize=3.5)
        axes.set_title(wrapped(f"({panel['name']}) {caption}", 100))
    column[-1].set_xlabel("x [mm]")


def draw_triangles(axes, layer, **how):
    for line in layer["lines"]:
        axes.plot(*millimetres(layer)[line].T, **how)


def draw_fall(axes, panel):
    axes.set_aspect("equal")
    axes.grid(False)
    start, target = layers(panel, "start")[0], layers(panel, "target")[0]
    for layer in [start, *layers(panel, "round")]:
        for k, centre in enumerate(millimetres(layer)):
            label = "bound $b_v$ of each round" if layer is start and k == 0 else None
            axes.add_patch(plt.Circle(centre, 1000 * layer["values"][k], facecolor="#9FD0EE60",
                                      edgecolor=style.COLOURS[0], linewidth=0.6, label=label))
    for k, layer in enumerate(layers(panel, "round")):
        draw_triangles(axes, layer, color="#909090", linewidth=0.8)
    draw_triangles(axes, start, color="black", linewidth=1.8)
    draw_triangles(axes, target, color=style.COLOURS[3], linewidth=1.8, linestyle="--")
    for a, b in zip(millimetres(start), millimetres(target)):
        axes.annotate("", b, a, arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1, "shrinkA": 0,
                                            "shrinkB": 0})
    side = millimetres(start)[4][0] + 6
    axes.text(side, millimetres(start)[4][1], "$x^t$", va="center")
    axes.text(side, millimetres(target)[4][1], "$x^{t+1}$", va="center", color=style.COLOURS[3])
    speed, step = target["values"]
    rounds = len(layers(panel, "round")) + 1
    axes.set(xlabel="x [mm]", ylabel="y [mm]", xlim=(-40, 70),
             title=wrapped(f"(b) {panel['caption']}: {speed:g} m/s, h = {step:g} s, {rounds} rounds", 60))
    axes.legend(loc="upper right")


def draw_rounds(axes, panel):
    axes.step(*xy(layers(panel, "rounds")[0]).T, where="post", label="rounds that are needed, with balls")
    axes.step(*xy(layers(panel, "rounds with planes")[0]).T, where="post", color=style.COLOURS[1],
              label="with planes between near pairs")
    limit = xy(layers(panel, "guess_rounds")[0])
    axes.plot(*limit.T, "--", color=style.COLOURS[3], label=f"default limit, guess_rounds = {limit[0][1]:g}")
    axes.axhline(1, color="grey", linewidth=0.8, linestyle=":", label="a line search with CCD: 1")
    axes.set(xlabel="speed at the start of the step [m/s]", ylabel="rounds", ylim=(0, 30), yticks=range(0, 30, 4),
             title=wrapped(panel["caption"], 60))
    axes.legend(loc="upper left")


def draw_limitations(figure, panels):
    axes = figure.subplots(2, 2)
    draw_path(figure, *axes[0], panels)
    draw_fall(axes[1][0], panels[2])
    draw_rounds(axes[1][1], panels[3])


# Drawings in space ---


def lines_of(layer):
    points = np.array(layer["points"], dtype=float).reshape(-1, 3)
    return [points[line] for line in layer["lines"]]


def not_drawn_yet(lines, drawn):
    """Returns the parts of `lines` whose segments are not in `drawn`, and adds them to `drawn`. Where two boundaries
    share an edge, the dashes of one must not fill the gaps of the other."""
    result = []
    for line in lines:
        part = [line[0]]
        for a, b in zip(line, line[1:]):
            segment = frozenset((tuple(a), tuple(b)))
            if segment in drawn:
                result, part = [*result, part], [b]
            else:
                drawn.add(segment)
                part.append(b)
        result.append(part)
    return [np.array(part) for part in result if len(part) > 1]


def draw_layer(axes, layer, colour, alpha, line_width=1.0, line_colour=None, drawn=None):
    """Draws a layer without the line segments that `drawn` already contains."""
    points = np.array(layer["points"], dtype=float).reshape(-1, 3)
    if layer["triangles"]:
        axes.add_collection3d(Poly3DCollection(points[np.array(layer["triangles"])], facecolors=colour,
                                               edgecolors="none", alpha=alpha))
    if not layer["lines"]:
        return
    style_of_line = "-" if layer["closed"] else (0, (4, 3))
    lines = lines_of(layer) if drawn is None else not_drawn_yet(lines_of(layer), drawn)
    if lines:
        axes.add_collection3d(Line3DCollection(lines, colors=line_colour or colour, linewidths=line_width,
                                               linestyles=[style_of_line]))
    if all(len(line) == 1 for line in layer["lines"]):
        axes.scatter(*points.T, color="black", s=18)


def space(axes, title, points, elevation=22, azimuth=-62):
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, (high - low).max() / 2
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half),
             zlim=(middle[2] - half, middle[2] + half))
    axes.set_box_aspect((1, 1, 1), zoom=1.15)
    axes.view_init(elev=elevation, azim=azimuth)
    axes.axis("off")
    axes.set_title(wrapped(title), fontsize=9)


def draw_blocks(axes, panel, letter, azimuth):
    for layer in layers(panel, "surface"):
        only_edges = not layer["triangles"]
        draw_layer(axes, layer, "#F4C2CE", 0.55, 2 if only_edges else 0.6, "black" if only_edges else "#A06070")
    drawn = set()
    for layer in sorted(layers(panel, "block"), key=lambda layer: not layer["closed"]):
        draw_layer(axes, layer, "#7CC97C", 0.28, 0.9, "#1B5E1B", drawn)
    for layer in layers(panel, "face"):
        draw_layer(axes, layer, "#1F8F1F", 0.9, 2.5, "#0B5F0B")
    shown = [layer for name in ("surface", "block") for layer in layers(panel, name)]
    space(axes, f"({letter}) {panel['caption']}",
          np.concatenate([np.array(layer["points"], dtype=float).reshape(-1, 3) for layer in shown]), azimuth=azimuth)


def fill_region(axes, points):
    """Fills the part of the sphere inside a closed curve, in rings towards its middle."""
    middle = points.mean(axis=0)
    rings = [(1 - k / 8) * points + k / 8 * middle for k in range(9)]
    rings = [ring / np.linalg.norm(ring, axis=1, keepdims=True) for ring in rings]
    quads = [np.array([low[i], low[i + 1], high[i + 1], high[i]])
             for low, high in zip(rings, rings[1:]) for i in range(len(low) - 1)]
    axes.add_collection3d(Poly3DCollection(quads, facecolors="#4CAF50", edgecolors="none", alpha=0.75))


def draw_sphere(axes, panel, elevation, azimuth):
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 40), np.linspace(0, np.pi, 20))
    axes.plot_wireframe(np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v), color="#C8C8C8", linewidth=0.3)
    for layer in layers(panel, "indicatrix"):
        draw_layer(axes, layer, style.COLOURS[3], 1, 1.8)
    for layer in layers(panel, "corners"):
        points = np.array(layer["points"])
        axes.scatter(*points.T, color=style.COLOURS[0], s=14)
        for k, point in enumerate(points):
            outward = point - points.mean(axis=0)
            axes.text(*(1.06 * point + 0.14 * outward / np.linalg.norm(outward)), str(k + 1), fontsize=8, ha="center",
                      va="center")
    for layer in layers(panel, "gauss_map"):
        points = np.array(layer["points"])
        if layer["lines"]:
            if np.linalg.norm(points.mean(axis=0)) > 0.05 and np.allclose(points[0], points[-1]):
                fill_region(axes, points)
            axes.plot(*points.T, color="#1B7F1B", linewidth=2.8)
        else:
            axes.scatter(*points.T, color="#1B7F1B", s=40)
            for point in points:
                axes.plot(*np.stack([0 * point, point]).T, color="#1B7F1B", linewidth=1)
    corners = layers(panel, "corners")
    caption = "normals $N_a$ (green)" if layers(panel, "gauss_map") else "no normals"
    if corners and corners[0]["values"]:
        caption = f"indicatrix (orange), signed area {corners[0]['values'][0]:.3f} sr;\n{caption}"
    space(axes, "", np.array([[-1.05] * 3, [1.05] * 3]), elevation, azimuth)
    axes.set_title(caption, fontsize=9)


def draw_space(figure, panels, spheres, elevation=22, azimuth=-62):
    """Draws blocks above, and with `spheres` the unit spheres of the same faces below, seen from `elevation` degrees
    above the horizon."""
    rows = 2 if spheres else 1
    for column, panel in enumerate(panels):
        draw_blocks(figure.add_subplot(rows, len(panels), 1 + column, projection="3d"), panel, "abcd"[column], azimuth)
        if spheres:
            draw_sphere(figure.add_subplot(rows, len(panels), 1 + len(panels) + column, projection="3d"), panel,
                        elevation, azimuth)


DRAWERS = {
    "fig02_models": (draw_models, (11, 3.6)),
    "fig03": (draw_face_sets, (10, 7.5)),
    "fig04": (draw_offsets, (11, 3.6)),
    "fig05": (lambda f, p: draw_space(f, p, True, 55), (10, 7)),
    "fig06": (lambda f, p: draw_space(f, p, True, azimuth=118), (8, 7)),
    "fig07": (lambda f, p: draw_space(f, p, False), (13, 3.8)),
    "fig08": (lambda f, p: draw_space(f, p, True), (8, 7)),
    "fig09": (draw_one_iteration, (9, 8.4)),
    "fig22": (draw_limitations, (11, 9)),
}


def draw(path):
    """Draws one file of `ogc illustrate` into a PNG and a PDF beside it; returns the PNG."""
    data = json.loads(Path(path).read_text())
    if data.get("format") != "ogc illustration 1":
        raise ValueError(f"{path} is no illustration of this version (format {data.get('format')!r}); write it again "
                         "with: ogc illustrate")
    drawer, size = DRAWERS[data["figure"]]
    figure = plt.figure(figsize=size)
    drawer(figure, data["panels"])
    high = size[1]
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - ROOM_OF_TITLE / high))
    figure.text(style.EDGE / size[0], 1 - 0.1 / high, TITLES[data["figure"]], va="top", fontsize=12, fontweight="bold")
    out = Path(path).with_suffix(".png")
    name = data["figure"]
    style.save(figure, out, TITLES[name], ALTS[name], f"ogc illustrate {name}")
    return out


def main():
    parser = argparse.ArgumentParser(description="Draws the illustrations that `ogc illustrate` computed.")
    parser.add_argument("folder", help="folder that `ogc illustrate --out` wrote to")
    parser.add_argument("figures", nargs="*", help="fig03 … (default: all that lie there)")
    arguments = parser.parse_args()
    files = sorted(path for path in Path(arguments.folder).glob("fig*.json") if not path.name.endswith(style.CAPTION))
    if arguments.figures:
        files = [path for path in files if path.stem in arguments.figures]
    if not files:
        sys.exit(f"illustrations: no fig*.json in {arguments.folder}; make them with: ogc illustrate --out "
                 f"{arguments.folder}")
    for path in files:
        try:
            print(draw(path))
        except (ValueError, KeyError) as error:
            sys.exit(f"illustrations: {error}")


if __name__ == "__main__":
    main()
