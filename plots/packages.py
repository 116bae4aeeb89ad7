"""Packages that a few commands need: named with their size, and installed into this Python's environment after a
question."""

import importlib.util
import subprocess
import sys

# module -> (what pip installs, its size when installed with what it brings, what it is for)
KNOWN = {
    "numpy": ("numpy==2.4.6", "75 MB", "all arrays"),
    "polyscope": ("polyscope==2.6.1", "14 MB", "windows"),
    "pxr": ("usd-core==26.11", "157 MB", "USD files"),
    "pyvista": ("pyvista==0.49.1 vtk==9.7.2", "580 MB", "pictures without a display"),
    "imageio_ffmpeg": ("imageio==2.38.1 imageio-ffmpeg==0.8.1", "168 MB", "movies"),
    "h5py": ("h5py==3.16.0", "17 MB", "the frames of runs"),
    "PIL": ("pillow==13.0.0", "22 MB", "pictures"),
}


class Missing(Exception):
    """Raised if a package is missing and was not installed; the message names the command that installs it."""


def begin(program):
    """Called before NumPy is imported: without it the program ends in words, with status 2."""
    try:
        need(["numpy"], "--yes" in sys.argv)
    except Missing as problem:
        print(f"{program}: {problem}", file=sys.stderr)
        sys.exit(2)


def need(modules, yes=False, ask=input):
    """Installs what is missing of these modules, if the user wants it. `yes`: nothing is asked."""
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    if not missing:
        return
    words = [word for name in missing for word in KNOWN[name][0].split()]
    command = [sys.executable, "-m", "pip", "install", *words]
    sentence = "; ".join(f"{KNOWN[name][0]} ({KNOWN[name][1]} installed), for {KNOWN[name][2]}" for name in missing)
    if sys.prefix == sys.base_prefix:  # an interpreter of the system, where pip must not write
        raise Missing(f"{sys.executable} lacks {sentence}. Make an environment of this project's own with: "
                      f"python3 -m venv .venv && .venv/bin/python -m pip install {' '.join(words)} "
                      "-r plots/requirements.txt")
    by_hand = f"install it with: {' '.join(command)}"
    if not yes and not sys.stdin.isatty():
        raise Missing(f"{sys.executable} lacks {sentence}; {by_hand}, or answer with --yes")
    if not yes and ask(f"{sys.executable} lacks {sentence}. Install it there? [y/N] ").strip().lower() not in (
            "y", "yes"):
        raise Missing(f"nothing was installed; {by_hand}")
    print(f"installing {' '.join(words)}", file=sys.stderr)
    done = subprocess.run([*command, "-q", "--disable-pip-version-check"], stdout=subprocess.DEVNULL,
                          check=False)
    importlib.invalidate_caches()
    if done.returncode != 0 or any(importlib.util.find_spec(name) is None for name in missing):
        raise Missing(f"pip could not install {' '.join(words)} (no connection?); when there is one, {by_hand}")
