"""Shortest paths between corners of cells, by Dijkstra's algorithm on whole visibility graphs.

Writes tests/it/crosscheck/visibility_graphs.json for a Rust test: 200 small maps from a written seed. Each has the
length of a shortest path from its lower left to its upper right corner, or null where there is none. A line is clear if
it crosses no blocked square, clipped in fractions, and if no unit of it lies between two squares that are blocked or
outside. Run from the root of the repository:

    python crosscheck/visibility_graphs.py
"""

import json
import random
from fractions import Fraction
from itertools import product
from math import hypot, inf
from pathlib import Path

COUNT = 200
SEED = 55

Point = tuple[int, int]


def crosses(a: Point, b: Point, cell: Point) -> bool:
    """Whether the segment meets the open unit square at `cell`."""
    low, high = Fraction(0), Fraction(1)
    for axis in (0, 1):
        step = b[axis] - a[axis]
        near, far = cell[axis] - a[axis], cell[axis] + 1 - a[axis]
        if step == 0:
            if not near < 0 < far:
                return False
            continue
        ends = sorted((Fraction(near, step), Fraction(far, step)))
        low, high = max(low, ends[0]), min(high, ends[1])
    return low < high


def is_clear(free: set[Point], blocked: list[Point], a: Point, b: Point) -> bool:
    """Whether `b` is seen from `a`."""
    if any(crosses(a, b, cell) for cell in blocked):
        return False
    for along, across in ((0, 1), (1, 0)):
        if a[across] == b[across]:
            for at in range(min(a[along], b[along]), max(a[along], b[along])):
                beside = [[0, 0], [0, 0]]
                for side in (0, 1):
                    beside[side][along] = at
                    beside[side][across] = a[across] - side
                if not any(tuple(cell) in free for cell in beside):
                    return False
    return True


def shortest(size: Point, free: set[Point]) -> float | None:
    """The length of a shortest path from the lower left to the upper right corner."""
    blocked = [cell for cell in product(range(size[0]), range(size[1])) if cell not in free]
    corners = list(product(range(size[0] + 1), range(size[1] + 1)))
    touching = {c for c in corners if any((c[0] - dx, c[1] - dy) in free for dx in (0, 1) for dy in (0, 1))}
    if (0, 0) not in touching or size not in touching:
        return None
    cost = dict.fromkeys(touching, inf)
    cost[0, 0] = 0.0
    left = set(touching)
    while left:
        near = min(left, key=lambda corner: (cost[corner], corner))
        left.remove(near)
        if cost[near] == inf:
            return None
        if near == size:
            return cost[near]
        for far in left:
            reached = cost[near] + hypot(far[0] - near[0], far[1] - near[1])
            if reached < cost[far] and is_clear(free, blocked, near, far):
                cost[far] = reached
    return None


def main() -> None:
    """Draws the maps and writes the file."""
    draw = random.Random(SEED)
    cases = []
    for _ in range(COUNT):
        size = draw.randint(2, 9), draw.randint(2, 9)
        share = draw.choice([0.1, 0.25, 0.4])
        rows = [["." if draw.random() >= share else "#" for _ in range(size[0])] for _ in range(size[1])]
        rows[0][0] = rows[-1][-1] = "."
        free = {(x, y) for y, row in enumerate(rows) for x, cell in enumerate(row) if cell == "."}
        text = ["".join(row) for row in reversed(rows)]
        cases.append({"map": text, "shortest": shortest(size, free)})
    target = Path("tests/it/crosscheck/visibility_graphs.json")
    target.write_text("[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]\n")


if __name__ == "__main__":
    main()
