"""Draws the figure of a finished run through the figure script, and checks that it refuses an unfinished one in words.

Usage: draw_figure.py SOURCE_DIR RUN_FOLDER SCENE_MODULE. Exit status 77: skipped, a Python package is missing (the reason is printed).
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py  # noqa: F401
    import matplotlib.image
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(77)


def run_script(source, module, folder, out):
    command = [sys.executable, "-m", f"paper_figures.{module}", str(folder), "--out", str(out)]
    return subprocess.run(command, cwd=source, capture_output=True, text=True, check=False)


def check_drawn(source, module, folder, scratch):
    out = scratch / "figure.png"
    done = run_script(source, module, folder, out)
    assert done.returncode == 0, done.stderr
    image = matplotlib.image.imread(out)
    assert image.shape[0] > 800 and image.shape[1] > 1000, image.shape
    assert image[..., :3].std() > 0.05, "the figure is nearly uniform"
    assert out.with_suffix(".pdf").stat().st_size > 10_000


def check_refused(source, module, folder, scratch):
    copy = scratch / "copy"
    shutil.copytree(folder, copy)
    manifest = json.loads((copy / "run.json").read_text())
    manifest["status"] = "running"
    (copy / "run.json").write_text(json.dumps(manifest))
    done = run_script(source, module, copy, scratch / "none.png")
    assert done.returncode != 0 and "not finished" in done.stderr, done.stderr
    (copy / "steps.csv").unlink()
    done = run_script(source, module, copy, scratch / "none.png")
    assert done.returncode != 0 and "steps.csv is missing" in done.stderr, done.stderr


if __name__ == "__main__":
    source_dir, run_folder, scene_module = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as name:
        check_drawn(source_dir, scene_module, run_folder, Path(name))
        check_refused(source_dir, scene_module, run_folder, Path(name))
    print("drawn, and refused where it should be")
