"""Answers to the questions about one model."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import numpy.typing as npt

from judge.model import Judged, load
from judge.tables import read_questions, write_table

Numbers = npt.NDArray[np.float64]
Truths = npt.NDArray[np.bool_]

FAR_M = 100.0
"""Pairs farther apart than this would be said to be this far: no robot is."""

FRAME_PARTS = ("x", "y", "z", "xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz")


@dataclass(frozen=True)
class Questions:
    """Configurations, one a row, and what is asked about them besides contact."""

    q_rad: Numbers
    frames: Truths
    gaps: Truths
    limits: Truths


@dataclass(frozen=True)
class Answers:
    """Answers by column: contact for every row, the others for the rows that asked, in their order."""

    touch: dict[str, Truths]
    gaps: dict[str, Numbers]
    frames: dict[str, Numbers]
    limits: dict[str, Truths]


def answer(judged: Judged, questions: Questions) -> Answers:
    """Answer every question."""
    touch = np.zeros((len(questions.q_rad), len(judged.pairs)), dtype=np.bool_)
    gaps, frames, limits = [], [], []
    column_of = contact_columns(judged)
    for row, q_rad in enumerate(questions.q_rad):
        judged.data.qpos[:] = q_rad
        mujoco.mj_kinematics(judged.model, judged.data)
        mujoco.mj_collision(judged.model, judged.data)
        touch[row, touching(judged.data, column_of)] = True
        if questions.frames[row]:
            frames.append(frame_numbers(judged))
        if questions.gaps[row]:
            gaps.append(gap_numbers(judged))
        if questions.limits[row]:
            limits.append(beyond_limits(judged))
    frame_names = [f"{frame}.{part}" for frame in judged.frames for part in FRAME_PARTS]
    pair_names = [pair.name for pair in judged.pairs]
    return Answers(
        touch=by_column(pair_names, touch),
        gaps=by_column(pair_names, stacked(gaps, len(pair_names), np.float64)),
        frames=by_column(frame_names, stacked(frames, len(frame_names), np.float64)),
        limits=by_column(list(judged.joints), stacked(limits, len(judged.joints), np.bool_)),
    )


def contact_columns(judged: Judged) -> npt.NDArray[np.int64]:
    """The column of each pair of geoms, either one first; -1 for pairs that nobody asks about."""
    columns = np.full((judged.model.ngeom, judged.model.ngeom), -1, dtype=np.int64)
    for column, pair in enumerate(judged.pairs):
        one, other = pair.geoms
        columns[one, other] = columns[other, one] = column
    return np.asarray(columns)


def touching(data: mujoco.MjData, column_of: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """The columns of the pairs in contact now."""
    if data.ncon == 0:
        return np.empty(0, dtype=np.int64)
    geoms = data.contact.geom[np.asarray(data.contact.dist) <= 0.0]
    columns = column_of[geoms[:, 0], geoms[:, 1]]
    if (columns < 0).any():
        message = f"MuJoCo reports contact of a pair that is not among those that may touch: {geoms.tolist()}"
        raise ValueError(message)
    return np.asarray(columns)


def frame_numbers(judged: Judged) -> Numbers:
    """Place and rotation, row by row, of every frame now."""
    bodies = [judged.data.body(name) for name in judged.frames]
    return np.concatenate([np.concatenate([body.xpos, body.xmat]) for body in bodies])


def gap_numbers(judged: Judged) -> Numbers:
    """MuJoCo's distance of every pair now; what it says of pairs in contact means little."""
    ends = np.zeros(6)
    distances = [mujoco.mj_geomDistance(judged.model, judged.data, *pair.geoms, FAR_M, ends) for pair in judged.pairs]
    return np.array(distances)


def beyond_limits(judged: Judged) -> Truths:
    """Which joints MuJoCo pushes back to their limits now."""
    mujoco.mj_fwdPosition(judged.model, judged.data)
    data, beyond = judged.data, np.zeros(len(judged.joints), dtype=np.bool_)
    is_limit = np.asarray(data.efc_type) == int(mujoco.mjtConstraint.mjCNSTR_LIMIT_JOINT)
    beyond[np.asarray(data.efc_id)[is_limit]] = True
    return beyond


def stacked(rows: list[npt.NDArray[Any]], width: int, kind: type) -> npt.NDArray[Any]:
    """The rows as one array, also if there is none."""
    return np.array(rows, dtype=kind) if rows else np.empty((0, width), dtype=kind)


def by_column(names: list[str], cells: npt.NDArray[Any]) -> dict[str, npt.NDArray[Any]]:
    """The columns of an array by their names."""
    return {name: np.ascontiguousarray(cells[:, column]) for column, name in enumerate(names)}


def answer_model(path: Path) -> str:
    """Answer the questions beside the model at `path` with files there, and say which model it was."""
    judged = load(path)
    q_rad, asked = read_questions(path, len(judged.joints))
    answers = answer(judged, Questions(q_rad, asked["frames"], asked["gaps"], asked["limits"]))
    for part in ("touch", "gaps", "frames", "limits"):
        write_table(path, part, getattr(answers, part))
    return f"{path.parent.name}/{path.stem}"
