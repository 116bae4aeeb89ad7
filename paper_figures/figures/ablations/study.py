"""Runs one study of the method's parts (points x scenes x seeds), tabulates and draws it. Usage: python3 -m
paper_figures.figures.ablations.study FOLDER --study NAME --ogc OGC --scale SCALE --backend BACKEND.

NAME.yaml beside this file defines the study. Keys of `study`: `jitter` [m], `repeat` by scale, `audit`, `solver`
(optional; it runs on the CPU), `timed` (optional: its runs have the machine for themselves, so that their times count;
without it the study has none) and `scenes`. Keys of a scene: `points` (as for --point of `ogc ablate`; all others are
compared with the first; one list for each scale if they differ), `scales` (optional: the scales at which the scene is
run), and by scale `set` (settings of all points) and `options` (further options of `ogc ablate`).

FOLDER then holds a folder of `ogc ablate` for each scene, ablations.csv (a row for each scene, metric and point),
NAME.txt (findings), NAME.png and NAME.pdf. An interrupted study continues with the interrupted run if it is called
again. With --made it only tabulates and draws existing scenes."""

import argparse
import csv
import json
import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import yaml

from paper_figures.workflow.durations import OF_ALL_RUNS, seconds_between
from paper_figures.workflow.evidence import membranes_of
from paper_figures.workflow.runs import write_table
from plots import ablation, style

HERE = Path(__file__).parent
TABLE = "ablations.csv"
KEPT = "guarantee_kept"  # metric: number of a point's runs that kept the guarantee
JUDGED = ("yes", "no")  # values of a run whose guarantee was audited
KEYS = {"jitter", "repeat", "audit", "scenes", "panels", "solver", "timed"}
TIMES = ("median_step", "worst_step")  # These metrics count where a study is timed.
SCENE_KEYS = {"points", "set", "options", "scales"}
CAME_TO_AN_END = (0, 1)  # exit statuses of ogc ablate; 1 means that a run failed, which is a result
AXES = 2.8  # width of a column's axes and titles beside the points' names [inches]
LETTER = 0.06  # width of a letter in a name [inches]
LETTERS = 14  # letters of the title in an inch
PANELS = ("median_step", "detections_a_step", "contacts_a_step", "largest_momentum_lost_end", "smallest_distance",
          "last_energy")


class StudyError(Exception):
    """Raised if a study can't be run or drawn; the message says what is wrong and where."""


def load(name):
    """Returns the part `study` of NAME.yaml. Throws StudyError if it has an unknown key."""
    path = HERE / f"{name}.yaml"
    if not path.is_file():
        there = ", ".join(sorted(path.stem for path in HERE.glob("*.yaml")))
        raise StudyError(f"there is no study '{name}'; there are: {there}")
    study = yaml.safe_load(path.read_text())["study"]
    unknown = (set(study) - KEYS) | {key for scene in study["scenes"].values() for key in set(scene) - SCENE_KEYS}
    if unknown:
        raise StudyError(f"{path.name}: unknown key {', '.join(sorted(unknown))}; there are: "
                         f"{', '.join(sorted(KEYS | SCENE_KEYS))}")
    return study


def scenes_at(study, scale):
    """Returns the names of the scenes that are run at this scale."""
    return [name for name, body in study["scenes"].items() if scale in body.get("scales", [scale])]


def points_at(body, scale):
    """Returns the points of a scene at this scale."""
    return body["points"][scale] if isinstance(body["points"], dict) else body["points"]


def command(study, scene, scale, backend, data=""):
    """Returns the words of `ogc ablate` after the program, without --out. `data`: folder of the published dress; None:
    the stand-in is used."""
    body = study["scenes"][scene]
    points = [word for point in points_at(body, scale) for word in ("--point", point)]
    chosen = [*body.get("set", {}).get(scale, []), *([f"data={data}"] if data and scene == "dress" else [])]
    settings = [word for setting in chosen for word in ("--set", setting)]
    who = ["--solver", study["solver"]] if "solver" in study else ["--backend", backend]
    return ["ablate", scene, "--scale", scale, *who, *settings, "--audit", study["audit"], *points,
            "--repeat", str(study["repeat"][scale]), "--jitter", str(study["jitter"]),
            *map(str, body.get("options", {}).get(scale, []))]


