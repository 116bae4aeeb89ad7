"""What viewers show is what runs hold: pages, pictures, movies, windows and USD files of small runs.

Usage: view.py SOURCE_DIR OGC. Exit status 77: skipped, a package is missing. What needs polyscope, usd-core or Chromium
is skipped where they are not installed.
"""

import base64
import contextlib
import importlib.util
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import types
import unittest
import zlib
from pathlib import Path
from unittest import mock

SOURCE, OGC = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
del sys.argv[1:3]
os.environ["OGC_MODULES"] = str(OGC.parent / "python" / "ogc_testbed")
sys.path.insert(0, str(SOURCE))
try:
    import h5py  # noqa: F401
    import numpy as np
    import pyvista  # noqa: F401
    from PIL import Image

    import plots  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

from ogc_testbed import motion  # noqa: E402
from ogc_testbed.motion import Field, Motion, motion_of_arrays, motion_of_run  # noqa: E402
from ogc_testbed.page import Page  # noqa: E402
from ogc_testbed.runs import Run, RunError  # noqa: E402
from plots import packages, render, stills, style, usd, view  # noqa: E402
from plots.progress import Progress  # noqa: E402

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
ENVIRONMENT = {key: value for key, value in os.environ.items()
               if key not in ("DISPLAY", "WAYLAND_DISPLAY", "OGC_MODULES")}
HAS_CONTACTS = (OGC.parent / "python" / "ogc_testbed" / "_fast.abi3.so").exists()


def ogc(*words, limit=250, **variables):
    return subprocess.run([OGC, *map(str, words)], capture_output=True, text=True, timeout=limit, check=False,
                          env={**ENVIRONMENT, "OGC_PYTHON": sys.executable, "OGC_ROOT": str(SOURCE), **variables})


def grid(side):
    line = np.linspace(0, 1, side, dtype=np.float32)
    x = np.array([[a, 0, b] for a in line for b in line], np.float32)
    i = np.arange(side * side, dtype=np.int32).reshape(side, side)
    a, b, c, d = i[:-1, :-1].ravel(), i[:-1, 1:].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel()
    return x, np.concatenate([np.stack([a, b, c], axis=1), np.stack([d, c, b], axis=1)])


def plain(frames, triangles, fields=(), name="mesh"):
    """A motion without contacts, with fields (name, values (F, V))."""
    count = frames.shape[1]
    return Motion(name, triangles, np.empty((0, 2), np.int32), np.zeros(count, np.int32), ["sheet"], [False],
                  np.arange(len(frames)), np.arange(len(frames)) / 60, lambda i: frames[i],
                  {"body": Field("", lambda i: np.zeros(count, np.float32), ""),
                   **{key: Field("m", lambda i, v=values: v[i], "") for key, values in fields}})


def unpacked(text, kind):
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), kind)


def positions_in(code):
    """Decodes positions as page.js does, but by itself."""
    count = code["vertices"]
    halves = unpacked(code["positions"], np.uint8).reshape(2, -1).astype(np.uint16)
    words = np.cumsum((halves[0] | halves[1] << 8).reshape(-1, count, 3), axis=0, dtype=np.uint16)
    return np.array(code["low"]) + words * code["step"]


