"""One robot in one scene as it is asked about, with errors made on purpose, and MuJoCo's answers.

Beside each model `<name>.xml` lies `<name>.questions.parquet`. `scene` is the right model; `longer_link` and
`shifted_obstacle` are wrong, and their questions name the row of the same configuration among those of `scene`.
`case.json` has what a comparison needs besides.
"""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from judge.answers import answer_model
from judge.gaps import Gaps
from judge.kinematics import flat, refined
from judge.mjcf import mjcf
from judge.paths import FINER, Pushed, cut, drawn_paths, first_pushed
from judge.questions import NEAR, PATH, PUSHED, Rows, block, questions
from judge.robots import Model, Numbers
from judge.specs import Case, Places, Spec
from judge.stored import Stored
from judge.tables import angles_of, beside

RIGHT, STRETCHED, SHIFTED = "scene", "longer_link", "shifted_obstacle"
TIE_M = 1e-6
"""How far distances may differ, and how near to contact either answer is right.

MuJoCo keeps the vertices of meshes in single precision, which moves faces by up to 6e-8 m at 1 m from their middle.
"""
STRETCH_M, SHIFT_M = 1e-3, 5e-3
"""By how much the longest link is made longer, and an obstacle moved."""
STRETCHED_ROWS, SHIFTED_ROWS = 200, 400
KEYS = 10
"""How many paths, and how many configurations near contact, have keyframes."""


def pose_case(places: Places, name: str, to: Path) -> str:
    """Write the case called `name` below `to` and have MuJoCo answer it; what was there of it is dropped."""
    spec = Spec(places)
    case, folder = spec.case(name), to / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    posed = Posed(case, spec.table["sizes"], spec.seed(name))
    picture = spec.table["picture"]
    if picture["case"] == name and picture["key"] not in posed.keys:
        known = ", ".join(posed.keys)
        raise spec.fault(("picture", "key"), f"there is no keyframe `{picture['key']}`; case `{name}` has {known}")
    posed.write(folder)
    for model in (RIGHT, STRETCHED, SHIFTED):
        answer_model(folder / f"{model}.xml")
    return name


@dataclass(frozen=True)
class Shift:
    """An obstacle that is moved, and the answers that must change: rows of the questions near contact, and pairs."""

    still: int
    by_m: Numbers
    flips: list[tuple[int, int]]


