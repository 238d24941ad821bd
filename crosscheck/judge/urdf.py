"""Robots in URDF files as rows and capsules, and the pairs of links that an SRDF file lets touch.

A row leads from one joint's axis to the next along their common normal; where two axes are parallel, along the normal
through the frame before. What stands before the first axis is the base, what stands behind the last the flange. Spheres
and cylinders are capsules; around a box stands the least capsule along its longest side. Meshes are not judged.

Sources: the pages XML of <https://wiki.ros.org/urdf/XML> and SRDF of <https://wiki.ros.org/srdf>.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from judge.located import Fault
from judge.robots import Model, Numbers, Part, Point, Row
from judge.scenes import Still

KINDS = ("revolute", "continuous", "prismatic")
"""Joints that are judged."""
BODY = "urdf"
"""What the only body of a URDF robot is called."""
RIGHT_RAD = 5e-6
"""An angle this near to a multiple of a right angle is one: files write 1.5708."""
PARALLEL = 1e-9
"""Below this sine two axes are parallel."""


@dataclass(frozen=True)
class Joint:
    """A joint that moves: its frame in that of the joint before, its axis, and its limits (radians, metres) if any."""

    name: str
    before: Numbers
    axis: Numbers
    limits: tuple[float, float] | None
    slides: bool


@dataclass(frozen=True)
class Solid:
    """A capsule with the name of its link, in the frame of the joint of this number; 0 is the base."""

    name: str
    owner: str
    joint: int
    ends: Numbers
    radius_m: float


class Chain:
    """The chain of a URDF file: joints that move, solids, and the tip in the frame of the last joint."""

    def __init__(self, path: Path, root: ET.Element) -> None:
        """Follow the joints from the base on."""
        self.path, self.root = path, root
        self.joints: list[Joint] = []
        self.solids: list[Solid] = []
        self.tip, self.deepest = np.eye(4), (0, -1)
        self.links = {link.attrib["name"]: link for link in root.findall("link")}
        self.below: dict[str, list[tuple[ET.Element, str]]] = {name: [] for name in self.links}
        for joint in root.findall("joint"):
            ends = [one(joint, part).attrib["link"] for part in ("parent", "child")]
            self.below[ends[0]].append((joint, ends[1]))
        children = {child for below in self.below.values() for _, child in below}
        (base,) = (name for name in self.links if name not in children)
        self.follow(base, np.eye(4), 0)

    def follow(self, link: str, pose: Numbers, depth: int) -> None:
        """Add a link whose frame is at `pose` in that of the last joint, and what follows it."""
        number = len(self.joints)
        if (number, depth) > self.deepest:
            self.tip, self.deepest = pose, (number, depth)
        for count, collision in enumerate(self.links[link].findall("collision"), 1):
            name = link if count == 1 else f"{link} {count}"
            ends, radius_m = self.capsule(one(collision, "geometry"), name)
            at = pose @ origin(collision)
            self.solids.append(Solid(name, link, number, ends @ at[:3, :3].T + at[:3, 3], radius_m))
        fixed = [below for below in self.below[link] if below[0].attrib["type"] == "fixed"]
        for joint, child in fixed:
            self.follow(child, pose @ origin(joint), depth + 1)
        for joint, child in self.below[link]:
            if (joint, child) not in fixed:
                self.joints.append(self.moving(joint, pose @ origin(joint)))
                self.follow(child, np.eye(4), 0)

    def moving(self, joint: ET.Element, before: Numbers) -> Joint:
        """A joint that moves."""
        kind, name = joint.attrib["type"], joint.attrib["name"]
        if kind not in KINDS:
            raise Fault(f"{self.path}: joint `{name}` is {kind}; {', '.join(KINDS)} and fixed joints are judged")
        if joint.find("mimic") is not None:
            raise Fault(f"{self.path}: joint `{name}` follows another by `mimic`; joints of their own are judged")
        axis = np.array(numbers(joint.find("axis"), "xyz", "1 0 0"))
        limit = None if kind == "continuous" else one(joint, "limit").attrib
        limits = None if limit is None else (float(limit.get("lower", 0)), float(limit.get("upper", 0)))
        return Joint(name, before, axis / np.linalg.norm(axis), limits, slides=kind == "prismatic")

    def capsule(self, geometry: ET.Element, name: str) -> tuple[Numbers, float]:
        """The ends and the radius of the capsule around a solid."""
        (shape,) = geometry
        if shape.tag == "sphere":
            return np.zeros((2, 3)), float(shape.attrib["radius"])
        if shape.tag == "cylinder":
            half = 0.5 * float(shape.attrib["length"])
            return np.array([[0.0, 0.0, -half], [0.0, 0.0, half]]), float(shape.attrib["radius"])
        if shape.tag == "box":
            half_m = 0.5 * np.array(numbers(shape, "size"))
            along = np.eye(3)[np.argmax(half_m)] * half_m
            return np.array([-along, along]), float(np.linalg.norm(half_m - along))
        raise Fault(f"{self.path}: the solid `{name}` is a {shape.tag}; box, cylinder and sphere are judged")

    def frames(self) -> list[Numbers]:
        """The frames of the base and of all joints where every joint is at 0."""
        found = [np.eye(4)]
        for joint in self.joints:
            found.append(found[-1] @ joint.before)
        return found


def one(element: ET.Element, tag: str) -> ET.Element:
    """The element below with this tag."""
    found = element.find(tag)
    if found is None:
        raise Fault(f"<{element.tag} {element.attrib}> has no <{tag}>; one is accepted")
    return found


def numbers(element: ET.Element | None, key: str, default: str = "0 0 0") -> list[float]:
    """The numbers of an attribute."""
    return [float(word) for word in (default if element is None else element.get(key, default)).split()]


def origin(element: ET.Element) -> Numbers:
    """The frame in `<origin>`: turned about fixed x, y and z in this order."""
    place = element.find("origin")
    angles = np.array(numbers(place, "rpy"))
    right = np.round(angles / (np.pi / 2)) * (np.pi / 2)
    angles = np.where(np.abs(angles - right) < RIGHT_RAD, right, angles)
    (sr, sp, sy), (cr, cp, cy) = np.sin(angles), np.cos(angles)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return framed(numbers(place, "xyz"), about_z @ about_y @ about_x)


def framed(place: Numbers | list[float], turn: Numbers) -> Numbers:
    """A frame as a matrix."""
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = turn, place
    return frame


def axis_frame(place: Numbers, x: Numbers, z: Numbers) -> Numbers:
    """The frame at a place with these axes."""
    return framed(place, np.stack([x, np.cross(z, x), z], axis=1))


def ahead(at: Numbers, point: Numbers, z: Numbers) -> Numbers:
    """The frame on the axis through `point` along `z`, whose x leads away from the z of `at`."""
    before, across, apart = at[:3, 2], np.cross(at[:3, 2], z), point - at[:3, 3]
    if np.linalg.norm(across) > PARALLEL:
        along = np.cross(before, apart) @ across / (across @ across)
        return axis_frame(point - z * along, across / np.linalg.norm(across), z)
    normal = apart - before * (apart @ before)
    length = np.linalg.norm(normal)
    x = normal / length if length > 1e-12 else at[:3, 0]
    return axis_frame(at[:3, 3] + normal, x, before * np.sign(before @ z))


def links_of(chain: Chain) -> list[Numbers]:
    """The frames of base and links where every joint is at 0, as rows lead from each to the next."""
    frames = chain.frames()[1:]
    axes = [frame[:3, :3] @ joint.axis for frame, joint in zip(frames, chain.joints, strict=True)]
    side = np.array([1.0, 0.0, 0.0]) if abs(axes[0][0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    x = side - axes[0] * (side @ axes[0])
    found = [axis_frame(frames[0][:3, 3], x / np.linalg.norm(x), axes[0])]
    for frame, axis in zip(frames[1:], axes[1:], strict=True):
        found.append(ahead(found[-1], frame[:3, 3], axis))
    return [*found, found[-1]]


def row_between(at: Numbers, following: Numbers, joint: Joint) -> Row:
    """The row of a joint, which leads from one frame to the next."""

    def turned(start: Numbers, end: Numbers, about: Numbers) -> float:
        return float(np.arctan2(np.cross(start, end) @ about, start @ end))

    apart = following[:3, 3] - at[:3, 3]
    alpha = turned(at[:3, 2], following[:3, 2], following[:3, 0])
    offset = turned(at[:3, 0], following[:3, 0], at[:3, 2])
    a, d = float(apart @ following[:3, 0]), float(apart @ at[:3, 2])
    limits, is_endless = joint.limits or (-np.pi, np.pi), joint.limits is None
    return Row(alpha, a, d, offset, limits, is_endless, joint.slides)


def read_urdf(path: Path, srdf: Path, name: str, base: Numbers, stills: tuple[Still, ...]) -> Model:
    """The robot in the file at `path`, whose links may touch as the file at `srdf` says."""
    root = parsed(path)
    chain = Chain(path, root)
    if not chain.joints:
        raise Fault(f"{path}: no joint moves; one is judged at least")
    links, frames = links_of(chain), chain.frames()
    pairs = zip(links, links[1:], chain.joints, strict=False)
    rows = tuple(row_between(at, following, joint) for at, following, joint in pairs)
    parts = tuple(part_of(solid, np.linalg.inv(links[solid.joint]) @ frames[solid.joint]) for solid in chain.solids)
    flange = np.linalg.inv(links[-1]) @ frames[-1] @ chain.tip
    return Model(name, base @ links[0], rows, 0.0, parts, tuple(held(chain, root, srdf)), stills, flange=flange)


def part_of(solid: Solid, into: Numbers) -> Part:
    """The solid in the frame of its link; the base touches nothing but the robot."""

    def end(index: int) -> Point:
        x, y, z = solid.ends[index] @ into[:3, :3].T + into[:3, 3]
        return float(x), float(y), float(z)

    return Part(solid.name, solid.joint, (end(0), end(1)), solid.radius_m, exposed=solid.joint > 0)


def held(chain: Chain, robot: ET.Element, srdf: Path) -> Iterator[tuple[int, int]]:
    """The pairs of solids of different links that the SRDF file does not let touch."""
    root = parsed(srdf)
    if root.get("name", robot.get("name")) != robot.get("name"):
        raise Fault(f"{srdf}: the file is of the robot `{root.get('name')}`; `{robot.get('name')}` is accepted")
    for tag in (str(element.tag) for element in root):
        if "collisions" in tag and tag != "disable_collisions":
            raise Fault(f"{srdf}: `{tag}` is not read; `disable_collisions` is accepted")
    may_touch = {frozenset((pair.attrib["link1"], pair.attrib["link2"])) for pair in root.findall("disable_collisions")}
    for (index, solid), (number, other) in combinations(enumerate(chain.solids), 2):
        if solid.joint != other.joint and frozenset((solid.owner, other.owner)) not in may_touch:
            yield index, number


def parsed(path: Path) -> ET.Element:
    """The element `<robot>` of a file."""
    try:
        root = ET.fromstring(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, ET.ParseError) as error:
        raise Fault(f"{path}: {error}") from error
    if root.tag != "robot":
        raise Fault(f"{path}: found the element `{root.tag}`; `robot` is accepted")
    return root
