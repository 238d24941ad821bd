"""Robots as their files give them: rows of Denavit-Hartenberg parameters and the capsules of a body.

Files are in millimetres and degrees; everything here is in metres and radians. Rows are distal: a joint turns
about z, then the frame moves by `d` along z and `a` along x and is twisted by `alpha` about x.
"""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from judge.located import Fault, Written
from judge.scenes import MM, Still

Numbers = npt.NDArray[np.float64]
Point = tuple[float, float, float]


@dataclass(frozen=True)
class Row:
    """One joint with its link; one that slides has metres where others have radians."""

    alpha_rad: float
    a_m: float
    d_m: float
    offset_rad: float
    limits_rad: tuple[float, float]
    """Within these it is drawn; one that turns without end has no others."""
    is_endless: bool = False
    slides: bool = False


@dataclass(frozen=True)
class Part:
    """A capsule fixed to a link; 0 is the base. The scene can touch it unless it counts for the robot alone."""

    name: str
    link: int
    ends_m: tuple[Point, Point]
    radius_m: float
    exposed: bool = True


@dataclass(frozen=True)
class Pair:
    """Two things that may touch: a part and a still thing, or two parts; by index."""

    part: int
    still: int | None = None
    other: int | None = None


@dataclass(frozen=True)
class Model:
    """A robot among obstacles."""

    name: str
    base: Numbers
    rows: tuple[Row, ...]
    tool_m: float
    parts: tuple[Part, ...]
    self_pairs: tuple[tuple[int, int], ...]
    stills: tuple[Still, ...]
    has_limits: bool = True
    flange: Numbers | None = None
    """The flange in the frame of the last link, where it is another; the tool is along its z."""

    def tool(self) -> Numbers:
        """The tool's frame in that of the last link."""
        along = np.eye(4)
        along[2, 3] = self.tool_m
        return along if self.flange is None else self.flange @ along

    def pairs(self) -> tuple[Pair, ...]:
        """Exposed parts with each still thing, then the robot with itself."""
        exposed = [index for index, part in enumerate(self.parts) if part.exposed]
        outer = [Pair(part, still=still) for part in exposed for still in range(len(self.stills))]
        return (*outer, *(Pair(one, other=other) for one, other in self.self_pairs))

    def pair_name(self, pair: Pair) -> str:
        """A part before a still thing, parts in alphabetical order."""
        part = self.parts[pair.part].name
        if pair.other is not None:
            return "|".join(sorted((part, self.parts[pair.other].name)))
        return f"{part}|{self.stills[pair.still or 0].name}"

    def pair_names(self) -> list[str]:
        """The names of all pairs."""
        return [self.pair_name(pair) for pair in self.pairs()]

    def longest(self) -> int:
        """The index of the longest link."""
        return max(range(len(self.rows)), key=lambda row: abs(self.rows[row].a_m))

    def stretched(self, by_m: float) -> "Model":
        """The same with the longest link longer."""
        longest = self.longest()
        rows = list(self.rows)
        length_m = rows[longest].a_m
        rows[longest] = replace(rows[longest], a_m=length_m + float(np.copysign(by_m, length_m)))
        return replace(self, rows=tuple(rows))

    def shifted(self, still: int, by_m: Numbers) -> "Model":
        """The same with one still thing elsewhere."""
        stills = list(self.stills)
        stills[still] = stills[still].moved(by_m)
        return replace(self, stills=tuple(stills))


def read_robot(path: Path, body: str, name: str, base: Numbers, stills: tuple[Still, ...]) -> Model:
    """The robot in the file at `path` with its body called `body`, standing at `base` among `stills`."""
    if path.suffix != ".toml":
        raise Fault(f"{path}: robots whose joints are rows are judged; accepted: a file that ends with .toml")
    written = Written(path)
    if written.table.get("convention", "distal") != "distal":
        raise written.fault(("convention",), "rows of this convention are not judged; accepted: distal")
    bodies = {entry["name"]: entry for entry in written.table["body"]}
    if body not in bodies:
        raise Fault(f"{path}: there is no body `{body}`; there are {', '.join(bodies)}")
    tool_m = written.table["tool"]["length_mm"] * MM
    rows = tuple(row(joint) for joint in written.table["joint"])
    parts = tuple(part(capsule, tool_m, len(rows)) for capsule in bodies[body]["capsule"])
    index = {part.name: number for number, part in enumerate(parts)}
    self_pairs = tuple((index[one], index[other]) for one, other in bodies[body]["self_pairs"])
    return Model(name, base, rows, tool_m, parts, self_pairs, stills)


def row(joint: dict[str, Any]) -> Row:
    """One `[[joint]]`."""
    angle = {key: float(np.deg2rad(joint[f"{key}_deg"])) for key in ("alpha", "offset", "lower", "upper")}
    limits = (angle["lower"], angle["upper"])
    return Row(angle["alpha"], joint["a_mm"] * MM, joint["d_mm"] * MM, angle["offset"], limits)


def part(capsule: dict[str, Any], tool_m: float, links: int) -> Part:
    """One `[[body.capsule]]`; the round end of one along the tool stops at the tool's tip."""
    radius_m = capsule["radius_mm"] * MM
    if "tool_share" in capsule:
        start, end = (share * tool_m for share in capsule["tool_share"])
        end = min(end, tool_m - radius_m)
        return Part(capsule["name"], links, ((0.0, 0.0, min(start, end)), (0.0, 0.0, end)), radius_m)
    one, other = ((x * MM, y * MM, z * MM) for x, y, z in (capsule["from_mm"], capsule["to_mm"]))
    exposed = not capsule.get("self_only", False)
    return Part(capsule["name"], capsule["link"], (one, other), radius_m, exposed)