def program():
    """Returns what distinguishes runs of different programs, if the workflow provides it."""
    stamp = Path(os.environ.get("OGC_STAMP", ""))
    return stamp.read_text() if stamp.is_file() else ""


def run(ogc, words, folder, jobs=1):
    """Makes the runs of a scene, `jobs` at a time, after it removed runs of another program or request. Throws
    StudyError if the runs do not finish."""
    question = json.dumps({"program": program(), "words": words})
    note = folder.with_suffix(".json")
    if folder.is_dir() and not (note.is_file() and note.read_text() == question):
        shutil.rmtree(folder)
    folder.parent.mkdir(parents=True, exist_ok=True)
    note.write_text(question)
    done = subprocess.run([ogc, *words, "--jobs", str(jobs), "--out", str(folder)], stdout=subprocess.DEVNULL,
                          check=False)
    if done.returncode not in CAME_TO_AN_END:
        raise StudyError(f"ogc {' '.join(words)} ended with exit status {done.returncode}; call it again to go on")


def origin(folder):
    """Returns commit and device of the scene's runs."""
    manifest = json.loads(next(iter(sorted(folder.glob("*/run.json")))).read_text())
    return {"commit": manifest["commit"][:10] + (" (dirty)" if manifest["dirty"] else ""),
            "device": manifest["device"]}


def membrane(folder, point):
    """Returns the model of the cloth's membranes at a point; empty if there is no cloth."""
    own = [path for path in sorted(folder.glob("*/run.json")) if "membrane=" not in path.parent.name]
    found = " and ".join(sorted(membranes_of(json.loads(own[0].read_text())))) if own else ""
    chosen = [word.partition("=")[2] for word in point.split(",") if word.startswith("membrane=")]
    return chosen[0] if chosen else found


def rows(folder, study, scene):
    """Returns a scene's rows of the study's table: one for each metric and point."""
    made_by = origin(folder)
    with (folder / ablation.TABLE).open(newline="") as file:
        for row in csv.DictReader(file):
            names = list(row)
            varied = names[1:names.index(ablation.AFTER_AXES)]
            point = ",".join(f"{name}={row[name]}" for name in varied if row[name]) or "default"
            yield {"study": study, "scene": scene, "metric": row["metric"], "point": point,
                   **{name: row[name] for name in names[len(varied) + 1:]}, **made_by,
                   "membrane": membrane(folder, point)}
    for point, runs in of_points(folder).items():
        if not any(run["guarantee_kept"] in JUDGED for run in runs):
            continue  # without an audit it is not known whether a run kept the guarantee
        kept = sum(run["guarantee_kept"] == "yes" for run in runs)
        ended = sum(run["status"] == "finished" for run in runs)
        yield {"study": study, "scene": scene, "metric": KEPT, "point": point, "unit": "1", "runs": len(runs),
               "finished": ended, **dict.fromkeys(("median", "smallest", "largest"), kept), **made_by,
               "membrane": membrane(folder, point)}
    yield from time_of(folder, {"study": study, "scene": scene, **made_by})


def time_of(folder, about):
    """Returns the row about the time that all runs of a scene took; none if a run does not say when it ended."""
    took = [seconds_between(json.loads(path.read_text())) for path in sorted(folder.glob("*/run.json"))]
    if took and None not in took:
        point = next(iter(of_points(folder)))
        yield {"study": about["study"], "scene": about["scene"], "metric": OF_ALL_RUNS, "point": point, "unit": "s",
               "runs": len(took), "finished": len(took), **dict.fromkeys(("median", "smallest", "largest"), sum(took)),
               "commit": about["commit"], "device": about["device"], "membrane": membrane(folder, point)}


