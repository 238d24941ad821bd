"""A* on a grid by a Python package: networkx or pathfinding, as their documentation shows.

The question has the rows of the map (1: free), the legal moves as the graph's edges and the queries, cells by index.
A round is all queries; the answer is the sum of their costs, 985 a straight step and 1393 a diagonal one.
"""

import json
import sys
import time
from collections.abc import Callable
from typing import Any

STRAIGHT, DIAGONAL = 985, 1393


def octile(ours: tuple[int, int], other: tuple[int, int]) -> int:
    """The least cost between two cells of an empty grid."""
    across, along = abs(ours[0] - other[0]), abs(ours[1] - other[1])
    return STRAIGHT * abs(across - along) + DIAGONAL * min(across, along)


def by_networkx(question: dict[str, Any]) -> Callable[[], int]:
    """`networkx.astar_path` on a graph with an attribute for the cost of each edge."""
    import networkx as nx

    width = len(question["rows"][0])
    graph = nx.DiGraph()
    for ours, other in question["moves"]:
        places = divmod(ours, width), divmod(other, width)
        graph.add_edge(*places, weight=octile(*places))

    def solve() -> int:
        total = 0
        for ends in question["queries"]:
            start, goal = (divmod(cell, width) for cell in ends)
            path = nx.astar_path(graph, start, goal, heuristic=octile, weight="weight")
            total += sum(octile(one, two) for one, two in zip(path, path[1:], strict=False))
        return total

    return solve


def by_pathfinding(question: dict[str, Any]) -> Callable[[], int]:
    """`AStarFinder`, no diagonal past a blocked cell."""
    from pathfinding.core.diagonal_movement import DiagonalMovement
    from pathfinding.core.grid import Grid
    from pathfinding.finder.a_star import AStarFinder

    grid = Grid(matrix=question["rows"])
    width = len(question["rows"][0])
    finder = AStarFinder(diagonal_movement=DiagonalMovement.only_when_no_obstacle)

    def solve() -> int:
        total = 0
        for start, goal in question["queries"]:
            grid.cleanup()
            ends = (grid.node(cell % width, cell // width) for cell in (start, goal))
            path, _ = finder.find_path(*ends, grid)
            cells = [(node.x, node.y) for node in path]
            total += sum(octile(one, two) for one, two in zip(cells, cells[1:], strict=False))
        return total

    return solve


def main() -> None:
    """Answer the sum of all costs by the package that the question names, then time rounds."""
    question = json.loads(sys.stdin.readline())
    solve = {"networkx": by_networkx, "pathfinding": by_pathfinding}[question["package"]](question)
    print(solve(), flush=True)
    for line in sys.stdin:
        begun = time.perf_counter_ns()
        for _ in range(int(line)):
            solve()
        print(time.perf_counter_ns() - begun, flush=True)


if __name__ == "__main__":
    main()
