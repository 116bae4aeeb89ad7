"""A window on motions: scrub and play frames, colours, contacts, and the row of a picked vertex. Needs polyscope."""

import time

import numpy as np

from ogc_testbed.motion import CONTACTS, PLANES, rgb
from ogc_testbed.page import placed

POLL = 0.25  # time between looks for a new frame of a run that goes on [s]


class Window:
    """The window of motions beside each other. `newer`: None, or a function that returns the motions anew if a run that
    goes on has a newer frame, else None."""

    def __init__(self, shown, colour="body", segments=(), frame=None, newer=None, headless=False):
        import polyscope as ps
        self.ps, self.newer, self.follows = ps, newer, newer is not None
        self.colour, self.segments = colour, set(segments)
        self.playing, self.played, self.looked = False, 0.0, 0.0
        ps.set_program_name("ogc view")
        ps.set_verbosity(0)
        ps.set_use_prefs_file(False)
        ps.set_allow_headless_backends(headless)
        ps.init()
        ps.set_up_dir("y_up")
        ps.set_ground_plane_mode("none")
        ps.set_build_default_gui_panels(False)
        ps.set_user_callback(self.tick)
        if not any(colour in motion.fields for motion in shown):
            shown[0].field(colour)  # says why there is none
        for name in segments:
            shown[0].segment(name)
        self.take(shown)
        self.go(len(shown[0]) - 1 if frame is None else frame)
        _, target, radius = placed(shown)
        away = np.array([0.55, 0.35, 1.0]) / np.linalg.norm([0.55, 0.35, 1.0])
        ps.look_at(tuple(np.array(target) + 2.6 * radius * away), tuple(target))

    def take(self, shown):
        """Shows these motions from now on."""
        self.shown, self.parts = shown, []
        self.names = ["body", *dict.fromkeys(name for m in shown for name in m.fields if name != "body")]
        self.limits = {}
        self.offsets, _, self.radius = placed(shown)
        for number, motion in enumerate(shown):
            corner = motion.body[motion.triangles[:, 0]]
            at_edge = motion.body[motion.edges[:, 0]] if len(motion.edges) else np.empty(0, int)
            for b, (front, back) in enumerate(motion.colours()):
                first, count = int((motion.body < b).sum()), int((motion.body == b).sum())
                x, name = motion.at(0)[first:first + count], f"{number} {motion.name}: {motion.bodies[b]}"
                if (corner == b).any():
                    mesh = self.ps.register_surface_mesh(
                        name, x, motion.triangles[corner == b] - first, color=tuple(rgb(front) / 255),
                        back_face_color=tuple(rgb(back) / 255), back_face_policy="custom", smooth_shade=True)
                    mesh.set_selection_mode("vertices_only")
                elif (at_edge == b).any():
                    mesh = self.ps.register_curve_network(name, x, motion.edges[at_edge == b] - first,
                                                          color=tuple(rgb(front) / 255))
                else:
                    continue
                self.parts.append((mesh, name, number, slice(first, first + count)))

    def frame_of(self, number):
        """Returns the frame that a motion shows: the first motion's own, the others' nearest in time."""
        if number == 0:
            return self.frame
        return int(np.abs(self.shown[number].times - self.shown[0].times[self.frame]).argmin())

    def go(self, frame):
        """Shows a frame of the first motion."""
        self.frame = int(np.clip(frame, 0, len(self.shown[0]) - 1))
        states = [m.at(self.frame_of(n)) + np.array(self.offsets[n], np.float32) for n, m in enumerate(self.shown)]
        for mesh, _, number, part in self.parts:
            x = states[number][part]
            getattr(mesh, "update_vertex_positions", getattr(mesh, "update_node_positions", None))(x)
        self.paint()

    def paint(self):
        """Colours the frame that is shown, and draws its segments."""
        if self.colour != "body" and self.colour not in self.limits:
            ends = [m.limits(self.colour) for m in self.shown if self.colour in m.fields]
            self.limits[self.colour] = min(e[0] for e in ends), max(e[1] for e in ends)
        for mesh, _, number, part in self.parts:
            mesh.remove_all_quantities()
            motion = self.shown[number]
            if self.colour == "body" or self.colour not in motion.fields:
                continue
            values = motion.fields[self.colour].of(self.frame_of(number))[part]
            low, high = self.limits[self.colour]
            mesh.add_scalar_quantity(self.colour, np.where(np.isfinite(values), values, low), enabled=True,
                                     vminmax=(low, high), cmap="viridis")
        for name, colour in (("contacts", CONTACTS), ("planes", PLANES)):
            for number, motion in enumerate(self.shown):
                ends = motion.segments[name](self.frame_of(number)) if (
                    name in self.segments and name in motion.segments) else np.empty((0, 2, 3))
                if len(ends) == 0:
                    self.ps.remove_curve_network(f"{number} {name}", error_if_absent=False)
                    continue
                points = (ends + np.array(self.offsets[number])).reshape(-1, 3)
                lines = self.ps.register_curve_network(f"{number} {name}", points,
                                                       np.arange(len(points)).reshape(-1, 2),
                                                       color=tuple(rgb(colour) / 255))
                lines.set_radius(0.002 * self.radius, relative=False)

    def picked(self):
        """Returns the rows of the picked vertex; empty if none is picked."""
        if not self.ps.have_selection():
            return []
        found = self.ps.get_selection()
        for _, name, number, part in self.parts:
            kind = str(found.structure_data.get("element_type", "")).lower()
            if found.structure_name == name and ("vertex" in kind or "node" in kind):
                vertex = part.start + int(found.structure_data["index"])
                return self.shown[number].row(self.frame_of(number), vertex)
        return []

    def tick(self):
        """Draws the panel and does what the reader asks; polyscope calls it for each picture."""
        gui, now, motion = self.ps.imgui, time.monotonic(), self.shown[0]
        self.look(now)
        gui.TextUnformatted(f"step {motion.steps[self.frame]}, {motion.times[self.frame]:.4g} s"
                            + (" (the newest)" if self.follows else ""))
        changed, frame = gui.SliderInt("frame", self.frame, 0, max(len(motion) - 1, 1))
        if gui.Button("Pause" if self.playing else "Play"):
            self.playing, self.played = not self.playing, now
        gui.SameLine()
        moves = [step for step, text in ((-1, "back"), (1, "on")) if (gui.Button(text), gui.SameLine())[0]]
        followed, self.follows = gui.Checkbox("newest", self.follows) if self.newer else (False, False)
        if changed or moves:
            self.follows, self.playing = False, False
            self.go(frame if changed else self.frame + moves[0])
        elif self.playing and now - self.played >= 1 / 30:
            self.played = now
            self.go((self.frame + 1) % len(motion))
        gui.NewLine()
        for name in self.names:
            if gui.RadioButton(name, self.colour == name) and self.colour != name:
                self.colour = name
                self.paint()
        for name in motion.segments:
            changed, chosen = gui.Checkbox(name, name in self.segments)
            if changed:
                self.segments ^= {name}
                self.paint()
        for name, text in self.picked():
            gui.TextUnformatted(f"{name}: {text}")
        for name, why in motion.missing.items():
            gui.TextWrapped(f"no {name}: {why}")

    def look(self, now):
        """Takes the newest frame of a run that goes on, if there is one."""
        if not self.newer or now - self.looked < POLL:
            return
        self.looked = now
        shown = self.newer()
        if shown:
            self.take(shown)
            self.go(len(shown[0]) - 1 if self.follows else self.frame)

    def run(self):
        """Shows the window until it is closed."""
        self.ps.show()
