"""Paths that are drawn where none are stored, and paths that are pushed into an obstacle."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from judge.gaps import Gaps
from judge.questions import Rows, drawn
from judge.robots import Numbers
from judge.stored import Stored

FINER = 4
"""Into how many parts each step of a stored path is cut."""
DRAWN_STEP_RAD = 0.02
"""The step of a path that is drawn: the largest change of a joint."""
DRAWS = 200
"""Draws per wanted path."""
PUSH_M = 2e-3
"""How deep a pushed path must be in contact."""
PUSH_STEP_RAD, PROBE_RAD, PUSHES = 0.01, 1e-6, 400
PUSH_REACH = 12
"""How many configurations either side are pushed along, less and less."""


@dataclass(frozen=True)
class Pushed:
    """A free path that was pushed: which of its configurations is in contact now, and of which pair."""

    path: Stored
    stop: int
    pair: int


def drawn_paths(measured: Gaps, count: int, seed: np.random.SeedSequence) -> list[Stored]:
    """Straight joint lines between drawn configurations that MuJoCo finds free."""
    stream = np.random.default_rng(seed)
    paths: list[Stored] = []
    for _ in range(count * DRAWS):
        if len(paths) == count:
            break
        start, end = drawn(measured.model, stream, 2)
        steps = max(1, int(np.ceil(np.abs(end - start).max() / DRAWN_STEP_RAD)))
        stops = start + (end - start) * (np.arange(steps + 1) / steps)[:, None]
        if all(map(measured.is_free, stops)):
            paths.append(Stored(f"drawn {len(paths) + 1}", stops))
    return paths


def first_pushed(measured: Gaps, paths: Iterable[Stored]) -> Pushed | None:
    """The first path that is free and can be pushed into something that stands still, pushed."""
    return next((found for path in paths if (found := pushed(measured, path)) is not None), None)


def cut(found: Pushed) -> Pushed:
    """The pushed path without what was left as it was."""
    first = max(0, found.stop - PUSH_REACH)
    stops = found.path.stops_rad[first : found.stop + PUSH_REACH + 1]
    return Pushed(Stored(found.path.name, stops), found.stop - first, found.pair)


def pushed(measured: Gaps, path: Stored) -> Pushed | None:
    """A free path with the configuration nearest to an obstacle moved downhill in clearance into contact."""
    outer = np.flatnonzero(measured.stills >= 0)
    if not len(outer) or not all(map(measured.is_free, path.stops_rad)):
        return None
    worst = int(np.argmin([measured.of(q_rad, outer).min() for q_rad in path.stops_rad]))
    start = path.stops_rad[worst]
    end = downhill(measured, outer, start)
    gaps = measured.of(end, outer)
    if gaps.min() > -PUSH_M:
        return None
    away = np.abs(np.arange(len(path.stops_rad)) - worst)
    weight = np.maximum(1.0 - away / PUSH_REACH, 0.0)[:, None]
    moved = Stored(path.name, path.stops_rad + weight * (end - start))
    return Pushed(moved, worst, int(outer[np.argmin(gaps)]))


def downhill(measured: Gaps, outer: Rows, start: Numbers) -> Numbers:
    """Where steps against the slope of the least gap lead, until it is deep enough."""
    q_rad = start.copy()
    for _ in range(PUSHES):
        here = measured.of(q_rad, outer).min()
        if here <= -PUSH_M:
            break
        probes = q_rad + PROBE_RAD * np.eye(len(q_rad))
        slopes = np.array([measured.of(probe, outer).min() - here for probe in probes]) / PROBE_RAD
        steepness = float(np.linalg.norm(slopes))
        if steepness == 0.0:
            break
        q_rad -= PUSH_STEP_RAD * slopes / steepness
    return q_rad
