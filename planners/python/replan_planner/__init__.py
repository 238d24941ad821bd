"""Joins a planner written in Python to replan: a planner is a function from a query to a result.

    from replan_planner import Query, Result, serve

    def straight(query: Query) -> Result:
        return Result.solved([query.start, query.goal])

    serve(straight, name="straight", version="1", worlds=["plane"])

Standard output belongs to the protocol, so that `print` is sent to standard error, the planner's log. The protocol is
documented in docs/PLANNER_PROTOCOL.md; a world is the dictionary that stands there. No dependencies.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, TextIO

PROTOCOL = 1

Configuration = Sequence[float]
Path = Sequence[Configuration]


class ProtocolError(Exception):
    """replan wrote something that this module does not understand."""


@dataclass(frozen=True)
class Limits:
    """What replan holds a planner to."""

    time_s: float
    memory_mb: int
    output_mb: int


@dataclass(frozen=True)
class Result:
    """How a query ended. A cost is in the world's unit; leave it out if you did not work it out."""

    status: str
    path: Path = ()
    cost: float | None = None
    counters: dict[str, float] = field(default_factory=dict)

    @staticmethod
    def solved(path: Path, cost: float | None = None, counters: dict[str, float] | None = None) -> Result:
        """A path from start to goal."""
        return Result("solved", path, cost, counters or {})

    @staticmethod
    def no_path(counters: dict[str, float] | None = None) -> Result:
        """There is no path, or nothing is left to try."""
        return Result("no_path", counters=counters or {})

    @staticmethod
    def time_spent(counters: dict[str, float] | None = None) -> Result:
        """The time ran out without a path."""
        return Result("time_spent", counters=counters or {})


class Query:
    """A query, and the questions that may be asked about its world; they come in batches because each costs a message."""

    def __init__(self, message: dict[str, Any], channel: Channel) -> None:
        self.id: int = message["id"]
        self.seed: int = message["seed"]
        self.limits = Limits(**message["limits"])
        self.world: dict[str, Any] = message["world"]
        self.start: list[float] = message["start"]
        self.goal: list[float] = message["goal"]
        self._channel = channel
        self._begun_s = time.monotonic()
        self._asked = 0

    @property
    def left_s(self) -> float:
        """The time that is left, by this process's clock; replan's judges."""
        return self.limits.time_s - (time.monotonic() - self._begun_s)

    def valid(self, configurations: Sequence[Configuration]) -> list[bool]:
        """Whether each configuration is free."""
        return self._ask("valid", valid=[list(at) for at in configurations]) if configurations else []

    def motion(self, pairs: Sequence[tuple[Configuration, Configuration]]) -> list[bool]:
        """Whether each motion is free, both ends included."""
        return self._ask("motion", motion=[[list(a), list(b)] for a, b in pairs]) if pairs else []

    def free_until(self, pairs: Sequence[tuple[Configuration, Configuration]]) -> list[float]:
        """Up to which fraction each motion is free: 1 for a free one."""
        asked = [[list(a), list(b)] for a, b in pairs]
        return self._ask("free_until", motion=asked, fractions=True) if asked else []

    def fk(self, joints: Sequence[Configuration]) -> list[dict[str, Any]]:
        """The pose of the tip in each posture."""
        return self._ask("fk", fk=[list(q) for q in joints]) if joints else []

    def ik(self, poses: Sequence[dict[str, Any]]) -> list[list[list[float]]]:
        """Every posture with the tip in each pose."""
        return self._ask("ik", ik=list(poses)) if poses else []

    def incumbent(self, path: Path, cost: float | None = None) -> None:
        """Hands over the best path so far; it counts if the time runs out."""
        self._channel.write({"type": "incumbent", "id": self.id, "cost": cost, "path": [list(at) for at in path]})

    def _ask(self, key: str, **questions: Any) -> Any:
        self._asked += 1
        self._channel.write({"type": "ask", "id": self._asked, **questions})
        answer = self._channel.read()
        if answer is None or answer.get("type") != "answer" or answer.get("id") != self._asked:
            raise ProtocolError(f"an answer to question {self._asked} is expected, found {answer}")
        return answer[key]


class Channel:
    """Lines of JSON in both directions."""

    def __init__(self, source: TextIO, sink: TextIO) -> None:
        self._source, self._sink = source, sink

    def read(self) -> dict[str, Any] | None:
        """The next message; none at the end."""
        line = self._source.readline()
        return json.loads(line) if line else None

    def write(self, message: dict[str, Any]) -> None:
        """Writes one message; numbers that JSON does not have are refused."""
        self._sink.write(json.dumps(message, allow_nan=False) + "\n")
        self._sink.flush()


def serve(
    planner: Callable[[Query], Result],
    *,
    name: str,
    version: str,
    worlds: Sequence[str],
    seeding: str = "query",
    deterministic: bool = False,
    anytime: bool = False,
    source: TextIO | None = None,
    sink: TextIO | None = None,
) -> None:
    """Says hello and answers queries until replan says quit."""
    channel = Channel(source or sys.stdin, sink or sys.stdout)
    if sink is None:
        sys.stdout = sys.stderr
    hello = {"name": name, "version": version, "worlds": list(worlds), "seeding": seeding}
    flags = {"deterministic": deterministic, "anytime": anytime}
    channel.write({"type": "hello", "protocol": PROTOCOL, **hello, **flags})
    while (message := channel.read()) is not None and message["type"] != "quit":
        if message["type"] != "solve":
            raise ProtocolError(f"a query is expected, found a message of type {message['type']}")
        query = Query(message, channel)
        begun_ns = time.perf_counter_ns()
        result = planner(query)
        counters = {"own_wall_ns": time.perf_counter_ns() - begun_ns, **result.counters}
        path = [list(at) for at in result.path]
        found = {"status": result.status, "path": path, "cost": result.cost, "counters": counters}
        channel.write({"type": "result", "id": query.id, **found})


def is_free(world: dict[str, Any], x: int, y: int) -> bool:
    """Whether a cell of a grid is inside and free."""
    width, height = world["size"]
    return 0 <= x < width and 0 <= y < height and bool(world["rows"][y][x] == ".")


def neighbours(world: dict[str, Any], x: int, y: int) -> list[tuple[int, int, float]]:
    """The cells that a step leads to from a free cell of a grid, under its rule of corners, with the step's length."""
    found = []
    for dx in (-1, 0, 1):
        for dy in (-1, 0, 1):
            if (dx, dy) == (0, 0) or not is_free(world, x + dx, y + dy):
                continue
            if dx and dy and world["corners"] != "allow":
                flanks = [is_free(world, x + dx, y), is_free(world, x, y + dy)]
                if not (all if world["corners"] == "forbid_any" else any)(flanks):
                    continue
            found.append((x + dx, y + dy, 2**0.5 if dx and dy else 1.0))
    return found
