"""AP Theta* and Field D* between corners of cells, written plainly, for a Rust test of the planners.

Writes tests/it/crosscheck/any_angle.json: 80 small maps from a written seed, with how many vertices each search expands
and how long its path is, or null where there is none. AP Theta* follows Daniel et al. (JAIR 39, 2010, section 6) with
angles in radians; Field D* finds the best point of an edge by ternary search. Equal f go to the smaller or larger g,
then to the vertex that was opened first; neighbours are opened for x from +1 down, for y from +1 down.
Run from the root of the repository:

    python crosscheck/any_angle.py
"""

import json
import random
from collections.abc import Callable
from itertools import pairwise, product
from math import atan2, inf, pi, sqrt
from pathlib import Path

COUNT = 80
SEED = 2010
STEPS = [step for step in product((1, 0, -1), (1, 0, -1)) if step != (0, 0)]
# What is nearer to 0 than this is 0.
NEAR = 1e-9

Corner = tuple[int, int]
Point = tuple[float, float]
Moved = tuple[Corner, float]


def apart(a: Point, b: Point) -> float:
    """The distance between two points."""
    return sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2)


def turned(at: Point, one: Point, other: Point) -> float:
    """The angle from `one` to `other` as seen from `at`, counter-clockwise, between half a turn each way."""
    angle = atan2(other[1] - at[1], other[0] - at[0]) - atan2(one[1] - at[1], one[0] - at[0])
    angle = (angle + pi) % (2 * pi) - pi
    return 0.0 if abs(angle) < NEAR else angle


class Search:
    """A* between corners; what a way costs is for those who derive from it."""

    def __init__(self, free: set[Corner], sign: int) -> None:
        """Among equal f the smaller `sign` times g is taken."""
        self.free, self.sign = free, sign
        self.g: dict[Corner, float] = {}
        self.parent: dict[Corner, Corner] = {}
        self.closed: set[Corner] = set()

    def cells(self, at: Corner) -> list[Corner]:
        """The four cells about a corner."""
        return [(at[0] - dx, at[1] - dy) for dx, dy in product((0, 1), (0, 1))]

    def neighbours(self, at: Corner) -> list[Corner]:
        """Those in sight, in the order in which they are opened: one cell that both touch is free."""
        near = [(at[0] + dx, at[1] + dy) for dx, dy in STEPS]
        return [to for to in near if set(self.cells(at)) & set(self.cells(to)) & self.free]

    def begin(self, at: Corner) -> None:
        """Called with each vertex that is expanded, before its neighbours are looked at."""

    def way(self, at: Corner, to: Corner) -> Moved:
        """The parent that `to` gets from the expanded `at`, and the cost of the way."""
        raise NotImplementedError

    def run(self, start: Corner, goal: Corner) -> int | None:
        """How many vertices are expanded until the goal is taken."""
        self.g[start], self.parent[start] = 0.0, start
        rank = {start: 0}
        opened = {start}

        def key(at: Corner) -> tuple[int, int, int]:
            f, g = (int(value * 1e9 + 0.5) for value in (self.g[at] + apart(at, goal), self.g[at]))
            return f, self.sign * g, rank[at]

        while opened:
            at = min(opened, key=key)
            if at == goal:
                return len(self.closed)
            opened.remove(at)
            self.closed.add(at)
            self.begin(at)
            for to in self.neighbours(at):
                parent, cost = self.way(at, to)
                if to not in self.closed and cost < self.g.get(to, inf):
                    rank.setdefault(to, len(rank))
                    self.g[to], self.parent[to] = cost, parent
                    opened.add(to)
        return None


class AngleRanges(Search):
    """AP Theta*."""

    def __init__(self, free: set[Corner]) -> None:
        """Ties go to the smaller g."""
        super().__init__(free, 1)
        self.low: dict[Corner, float] = {}
        self.high: dict[Corner, float] = {}

    def begin(self, at: Corner) -> None:
        """Bounds the angles within which the parent sees past `at`."""
        self.low[at], self.high[at] = -inf, inf
        parent = self.parent[at]
        if parent == at:
            return
        for x, y in self.cells(at):
            if (x, y) in self.free:
                continue
            corners = [(x + dx, y + dy) for dx, dy in product((0, 1), (0, 1))]
            turns = [(corner, 0.0 if corner == parent else turned(parent, at, corner)) for corner in corners]
            behind = [turn == 0 and apart(parent, corner) <= apart(parent, at) for corner, turn in turns]
            if all(turn < 0 or is_behind for (_, turn), is_behind in zip(turns, behind, strict=True)):
                self.low[at] = 0.0
            if all(turn > 0 or is_behind for (_, turn), is_behind in zip(turns, behind, strict=True)):
                self.high[at] = 0.0
        for near in self.neighbours(at):
            turn = 0.0 if near == parent else turned(parent, at, near)
            if near in self.closed and self.parent[near] == parent and near != parent:
                if self.low[near] + turn <= NEAR:
                    self.low[at] = max(self.low[at], self.low[near] + turn)
                if self.high[near] + turn >= -NEAR:
                    self.high[at] = min(self.high[at], self.high[near] + turn)
            elif apart(parent, near) < apart(parent, at) and near != parent:
                if turn < 0:
                    self.low[at] = max(self.low[at], turn)
                if turn > 0:
                    self.high[at] = min(self.high[at], turn)

    def way(self, at: Corner, to: Corner) -> Moved:
        """Over the parent of `at` if that sees `to`."""
        parent = self.parent[at]
        if parent != at and to != parent:
            turn = turned(parent, at, to)
            if self.low[at] - NEAR <= turn <= self.high[at] + NEAR:
                return parent, self.g[parent] + apart(parent, to)
        return at, self.g[at] + apart(at, to)

    def length(self, goal: Corner) -> float:
        """The cost of the goal."""
        return self.g[goal]


