"""Draws the figure and the movie of a finished run through the figure script, and checks that it refuses in words what
it can't draw.

Usage: draw_figure.py SOURCE_DIR RUN_FOLDER SCENE_MODULE. Exit status 77: skipped, a Python package is missing (the
reason is printed).
"""

import json
import runpy
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


def run_script(source, module, folder, out, option="--out"):
    command = [sys.executable, "-m", f"paper_figures.figures.{module}", str(folder), option, str(out)]
    return subprocess.run(command, cwd=source, capture_output=True, text=True, check=False)


def check_drawn(source, module, folder, scratch):
    out = scratch / "figure.png"
    done = run_script(source, module, folder, out)
    assert done.returncode == 0, done.stderr
    image = matplotlib.image.imread(out)
    assert image.shape[0] > 800 and image.shape[1] > 1000, image.shape
    assert image[..., :3].std() > 0.05, "the figure is nearly uniform"
    assert out.with_suffix(".pdf").stat().st_size > 10_000


def check_movie(source, module, folder, scratch):
    """A movie where the packages for it are there; words where they are not."""
    out = scratch / "movie.mp4"
    done = run_script(source, module, folder, out, "--movie")
    if done.returncode == 0:
        assert out.read_bytes()[4:8] == b"ftyp" and out.stat().st_size > 2_000, "no movie"
    else:
        assert "can't be imported" in done.stderr, done.stderr


def check_teaser(source, folder, scratch):
    """The teaser of one run; of a scene that it knows no camera of, words."""
    out, other = scratch / "teaser.png", scratch / "other"
    sentence = said(source, "fig01_teaser", out, folder)
    if not out.exists():
        assert "PyVista can't be imported" in sentence, sentence
        return
    assert matplotlib.image.imread(out)[..., :3].std() > 0.02, "the teaser is nearly uniform"
    out.unlink()
    shutil.copytree(folder, other)
    manifest = json.loads((other / "run.json").read_text())
    manifest["scene"]["name"] = "unknown"
    (other / "run.json").write_text(json.dumps(manifest))
    check_words(said(source, "fig01_teaser", out, other), "of which the teaser knows no camera", out)


def check_refused(source, module, folder, scratch):
    """Each thing that is wrong with a run is said in words, with status 1, no traceback and no picture."""
    copy, out = scratch / "copy", scratch / "none.png"
    shutil.copytree(folder, copy)
    good, rows = json.loads((copy / "run.json").read_text()), (copy / "steps.csv").read_text()
    faults = [({"status": "running"}, rows, "not finished"), ({"guarantee_kept": False}, rows, "the audit failed"),
              ({"scene": {**good["scene"], "name": "knot"}}, rows, "is a run of 'knot'"),
              ({}, rows.replace("discrete_detections", "pairs", 1),
               "has no column 'discrete_detections'; it has: step"),
              ({}, rows.splitlines()[0] + "\n", "holds no step yet"), ({}, None, "steps.csv is missing")]
    for changes, table, words in faults:
        (copy / "run.json").write_text(json.dumps({**good, **changes}))
        (copy / "steps.csv").write_text(table) if table else (copy / "steps.csv").unlink()
        check_words(said(source, module, copy, "--out", out), words, out)
    check_former_columns(source, copy / "steps.csv", rows)
    check_words(said(source, module, scratch / "nowhere", "--out", out),
                "is no run folder: it has no run.json. Make one with: ogc run", out)


def check_former_columns(source, path, rows):
    """A run of format 1, whose columns of cut vertices have other names, reads as one of today."""
    sys.path.insert(0, str(source))
    from ogc_testbed.runs import Run
    former = rows.replace("vertices_cut", "vertices_at_bound", 1).replace("share_cut", "share_at_bound", 1)
    if former == rows:
        sys.exit(f"{path} has no column of cut vertices")
    path.write_text(rows)
    today = Run(path.parent)
    path.write_text(former)
    before = Run(path.parent)
    for column in ("vertices_cut", "share_cut"):
        if list(before.column(column)) != list(today.column(column)) or before.units[column] != "1":
            sys.exit(f"column {column} of a run of format 1 is not that of today")


def said(source, module, *words):
    """The sentence that a script ends with, run in this process because starting Python takes longer than refusing;
    another exception than a sentence is not caught."""
    sys.path.insert(0, str(source))
    before, sys.argv = sys.argv, [module, *map(str, words)]
    try:
        runpy.run_path(f"{source}/paper_figures/figures/{module}.py", run_name="__main__")
    except SystemExit as end:
        return end.code
    finally:
        sys.argv = before
    return "nothing was wrong"


def check_words(sentence, words, out):
    assert isinstance(sentence, str) and words in sentence, (words, sentence)
    assert not out.exists(), words


def check_mixture(source, folder):
    """Runs of one commit are said to be so; of several, which is whose."""
    sys.path.insert(0, str(source))
    from ogc_testbed.runs import Run, commits_in_words

    first, second = Run(folder), Run(folder)
    dirty = " (dirty)" if first.manifest.get("dirty") else ""
    assert commits_in_words([first, second]) == f"commit {first.manifest['commit'][:10]}{dirty}"
    second.manifest["commit"] = "0" * 40
    said = commits_in_words([first, second])
    assert said.startswith("MIXED, not one program's runs: ") and "of commit 0000000000" in said, said


def check_damaged(source, folder, scratch):
    """A frame whose content is not what its checksum says is refused by name; one of format 1, without any, is read."""
    import h5py
    sys.path.insert(0, str(source))
    from ogc_testbed.runs import Run, RunError

    run = Run(folder)
    path = scratch / run.frames[-1].name
    path.write_bytes(run.frames[-1].read_bytes())
    whole = run.frame(path)
    with h5py.File(path, "r+") as file:
        file["bounds"][0] += 1
    try:
        said = run.frame(path) and "nothing was wrong"
    except RunError as error:
        said = str(error)
    assert path.name in said and "damaged" in said, said
    with h5py.File(path, "r+") as file:
        del file.attrs["crc32"]
    assert run.frame(path).step == whole.step


if __name__ == "__main__":
    source_dir, run_folder, scene_module = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as name:
        check_drawn(source_dir, scene_module, run_folder, Path(name))
        check_movie(source_dir, scene_module, run_folder, Path(name))
        check_teaser(source_dir, run_folder, Path(name))
        check_refused(source_dir, scene_module, run_folder, Path(name))
        check_mixture(source_dir, run_folder)
        check_damaged(source_dir, run_folder, Path(name))
    print("drawn, and refused where it should be")
