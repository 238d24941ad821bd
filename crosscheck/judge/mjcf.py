"""Models in MuJoCo's own language (MJCF).

The numbers are those of the robot and scene files, with all their digits, and each Denavit-Hartenberg row is two
nested bodies: one that turns about `0 0 1` or slides along it, one that is moved by `(a, 0, d)` and twisted about x.

MuJoCo's capsule-box primitive misses a capsule whose axis pierces deep through the box, so boxes are given as
meshes of eight vertices. Links and obstacles meet by masks, parts of the robot by explicit pairs.
"""

from collections.abc import Iterable
from xml.sax.saxutils import quoteattr

from judge.robots import Model, Numbers, Part, Row
from judge.scenes import Still

SEEN_M = 4e-3
"""The least radius that a picture shows."""
ARM, OWN, STONE, FLOOR = "0.90 0.55 0.20 1", "0.45 0.45 0.50 1", "0.35 0.50 0.70 1", "0.80 0.80 0.78 1"
HEAD = """  <compiler angle="radian" autolimits="true"/>
  <option gravity="0 0 0"/>
  <size memory="64M"/>
  <visual>
    <global offwidth="1600" offheight="1200"/>
    <headlight ambient="0.35 0.35 0.35" diffuse="0.4 0.4 0.4" specular="0 0 0"/>
  </visual>
  <asset>
    <texture type="skybox" builtin="flat" rgb1="1 1 1" rgb2="1 1 1" width="16" height="96"/>"""
LIGHT = '    <light pos="1 -2 4" dir="-0.2 0.4 -0.9" diffuse="0.7 0.7 0.7"/>'


def number(value: float) -> str:
    """A number with all its digits; `-0` is written as `0`."""
    return repr(float(value) + 0.0)


def numbers(values: Iterable[float]) -> str:
    """Numbers with blanks between."""
    return " ".join(map(number, values))


def mjcf(model: Model, keys: dict[str, Numbers]) -> str:
    """The model as an MJCF file with keyframes."""
    lines = [f"<mujoco model={quoteattr(model.name)}>", HEAD]
    meshes = [(index, still) for index, still in enumerate(model.stills) if still.shape == "mesh"]
    for index, still in meshes:
        lines.append(f'    <mesh name="mesh_{index}" vertex="{numbers(still.points_m.ravel())}"/>')
    lines += ["  </asset>", "  <worldbody>", LIGHT]
    lines += [f"    {still_geom(index, still)}" for index, still in enumerate(model.stills)]
    lines += [*robot(model), "  </worldbody>", "  <contact>"]
    for one, other in model.self_pairs:
        names = [quoteattr(f"part:{model.parts[part].name}") for part in (one, other)]
        lines.append(f'    <pair geom1={names[0]} geom2={names[1]} margin="0" gap="0"/>')
    lines += ["  </contact>", "  <keyframe>"]
    lines += [f'    <key name={quoteattr(name)} qpos="{numbers(q_rad)}"/>' for name, q_rad in keys.items()]
    return "\n".join([*lines, "  </keyframe>", "</mujoco>", ""])


def robot(model: Model) -> list[str]:
    """The links, one in the other."""
    x, y, place = model.base[:3, 0], model.base[:3, 1], numbers(model.base[:3, 3])
    lines = [f'    <body name="link_0" pos="{place}" xyaxes="{numbers(x)} {numbers(y)}">', *geoms(model, 0)]
    for link, row in enumerate(model.rows, 1):
        lines += [
            f'    <body name="turned_{link}" axisangle="0 0 1 {number(row.offset_rad)}">',
            f'      <joint name="joint_{link}"{kind(row)} axis="0 0 1"{limits(row)}/>',
            '      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>',
            f'    <body name="link_{link}" pos="{numbers((row.a_m, 0.0, row.d_m))}" '
            f'axisangle="1 0 0 {number(row.alpha_rad)}">',
            *geoms(model, link),
        ]
    return [*lines, f'    <body name="tool" {tool_place(model)}/>', "    " + "</body>" * (2 * len(model.rows) + 1)]


def kind(row: Row) -> str:
    """The kind of a joint, unless it turns."""
    return ' type="slide"' if row.slides else ""


def limits(row: Row) -> str:
    """The limits of a joint; one that turns without end has none."""
    return "" if row.is_endless else f' range="{numbers(row.limits_rad)}"'


def tool_place(model: Model) -> str:
    """Where the tool is on the last link."""
    if model.flange is None:
        return f'pos="0 0 {number(model.tool_m)}"'
    tool = model.tool()
    return f'pos="{numbers(tool[:3, 3])}" xyaxes="{numbers(tool[:3, 0])} {numbers(tool[:3, 1])}"'


def geoms(model: Model, link: int) -> list[str]:
    """The parts of a link, each one that is too thin to be seen in a sleeve that touches nothing."""
    lines = []
    for part in (part for part in model.parts if part.link == link):
        lines.append(f"      {part_geom(part)}")
        if part.radius_m < SEEN_M:
            lines.append(f'      <geom {part_shape(part, SEEN_M)} contype="0" conaffinity="0" mass="0" rgba="{ARM}"/>')
    return lines


def part_geom(part: Part) -> str:
    """A capsule of the robot."""
    return (
        f"<geom name={quoteattr(f'part:{part.name}')} {part_shape(part, part.radius_m)} "
        f'contype="{int(part.exposed)}" conaffinity="0" mass="0" rgba="{ARM if part.exposed else OWN}"/>'
    )


def part_shape(part: Part, radius_m: float) -> str:
    """A capsule, or a ball where its ends are one: MuJoCo refuses capsules without an axis."""
    start, end = part.ends_m
    if start == end:
        return f'type="sphere" pos="{numbers(start)}" size="{number(radius_m)}"'
    return f'type="capsule" fromto="{numbers(start)} {numbers(end)}" size="{number(radius_m)}"'


def still_geom(index: int, still: Still) -> str:
    """Something that stands still; a floor is drawn 6 m wide and is a half-space for contact."""
    points, radius, colour = still.points_m, number(still.radius_m), STONE
    if still.shape == "mesh":
        shape = f'type="mesh" mesh="mesh_{index}"'
    elif still.shape == "sphere":
        shape = f'type="sphere" pos="{numbers(points[0])}" size="{radius}"'
    elif still.shape == "capsule":
        shape = f'type="capsule" fromto="{numbers(points.ravel())}" size="{radius}"'
    else:
        shape = f'type="plane" pos="{numbers(points[0])}" zaxis="{numbers(points[1])}" size="3 3 0.05"'
        colour = FLOOR
    name = quoteattr(f"still:{still.name}")
    return f'<geom name={name} {shape} contype="0" conaffinity="1" rgba="{colour}"/>'
