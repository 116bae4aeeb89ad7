"""`yarn_twist` without the motion that turns it, as a scene file: what was twisted is let go, or hangs as it is from
the start. Python's own library is enough.
"""

import json
import subprocess
from dataclasses import dataclass

SCENE, TURNED = "yarn_twist", "lower"


@dataclass(frozen=True)
class Release:
    """The scene of a scale as a file below the folder of the runs (jobs.Job)."""

    scale: str

    @property
    def path(self):
        return f"scenes/released_{self.scale}/{SCENE}.json"

    def write(self, program, root):
        """Where it is missing."""
        path = root / self.path
        if path.is_file():
            return
        subprocess.run([str(program), "scenes", SCENE, "--scale", self.scale, "--write", str(path.parent)], check=True,
                       stdout=subprocess.DEVNULL)
        scene = json.loads(path.read_text())
        scene["motions"] = [motion for motion in scene["motions"] if motion["name"] != TURNED]
        scene["name"] = f"{SCENE}_released"
        path.write_text(json.dumps(scene, indent=1))
