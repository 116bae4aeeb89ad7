"""The container recipes do what their one step does, and nothing besides, and the step's commands are understood. The
step itself runs in bare_root.sh.

Usage: recipes.py SOURCE_DIR
"""

import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
FOLDER = SOURCE / "experiments/container"
STEP = "/ogc/experiments/container/steps"
# What a recipe says besides its step: the pattern of a line.
CONTAINERFILE = (r"ARG BASE=debian:12", r"FROM \$\{BASE\}", r"ARG OGC_CUDA=OFF", r"COPY \. /ogc",
                 rf"RUN OGC_CUDA=\$\{{OGC_CUDA\}} {STEP}", r"WORKDIR /ogc", r'ENTRYPOINT \["/ogc/build/default/ogc"\]')
DEFINITION = (r"Bootstrap: docker", r"From: debian:12", r"%files", r"\. /ogc", r"%post", STEP, r"%runscript",
              r'exec /ogc/build/default/ogc "\$@"')


def lines_of(path):
    return [line.strip() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]


class Recipes(unittest.TestCase):
    def test_each_has_one_step_and_says_that_no_image_was_made(self):
        self.assertEqual({path.name for path in FOLDER.iterdir()}, {"Containerfile", "ogc.def", "steps"})
        for name, allowed in (("Containerfile", CONTAINERFILE), ("ogc.def", DEFINITION)):
            found = lines_of(FOLDER / name)
            self.assertEqual([line for line in found if not any(re.fullmatch(each, line) for each in allowed)], [])
            self.assertEqual(sum(line.endswith(STEP) for line in found), 1, name)
            self.assertTrue((FOLDER / name).read_text().startswith("# UNBUILT"), name)

    def test_the_step_s_commands_are_understood(self):
        commands = [line for line in lines_of(FOLDER / "steps") if line.startswith("experiments/")]
        self.assertTrue(commands)
        for command in commands:
            done = subprocess.run(command.split(), cwd=SOURCE, env={**os.environ, "OGC_PARSE_ONLY": "1"},
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
