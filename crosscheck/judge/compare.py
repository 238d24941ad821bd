"""replan's answers beside MuJoCo's.

replan's lie in the tables `replan.gaps` (every row, a column a pair, metres: at most 0 in contact), `replan.frames`
and `replan.limits` (the rows that ask) and, where planners have a check of their own for the robot,
`replan.planners`: whether the robot is free, and whether that is of the scene alone or of all contact.
"""

import json
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow.parquet as pq

from judge.answers import FRAME_PARTS
from judge.pose import RIGHT, SHIFT_M, SHIFTED, STRETCHED, TIE_M
from judge.questions import KINDS, PATH, Rows
from judge.tables import angles_of, beside, read_answers

FRAME_TOLERANCE = 1e-9
"""How far frames may differ, in metres and per entry of a rotation: both sides round on numbers of the order of 1."""
OURS = "replan"
OF_SETS = (None, f"obstacles shifted by {SHIFT_M * 1e3:.0f} mm", "paths pushed")
"""What controls are called where they differ from problem to problem."""

Truths = npt.NDArray[np.bool_]
Numbers = npt.NDArray[np.float64]


@dataclass
class Line:
    """What was asked of one kind of configuration, and how much of it the two agree on."""

    question: str
    kind: str
    asked: int
    differ: int
    in_contact: int | None = None
    ties: int = 0
    largest: float | None = None

    def with_more(self, other: "Line") -> "Line":
        """Both as one."""
        return Line(
            self.question,
            self.kind,
            self.asked + other.asked,
            self.differ + other.differ,
            None if self.in_contact is None else self.in_contact + (other.in_contact or 0),
            self.ties + other.ties,
            None if self.largest is None else max(self.largest, other.largest or 0.0),
        )


@dataclass(frozen=True)
class Control:
    """An error made on purpose: how many answers had to differ, and how many did."""

    what: str
    listed: int
    caught: int

    @property
    def is_caught(self) -> bool:
        """Whether it was noticed wherever it had to be."""
        return self.listed > 0 and self.caught == self.listed


@dataclass
class Outcome:
    """Everything that came of a case."""

    case: str
    told: dict[str, Any]
    lines: list[Line] = field(default_factory=list)
    differences: list[str] = field(default_factory=list)
    blocked: list[str] = field(default_factory=list)
    controls: list[Control] = field(default_factory=list)

    @property
    def missed(self) -> list[Control]:
        """Errors made on purpose that went unnoticed."""
        return [control for control in self.controls if not control.is_caught]

    @property
    def is_agreed(self) -> bool:
        """Whether nothing differs and every error was noticed."""
        return not (self.differences or self.blocked or self.missed)

    def listed(self) -> list[str]:
        """Everything that differs, one by one."""
        missed = [
            f"{self.case}, control not noticed: {control.what} ({control.caught} of {control.listed})"
            for control in self.missed
        ]
        return self.differences + [f"{self.case}, {path}" for path in self.blocked] + missed

    def with_more(self, other: "Outcome") -> "Outcome":
        """The outcome of a set, with that of one more of its problems."""
        lines = {(line.question, line.kind): line for line in self.lines}
        for line in other.lines:
            before = lines.get((line.question, line.kind))
            lines[line.question, line.kind] = line if before is None else before.with_more(line)
        controls = [
            replace(one, listed=one.listed + more.listed, caught=one.caught + more.caught)
            for one, more in zip(self.controls, other.controls, strict=True)
        ]
        told = self.told | {"paths": self.told["paths"] + other.told["paths"]}
        return Outcome(
            self.case,
            told,
            list(lines.values()),
            self.differences + other.differences,
            self.blocked + other.blocked,
            controls,
        )