def of_points(folder):
    """Returns point -> rows of its runs, including failed ones."""
    found = {}
    with (folder / "ablation.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            varied = list(row)[:list(row).index("seed")]
            point = ",".join(f"{name}={row[name]}" for name in varied if row[name]) or "default"
            found.setdefault(point, []).append(row)
    return found


def draw(folders, panels, title, out):
    """Draws a row for each metric that any scene has, and a column for each scene."""
    plt = style.use()
    panels = [name for name in panels if any(name in metrics for metrics in folders.values())]
    points = [list(settings) for metrics in folders.values() for _, settings in metrics.values()]
    width = (AXES + LETTER * max(len(name) for names in points for name in names)) * len(folders)
    figure, grid = plt.subplots(len(panels), len(folders), squeeze=False,
                                figsize=(width, len(panels) * (0.9 + 0.22 * max(map(len, points)))))
    for column, (scene, metrics) in enumerate(folders.items()):
        for row, name in enumerate(panels):
            axes = grid[row][column]
            if name not in metrics:
                axes.set_axis_off()
                continue
            ablation.draw_metric(axes, name, *metrics[name], has_names=True)
            if row == 0:
                axes.set_title(f"{scene}\n{axes.get_title('left')}")
    words = f"{title}\npoint: median of the runs; line: their range; shaded: the first point's"
    lines = (textwrap.fill(line, int(LETTERS * width)) for line in words.splitlines())
    figure.suptitle("\n".join(lines), fontsize=9)
    style.save(figure, out)


def arguments():
    parser = argparse.ArgumentParser(description="Runs, tabulates and draws one study of the method's parts.")
    parser.add_argument("folder", type=Path, help="where the runs and the picture go")
    parser.add_argument("--study", required=True, help="name of the YAML file beside this script")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scale", default="smoke", choices=("smoke", "small", "paper"))
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"))
    parser.add_argument("--data", default="", metavar="FOLDER",
                        help="of Codimensional IPC's dress and dancer (default: a stand-in)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time; their times tell settings apart no more")
    parser.add_argument("--made", action="store_true", help="tabulate and draw the scenes that there are, run none")
    return parser.parse_args()


def main():
    asked = arguments()
    study = load(asked.study)
    table, findings, metrics = [], [], {}
    scenes = scenes_at(study, asked.scale)
    if asked.made:
        scenes = [scene for scene in scenes if (asked.folder / scene / ablation.TABLE).is_file()]
        if not scenes:
            raise StudyError(f"{asked.folder} has no scene of {asked.study}; leave --made out, and they are run")
    for number, scene in enumerate(scenes, 1):
        words = command(study, scene, asked.scale, asked.backend, asked.data)
        print(f"{asked.study}: {scene} ({number} of {len(scenes)}): ogc {' '.join(words)}", flush=True)
        folder = asked.folder / scene
        if not asked.made:
            run(asked.ogc, words, folder, asked.jobs)
        hidden = () if study.get("timed") else TIMES
        table += (row for row in rows(folder, asked.study, scene) if row["metric"] not in hidden)
        findings += [f"{scene}: {line}\n" for line in (folder / "ablation_findings.txt").read_text().splitlines()
                     if not line.startswith(hidden)]
        metrics[scene] = {name: metric for name, metric in ablation.read(folder).items() if name not in hidden}
    out = asked.folder / asked.study
    write_table(asked.folder / TABLE, table)
    out.with_suffix(".txt").write_text("".join(findings))
    title = yaml.safe_load((HERE / f"{asked.study}.yaml").read_text())["title"]
    draw(metrics, study.get("panels", PANELS), f"{title} ({asked.scale}, {study['repeat'][asked.scale]} seeds)",
         out.with_suffix(".png"))


if __name__ == "__main__":
    try:
        main()
    except (StudyError, ablation.AblationError) as error:
        sys.exit(f"study: {error}")
