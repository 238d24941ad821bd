"""Where links and tool are, how they move, and which joint angles put the tool somewhere: worked out from rows.

Frames are 4 by 4 matrices in the world; angles come and go as one row a configuration.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from judge.located import Fault
from judge.robots import Model, Numbers, Row

NEWTON_STEPS = 30
REACHED = 1e-10
"""How far from its target a tool may be, in metres and radians."""


def moved(row: Row, value: Numbers) -> Numbers:
    """The frame after one joint and link, in the frame before."""
    turn, slide = (0.0 * value, value) if row.slides else (value, 0.0)
    sine, cosine = np.sin(turn + row.offset_rad), np.cos(turn + row.offset_rad)
    twisted = np.array([0.0, np.sin(row.alpha_rad), np.cos(row.alpha_rad)])
    frame = np.zeros((len(value), 4, 4))
    frame[:, 0] = np.stack([cosine, -sine * twisted[2], sine * twisted[1], row.a_m * cosine], axis=1)
    frame[:, 1] = np.stack([sine, cosine * twisted[2], -cosine * twisted[1], row.a_m * sine], axis=1)
    frame[:, 2, :3] = twisted
    frame[:, 2, 3] = row.d_m + slide
    frame[:, 3, 3] = 1.0
    return frame


def frames(model: Model, q_rad: Numbers) -> Numbers:
    """The frames of the base, of every link and of the tool, for each configuration."""
    now = np.broadcast_to(model.base, (len(q_rad), 4, 4))
    found = [now]
    for row, value in zip(model.rows, q_rad.T, strict=True):
        now = now @ moved(row, value)
        found.append(now)
    return np.stack([*found, now @ model.tool()], axis=1)


def jacobian(model: Model, placed: Numbers, frame: int) -> Numbers:
    """How the origin of a frame moves and turns with each joint: six rows, for each configuration."""
    joints = placed[:, :-2]
    axes, origins = joints[:, :, :3, 2], joints[:, :, :3, 3]
    arms = placed[:, frame, None, :3, 3] - origins
    slides = np.array([row.slides for row in model.rows])[:, None]
    ways, turns = np.where(slides, axes, np.cross(axes, arms)), np.where(slides, 0.0, axes)
    return np.concatenate([ways, turns], axis=2).transpose(0, 2, 1)


def determinant(model: Model, q_rad: Numbers) -> Numbers:
    """The determinant of the last link's Jacobian, 0 at a singular pose; in the plane that of its place alone."""
    joints = len(model.rows)
    found = jacobian(model, frames(model, q_rad), joints)
    return np.asarray(np.linalg.det(found[:, :2] if joints == 2 else found))


def straight_tool(model: Model, start: Numbers, end: Numbers, share: float) -> Numbers:
    """Joint angles at a share of each of many steps whose tool goes straight and turns evenly about one axis.

    They are found from the angles in between, so that they are of the same posture; NaN where none are found.
    """
    from_tool, to_tool = frames(model, start)[:, -1], frames(model, end)[:, -1]
    origin = from_tool[:, :3, 3] + (to_tool[:, :3, 3] - from_tool[:, :3, 3]) * share
    turn = Rotation.from_matrix(to_tool[:, :3, :3] @ from_tool[:, :3, :3].transpose(0, 2, 1)).as_rotvec()
    axes = Rotation.from_rotvec(turn * share).as_matrix() @ from_tool[:, :3, :3]
    q_rad = start + (end - start) * share
    for _ in range(NEWTON_STEPS):
        placed = frames(model, q_rad)
        turned = Rotation.from_matrix(axes @ placed[:, -1, :3, :3].transpose(0, 2, 1)).as_rotvec()
        error = np.concatenate([origin - placed[:, -1, :3, 3], turned], axis=1)
        far = np.abs(error).max(axis=1) > REACHED
        if not far.any():
            return q_rad
        slopes = np.linalg.pinv(jacobian(model, placed, len(model.rows) + 1)[far], rcond=1e-9)
        q_rad[far] += (slopes @ error[far, :, None])[:, :, 0]
    q_rad[far] = np.nan
    return q_rad


def continued(start: Numbers, end: Numbers) -> Numbers:
    """The angles `end` with whole turns added so that each is as near as possible to `start`."""
    return end + 2 * np.pi * np.round((start - end) / (2 * np.pi))


def straight_tip(model: Model, start: Numbers, end: Numbers, share: float) -> Numbers:
    """The same of an arm with two links in the plane, in closed form: the elbow stays on its side."""
    one, other = frames(model, start)[:, -1, :2, 3], frames(model, end)[:, -1, :2, 3]
    x, y = (one + (other - one) * share).T
    first, second = model.rows[0].a_m, model.rows[1].a_m
    cosine = (x**2 + y**2 - first**2 - second**2) / (2 * first * second)
    bend = np.arccos(np.clip(cosine, -1.0, 1.0))
    bend = np.where(start[:, 1] + end[:, 1] > 0, bend, -bend)
    lean = np.arctan2(y, x) - np.arctan2(second * np.sin(bend), first + second * np.cos(bend))
    return continued(start, np.stack([lean, bend], axis=1))


def between(model: Model, straight: str, start: Numbers, end: Numbers, share: float) -> Numbers:
    """Joint angles at a share of each of many steps; `tool`, `tip` or `joints` go straight."""
    if straight == "tool":
        return straight_tool(model, start, end, share)
    if straight == "tip":
        return straight_tip(model, start, end, share)
    end = np.where([row.is_endless for row in model.rows], continued(start, end), end)
    return start + (end - start) * share


def refined(model: Model, straight: str, stops_rad: Numbers, parts: int, name: str) -> Numbers:
    """A path with each step cut in `parts`; steps that lead nowhere are left out."""
    stops_rad = stops_rad[[True, *(stops_rad[1:] != stops_rad[:-1]).any(axis=1)]]
    start, end = stops_rad[:-1], stops_rad[1:]
    cuts = [between(model, straight, start, end, part / parts) for part in range(1, parts)]
    finer = np.stack([start, *cuts], axis=1).reshape(-1, stops_rad.shape[1])
    if np.isnan(finer).any():
        step = int(np.flatnonzero(np.isnan(finer).any(axis=1))[0]) // parts + 1
        raise Fault(f"step {step} of path `{name}` cannot be followed")
    return np.vstack([finer, stops_rad[-1:]])


def flat(q_rad: Numbers) -> list[float]:
    """A configuration as plain numbers."""
    return [float(angle) for angle in q_rad]
