"""Asks and plans nothing: `ask.py BATCHES SIZE` asks about the motion from start to goal, to measure what questions cost."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from replan_planner import Query, Result, serve


def plan(query: Query) -> Result:
    """Every batch, one after another."""
    batches, size = (int(word) for word in sys.argv[1:3])
    for _ in range(batches):
        query.motion([(query.start, query.goal)] * size)
    return Result.no_path()


if __name__ == "__main__":
    serve(
        plan, name="ask", version="1", worlds=["grid", "planar_arm", "cell", "polyhedra", "plane"], deterministic=True
    )
