"""Which pairs of points have both lengths that the planar paper prints, and how many other lengths are met so.

The paper names no start and no goal. 72.8406 = 29 + 31 sqrt 2 is printed for its first map and 70.7401 = 17 + 38 sqrt 2
for its second. Every pair of points that are free in both maps is tried: shortest paths by scipy, on a lattice of 1 cm
with eight moves, for obstacles that are circles or squares of the widths given. The arm has links of 30 and 20 cm, and
its tip stays 20 cm from the base. A node is blocked if a link touches an obstacle, and a move is free if both its nodes
are.

For each of them the pairs are listed, and the share of other targets met. A target is two sums of straight and
diagonal steps, each within 5 cm of its printed length. The straight steps of the two are both even or both odd, as
between equal ends they must be. If many targets are met, that some pair meets the printed ones says little. Run from
the root of the repository:

    python crosscheck/end_points.py circle=10 circle=8 square=10
"""

import sys
from math import hypot, isqrt, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

LINKS = (30.0, 20.0)
INNER = 20.0
CASES = (
    (((35, 18), (7, 35), (-13, 35), (-30, 20)), (29, 31)),
    (((41, 10), (7, 40), (-16, 33)), (17, 38)),
)
WINDOW = 5.0
Point = tuple[float, float]
NODES = [(x, y) for x in range(-50, 51) for y in range(51)]


def elbow(x: float, y: float) -> tuple[float, float]:
    """The elbow of the posture with the negative second angle."""
    first, second = LINKS
    far = hypot(x, y)
    along = (first**2 - second**2 + far**2) / (2 * far)
    across = sqrt(max(first**2 - along**2, 0.0))
    return (along * x - across * y) / far, (along * y + across * x) / far


def distance(a: Point, b: Point, centre: tuple[int, int]) -> float:
    """From a point to a segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    share = min(max(((centre[0] - a[0]) * dx + (centre[1] - a[1]) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    return hypot(a[0] + share * dx - centre[0], a[1] + share * dy - centre[1])


def is_in_square(a: Point, b: Point, centre: tuple[int, int], half: float) -> bool:
    """Whether the segment meets the square."""
    low, high = 0.0, 1.0
    for axis in (0, 1):
        step = b[axis] - a[axis]
        walls = (centre[axis] - half - a[axis], centre[axis] + half - a[axis])
        if step == 0:
            if not walls[0] <= 0 <= walls[1]:
                return False
            continue
        shares = sorted(wall / step for wall in walls)
        low, high = max(low, shares[0]), min(high, shares[1])
    return low <= high


def is_free(x: int, y: int, obstacles: tuple[tuple[int, int], ...], shape: str, width: float) -> bool:
    """Whether the tip may stand there."""
    if not INNER <= hypot(x, y) <= sum(LINKS):
        return False
    bend = elbow(x, y)
    links = (((0.0, 0.0), bend), (bend, (float(x), float(y))))
    half = width / 2 + 1e-9
    if shape == "square":
        return not any(is_in_square(*link, centre, half) for centre in obstacles for link in links)
    return all(distance(*link, centre) > half for centre in obstacles for link in links)


def lengths(free: set[tuple[int, int]], among: list[tuple[int, int]]) -> NDArray[np.float64]:
    """Of shortest paths between the nodes `among`."""
    index = {node: i for i, node in enumerate(free)}
    edges = [
        (i, index[x + dx, y + dy], hypot(dx, dy))
        for (x, y), i in index.items()
        for dx in (-1, 0, 1)
        for dy in (-1, 0, 1)
        if (dx or dy) and (x + dx, y + dy) in index
    ]
    rows, columns, weights = zip(*edges, strict=True)
    graph = coo_matrix((weights, (rows, columns)), shape=(len(index), len(index))).tocsr()
    at = [index[node] for node in among]
    return np.asarray(dijkstra(graph, indices=at)[:, at])


def sums(near: float) -> dict[int, tuple[int, int]]:
    """Straight and diagonal steps of all sums in the window, by their length in units of 1e-7."""
    most = isqrt(int(near + WINDOW) ** 2) + 1
    found = ((a, b) for b in range(most) for a in range(most))
    return {round(1e7 * (a + b * sqrt(2))): (a, b) for a, b in found if abs(a + b * sqrt(2) - near) <= WINDOW}


def main() -> None:
    """Prints a line a shape and a line a pair."""
    for argument in sys.argv[1:] or ["circle=10"]:
        shape, _, width = argument.partition("=")
        if shape not in ("circle", "square") or not width:
            sys.exit(f"{argument}: circle=WIDTH_CM and square=WIDTH_CM are accepted")
        frees = [{node for node in NODES if is_free(*node, case[0], shape, float(width))} for case in CASES]
        among = sorted(frees[0] & frees[1])
        upper = np.triu_indices(len(among), 1)
        both = np.array([np.round(1e7 * lengths(free, among)[upper]) for free in frees])
        both = np.where(np.isfinite(both), both, -1).astype(np.int64)
        near = [sums(a + b * sqrt(2)) for _, (a, b) in CASES]
        parities = [[sum(a % 2 == odd for a, _ in one.values()) for odd in (0, 1)] for one in near]
        targets = sum(first * second for first, second in zip(*parities, strict=True))
        known = [np.array(sorted(one)) for one in near]
        in_window = np.all([np.isin(row, one) for row, one in zip(both, known, strict=True)], axis=0)
        met = {(first, second) for first, second in both[:, in_window].T.tolist()}
        share = 100 * len(met) / targets
        print(f"{shape}s of {width} cm: {len(met)} of {targets} targets are met ({share:.2f} %)")
        printed = [round(1e7 * (a + b * sqrt(2))) for _, (a, b) in CASES]
        for place in np.flatnonzero((both[0] == printed[0]) & (both[1] == printed[1])):
            print(f"  {among[upper[0][place]]} and {among[upper[1][place]]}")


if __name__ == "__main__":
    main()
