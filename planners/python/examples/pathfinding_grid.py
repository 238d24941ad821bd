"""The package `pathfinding` on grids: its A* with the octile distance."""

from __future__ import annotations

import sys
from importlib.metadata import version
from pathlib import Path

from pathfinding.core.diagonal_movement import DiagonalMovement
from pathfinding.core.grid import Grid
from pathfinding.core.heuristic import octile
from pathfinding.finder.a_star import AStarFinder

sys.path.insert(0, str(Path(__file__).parents[1]))

from replan_planner import Query, Result, serve

MOVEMENT = {
    "allow": DiagonalMovement.always,
    "forbid_both": DiagonalMovement.if_at_most_one_obstacle,
    "forbid_any": DiagonalMovement.only_when_no_obstacle,
}


def plan(query: Query) -> Result:
    """A path of its A*; whether it is the shortest is for the verifier's optimum to say."""
    rows = [[1 if cell == "." else 0 for cell in row] for row in query.world["rows"]]
    grid = Grid(matrix=rows)
    start, goal = (grid.node(int(at[0]), int(at[1])) for at in (query.start, query.goal))
    finder = AStarFinder(heuristic=octile, diagonal_movement=MOVEMENT[query.world["corners"]])
    path, runs = finder.find_path(start, goal, grid)
    counters = {"iterations": float(runs)}
    if not path:
        return Result.no_path(counters)
    return Result.solved([(node.x, node.y) for node in path], counters=counters)


if __name__ == "__main__":
    serve(
        plan,
        name="pathfinding A*",
        version=f"pathfinding {version('pathfinding')}",
        worlds=["grid"],
        deterministic=True,
    )
