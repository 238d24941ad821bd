"""A* on grids in plain Python: the smallest example. Needs nothing but Python."""

from __future__ import annotations

import heapq
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from replan_planner import Query, Result, neighbours, serve


def plan(query: Query) -> Result:
    """A shortest path by the octile distance."""
    start, goal = ((int(at[0]), int(at[1])) for at in (query.start, query.goal))

    def octile(x: int, y: int) -> float:
        near, far = sorted((abs(x - goal[0]), abs(y - goal[1])))
        return far - near + near * 2**0.5

    best, before = {start: 0.0}, {start: start}
    queue, closed = [(octile(*start), start)], set()
    while queue:
        _, at = heapq.heappop(queue)
        if at == goal:
            path = [at]
            while path[-1] != start:
                path.append(before[path[-1]])
            return Result.solved(path[::-1], best[goal], {"expansions": len(closed)})
        if at in closed:
            continue
        closed.add(at)
        for x, y, length in neighbours(query.world, *at):
            cost = best[at] + length
            if cost < best.get((x, y), float("inf")):
                best[x, y], before[x, y] = cost, at
                heapq.heappush(queue, (cost + octile(x, y), (x, y)))
    return Result.no_path({"expansions": len(closed)})


if __name__ == "__main__":
    serve(plan, name="grid A* in Python", version="1", worlds=["grid"], deterministic=True)
