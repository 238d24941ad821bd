"""OMPL's planners in the plane, among polyhedra and in the cell of an arm, with replan's collision checks.

    python ompl_planner.py RRTConnect|RRTstar|PRMstar|BITstar [--shortcut]

A second seed in one process is ignored by OMPL, so every query gets a process of its own. The planners that go on to improve
their path use the whole time; the others stop at their first. With --shortcut the path is simplified by OMPL while a tenth of
the time is left for it. Needs OMPL 2 (Python 3.11).
"""

from __future__ import annotations

import sys
from importlib.metadata import version
from pathlib import Path

from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

sys.path.insert(0, str(Path(__file__).parents[1]))

from replan_planner import Query, Result, serve

IMPROVES = {"RRTConnect": False, "RRTstar": True, "PRMstar": True, "BITstar": True}
SHARE = 0.85
"""The share of the time that planning may take, shortcuts included; what is left is for messages."""
SHORTCUT_SHARE = 0.1
"""Of it, what shortcuts may take."""
SLICES = 20
"""Incumbents are handed over after each slice of the time."""


def bounds(world: dict) -> list[tuple[float, float]]:
    """The least and the greatest of each number of a configuration."""
    if world["kind"] == "plane":
        return [(0.0, side) for side in world["size_mm"]]
    if world["kind"] == "polyhedra":
        return list(zip(world["low_cm"], world["high_cm"], strict=True))
    return [(joint["lower_rad"], joint["upper_rad"]) for joint in world["joints"]]


def numbers(state: ob.State, width: int, world: dict) -> list[float]:
    """A state as replan takes it: in the plane on its raster, on which a path's states and those asked about are the same."""
    raster = world.get("raster_mm")
    return [round(state[i] / raster) * raster if raster else state[i] for i in range(width)]


class Motions(ob.MotionValidator):
    """Asks replan whether a motion is free."""

    def __init__(self, space: ob.SpaceInformation, query: Query, width: int) -> None:
        super().__init__(space)
        self.query, self.width = query, width

    def checkMotion(self, a: ob.State, b: ob.State, lastValid: object = None) -> bool:
        """Whether the motion is free; the last valid state is not worked out, since none of these planners uses it."""
        ends = [numbers(state, self.width, self.query.world) for state in (a, b)]
        return ends[0] == ends[1] or self.query.motion([(ends[0], ends[1])])[0]


def plan(query: Query, name: str, shortcut: bool) -> Result:
    """One planner on one query."""
    ou.setLogLevel(ou.LogLevel.LOG_ERROR if hasattr(ou, "LogLevel") else ou.LOG_ERROR)
    ou.RNG.setSeed(query.seed % (2**31 - 2) + 1)
    limits, width = bounds(query.world), len(query.start)
    space = ob.RealVectorStateSpace(width)
    box = ob.RealVectorBounds(width)
    for axis, (low, high) in enumerate(limits):
        box.setLow(axis, low)
        box.setHigh(axis, high)
    space.setBounds(box)
    setup = og.SimpleSetup(space)
    information = setup.getSpaceInformation()
    setup.setStateValidityChecker(lambda state: query.valid([numbers(state, width, query.world)])[0])
    information.setMotionValidator(Motions(information, query, width))
    states = []
    for at in (query.start, query.goal):
        state = space.allocState()
        for axis, value in enumerate(at):
            state[axis] = value
        states.append(state)
    setup.setStartAndGoalStates(*states)
    setup.setPlanner(getattr(og, name)(information))
    setup.setup()

    def path() -> list[list[float]]:
        found = setup.getSolutionPath()
        states = [numbers(found.getState(k), width, query.world) for k in range(found.getStateCount())]
        # What OMPL rounds at the ends is put right: the ends are the query's.
        return [query.start, *states[1:-1], query.goal]

    ends_s = query.limits.time_s * (1.0 - SHARE + (SHORTCUT_SHARE if shortcut else 0.0)) + 0.02
    slice_s = (query.limits.time_s - ends_s) / SLICES
    while query.left_s > ends_s and (IMPROVES[name] or not setup.haveExactSolutionPath()):
        setup.solve(max(min(slice_s, query.left_s - ends_s), 0.001))
        if setup.haveExactSolutionPath():
            query.incumbent(path())
    if not setup.haveExactSolutionPath():
        return Result.time_spent()
    if shortcut:
        setup.simplifySolution(query.limits.time_s * SHORTCUT_SHARE)
    return Result.solved(path())


def main() -> None:
    """Serves the planner that the command line names."""
    name, shortcut = sys.argv[1], "--shortcut" in sys.argv[2:]
    serve(
        lambda query: plan(query, name, shortcut),
        name=f"OMPL {name}",
        version=f"ompl {version('ompl')}",
        worlds=["plane", "polyhedra", "cell"],
        seeding="process",
        anytime=IMPROVES[name],
    )


if __name__ == "__main__":
    main()