class Posed:
    """A case with its questions."""

    def __init__(self, case: Case, sizes: dict[str, int], seed: np.random.SeedSequence) -> None:
        """Draw and seek the configurations."""
        self.case, self.model, self.measured = case, case.model, Gaps(case.model)
        blocks = questions(self.measured, sizes, seed)
        finer = [
            Stored(path.name, refined(self.model, case.straight, path.stops_rad, FINER, path.name))
            for path in case.paths
        ]
        own = drawn_paths(self.measured, sizes["drawn_paths"], seed.spawn(1)[0])
        self.paths = finer or own
        # Frames are asked along one path at least, also where nothing is drawn.
        blocks += [block(PATH, path.stops_rad, path=index, frames=index == 0) for index, path in enumerate(self.paths)]
        self.pushed: Pushed | None = first_pushed(self.measured, [*finer, *own])
        if self.pushed and case.of:
            self.pushed = cut(self.pushed)
        if self.pushed:
            blocks.append(block(PUSHED, self.pushed.path.stops_rad))
        self.asked: pa.Table = pa.concat_tables(blocks)
        self.q_rad = angles_of(self.asked, len(self.model.rows))
        self.keys = self.keyframes()

    def rows(self, kind: str) -> Rows:
        """The rows of one kind."""
        return np.flatnonzero(np.array(self.asked["kind"].to_pylist()) == kind).astype(np.int64)

    def keyframes(self) -> dict[str, Numbers]:
        """What the viewer can be put into: zero, the first paths, the first configurations near contact."""
        low, high = np.array([row.limits_rad for row in self.model.rows]).T
        keys = {"zero": np.clip(0.0, low, high)}
        for number, path in enumerate(self.paths[:KEYS], 1):
            last = len(path.stops_rad) - 1
            for what, place in (("start", 0), ("middle", last // 2), ("end", last)):
                keys[f"path {number} {what}"] = path.stops_rad[place]
        for number, row in enumerate(self.rows(NEAR)[:KEYS], 1):
            keys[f"near contact {number}"] = self.q_rad[row]
        return keys

    def write(self, folder: Path) -> None:
        """Write models, questions and what a comparison needs."""
        shift, longest = self.shift(), self.model.longest()
        near, framed = self.rows(NEAR)[:SHIFTED_ROWS], np.flatnonzero(self.asked["frames"].to_numpy()).astype(np.int64)
        self.write_model(folder, RIGHT, self.model, self.asked)
        stretched = self.model.stretched(STRETCH_M)
        self.write_model(folder, STRETCHED, stretched, self.wrong(framed[:STRETCHED_ROWS], frames=True))
        shifted = self.model.shifted(shift.still, shift.by_m) if self.model.stills else self.model
        self.write_model(folder, SHIFTED, shifted, self.wrong(near, frames=False))
        names = self.model.pair_names()
        still = self.model.stills[shift.still].name if self.model.stills else "nothing"
        moved = ", ".join(f"{length:.1f}" for length in shift.by_m * 1e3 + 0.0)
        told: dict[str, Any] = {
            "pairs": names,
            "outer": [pair.still is not None for pair in self.measured.pairs],
            "set": self.case.of,
            "free_of": self.case.free_of if self.case.paths else "contact",
            "are_stored": bool(self.case.paths),
            "paths": [path.name for path in self.paths],
            "stretched": f"link {longest + 1} 1 mm longer",
            "shifted": f"`{still}` shifted by [{moved}] mm",
            "flips": [[int(near[row]), names[pair]] for row, pair in shift.flips],
            "pushed": self.pushed_answer(),
            "keys": {name: flat(q_rad) for name, q_rad in self.keys.items()},
        }
        (folder / "case.json").write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")

    def wrong(self, rows: Rows, *, frames: bool) -> pa.Table:
        """The questions in some rows, with the rows, asked for contact and perhaps frames."""
        plain = self.asked.select([name for name in self.asked.column_names if name.startswith("q")]).take(rows)
        for name, flag in {"frames": frames, "gaps": False, "limits": False}.items():
            plain = plain.append_column(name, pa.array(np.full(len(rows), flag)))
        return plain.append_column("row", pa.array(rows))

    def write_model(self, folder: Path, name: str, model: Model, asked: pa.Table) -> None:
        """Write one model with its questions."""
        path = folder / f"{name}.xml"
        path.write_text(mjcf(model, self.keys), encoding="utf-8")
        pq.write_table(asked, beside(path, "questions"), compression="zstd")

    def pushed_answer(self) -> dict[str, Any] | None:
        """Where the pushed path is in contact, and with what."""
        if self.pushed is None:
            return None
        row = int(self.rows(PUSHED)[0]) + self.pushed.stop
        return {"path": self.pushed.path.name, "row": row, "pair": self.model.pair_names()[self.pushed.pair]}

    def shift(self) -> Shift:
        """Of all obstacles and of six directions the move by which most answers near contact change."""
        rows = self.q_rad[self.rows(NEAR)[:SHIFTED_ROWS]]
        gaps, best = self.measured.many(rows), Shift(0, np.zeros(3), [])
        for still in range(len(self.model.stills)):
            own = self.measured.group(still)
            for by_m in SHIFT_M * np.vstack([np.eye(3), -np.eye(3)]):
                moved = np.array([self.measured.of(q_rad, own, (still, by_m)) for q_rad in rows])
                moved = moved.reshape(len(rows), len(own))
                before = gaps[:, own]
                changed = (np.abs(before) > TIE_M) & (np.abs(moved) > TIE_M) & ((before <= 0) != (moved <= 0))
                if changed.sum() > len(best.flips):
                    best = Shift(still, by_m, [(int(row), int(own[pair])) for row, pair in np.argwhere(changed)])
        return best
