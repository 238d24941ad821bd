"""The command line: pose and answer a paper's questions, compare the answers, or draw one model."""

import argparse
import sys
from functools import partial
from multiprocessing import Pool
from pathlib import Path

from judge.located import Fault
from judge.picture import View, draw
from judge.pose import pose_case
from judge.report import Shown, report
from judge.specs import Places, Spec

DIFFERS = 3


def main() -> int:
    """Run one of the commands; the exit code is 2 for wrong input and 3 if something differs."""
    parser = argparse.ArgumentParser(prog="judge", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    posing = commands.add_parser("pose", help="write a paper's questions and MuJoCo's answers; a line for each case")
    posing.add_argument("--jobs", type=int, default=1, help="processes (default: %(default)s)")
    comparing = commands.add_parser("report", help="compare answers, write the chapter and draw the picture")
    comparing.add_argument("--plots", type=Path, required=True)
    comparing.add_argument("--check", action="store_true", help="write nothing; say whether the chapter is current")
    for command in (posing, comparing):
        command.add_argument("answers", type=Path, help="the folder of the paper's answers")
        for name in ("folder", "home", "runs"):
            command.add_argument(f"--{name}", type=Path, required=True)
    add_drawing(commands)
    words = parser.parse_args()
    try:
        return run(words)
    except Fault as fault:
        sys.stderr.write(f"{fault}\n")
        return fault.code


def add_drawing(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """The words of the command that draws."""
    drawing = commands.add_parser("draw", help="draw a model in a keyframe")
    drawing.add_argument("model", type=Path)
    drawing.add_argument("to", type=Path)
    drawing.add_argument("--key", required=True)
    drawing.add_argument("--scene", default="", help="a hash of what is shown, which the picture keeps")
    drawing.add_argument("--azimuth", type=float, default=135.0, help="degrees (default: %(default)s)")
    drawing.add_argument("--elevation", type=float, default=-25.0, help="degrees (default: %(default)s)")
    drawing.add_argument("--zoom", type=float, default=1.0, help="1: everything is in the picture (default)")


def run(words: argparse.Namespace) -> int:
    """Run the command."""
    if words.command == "draw":
        view = View(words.azimuth, words.elevation, words.zoom)
        draw(words.model, words.to, words.key, view, words.scene)
        return 0
    places = Places(words.folder, words.home, words.runs, words.answers)
    if words.command == "pose":
        pose(places, words.answers, words.jobs)
        return 0
    return DIFFERS if report(places, Shown(words.answers, words.plots, words.check)) else 0


def pose(places: Places, answers: Path, jobs: int) -> None:
    """Pose and answer every case; one line when one is done."""
    spec = Spec(places)
    names = spec.names()
    shown = spec.table["picture"]["case"]
    if shown not in names:
        raise spec.fault(("picture", "case"), f"there is no case `{shown}`; the cases are {', '.join(names)}")
    with Pool(jobs) as pool:
        for name in pool.imap_unordered(partial(pose_case, places, to=answers), names):
            print(name, flush=True)


if __name__ == "__main__":
    sys.exit(main())
