"""The command line: recompute the verdicts of the papers that a request names."""

import argparse
import json
import sys
from multiprocessing import Pool
from pathlib import Path

from statistics_judge.judge import Compared, compare, recomputed
from statistics_judge.records import Metric, Paper, toml

# Something differs.
DIFFERS = 3


def main() -> int:
    """Judge every paper; one line each, and one for all that is near or differs."""
    parser = argparse.ArgumentParser(prog="statistics_judge", description=__doc__)
    parser.add_argument("request", type=Path, help="metrics and papers, as `replan crosscheck` writes them")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default: %(default)s)")
    words = parser.parse_args()
    request = json.loads(words.request.read_text(encoding="utf-8"))
    metrics = [Metric(**metric) for metric in request["metrics"]]
    asked = [
        (Path(one["experiments"]), Path(one["runs"]), metrics, Path(one["explored"]))
        for one in request["papers"]
    ]
    differing = 0
    with Pool(words.jobs) as pool:
        for name, compared in pool.imap(answer, asked, chunksize=1):
            report(name, compared)
            differing += len(compared.differ)
    return DIFFERS if differing else 0


def answer(asked: tuple[Path, Path, list[Metric], Path]) -> tuple[str, Compared]:
    """One paper."""
    paper = Paper(*asked)
    return paper.id, compare(paper, recomputed(paper), toml(paper.runs / "verdicts.toml"))


def report(name: str, compared: Compared) -> None:
    """Say what agrees, what is near and what differs."""
    rows = compared.rows + compared.left_out.total()
    agree = (
        f"{compared.estimates} estimates, {compared.intervals} intervals, {compared.classes} outcomes "
        f"and {compared.across} combinations across interpretations agree; "
        f"compared {compared.rows} of {rows} rows of the defaults in estimates.parquet"
    )
    print(f"{name}: {agree}; {len(compared.near)} near, {len(compared.differ)} differ", flush=True)
    for why, count in sorted(compared.left_out.items()):
        print(f"  not compared: {count} rows that {why}")
    for line in compared.near:
        print(f"  near: {line}")
    for line in compared.differ:
        print(f"  differs: {line}")


if __name__ == "__main__":
    sys.exit(main())
