"""The module by itself: a conversation on strings."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))

import grid_astar

from replan_planner import ProtocolError, Query, Result, neighbours, serve

WORLD = {"kind": "grid", "size": [3, 2], "rows": ["..@", ".@."], "corners": "allow", "any_angle": False}
SOLVE = {
    "type": "solve",
    "id": 4,
    "seed": 9,
    "limits": {"time_s": 1.0, "memory_mb": 64, "output_mb": 1},
    "world": WORLD,
    "start": [0, 1],
    "goal": [2, 1],
}


def said(planner, *messages: dict) -> list[dict]:
    """What a planner writes when it is given these messages."""
    sink = io.StringIO()
    source = io.StringIO("".join(json.dumps(message) + "\n" for message in messages))
    serve(planner, name="t", version="1", worlds=["grid"], source=source, sink=sink)
    return [json.loads(line) for line in sink.getvalue().splitlines()]


def test_hello_comes_first_and_quit_or_the_end_of_input_ends_it() -> None:
    for messages in ([], [{"type": "quit"}]):
        (hello,) = said(lambda query: Result.no_path(), *messages)
        assert (hello["type"], hello["protocol"], hello["seeding"]) == ("hello", 1, "query")


def test_questions_are_answered_by_what_comes_next_on_the_input() -> None:
    def plan(query: Query) -> Result:
        assert query.valid([[0, 0], [1, 1]]) == [True, False]
        assert query.motion([([0, 1], [1, 0])]) == [True]
        query.incumbent([query.start, query.goal], 2.0)
        return Result.solved([query.start, query.goal])

    answers = [
        {"type": "answer", "id": 1, "valid": [True, False]},
        {"type": "answer", "id": 2, "motion": [True]},
    ]
    _, ask, move, incumbent, result = said(plan, SOLVE, *answers)
    assert ask == {"type": "ask", "id": 1, "valid": [[0, 0], [1, 1]]}
    assert move["motion"] == [[[0, 1], [1, 0]]]
    assert (incumbent["id"], incumbent["cost"]) == (4, 2.0)
    assert (result["id"], result["status"], result["path"]) == (4, "solved", [[0, 1], [2, 1]])
    assert result["counters"]["own_wall_ns"] > 0


def test_an_answer_to_another_question_and_a_number_that_json_lacks_are_errors() -> None:
    with pytest.raises(ProtocolError):
        said(lambda query: Result.solved(query.valid([[0, 0]])), SOLVE, {"type": "answer", "id": 7, "valid": [True]})
    with pytest.raises(ValueError, match="not JSON compliant"):
        said(lambda query: Result.solved([[float("nan"), 0]]), SOLVE)


def test_corners_are_cut_as_the_rule_says() -> None:
    # From (1, 0): the cells beside the step to (2, 1) are both blocked, of those beside the step to (0, 1) one is.
    steps = {
        rule: {(x, y) for x, y, _ in neighbours({**WORLD, "corners": rule}, 1, 0)}
        for rule in ("allow", "forbid_both", "forbid_any")
    }
    assert steps == {"allow": {(0, 0), (0, 1), (2, 1)}, "forbid_both": {(0, 0), (0, 1)}, "forbid_any": {(0, 0)}}


def test_the_smallest_example_finds_the_shortest_path() -> None:
    result = said(grid_astar.plan, SOLVE)[1]
    assert result["path"] == [[0, 1], [1, 0], [2, 1]]
    assert abs(result["cost"] - 2 * 2**0.5) < 1e-12
