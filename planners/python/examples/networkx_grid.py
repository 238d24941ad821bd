"""networkx on grids: `astar_path` over the graph of free cells."""

from __future__ import annotations

import sys
from pathlib import Path

import networkx as nx

sys.path.insert(0, str(Path(__file__).parents[1]))

from replan_planner import Query, Result, is_free, neighbours, serve


def plan(query: Query) -> Result:
    """A shortest path; the time to build the graph counts, as it would for anyone who is given a map."""
    start, goal = ((int(at[0]), int(at[1])) for at in (query.start, query.goal))
    width, height = query.world["size"]
    graph = nx.DiGraph()
    for x in range(width):
        for y in range(height):
            if is_free(query.world, x, y):
                graph.add_node((x, y))
                graph.add_weighted_edges_from(((x, y), (a, b), w) for a, b, w in neighbours(query.world, x, y))

    def octile(a: tuple[int, int], b: tuple[int, int]) -> float:
        near, far = sorted((abs(a[0] - b[0]), abs(a[1] - b[1])))
        return far - near + near * 2**0.5

    try:
        path = nx.astar_path(graph, start, goal, heuristic=octile)
    except nx.NetworkXNoPath:
        return Result.no_path()
    return Result.solved(path)


if __name__ == "__main__":
    serve(plan, name="networkx A*", version=f"networkx {nx.__version__}", worlds=["grid"], deterministic=True)
