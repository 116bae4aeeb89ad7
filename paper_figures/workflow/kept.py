"""Prepares the files of runs and pictures for results: rows of a long run thinned (thinned.py), a scene once for all
manifests that name its hash, settings without their explanations, pictures as PNG or WebP.
"""

import gzip
import hashlib
import io
import json
import re

from paper_figures.workflow import thinned
from paper_figures.workflow.evidence import ROWS, SCENES, EvidenceError, run_at
from paper_figures.workflow.jobs import AUDIT, PROCESSOR_TIME

LONG = 2**15  # bytes of rows; larger files are compressed
QUALITY = 90  # of WebP
FEW = 4096  # colours of a drawing at most: those of its lines and of the edges of its letters
PICTURES, MOVIES = (".png", ".webp", ".svg"), (".mp4",)


class AcceptError(Exception):
    """Raised if a figure's files can't become accepted results; the message names the file and a remedy."""


def relative(text):
    """Returns a command without the folders of absolute paths, which mean nothing on another machine."""
    return re.sub(r"(?<![^\s=])/\S*/", "", text)


def compressed(name, data):
    """Returns (name, data) as kept: long rows with gzip, which evidence.py reads as well."""
    return (f"{name}.gz", gzip.compress(data, mtime=0)) if len(data) > LONG else (name, data)


def file_of(path):
    """Returns (suffix, bytes) of what is kept of a figure's file. A picture is kept without loss where that is small,
    as drawings are, and as WebP where it is rendered."""
    return picture(path.read_bytes()) if path.suffix == ".png" else (path.suffix, path.read_bytes())


def picture(data):
    """Returns (suffix, bytes) of a PNG as kept: as PNG if it has few colours, as a drawing has, otherwise as WebP.
    Throws AcceptError."""
    from PIL import Image, UnidentifiedImageError

    try:
        image = Image.open(io.BytesIO(data)).convert("RGB")
    except UnidentifiedImageError as error:
        raise AcceptError(f"a picture is no PNG ({error}): draw it again") from error
    out, drawn = io.BytesIO(), image.getcolors(FEW) is not None
    if drawn:
        image.save(out, "PNG", optimize=True)
    else:
        image.save(out, "WEBP", quality=QUALITY, method=6)
    return ".png" if drawn else ".webp", out.getvalue()


def run_files(path, stem):
    """Returns manifest, scene, rows, iterations and processor time of the run whose manifest is `path`."""
    rows = path.with_name("steps.csv")
    text = rows.read_text() if rows.is_file() else ""
    manifest, scene = compact(json.loads(path.read_text()))
    found = [*scene]
    if thinned.is_long(text):
        manifest["whole_run"] = {**thinned.whole_run(text), **costs_of(path.parent)}
        found.append(compressed(f"{stem}_{ROWS[1]}", thinned.hundreds(text).encode()))
    elif text:
        found.append(compressed(f"{stem}_{ROWS[0]}", text.encode()))
    kept = ("iterations.csv", PROCESSOR_TIME)
    found += [compressed(f"{stem}_{name}", path.with_name(name).read_bytes()) for name in kept
              if path.with_name(name).is_file()]
    if path.with_name(AUDIT).is_file():
        audit = json.loads(path.with_name(AUDIT).read_text())
        audit.pop("steps", None)  # `states` is their number
        found.append((f"{stem}_{AUDIT}", (json.dumps(audit) + "\n").encode()))
    return [(f"{stem}_run.json", (json.dumps(manifest, indent=1) + "\n").encode()), *found]


def compact(manifest):
    """Returns the manifest without folders of the machine, explanations of settings, and the scene, which the file
    beside it holds: (manifest, [(name, bytes)])."""
    manifest = dict(manifest)
    manifest.update({key: relative(manifest[key]) for key in ("command", "from_state") if key in manifest})
    manifest["settings"] = {name: {key: value for key, value in entry.items() if key != "meaning"}
                            for name, entry in manifest.get("settings", {}).items()}
    data = (json.dumps(manifest["scene"]) + "\n").encode()
    digest = hashlib.sha256(data).hexdigest()[:16]
    manifest["scene"] = {"name": manifest["scene"]["name"], "sha256": digest}
    return manifest, [(f"../{SCENES}/{digest}.json", data)]


def costs_of(folder):
    """Returns the costs of the run's steps, which can't be computed from thinned rows; nothing if they can't be
    computed from all rows either."""
    from paper_figures.workflow.step_costs import costs

    try:
        return {"step_costs": costs(run_at(folder))}
    except EvidenceError:
        return {}