class Pages(unittest.TestCase):
    def test_positions_are_within_the_stated_error_and_no_worse_than_half_a_step(self):
        random = np.random.default_rng(1)
        for scale, shift in ((1, 0), (1e-3, 5), (40, -3)):
            frames = (scale * random.uniform(-1, 1, (7, 50, 3)) + shift).astype(np.float32)
            page = Page(plain(frames, grid(4)[1]))
            found = positions_in(page.data["motions"][0])
            extent = float(np.ptp(frames.reshape(-1, 3), axis=0).max())
            self.assertAlmostEqual(page.error, extent / 65534 / 2, delta=1e-6 * page.error)
            # half a step, and the rounding of products and sums in double precision at these coordinates
            error = np.abs(found - frames).max()
            self.assertLessEqual(error, page.error + 4 * np.spacing(float(np.abs(frames).max()) + extent))
            self.assertGreater(error, page.error / 2)  # 1050 random numbers come near half a step

    def test_equal_values_have_one_colour_and_missing_ones_are_grey(self):
        with np.errstate(all="raise"):
            colours = motion.scaled(np.array([0, np.nan, 0], np.float32), (0.0, 0.0))
        expected = [motion.rgb(name) for name in (motion.SCALE[0], motion.STILL, motion.SCALE[0])]
        self.assertEqual(colours.tolist(), np.array(expected).tolist())

    def test_values_are_one_of_255_and_missing_ones_are_missing(self):
        frames, values = np.zeros((2, 9, 3), np.float32), np.random.default_rng(2).uniform(3, 7, (2, 9))
        frames[1] = 1
        values[1, 4] = np.nan
        (code,) = Page(plain(frames, grid(3)[1], [("height", values)])).data["motions"]
        (field,) = code["fields"]
        stored = np.cumsum(unpacked(field["values"], np.uint8).reshape(2, 9), axis=0, dtype=np.uint8)
        self.assertEqual(np.argwhere(stored == 0).tolist(), [[1, 4]])
        error = np.abs(field["low"] + (stored - 1.0) / 254 * (field["high"] - field["low"]) - values)
        self.assertLessEqual(np.nanmax(error), (field["high"] - field["low"]) / 508 * (1 + 1e-9))

    def test_a_thousand_frames_of_a_thousand_vertices_take_at_most_ten_megabytes(self):
        """Of a sheet that waves with all its colours, and of noise, which nothing packs: that leaves out colours."""
        x, triangles = grid(32)
        x, triangles = x[:1000], triangles[(triangles < 1000).all(axis=1)]
        times = np.arange(1000)[:, None] / 60
        waving = np.repeat(x[None], 1000, axis=0)
        waving[:, :, 1] = 0.1 * np.sin(9 * x[:, 0] + 5 * times) + 0.03 * np.sin(31 * x[:, 2] - 11 * times)
        random = np.random.default_rng(3)
        noise = random.uniform(0, 1, (1000, 1000, 3)).astype(np.float32)
        speed = np.abs(np.gradient(waving[:, :, 1], axis=0) * 60)
        for frames, fields, all_fit in ((waving, [("speed", speed), ("bound", speed**0.5), ("distance", speed**2),
                                                  ("force", speed**3)], True),
                                        (noise, [(n, random.uniform(0, 1, (1000, 1000))) for n in "abc"], False)):
            page = Page(plain(frames, triangles, fields))
            size = len(page.html().encode())
            print(f"1000 frames of 1000 vertices: {size / 1e6:.2f} MB, within {page.error:.2g} of 1 m; "
                  f"left out: {page.left_out}")
            self.assertLessEqual(size, 10_000_000)
            self.assertEqual(not page.left_out, all_fit)
            self.assertEqual(len(page.data["motions"][0]["fields"]) + len(page.left_out), len(fields))

    def test_names_can_not_end_the_script(self):
        frames = np.zeros((1, 9, 3), np.float32)
        text = Page(plain(frames, grid(3)[1], name="</script><b>")).html()
        self.assertNotIn("</script><b>", text)
        self.assertIn("&lt;/script&gt;&lt;b&gt;", text)
        found = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)
        self.assertEqual(json.loads(found[1])["title"], "</script><b>")

    def test_nothing_is_asked_of_the_network(self):
        text = Page(plain(np.zeros((1, 9, 3), np.float32), grid(3)[1])).html()
        self.assertEqual(re.findall(r"(?:src|href|url|import|fetch)\s*[=(]\s*[\"']?\s*(?:https?:|//)", text), [])

    def test_bad_arrays_are_refused_in_words(self):
        x, triangles = grid(3)
        for frames, faces, words in ((x[:, :2], triangles, "(F, V, 3)"), (x[:4], triangles, "names vertex"),
                                     (x, triangles - 1, "a triangle or edge")):
            with self.assertRaisesRegex(RunError, re.escape(words)):
                motion_of_arrays(frames, faces)
        broken = x.copy()
        broken[4, 1] = np.nan
        with self.assertRaisesRegex(RunError, "frame 0 is not finite"):
            Page(plain(broken[None], triangles))

    @unittest.skipUnless(CHROMIUM, "SKIPPED: Chromium is not installed")
    def test_a_browser_shows_what_the_run_holds(self):
        """No script fails, and the rows of a typed and of a clicked vertex are those of the motion."""
        x, triangles = grid(9)
        frames = np.stack([x, x + np.float32([0, 0.5, 0]), x + np.float32([0, 1, 0])])
        page = Page(plain(frames, triangles, [("height", frames[:, :, 1])]), colour="height", frame=2)
        act = """<script type="module">
          const wait = () => document.documentElement.dataset.ready ? go() : setTimeout(wait, 20), $ = (id) =>
            document.getElementById(id), note = (text) => { document.body.dataset[text[0]] = text.slice(1); };
          window.onerror = (error) => note("e" + error);
          function row() { return $("row").innerText; }
          function go() {
            $("vertex").value = 40; $("vertex").dispatchEvent(new Event("change")); note("a" + row());
            $("back").click(); note("b" + row() + $("when").textContent);
            const box = $("canvas").getBoundingClientRect(), at = { pointerId: 1, button: 0, bubbles: true,
              clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 };
            $("canvas").setPointerCapture = () => {};
            for (const kind of ["pointerdown", "pointerup"]) $("canvas").dispatchEvent(new PointerEvent(kind, at));
            note("c" + row());
            note("d" + getComputedStyle($("contacts-label")).display);
          }
          wait();</script>"""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "page.html"
            file.write_text(page.html().replace("</body>", act + "</body>"))
            dom = subprocess.run(
                [CHROMIUM, "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                 f"--user-data-dir={folder}/profile", "--window-size=1000,700", "--virtual-time-budget=20000",
                 "--dump-dom", file.as_uri()], capture_output=True, text=True, timeout=200, check=False).stdout
        said = {key: value.replace("\t", " ") for key, value in re.findall(r'data-([abcde])="([^"]*)"', dom)}
        self.assertEqual(set(said), {"a", "b", "c", "d"}, dom[:3000] if not said else said)
        self.assertEqual(said["d"], "none")  # there are no contacts to switch on
        self.assertIn("vertex 40", said["a"])
        self.assertIn("position 0.5, 1, 0.5 m", said["a"])
        self.assertIn("position 0.5, 0.5, 0.5 m", said["b"])
        self.assertIn("(frame 2 of 3)", said["b"])
        self.assertIn("vertex 40", said["c"])  # the middle of the sheet is where the view looks


