"""The verdict table for the terminal, and a paper's chapter of the report."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import mujoco

from judge.compare import FRAME_TOLERANCE, Line, Outcome
from judge.pose import TIE_M
from judge.questions import KINDS
from judge.stored import LINK_RADIUS_M

LISTED = 100
"""Differences that the chapter lists; the file beside the answers holds every one."""
FREE_OF = {"nothing": "nothing", "scene": "obstacles", "contact": "all contact"}
QUESTIONS = {
    "contact": "for contact",
    "planners": "also of the check that planners use",
    "frame": "for frames",
    "distance": "for distances",
    "limit": "for joint limits",
}


@dataclass(frozen=True)
class Frame:
    """What stands around the outcomes in a chapter."""

    paper: str
    view: str
    picture: str
    notes: list[str]


def bound(largest: float | None) -> str:
    """The power of ten above a difference, at least the twelfth of 1: what is below changes with the processor."""
    if largest is None:
        return "–"
    exponent = math.floor(math.log10(largest)) + 1 if largest > 0 else -12
    return f"< 1e{max(exponent, -12)}"


def table(outcomes: list[Outcome]) -> str:
    """The verdict table for the terminal."""
    width = max([4, *(len(outcome.case) for outcome in outcomes)])
    head = ["question", "configurations", "asked", "in contact", "ties", "largest", "differ"]
    rows = [cells(width, "case", head, "verdict")]
    for outcome in outcomes:
        for line in outcome.lines:
            contact = "–" if line.in_contact is None else str(line.in_contact)
            of_line = [
                line.question,
                line.kind,
                str(line.asked),
                contact,
                str(line.ties),
                bound(line.largest),
            ]
            rows.append(cells(width, outcome.case, [*of_line, str(line.differ)], verdict(line.differ == 0)))
        origin = "stored" if outcome.told["are_stored"] else "drawn"
        blocked = len(outcome.blocked)
        of_paths = ["free path", origin, str(len(outcome.told["paths"])), "–", "–", "–", str(blocked)]
        rows.append(cells(width, outcome.case, of_paths, verdict(blocked == 0)))
        for control in outcome.controls:
            noticed = "noticed" if control.is_caught else "NOT NOTICED"
            count = f"{control.caught} of {control.listed}"
            rows.append(f"{outcome.case:<{width}}  control: {control.what}: {count}  {noticed}")
    return "\n".join(rows)


def verdict(is_agreed: bool) -> str:
    """Agreement in a word."""
    return "agree" if is_agreed else "DIFFER"


def cells(width: int, case: str, seven: list[str], end: str) -> str:
    """A row of the table for the terminal."""
    question, kind, asked, contact, ties, largest, differ = seven
    numbers = f"{asked:>7} {contact:>10} {ties:>5} {largest:>8} {differ:>7}"
    return f"{case:<{width}}  {question:<9} {kind:<24} {numbers}  {end}"


def chapter(outcomes: list[Outcome], frame: Frame) -> str:
    """The chapter of a paper."""
    blocks = [
        f"# {frame.paper}: the same robots, scenes and paths judged by MuJoCo",
        f"Made by `replan crosscheck {frame.paper}`. Python reads the robot, scene and study files and the stored "
        f"paths by itself\nand gives them to MuJoCo {mujoco.__version__}; it shares no code with us. replan answers "
        "the same questions, and the answers are compared.",
        *frame.notes,
        f"**{summary(outcomes)}**",
        frame.picture,
        f"In MuJoCo's own viewer, with keyframes: `{frame.view}`.",
        tolerances(),
        "Contact of each pair that may touch: configurations asked, and in brackets how many are in contact.",
        contacts(outcomes, "contact"),
        *planners(outcomes),
        "Configurations asked for numbers, and the largest difference.",
        numbers(outcomes),
        paths(outcomes),
        "Errors made on purpose, and how many of the answers that must differ do:",
        controls(outcomes),
        differences(outcomes),
    ]
    return "\n\n".join(blocks) + "\n"


def tolerances() -> str:
    """How near answers must be to each other, and why."""
    return (
        f"Tolerances: frames {power(FRAME_TOLERANCE)} m and per entry of a rotation, since both sides round a few "
        "dozen operations on numbers of the order of 1; "
        f"distances {power(TIE_M)} m, since MuJoCo keeps vertices of meshes in single precision "
        f"and links without width are given to it {power(LINK_RADIUS_M)} m thick. "
        f"Within {power(TIE_M)} m of contact either answer is right: a tie. Depths of penetration are not compared. "
        "Obstacles with flat faces are given as meshes, because MuJoCo's capsule–box primitive misses capsules that "
        "pierce a box."
    )


def power(value: float) -> str:
    """A power of ten in few letters."""
    return f"1e{round(math.log10(value))}"


def summary(outcomes: list[Outcome]) -> str:
    """The verdict in a sentence."""
    lines = [line for outcome in outcomes for line in outcome.lines]
    if all(outcome.is_agreed for outcome in outcomes):
        found = "MuJoCo agrees with every answer, and every error made on purpose was noticed"
    else:
        differ = sum(line.differ for line in lines)
        blocked = sum(len(outcome.blocked) for outcome in outcomes)
        missed = sum(len(outcome.missed) for outcome in outcomes)
        found = (
            f"MuJoCo DIFFERS: {differ} answers, {blocked} paths that should be free, {missed} errors made on purpose "
            "that went unnoticed"
        )
    asked = {question: sum(line.asked for line in lines if line.question == question) for question in QUESTIONS}
    parts = ", ".join(f"{asked[question]} {words}" for question, words in QUESTIONS.items() if asked[question])
    cases = sum(len(outcome.told["paths"]) if outcome.told.get("set") else 1 for outcome in outcomes)
    return f"{found}: {cases} cases (a robot in a scene), configurations asked {parts}."


def markdown(head: list[str], rows: Iterable[list[str]]) -> str:
    """A table in Markdown."""
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([f"| {' | '.join(head)} |", "|---" * len(head) + "|", *lines])


def contacts(outcomes: list[Outcome], question: str) -> str:
    """One row a case that was asked, one column a kind of configuration."""
    asked = {outcome.case: of(outcome, question) for outcome in outcomes if of(outcome, question)}
    kinds = [kind for kind in KINDS if any(line.kind == kind for lines in asked.values() for line in lines)]
    rows = []
    for case, lines in asked.items():
        by_kind = {line.kind: f"{line.asked} ({line.in_contact})" for line in lines}
        ties, differ = sum(line.ties for line in lines), sum(line.differ for line in lines)
        rows.append([case, *(by_kind.get(kind, "–") for kind in kinds), str(ties), f"**{differ}**"])
    return markdown(["case", *kinds, "ties", "differ"], rows)


def of(outcome: Outcome, *questions: str) -> list[Line]:
    """The lines of some questions."""
    return [line for line in outcome.lines if line.question in questions]


def planners(outcomes: list[Outcome]) -> list[str]:
    """The check that planners use, where there is one."""
    if not any(of(outcome, "planners") for outcome in outcomes):
        return []
    words = (
        "The same of the check that planners use, which knows no pairs (and for some robots only what stands around "
        "them)."
    )
    return [words, contacts(outcomes, "planners")]


def numbers(outcomes: list[Outcome]) -> str:
    """Frames, distances and limits: how many configurations were asked, and the largest difference."""
    head = ["case", "frames", "largest", "distances", "largest, m", "joint limits", "differ"]
    rows = []
    for outcome in outcomes:
        cells = [outcome.case]
        for question in ("frame", "distance", "limit"):
            lines = of(outcome, question)
            cells.append(str(sum(line.asked for line in lines)))
            largest = [line.largest for line in lines if line.largest is not None]
            cells += [] if question == "limit" else [bound(max(largest, default=None))]
        differ = sum(line.differ for line in of(outcome, "frame", "distance", "limit"))
        rows.append([*cells, f"**{differ}**"])
    return markdown(head, rows)


def paths(outcomes: list[Outcome]) -> str:
    """Paths that should be free."""

    def row(outcome: Outcome) -> list[str]:
        stored, drawn = (
            "the stored run, at a quarter of its step",
            "drawn: no stored paths of this robot in this scene",
        )
        told: dict[str, Any] = outcome.told
        origin = stored if told["are_stored"] else drawn
        return [
            outcome.case,
            str(len(told["paths"])),
            origin,
            FREE_OF[told["free_of"]],
            f"**{len(outcome.blocked)}**",
        ]

    return markdown(["case", "paths", "from", "free of", "not so for MuJoCo or us"], map(row, outcomes))


def controls(outcomes: list[Outcome]) -> str:
    """Errors made on purpose."""

    def row(outcome: Outcome) -> list[str]:
        noticed = (f"{control.what}: {control.caught} of {control.listed}" for control in outcome.controls)
        return [outcome.case, *noticed]

    head = ["case", "a longer link", "a moved obstacle", "a path pushed into an obstacle"]
    return markdown(head, map(row, outcomes))


def differences(outcomes: list[Outcome]) -> str:
    """Everything that differs, as far as there is room."""
    every = [item for outcome in outcomes for item in outcome.listed()]
    if not every:
        return "Nothing differs."
    text = "Everything that differs, one by one:\n\n" + "\n".join(f"- {item}" for item in every[:LISTED])
    if len(every) <= LISTED:
        return text
    return text + f"\n\n… and {len(every) - LISTED} more, in `disagreements.txt` beside the answers."
