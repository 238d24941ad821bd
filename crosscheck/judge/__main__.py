"""The command line: answer the questions below a folder, or draw one model."""

import argparse
from multiprocessing import Pool
from pathlib import Path

from judge.answers import answer_model
from judge.picture import View, draw


def main() -> None:
    """Run one of the two commands."""
    parser = argparse.ArgumentParser(prog="judge", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    asking = commands.add_parser("answer", help="answer every model two levels below a folder")
    asking.add_argument("folder", type=Path)
    asking.add_argument("--jobs", type=int, default=1, help="processes (default: %(default)s)")
    drawing = commands.add_parser("draw", help="draw a model in a keyframe")
    drawing.add_argument("model", type=Path)
    drawing.add_argument("to", type=Path)
    drawing.add_argument("--key", required=True)
    drawing.add_argument("--azimuth", type=float, default=135.0, help="degrees (default: %(default)s)")
    drawing.add_argument("--elevation", type=float, default=-25.0, help="degrees (default: %(default)s)")
    drawing.add_argument("--zoom", type=float, default=1.0, help="1: everything is in the picture (default)")
    words = parser.parse_args()
    if words.command == "answer":
        answer_all(words.folder, words.jobs)
    else:
        draw(words.model, words.to, words.key, View(words.azimuth, words.elevation, words.zoom))


def answer_all(folder: Path, jobs: int) -> None:
    """Answer every model below `folder`, the ones with most questions first; one line when one is done."""
    models = sorted(folder.glob("*/*.xml"))
    models.sort(
        key=lambda model: model.with_name(f"{model.stem}.questions.parquet").stat().st_size, reverse=True
    )
    with Pool(jobs) as pool:
        for name in pool.imap_unordered(answer_model, models):
            print(name, flush=True)


if __name__ == "__main__":
    main()