@unittest.skipUnless(HAS_CONTACTS, "SKIPPED: the Python package is not built")
class Contacts(unittest.TestCase):
    def test_segments_join_closest_points(self):
        """Their lengths are below the radius, the least is the smallest distance, and edges' are across both edges."""
        import ogc_testbed as ogc_package
        random = np.random.default_rng(4)
        x, triangles = grid(8)
        upper = x + np.float32([0.03, 0.02, 0.05])
        both = np.concatenate([x, upper]).astype(np.float32)
        both[:, 1] += random.uniform(0, 0.01, len(both)).astype(np.float32)
        faces = np.concatenate([triangles, triangles + np.int32(len(x))])
        radius = 0.03
        shown = motion_of_arrays(both, faces, radius=radius)
        ends = shown.segments["contacts"](0).astype(float)
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        sets = ogc_package.find_contacts(ogc_package.Mesh(faces, vertex_count=len(both)), both, radius, 2 * radius)
        self.assertEqual(len(ends), len(sets.vertex_facet) + len(sets.edge_edge))
        self.assertGreater(len(sets.edge_edge), 20)
        self.assertLess(lengths.max(), radius * (1 + 1e-5))
        self.assertAlmostEqual(lengths.min(), sets.smallest_distance, delta=1e-6)
        self.assertAlmostEqual(shown.limits("distance")[0], sets.smallest_distance, delta=1e-6)
        crosses = shown.segments["planes"](0).astype(float)
        along, across = np.repeat(ends[:, 1] - ends[:, 0], 1, axis=0), crosses[:, 1] - crosses[:, 0]
        self.assertEqual(len(crosses), 2 * len(ends))
        for part in (across[:len(ends)], across[len(ends):]):
            self.assertLess(np.abs((part * along).sum(axis=1)).max(), 1e-4 * radius**2)
        # of each vertex-face pair no corner of the face is nearer than the segment's end
        v, face = sets.vertex_facet[sets.vertex_facet_kind == 2][:, :2].T
        offset = int((sets.vertex_facet_kind < 2).sum())
        nearest = np.linalg.norm(both[faces[face]].astype(float) - both[v][:, None], axis=2).min(axis=1)
        self.assertTrue((lengths[offset:offset + len(v)] <= nearest + 1e-7).all())


