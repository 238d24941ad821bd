"""A* for a planar arm whose tip goes from lattice point to lattice point; replan checks the hops. Needs nothing but Python."""

from __future__ import annotations

import heapq
import sys
from math import hypot
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from replan_planner import Query, Result, serve

HOPS = [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)]


def plan(query: Query) -> Result:
    """A shortest path over eight neighbours, in the tip's way; all hops of a point are asked about in one batch."""
    (low_x, low_y), step, (columns, rows) = (query.world[key] for key in ("low_cm", "step_cm", "size"))

    def place(cell: tuple[int, int]) -> list[float]:
        return [low_x + step * cell[0], low_y + step * cell[1]]

    def cell_at(at: list[float]) -> tuple[int, int]:
        return round((at[0] - low_x) / step), round((at[1] - low_y) / step)

    start, goal = cell_at(query.start), cell_at(query.goal)

    def ahead(cell: tuple[int, int]) -> float:
        return step * hypot(cell[0] - goal[0], cell[1] - goal[1])

    best, before = {start: 0.0}, {start: start}
    queue, closed = [(ahead(start), start)], set()
    while queue:
        _, at = heapq.heappop(queue)
        if at == goal:
            path = [at]
            while path[-1] != start:
                path.append(before[path[-1]])
            places = [place(cell) for cell in path[::-1]]
            return Result.solved([query.start, *places[1:-1], query.goal], counters={"expansions": len(closed)})
        if at in closed:
            continue
        closed.add(at)
        near = [(at[0] + dx, at[1] + dy) for dx, dy in HOPS]
        near = [to for to in near if 0 <= to[0] < columns and 0 <= to[1] < rows and to not in closed]
        free = query.motion([(place(at), place(to)) for to in near]) if near else []
        for to in (to for to, is_free in zip(near, free, strict=True) if is_free):
            cost = best[at] + step * hypot(to[0] - at[0], to[1] - at[1])
            if cost < best.get(to, float("inf")):
                best[to], before[to] = cost, at
                heapq.heappush(queue, (cost + ahead(to), to))
    return Result.no_path({"expansions": len(closed)})


if __name__ == "__main__":
    serve(plan, name="A* for a planar arm", version="1", worlds=["planar_arm"], deterministic=True)