class Comparison:
    """The answers to one case."""

    def __init__(self, folder: Path) -> None:
        """Read the questions, and whether and how far each pair touches."""
        self.folder = folder
        told = json.loads((folder / "case.json").read_text(encoding="utf-8"))
        self.outcome, self.pairs = Outcome(folder.name, told), told["pairs"]
        self.table = pq.read_table(beside(folder / f"{RIGHT}.xml", "questions"))
        self.joints = sum(name[1:].isdigit() for name in self.table.column_names if name.startswith("q"))
        self.q_rad = angles_of(self.table, self.joints)
        self.kinds, self.height = np.array(self.table["kind"].to_pylist()), self.table.num_rows
        self.gaps: Numbers = self.answers(OURS, "gaps", self.pairs, self.height)
        self.touch: Truths = self.answers(RIGHT, "touch", self.pairs, self.height)
        self.ties: Truths = np.abs(self.gaps) <= TIE_M

    def answers(self, who: str, part: str, names: list[str], rows: int) -> npt.NDArray[Any]:
        """A table of answers."""
        return read_answers(beside(self.folder / f"{who}.xml", part), names, rows)

    def asked(self, flag: str) -> npt.NDArray[np.int64]:
        """The rows that ask for something besides contact."""
        return np.flatnonzero(self.table[flag].to_numpy()).astype(np.int64)

    def differ(self, question: str, of: str, row: "int | np.signedinteger[Any]", ours: str, theirs: str) -> None:
        """Note one difference."""
        self.outcome.differences.append(
            f"{self.outcome.case}, {question} of {of}, {self.kinds[row]} configuration {row + 1} "
            f"{written(self.q_rad[row])}: ours {ours}, MuJoCo {theirs}"
        )

    def line(self, question: str, rows: Rows, bad: npt.NDArray[Any], **more: npt.NDArray[Any]) -> None:
        """Note a line for each kind among some rows; values of `more` are by row."""
        for kind in KINDS:
            own = self.kinds[rows] == kind
            if own.any():
                line = Line(question, kind, int(own.sum()), int(bad[own].sum()))
                for name, values in more.items():
                    setattr(line, name, float(values[own].max()) if name == "largest" else int(values[own].sum()))
                self.outcome.lines.append(line)

    def compared(self) -> Outcome:
        """Compare every answer, and whether errors made on purpose were noticed."""
        self.contacts()
        self.planners()
        self.distances()
        self.frames()
        self.limits()
        self.outcome.blocked = list(self.blocked())
        self.outcome.controls = [self.stretched(), self.shifted(), self.pushed()]
        return self.outcome

    def contacts(self) -> None:
        """Contact of every pair in every row."""
        bad = ~self.ties & (self.touch != (self.gaps <= 0))
        rows = np.arange(self.height)
        contact: npt.NDArray[Any] = np.asarray((self.gaps <= 0).any(axis=1))
        self.line("contact", rows, bad.sum(axis=1), in_contact=contact, ties=self.ties.sum(axis=1))
        for row, pair in np.argwhere(bad):
            theirs = contact_word(self.touch[row, pair])
            self.differ("contact", self.pairs[pair], row, f"gap {self.gaps[row, pair]:e} m", theirs)

    def planners(self) -> None:
        """The check that planners use, which knows no pairs."""
        path = beside(self.folder / f"{OURS}.xml", "planners")
        if not path.is_file():
            return
        free, of_scene = self.answers(OURS, "planners", ["free", "of_scene"], self.height).T
        outer = np.array(self.outcome.told["outer"], dtype=bool)
        sought = outer[None, :] | ~of_scene[:, None]
        touches = (sought & self.touch & ~self.ties).any(axis=1)
        ties = ~touches & (sought & self.ties).any(axis=1)
        bad = ~ties & (free == touches)
        self.line("planners", np.arange(self.height), bad, in_contact=np.logical_not(free), ties=ties)
        for row in np.flatnonzero(bad):
            ours, theirs = contact_word(not free[row]), contact_word(touches[row])
            self.differ("planners", "the whole robot", row, ours, theirs)

    def distances(self) -> None:
        """Distances of pairs that are apart."""
        rows = self.asked("gaps")
        if not len(rows):
            return
        theirs, ours = self.answers(RIGHT, "gaps", self.pairs, len(rows)), self.gaps[rows]
        apart = np.where(ours > TIE_M, np.abs(ours - theirs), 0.0)
        bad = ~(apart <= TIE_M)
        self.line("distance", rows, bad.sum(axis=1), largest=apart.max(axis=1, initial=0.0))
        for place, pair in np.argwhere(bad):
            values = (f"{value:e} m" for value in (ours[place, pair], theirs[place, pair]))
            self.differ("distance", self.pairs[pair], rows[place], *values)

    def frame_tables(self, who: str, rows: int) -> Numbers:
        """Frames: row, frame, number."""
        names = [f"{frame}.{part}" for frame in self.frame_names() for part in FRAME_PARTS]
        return self.answers(who, "frames", names, rows).reshape(rows, -1, len(FRAME_PARTS))

    def frame_names(self) -> list[str]:
        """Each link's frame and the tool's."""
        return [*(f"link_{link}" for link in range(1, self.joints + 1)), "tool"]

    def frames(self) -> None:
        """Places and rotations."""
        rows = self.asked("frames")
        if not len(rows):
            return
        ours, theirs = (self.frame_tables(who, len(rows)) for who in (OURS, RIGHT))
        apart = np.abs(ours - theirs).max(axis=2)
        bad = ~(apart <= FRAME_TOLERANCE)
        self.line("frame", rows, bad.sum(axis=1), largest=apart.max(axis=1))
        for place, frame in np.argwhere(bad):
            values = (f"{written(table[place, frame, :3])} m" for table in (ours, theirs))
            self.differ("frame", self.frame_names()[frame], rows[place], *values)

    def limits(self) -> None:
        """Joints beyond their limits."""
        rows, names = self.asked("limits"), [f"joint_{joint}" for joint in range(1, self.joints + 1)]
        if not len(rows):
            return
        ours, theirs = (self.answers(who, "limits", names, len(rows)) for who in (OURS, RIGHT))
        self.line("limit", rows, (ours != theirs).sum(axis=1))
        for place, joint in np.argwhere(ours != theirs):
            values = ("beyond" if table[place, joint] else "within" for table in (ours, theirs))
            self.differ("limit", names[joint], rows[place], *values)

    def blocked(self) -> Iterable[str]:
        """The first contact, by either side, of every path that should be free."""
        told = self.outcome.told
        broken = np.array([promise_broken(told["free_of"], outer) for outer in told["outer"]], dtype=bool)
        touches = ~self.ties & (self.touch | (self.gaps <= 0)) & broken
        path = self.table["path"].to_numpy()
        for index, name in enumerate(told["paths"]):
            rows = np.flatnonzero((self.kinds == PATH) & (path == index))
            for row, pair in zip(*np.nonzero(touches[rows]), strict=True):
                yield f"path `{name}` touches {self.pairs[pair]} at {written(self.q_rad[rows[row]])}"
                break

    def stretched(self) -> Control:
        """The longer link: a frame must differ in every row."""
        rows = self.wrong_rows(STRETCHED)
        place = np.searchsorted(self.asked("frames"), rows)
        ours = self.frame_tables(OURS, len(self.asked("frames")))[place]
        apart = np.abs(ours - self.frame_tables(STRETCHED, len(rows))).max(axis=(1, 2), initial=0.0)
        return Control(self.outcome.told["stretched"], len(rows), int((apart > FRAME_TOLERANCE).sum()))

    def shifted(self) -> Control:
        """The moved obstacle: the answers that it turns must differ from ours of the right scene."""
        rows, flips = self.wrong_rows(SHIFTED).tolist(), self.outcome.told["flips"]
        touch = self.answers(SHIFTED, "touch", self.pairs, len(rows))
        caught = 0
        for row, name in flips:
            pair = self.pairs.index(name)
            differs = touch[rows.index(row), pair] != (self.gaps[row, pair] <= 0)
            caught += int(differs and not self.ties[row, pair])
        return Control(self.outcome.told["shifted"], len(flips), caught)

    def pushed(self) -> Control:
        """The pushed path: both sides must find it in contact where it was pushed to."""
        told = self.outcome.told["pushed"]
        if told is None:
            return Control("no path can be pushed into anything", 0, 0)
        row, pair = told["row"], self.pairs.index(told["pair"])
        both = bool(self.touch[row, pair]) and bool(self.gaps[row, pair] <= 0)
        # A bar would end the cell of a table.
        return Control(f"path `{told['path']}` pushed, {told['pair'].replace('|', ' on ')}", 1, int(both))

    def wrong_rows(self, model: str) -> npt.NDArray[np.int64]:
        """Which of the right model's rows a wrong model was asked about."""
        table = pq.read_table(beside(self.folder / f"{model}.xml", "questions"), columns=["row"])
        return np.asarray(table["row"].to_numpy())


def promise_broken(free_of: str, is_outer: bool) -> bool:
    """Whether contact of a pair breaks what a path is said to be free of."""
    return free_of == "contact" or (free_of == "scene" and is_outer)


def contact_word(touches: bool) -> str:
    """Contact in words."""
    return "contact" if touches else "no contact"


def written(values: Iterable[float]) -> str:
    """Numbers with all their digits."""
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def compare_case(folder: Path) -> Outcome:
    """Compare the answers to one case."""
    return Comparison(folder).compared()


def compare_all(folders: Iterable[Path]) -> list[Outcome]:
    """Compare the answers to all cases; those of a set's problems come as one."""
    found: dict[str, Outcome] = {}
    for folder in folders:
        outcome = compare_case(folder)
        label = outcome.told.get("set") or outcome.case
        if label != outcome.case:
            named = zip(outcome.controls, OF_SETS, strict=True)
            controls = [replace(control, what=what or control.what) for control, what in named]
            outcome = replace(outcome, case=label, controls=controls)
        found[label] = found[label].with_more(outcome) if label in found else outcome
    return list(found.values())