class Packages(unittest.TestCase):
    """Nothing is installed: pip has no index, or the answer is no."""

    KNOWN = {"no_such_module": ("no-such-package==1", "3 MB", "tests")}

    def need(self, in_venv=True, **more):
        prefix = "/venv" if in_venv else sys.base_prefix
        with mock.patch.object(packages, "KNOWN", self.KNOWN), mock.patch.object(sys, "prefix", prefix), \
                contextlib.redirect_stderr(io.StringIO()):
            with self.assertRaises(packages.Missing) as raised:
                packages.need(["no_such_module"], **more)
        return str(raised.exception)

    def test_what_is_missing_is_named_with_size_and_command(self):
        said = self.need()
        for words in ("no-such-package==1 (3 MB installed), for tests", "-m pip install no-such-package==1", "--yes"):
            self.assertIn(words, said)

    def test_a_system_interpreter_is_left_alone(self):
        self.assertIn("python3 -m venv .venv", self.need(in_venv=False, yes=True))

    def test_a_no_installs_nothing_and_names_the_command(self):
        with mock.patch.object(sys.stdin, "isatty", lambda: True, create=True):
            said = self.need(ask=lambda question: "n")
        self.assertIn("nothing was installed; install it with:", said)

    def test_without_a_connection_the_command_is_named(self):
        offline = {"PIP_INDEX_URL": "http://127.0.0.1:9/simple", "PIP_RETRIES": "0", "PIP_CONFIG_FILE": os.devnull,
                   "PIP_NO_INDEX": "1"}
        with mock.patch.dict(os.environ, offline):
            self.assertIn("pip could not install no-such-package==1", self.need(yes=True))

    def test_what_is_there_is_not_asked_for(self):
        packages.need(["json"], ask=lambda question: self.fail("it asked"))


class Bars(unittest.TestCase):
    def said(self, terminal, seconds):
        stream, clock = io.StringIO(), iter(seconds)
        stream.isatty = lambda: terminal
        bar = Progress("frame", stream, lambda: next(clock))
        for done in range(1, len(seconds)):
            bar(done, 4)
        bar.end()
        return stream.getvalue()

    def test_it_says_what_is_left(self):
        self.assertEqual(self.said(False, [0, 30, 35, 90]), "frame 1/4, 2 min left\nframe 3/4, 30 s left\n")
        self.assertIn("\r[######..................] frame 1/4, 3 s left", self.said(True, [0, 1]))


