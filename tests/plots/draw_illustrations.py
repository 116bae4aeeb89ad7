"""Computes every illustration, draws it, and checks that the pictures show something and that the numbers behind them
hold.

Usage: draw_illustrations.py SOURCE_DIR OGC. Exit status 77: skipped, a Python package is missing (the reason is
printed).
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import matplotlib.image
    import numpy as np
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(77)

FIGURES = {"fig02_models", "fig03", "fig04", "fig05", "fig06", "fig07", "fig08", "fig09", "fig22"}


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


def check_picture(path):
    image = matplotlib.image.imread(path)[..., :3]
    assert image.shape[0] > 500 and image.shape[1] > 1000, (path, image.shape)
    inked = (image < 0.95).any(axis=2)
    assert 0.005 < inked.mean() < 0.6, (path, inked.mean())
    thirds = np.array_split(inked, 3, axis=1)
    assert all(part.mean() > 0.001 for part in thirds), f"{path}: a third of the picture is blank"
    for border in (inked[0], inked[-1], inked[:, 0], inked[:, -1]):
        assert not border.any(), f"{path}: something is cut off at the border"
    assert path.with_suffix(".pdf").stat().st_size > 5_000, path


def panels_of(folder, figure):
    panels = json.loads((folder / f"{figure}.json").read_text())["panels"]
    return [{layer["name"]: layer for layer in panel["layers"]} for panel in panels]


def check_numbers(folder):
    step = panels_of(folder, "fig09")
    whole, parts = np.array(step[1]["after"]["values"]), np.array(step[3]["after"]["values"])
    assert np.ptp(whole) == 0 and 0 < whole[0] < 1
    assert abs(parts.max() - 1) < 1e-5 and parts.mean() > whole[0], "per-vertex bounds leave more of the step"
    assert (np.array(step[2]["bounds"]["values"]) > 0).all()
    limits = panels_of(folder, "fig22")
    speed, rounds = np.array(limits[3]["rounds"]["points"])[:, :2].T
    assert (np.diff(speed) > 0).all() and (np.diff(rounds) >= 0).all() and rounds[0] == 1 and rounds[-1] > 16, rounds
    force = np.array(limits[1]["force of the right facet"]["points"])[:, 1]
    assert np.abs(np.diff(force)).max() > 10 * np.median(np.abs(np.diff(force))) and np.abs(np.diff(force)).max() > 0.1
    sets = panels_of(folder, "fig03")
    assert [len(panel["OGC"]["lines"]) for panel in sets] == [1, 0, 2]
    layers = np.array(panels_of(folder, "fig04")[2]["layers"]["values"])
    assert layers.max() >= 2 and (layers > 0).mean() > 0.2


def main(source, program):
    listed = run(Path(source) / "experiments" / "reproduce", "--list")
    assert FIGURES <= {line.split()[0] for line in listed.splitlines()}, listed
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(program, "illustrate", "--out", folder)
        assert {path.stem for path in folder.glob("*.json")} == FIGURES
        drawn = run(sys.executable, "-m", "paper_figures.figures.illustrations", folder, cwd=source).split()
        assert {Path(path).stem for path in drawn} == FIGURES, drawn
        for path in drawn:
            check_picture(Path(path))
        again = run(sys.executable, "-m", "paper_figures.figures.illustrations", folder, "fig06", cwd=source).split()
        assert [Path(path).stem for path in again] == ["fig06"], "captions beside pictures are no illustrations"
        check_numbers(folder)
    print(f"{len(FIGURES)} figures computed and drawn")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
