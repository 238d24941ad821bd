"""From answers to the terminal, the chapter and the picture."""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from judge.chapter import Frame, chapter, table
from judge.compare import compare_all
from judge.located import Fault, Stale, Written
from judge.picture import View, scene_hash, shown_scene
from judge.pose import RIGHT
from judge.specs import Places, Spec
from judge.stored import read

CHAPTER, PICTURE, DIFFERENCES = "crosscheck.md", "scene_mujoco.png", "disagreements.txt"
VIEWER = "target/replan/crosscheck/venv/bin/python -m mujoco.viewer"
RENDERERS = ("osmesa", "egl")
"""Renderers that work without a screen, the one that needs no GPU first."""
IMAGE = f"![the scene as MuJoCo sees it]({PICTURE})"
FAILED = (
    "it could not be drawn when this was written; most often no renderer works without a screen (Debian or Ubuntu: apt "
    "install libosmesa6)"
)


@dataclass(frozen=True)
class Shown:
    """Where answers lie, and where chapter and picture go; a check writes neither."""

    answers: Path
    plots: Path
    is_check: bool


def report(places: Places, shown: Shown) -> int:
    """Compare all answers of a paper, show them, and say how many things differ."""
    spec = Spec(places)
    outcomes = compare_all(shown.answers / name for name in spec.names() if is_answered(shown.answers / name))
    listed = [item for outcome in outcomes for item in outcome.listed()]
    print(table(outcomes), flush=True)
    text = "".join(f"{item}\n" for item in listed)
    (shown.answers / DIFFERENCES).write_text(text, encoding="utf-8")
    sys.stderr.write(text)
    case = spec.table["picture"]["case"]
    place = shown.answers / case / f"{RIGHT}.xml"
    view = f"{VIEWER} --mjcf={place}"
    notes = [*stand_ins(places), *samples(spec)]
    frame = Frame(places.runs.name, view, picture(spec, shown, place), notes)
    keep(chapter(outcomes, frame), shown, frame.view)
    return len(listed)


def is_answered(folder: Path) -> bool:
    """Whether a case was asked; one that was not is refused."""
    if (folder / "case.json").is_file():
        return True
    raise Fault(f"{folder}: there are no answers to judge; run `replan crosscheck` without --answered")


def keep(text: str, shown: Shown, view: str) -> None:
    """Write the chapter, or say whether it is what stands there."""
    path = shown.plots / CHAPTER
    if not shown.is_check:
        path.write_text(text, encoding="utf-8")
        print(f"what MuJoCo finds is in {path}; to look around the scene: {view}")
    elif path.is_file() and path.read_text(encoding="utf-8") == text:
        print(f"{path} is current")
    else:
        raise Stale(f"not current: {path}")


def stand_ins(places: Places) -> list[str]:
    """What the paper notes of inputs that stand in for its own."""
    note = Written(places.folder / "paper.toml").table.get("source", {}).get("stand_ins")
    return [note] if isinstance(note, str) else []


def samples(spec: Spec) -> list[str]:
    """How many of each set's solved problems were drawn, and by which seed."""
    drawn = []
    for entry in spec.table.get("set", []):
        trials = read(spec.places.runs / f"{entry['paths']['study']}.trials.parquet").select(["group", "status"])
        solved = trials.to_pylist().count({"group": entry["paths"]["problems"], "status": "solved"})
        drawn.append(f"{entry['label']} {entry['sample']} of {solved}")
    if not drawn:
        return []
    return [
        f"Of the solved problems of each set a sample is judged, drawn by the seed {spec.table['seed']}: "
        f"{', '.join(drawn)}. Each of these trials was run again for its path and came out as it is stored."
    ]


def picture(spec: Spec, shown: Shown, model: Path) -> str:
    """The chapter's paragraph about the picture, which is drawn if it shows another scene than this."""
    entry, to = spec.table["picture"], shown.plots / PICTURE
    keys = json.loads((model.parent / "case.json").read_text(encoding="utf-8"))["keys"]
    view = View(float(entry["azimuth_deg"]), float(entry["elevation_deg"]), float(entry["zoom"]))
    scene = scene_hash(model, keys[entry["key"]], view)
    if shown_scene(to) == scene or (not shown.is_check and is_drawn(model, to, entry["key"], view, scene)):
        return IMAGE
    return f"{IMAGE}\n\nThe picture is of an earlier run: {FAILED}." if to.is_file() else f"No picture: {FAILED}."


def is_drawn(model: Path, to: Path, key: str, view: View, scene: str) -> bool:
    """Draw with the first renderer that works; without any, say why."""
    words = [sys.executable, "-m", "judge", "draw", str(model), str(to), f"--key={key}", f"--scene={scene}"]
    words += [f"--azimuth={view.azimuth_deg}", f"--elevation={view.elevation_deg}", f"--zoom={view.zoom}"]
    reasons = []
    for renderer in RENDERERS:
        environment = {**os.environ, "MUJOCO_GL": renderer}
        ended = subprocess.run(words, capture_output=True, text=True, check=False, env=environment)
        if ended.returncode == 0:
            return True
        reasons.append(f"{renderer}: {(ended.stderr.strip().splitlines() or ['no reason given'])[-1]}")
    sys.stderr.write(f"no picture: {'; '.join(reasons)}\n")
    return False