class Ends(unittest.TestCase):
    def test_a_run_whose_program_was_killed_has_ended(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertFalse(view.has_ended(Path(folder), os.getpid()))  # not begun
            (Path(folder) / "run.json").write_text('{"status": "running"}')
            self.assertFalse(view.has_ended(Path(folder), None))
            self.assertFalse(view.has_ended(Path(folder), os.getpid()))
            gone = subprocess.Popen([sys.executable, "-c", ""])
            gone.wait()
            self.assertTrue(view.has_ended(Path(folder), gone.pid))
            (Path(folder) / "run.json").write_text('{"status": "finished"}')
            self.assertTrue(view.has_ended(Path(folder), os.getpid()))


class Scratch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name)
        cls.run_folder = cls.folder / "run"
        done = ogc("run", "cloth_on_sphere", "--scale", "smoke", "--steps", "16", "--audit", "off", "--out",
                   cls.run_folder)
        assert done.returncode == 0, done.stderr
        (cls.folder / "two.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.1\nv 1 0 0.1\nv 0 1 0.1\n"
                                            "f 1 2 3\nf 4 5 6\n")


class Program(Scratch):
    def shown(self, *words):
        """Returns the pixels of the picture that `ogc view` makes."""
        out = self.folder / "picture.png"
        out.unlink(missing_ok=True)
        done = ogc("view", *words, "--png", out)
        self.assertEqual((done.returncode, done.stdout.strip()), (0, str(out)), done.stderr)
        return np.asarray(Image.open(out).convert("RGB")).astype(int)

    def drawn(self, image):
        """Returns which pixels above the scale bar differ from the background."""
        return (np.abs(image - image[0, 0]).max(axis=2) > 20)[:-80]

    def test_a_picture_fills_the_frame_and_a_second_run_stands_beside(self):
        one = self.shown(self.run_folder)
        filled = max(np.ptp(np.flatnonzero(self.drawn(one).any(axis=axis))) / one.shape[1 - axis] for axis in (0, 1))
        self.assertGreater(filled, 0.7)
        two = self.shown(self.run_folder, "--beside", self.run_folder, "--step", "0")
        empty = ~self.drawn(two).any(axis=0)
        runs = np.flatnonzero(np.diff(np.concatenate([[1], empty.astype(int), [1]])))
        self.assertGreaterEqual(len(runs), 2)

    @unittest.skipUnless(HAS_CONTACTS, "SKIPPED: the Python package is not built")
    def test_colours_and_contacts_are_drawn(self):
        image = self.shown(self.run_folder, "--colour", "distance", "--contacts", "--planes")
        for colour in ((0xD5, 0x5E, 0x00), (0x00, 0x72, 0xB2)):
            self.assertGreater(int((image == colour).all(axis=2).sum()), 50, colour)
        self.assertGreater(int((image[40:50, 16:250] != image[40:50, 16:17]).any(axis=2).sum()), 500, "no legend")

    def test_what_a_run_measures_of_each_vertex_colours_it(self):
        folder = self.folder / "measured"
        done = ogc("run", "cloth_on_sphere", "--scale", "smoke", "--audit", "off", "--residual", "--ledger", "--set",
                   "frame_steps=20", "--out", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        run = Run(folder)
        shown = motion_of_run(run)
        rows = [int(step) - 1 for step in shown.steps]
        self.assertTrue(np.isnan(shown.field("residual").of(0)).all(), "the start has no step before it")
        for i, row in enumerate(rows[1:], 1):
            mean = np.nanmean(shown.field("residual").of(i).astype(float))
            # each part is rounded to single precision once
            self.assertAlmostEqual(mean / run.column("residual")[row], 1, delta=2**-23)
            self.assertEqual(shown.field("cut").of(i).sum(), run.column("vertices_cut")[row])
        self.assertEqual(shown.thinned(2).limits("cut"), (0, 1))
        self.assertGreater(run.column("vertices_cut")[rows[1:]].sum(), 0)
        step = str(shown.steps[1:][np.argmax(run.column("vertices_cut")[rows[1:]])])
        plain = self.shown(folder, "--step", step)
        for colour in ("cut", "residual"):
            self.assertGreater(np.abs(self.shown(folder, "--step", step, "--colour", colour) - plain).max(), 50)

    def test_meshes_and_scenes_are_shown(self):
        for words in ([self.folder / "two.obj"], ["cloth_on_sphere", "--scale", "smoke"]):
            self.assertGreater(self.shown(*words).std(), 5)
        page = self.folder / "mesh.html"
        self.assertEqual(ogc("view", self.folder / "two.obj", "--html", page).returncode, 0)
        found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page.read_text(), re.S)
        (code,) = json.loads(found[1])["motions"]
        self.assertTrue(np.allclose(positions_in(code)[0], [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0.1], [1, 0, 0.1],
                                                            [0, 1, 0.1]], rtol=0, atol=1e-5))
        self.assertEqual(unpacked(code["triangles"], np.int32).tolist(), list(range(6)))

    def test_a_scene_stands_beside_a_mesh(self):
        out = self.folder / "both.html"
        done = ogc("view", "cloth_on_sphere", "--scale", "smoke", "--beside", self.folder / "two.obj", "--html", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("two.obj: has one size; --scale belongs to the built-in scenes", done.stderr)
        self.assertIn("<title>cloth_on_sphere beside two</title>", out.read_text())

    def test_a_movie_and_a_page(self):
        movie, page = self.folder / "movie.mp4", self.folder / "page.html"
        done = ogc("view", self.run_folder, "--every", "8", "--mp4", movie, "--html", page)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(movie.read_bytes()[4:8], b"ftyp")
        found = re.search(r"page.html: (\d+) frames, ([\d.]+) MB, positions within ([\d.e-]+) m", done.stdout)
        self.assertTrue(found, done.stdout)
        self.assertAlmostEqual(float(found[2]), page.stat().st_size / 1e6, delta=0.006)

    def test_a_page_holds_the_frames_of_the_run(self):
        run = Run(self.run_folder)
        page = run.view(colour="speed")
        self.assertIn("<iframe srcdoc=", page._repr_html_())
        (code,) = page.data["motions"]
        decoded = positions_in(code)
        self.assertEqual(code["steps"], [int(path.stem[6:]) for path in run.frames])
        for i, path in enumerate(run.frames):
            x = run.frame(path).positions
            self.assertLessEqual(np.abs(decoded[i] - x).max(), page.error * (1 + 1e-6))
        thinned = motion_of_run(run, every=3)
        self.assertEqual(thinned.steps.tolist(), code["steps"][::-1][::3][::-1])

    def test_without_a_display_the_way_to_a_picture_is_named(self):
        for words in (["view", self.run_folder], ["run", "cloth_on_sphere", "--scale", "smoke", "--view", "--out",
                                                  self.folder / "never"]):
            done = ogc(*words)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("there is no display", done.stderr)
            self.assertIn("--png view.png", done.stderr)
        self.assertFalse((self.folder / "never").exists())

    def test_what_is_wrong_is_said(self):
        png = ("--png", self.folder / "none.png")
        empty = self.folder / "empty"
        empty.mkdir()
        cases = [((self.run_folder, "--colour", "cut", *png), {}, "has no cut: its frames hold none; ogc run --ledger"),
                 ((self.run_folder, "--colour", "heat", *png), {}, "there is no colour 'heat'; run has: body"),
                 ((self.folder / "two.obj", "--colour", "speed", *png), {}, "a mesh has positions alone"),
                 ((self.folder / "nothing.obj", *png), {}, "nothing.obj"),
                 ((empty, *png), {}, "empty"),
                 ((self.run_folder, "--follow", "--html", "x.html"), {}, "--follow shows a run that goes on"),
                 ((self.run_folder, *png), {"OGC_PYTHON": "/nowhere/python3"}, "/nowhere/python3 can't be started"),
                 ((self.run_folder, *png), {"OGC_ROOT": "/nowhere"}, "OGC_ROOT names /nowhere"),
                 ((self.run_folder, "--png", "/nowhere/a.png"), {}, "/nowhere/a.png")]
        for words, variables, said in cases:
            with self.subTest(said=said):
                done = ogc("view", *words, **variables)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(said, done.stderr)
                self.assertNotIn("Traceback", done.stderr)
        self.assertFalse(png[1].exists())

    def test_an_interpreter_without_numpy_is_named_with_what_it_lacks(self):
        bare = self.folder / "bare"
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", bare], check=True, capture_output=True)
        for words in (["view", self.run_folder, "--html", "x.html"], ["export", self.run_folder, "--format", "usd"]):
            done = ogc(*words, OGC_PYTHON=str(bare / "bin" / "python"), PYTHONPATH="")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("lacks numpy==2.4.6 (75 MB installed)", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_sheets_are_removed(self):
        place = self.folder / "temporary"
        place.mkdir()
        done = ogc("view", self.folder / "two.obj", "--html", self.folder / "two.html", TMPDIR=str(place))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(list(place.glob("ogc-*")), [])

    def test_the_newest_frame_is_drawn_while_the_run_goes_on(self):
        """In the end the picture is that of the last frame."""
        live, folder = self.folder / "live.png", self.folder / "live"
        done = ogc("run", "cloth_on_sphere", "--scale", "smoke", "--steps", "6", "--audit", "off", "--out", folder,
                   "--view-png", live)
        self.assertEqual(done.returncode, 0, done.stderr)
        last, end = self.shown(folder), time.monotonic() + 120
        while time.monotonic() < end and not (
                live.exists() and (np.asarray(Image.open(live).convert("RGB")) == last).all()):
            time.sleep(0.2)
        self.assertTrue((np.asarray(Image.open(live).convert("RGB")) == last).all(), "not the last frame")

    def test_a_run_does_not_wait_for_its_picture(self):
        """The viewer here never ends; the run does, and the viewer is still there."""
        viewer, number = self.folder / "viewer", self.folder / "number"
        viewer.write_text(f'#!/bin/sh\ncase "$*" in *--check*) exit 0 ;; esac\necho $$ > {number}\nexec sleep 600\n')
        viewer.chmod(0o755)
        # the test reads the program's output to its end, which a viewer that kept it open would delay
        done = ogc("run", "cloth_on_sphere", "--scale", "smoke", "--steps", "4", "--out", self.folder / "alone",
                   "--view-png", self.folder / "x.png", OGC_PYTHON=str(viewer))
        self.assertEqual(done.returncode, 0, done.stderr)
        end = time.monotonic() + 60
        while not number.exists() and time.monotonic() < end:
            time.sleep(0.05)
        os.kill(int(number.read_text()), 15)  # raises if it has ended

    def test_a_resumed_run_takes_a_picture_and_no_settings(self):
        done = ogc("run", "--resume", self.run_folder, "--view-png", self.folder / "r.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn("is a finished run", done.stderr)


class Windows(Scratch):
    @unittest.skipUnless(importlib.util.find_spec("polyscope"), "SKIPPED: polyscope is not installed")
    def test_a_window_shows_frames_colours_and_the_row_of_a_pick(self):
        from plots.window import Window
        motion = motion_of_run(Run(self.run_folder))
        window = Window([motion, motion], "speed", headless=True)
        window.go(3)
        window.colour = "bound"
        window.paint()
        self.assertEqual(window.picked(), [])
        _, name, number, part = window.parts[2]  # of the second motion
        picked = types.SimpleNamespace(structure_name=name, structure_data={"element_type": "vertex", "index": 7})
        with mock.patch.multiple(window.ps, have_selection=lambda: True, get_selection=lambda: picked):
            self.assertEqual(window.picked(), motion.row(3, part.start + 7))
        self.assertEqual(number, 1)
        image = window.ps.screenshot_to_buffer()
        self.assertGreater(image[..., :3].std(), 5)


class UsdFiles(Scratch):
    @unittest.skipIf(importlib.util.find_spec("pxr"), "usd-core is installed")
    def test_without_usd_core_its_size_and_command_are_named(self):
        for words in (["export", self.run_folder, "--format", "usd"], ["audit", self.folder / "two.usda"]):
            (self.folder / "two.usda").write_text("#usda 1.0\n")
            done = ogc(*words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("usd-core==26.11 (157 MB installed)", done.stderr)

    @unittest.skipUnless(importlib.util.find_spec("pxr"), "SKIPPED: usd-core is not installed")
    def test_a_run_reads_back_to_the_same_bits_and_is_audited_as_the_run(self):
        done = ogc("export", self.run_folder, "--format", "usd", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        (file,) = json.loads(done.stdout)["files"]
        run = Run(self.run_folder)
        positions, triangles, remarks = usd.read(file)
        self.assertEqual(remarks, [])
        self.assertEqual(positions.shape[0], len(run.frames))
        for i, path in enumerate(run.frames):
            self.assertTrue((positions[i] == run.frame(path).positions).all())
        self.assertTrue((triangles == run.topology[0]).all())
        ours, theirs = (json.loads(ogc("audit", what, "--json").stdout) for what in (self.run_folder, file))
        self.assertEqual([s["count"] for s in ours["states"]], [s["count"] for s in theirs["states"]])
        self.assertEqual(ours["states"][-1]["smallest_distances"]["edge_edge"]["distance"],
                         theirs["states"][-1]["smallest_distances"]["edge_edge"]["distance"])

    @unittest.skipUnless(importlib.util.find_spec("pxr"), "SKIPPED: usd-core is not installed")
    def test_transformations_units_and_polygons_are_applied_and_said(self):
        file = self.folder / "moved.usda"
        file.write_text("""#usda 1.0
(
  metersPerUnit = 0.01
  upAxis = "Y"
)
def Xform "a" {
  double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 2: (100, 0, 0) }
  uniform token[] xformOpOrder = ["xformOp:translate"]
  def Mesh "m" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
  }
  def Mesh "hidden" {
    token visibility = "invisible"
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
  }
}
""")
        positions, triangles, remarks = usd.read(file)
        self.assertEqual(triangles.tolist(), [[0, 1, 2], [0, 2, 3]])
        self.assertTrue(np.allclose(positions[1] - positions[0], [1, 0, 0], atol=1e-15))
        self.assertTrue(np.allclose(positions[0][2], [0.01, 0.01, 0], atol=1e-17))
        self.assertEqual(len(remarks), 3, remarks)
        for content, words in (("#usda 1.0\n", "no visible mesh"), ("nothing", "can't open it")):
            file.write_text(content)
            with self.assertRaisesRegex(RunError, words):
                usd.read(file)


class Stills(unittest.TestCase):
    def test_colours_are_those_of_all_pictures(self):
        self.assertEqual((motion.FRONTS, motion.BACKS, motion.STILL), (style.FRONTS, style.BACKS, style.BODY))

    def test_segments_lie_where_the_picture_has_their_ends(self):
        """A red body at the end of a segment is drawn where the segment ends."""
        frames = np.zeros((1, 3, 3), np.float32)
        frames[0] = [[0, 0, 0], [1, 0, 0], [0.4, 0.7, 0.2]]
        stage = stills.Stage([plain(frames, np.array([[0, 1, 2]], np.int32))])
        for place in frames[0].astype(float):
            near = place + 0.004 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
            red = (near, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]), "#FF0000", "#FF0000")
            image = render.picture([red], stage.camera, stills.SIZE, bar=False).astype(int)
            rows, columns = np.nonzero(image[..., 0] - image[..., 1] > 60)
            (x, y), _ = stage._on_picture(np.stack([near.mean(axis=0)] * 2)[None], stills.SIZE)[0]
            self.assertLess(np.hypot(columns.mean() - x, rows.mean() - y), 3)


if __name__ == "__main__":
    unittest.main(verbosity=1)
