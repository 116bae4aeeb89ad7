"""What compare/deviations.md says of defaults is what the program has: each named default is asked of `ogc run --help`,
or of the scenes as they are written. A sentence that is worded anew must be entered here anew, and every setting and
value that the page names must exist.

Usage: deviations.py SOURCE_DIR OGC. The standard library is enough.
"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from functools import lru_cache
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), sys.argv[2]
del sys.argv[1:3]
PAGE = (SOURCE / "compare/deviations.md").read_text()

# Words of the page -> (setting, its default).
DEFAULTS = {
    "at most 4 r (`detection_radius_cap`;": ("detection_radius_cap", "4"),
    "(at most `guess_rounds`, default 16; 1 is the paper's)": ("guess_rounds", "16"),
    "a ball about X_prev | the same by default; `bounds=planes` is a variant": ("bounds", "ball"),
    "k'_c = τ k_c (r − τ)": ("contact_activation", "ogc"),
    "each position is truncated before it is written; the reference's VBD has both (`reference_vbd_cut_after`)":
        ("reference_vbd_cut_after", "update"),
    "colours of the k-th connected component are rotated by k": ("reference_vbd_colours", "turned"),
    "|w\\| Σ \\|w_u\\|": ("reference_vbd_contact_blocks", "majorised"),
    "the root of the secular equation": ("rod_orientation", "exact"),
    "frames turned along with their segments at the guess": ("rod_start", "turned"),
    "damping by vertex, `damping=per_vertex` | the authors' code | off;": ("damping", "strain"),
    "the same by default; `newton_truncation=pair`": ("newton_truncation", "vertex"),
    "‖p‖_∞/h is below 10⁻² of the diagonal": ("ipc_tolerance", "0.01"),
    "a step ends where ‖p‖_∞/h": ("ipc_stopping", "displacement"),
}
VOLUMES = "the dancer of `dress` and the jaws of `robot_shirt` are volumes, with γ_e = 0.01"
SURFACES = "With `--set body_contact=surface` a body has the ordinary contact"
FRACTION_OF_SURFACES = "γ_e is then 0"
MEMBRANE = "stable Neo-Hookean on F (3×2)"
GRID = "a grid of 88 × 87 × 2 vertices"
# Constants that contracts and kernels state: words of the page -> (file, what it says).
STATED = {
    "sine between its edge and a side of a triangle is below 32 u; the contract accepts that up to 64 u":
        ("compare/stages/bending.hpp", "bending_needle = 64;"),
    "below 2⁻⁹ of its longest side": ("compare/stages/contact_force.hpp", "a height below 2⁻⁹ of its longest side"),
    "below 2⁻²³ r slope and curvature": ("fast/kernels/contact_force.hpp", "0x1p-23f * contact_radius"),
    "‖e×e'‖² < 10⁻⁶‖e‖²‖e'‖²": ("fast/kernels/contact_force.hpp", "sine < 1e-6f * aa * bb"),
    "a side has at least a sixteenth": ("compare/dat.md", "a sixteenth of 2γ_p g"),
}
# name, unit, default, what is allowed
ROW = re.compile(r"^  ([a-z]\w+) {2,}(\S+) {2,}(\S(?:\S| (?! ))*) {2,}(\S.*)$", re.M)
# Other names of the page: wrong forms of the judge, and a scene.
NOT_SETTINGS = {"ogc_as_printed", "as_published", "block_ends_at_radius", "block_of_own_weight_alone", "robot_shirt"}
NAMED = re.compile(r"`(?:--set )?([a-z]\w*_[a-z_]+|bounds|damping|membrane)(?:=(\w+))?`")


@lru_cache(maxsize=1)
def settings():
    """Returns setting -> (default, what is allowed) as `ogc run --help` says."""
    said = subprocess.run([OGC, "run", "--help"], capture_output=True, text=True, check=True).stdout
    return {name: (default, allowed) for name, _, default, allowed in ROW.findall(said)}


def scene(name, scale="smoke"):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([OGC, "scenes", name, "--scale", scale, "--write", folder], check=True, capture_output=True)
        return json.loads((Path(folder) / f"{name}.json").read_text())


def sizes():
    """Returns scene -> scale -> vertices."""
    said = subprocess.run([OGC, "scenes", "--json"], capture_output=True, text=True, check=True).stdout
    return {each["name"]: {size["scale"]: size["vertices"] for size in each["scales"]}
            for each in json.loads(said)["scenes"]}


def contacts(found):
    return {body["name"]: body["body_contact"] for body in found["bodies"]}


def wrong(page, there):
    """Returns sentences about what a page says of defaults and `there`, setting -> (default, allowed), does not."""
    for words, (name, value) in DEFAULTS.items():
        if words not in page:
            yield f"the page no longer says '{words}': enter its new words in {Path(__file__).name}"
        elif there[name][0] != value:
            yield f"'{words}': the default of {name} is {there[name][0]}, not {value}"
    stages = {path.stem for path in (SOURCE / "compare/stages").glob("*.hpp")}
    for name, value in NAMED.findall(page):
        if name not in there and name not in stages | NOT_SETTINGS:
            yield f"`{name}` is no setting"
        elif value and name in there and value not in there[name][1].split(", "):
            yield f"`{name}={value}`: {name} is one of {there[name][1]}"


class Defaults(unittest.TestCase):
    def test_the_page_says_what_the_program_has(self):
        self.assertEqual(list(wrong(PAGE, settings())), [])

    def test_another_default_other_words_and_a_wrong_name_are_found(self):
        there = settings()
        for page, other, words in ((PAGE, {"guess_rounds": ("8", "")}, "default of guess_rounds is 8"),
                                   (PAGE.replace("default 16", "default 8"), {}, "no longer says"),
                                   (PAGE + "`newton_trunkation`", {}, "`newton_trunkation` is no setting"),
                                   (PAGE + "`bounds=boxes`", {}, "bounds is one of ball")):
            found = list(wrong(page, {**there, **other}))
            self.assertEqual(len(found), 1, found)
            self.assertIn(words, found[0])

    def test_bodies_are_volumes_by_default_and_surfaces_where_asked(self):
        for words in (VOLUMES, SURFACES, FRACTION_OF_SURFACES):
            self.assertIn(words, PAGE)
        dress, shirt = scene("dress"), scene("robot_shirt")
        self.assertEqual(contacts(dress)["body"], "volume")
        self.assertEqual({contacts(shirt)[name] for name in ("left_gripper", "right_gripper")}, {"volume"})
        self.assertEqual([found["settings"]["detection_fraction"] for found in (dress, shirt)], [0.01, 0.01])
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([OGC, "run", "dress", "--scale", "smoke", "--steps", "1", "--set", "body_contact=surface",
                            "--out", f"{folder}/run"], check=True, capture_output=True)
            manifest = json.loads((Path(folder) / "run/run.json").read_text())
        self.assertEqual(manifest["settings"]["detection_fraction"]["value"], 0)
        self.assertEqual(contacts(manifest["scene"])["body"], "surface")

    def test_every_cloth_has_the_named_membrane(self):
        self.assertIn(MEMBRANE, PAGE)
        self.assertGreater(len(sizes()), 10)
        for name in sizes():
            models = {body["material"].get("membrane", "none") for body in scene(name)["bodies"]}
            self.assertLessEqual(models, {"none", "stable_neo_hookean"}, name)

    def test_the_mat_is_the_named_grid(self):
        self.assertIn(GRID, PAGE)
        self.assertEqual(sizes()["mat_twist"]["paper"], 88 * 87 * 2)

    def test_constants_are_those_of_the_code(self):
        for words, (name, says) in STATED.items():
            self.assertIn(words, PAGE)
            self.assertIn(says, (SOURCE / name).read_text(), words)


if __name__ == "__main__":
    unittest.main()