class Field(Search):
    """Field D*, searched from start to goal."""

    def __init__(self, free: set[Corner], *, only_expanded: bool, looks_ahead: bool) -> None:
        """Ties go to the larger g."""
        super().__init__(free, -1)
        self.only_expanded, self.looks_ahead = only_expanded, looks_ahead

    def way(self, at: Corner, to: Corner) -> Moved:
        """Straight, or over an edge that `at` ends, of a free cell that `to` touches."""
        best = self.g[at] + apart(at, to)
        for x, y in set(self.cells(to)) & self.free:
            other = (2 * x + 1 - to[0], 2 * y + 1 - to[1])
            for edge in (((other[0], to[1]), other), ((to[0], other[1]), other)):
                known = all(end in (self.closed if self.only_expanded else self.g) for end in edge)
                if at in edge and known:
                    best = min(best, self.over(to, edge)[0])
        return at, best

    def over(self, at: Point, edge: tuple[Corner, Corner]) -> tuple[float, Point]:
        """The least cost of a way from `at` over an edge, and where it meets it."""
        (a, b), (cost, other) = edge, (self.g[edge[0]], self.g[edge[1]])

        def point(share: float) -> Point:
            return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])

        def rated(share: float) -> float:
            return apart(at, point(share)) + cost + share * (other - cost)

        share = lowest(rated)
        return rated(share), point(share)

    def ways(self, at: Point) -> list[tuple[Point, float]]:
        """Corners and best points of edges of the free cells about `at`, with the cost that is left from each."""
        found: list[tuple[Point, float]] = []
        for x, y in self.free:
            if not (x <= at[0] <= x + 1 and y <= at[1] <= y + 1):
                continue
            corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
            for edge in pairwise([*corners, corners[0]]):
                found += [(end, self.g[end]) for end in edge if end in self.g and end != at]
                axis = int(edge[0][0] == edge[1][0])
                if all(end in self.g for end in edge) and at[1 - axis] != edge[0][1 - axis]:
                    rated, to = self.over(at, edge)
                    if all(apart(to, end) > 1e-6 for end in edge):
                        found.append((to, rated - apart(at, to)))
        return found

    def length(self, goal: Corner) -> float:
        """The length of the path that is extracted from the goal to the start."""
        at: Point = goal
        cost, length = self.g[goal], 0.0
        while cost > NEAR:
            ways = self.ways(at)
            falls = [(to, left) for to, left in ways if left < cost - NEAR]
            if falls:
                to, cost = min(falls, key=lambda way: apart(at, way[0]) + self.rest(*way))
            else:
                to, cost = min((way for way in ways if way[0] in self.g), key=lambda way: way[1])
            length += apart(at, to)
            at = to
        return length

    def rest(self, at: Point, left: float) -> float:
        """What a path from `at` still costs."""
        if not self.looks_ahead or at in self.g:
            return left
        return min(apart(at, to) + further for to, further in self.ways(at))


def lowest(rated: Callable[[float], float]) -> float:
    """Where between 0 and 1 a convex function is least."""
    low, high = 0.0, 1.0
    for _ in range(100):
        one, other = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, other) if rated(one) < rated(other) else (one, high)
    return min((0.0, 1.0, (low + high) / 2), key=rated)


def main() -> None:
    """Draws the maps and writes the file."""
    draw = random.Random(SEED)
    cases = []
    for _ in range(COUNT):
        size = draw.randint(3, 14), draw.randint(3, 14)
        share = draw.choice([0.0, 0.1, 0.2, 0.4, 0.5])
        rows = [["." if draw.random() >= share else "#" for _ in range(size[0])] for _ in range(size[1])]
        goal = size[0], draw.randint(0, size[1])
        rows[0][0] = rows[max(goal[1] - 1, 0)][-1] = "."
        free = {(x, y) for y, row in enumerate(rows) for x, cell in enumerate(row) if cell == "."}
        searches: dict[str, AngleRanges | Field] = {"ap_theta_star": AngleRanges(free)}
        for interpolates, extraction in product(("opened", "expanded"), ("looks_ahead", "interpolated")):
            rules = {"only_expanded": interpolates == "expanded", "looks_ahead": extraction == "looks_ahead"}
            searches[f"field_dstar {interpolates} {extraction}"] = Field(free, **rules)
        found: dict[str, list[float] | None] = {}
        for name, search in searches.items():
            expansions = search.run((0, 0), goal)
            found[name] = None if expansions is None else [expansions, search.length(goal)]
        text = ["".join(row) for row in reversed(rows)]
        cases.append({"map": text, "goal": list(goal), "found": found})
    target = Path("tests/it/crosscheck/any_angle.json")
    target.write_text("[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]\n")


if __name__ == "__main__":
    main()
