"""What VAMP's own code finds on each problem beside our trials, as `run` writes and exports them."""

import csv
import statistics
import sys
from pathlib import Path


def rows(path: Path, robot: str) -> list[dict[str, str]]:
    """The rows of a robot's problems in a file of comma-separated values under the default options."""
    with path.open(encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if row["group"] == robot]


def main(theirs: str, ours: str, robot: str) -> None:
    """Prints counts of agreement, and medians."""
    folder = Path(ours)
    found = [line.split() for line in Path(theirs).read_text(encoding="utf-8").splitlines()]
    trials = {int(row["instance"]): row for row in rows(folder / "motionbench.trials.csv", robot)}
    both = []
    valid = [0, 0, 0]
    for instance, row in sorted(trials.items()):
        _, start, goal, *rest = found[instance]
        is_valid = [row["status"] != "invalid_problem", start == goal == "1"]
        valid = [valid[0] + is_valid[0], valid[1] + is_valid[1], valid[2] + (is_valid[0] == is_valid[1])]
        if all(is_valid):
            # Without a path, VAMP counts one more than its limit.
            both.append((instance, row["status"] == "solved", int(row["iterations"]), len(rest) > 3, int(rest[0]), rest))
    solved = [sum(each[place] for each in both) for place in (1, 3)]
    equal = sum(own == other or not is_solved and other == own + 1 for _, is_solved, own, _, other, _ in both)
    print(f"{robot}: {len(trials)} problems; valid: {valid[0]} ours, {valid[1]} VAMP's, alike on {valid[2]}")
    print(f"  of {len(both)} valid for both: solved {solved[0]} ours, {solved[1]} VAMP's; as many iterations on {equal}")
    solved_by_both = [each for each in both if each[1] and each[3]]
    for what, own, other in (
        ("iterations", [each[2] for each in solved_by_both], [each[4] for each in solved_by_both]),
        (
            "initial cost",
            [float(trials[each[0]]["initial_length_rad"]) for each in solved_by_both],
            [float(each[5][3]) for each in solved_by_both],
        ),
        (
            "simplified cost",
            [float(trials[each[0]]["joint_length_rad"]) for each in solved_by_both],
            [float(each[5][4]) for each in solved_by_both],
        ),
    ):
        medians = f"{statistics.median(own):.6g} and {statistics.median(other):.6g}"
        print(f"  {what}: mean {statistics.mean(own):.6g} ours, {statistics.mean(other):.6g} VAMP's; median {medians}")
    times: dict[int, list[int]] = {}
    for row in rows(folder / "motionbench.times.csv", robot):
        times.setdefault(int(row["instance"]), []).append(int(row["plan_wall_ns"]))
    timed = [(statistics.median(times[each[0]]), int(each[5][2]) + int(each[5][5])) for each in solved_by_both if each[0] in times]
    if timed:
        own, other = (statistics.median(column) / 1000 for column in zip(*timed, strict=True))
        print(f"  planning and simplification, median of {len(timed)} problems: {own:.0f} µs ours, {other:.0f} µs VAMP's")
        searched = [each[0] for each in solved_by_both if each[0] in times]
        columns = ("motions", "simplification_motions")
        motions = sum(int(trials[instance][column]) for instance in searched for column in columns)
        spent = sum(statistics.median(times[instance]) for instance in searched)
        print(f"  motions that ours checks a second of planning and simplification: {1e9 * motions / spent:.3g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
