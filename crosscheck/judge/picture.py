"""A picture of a model, rendered without a screen (MUJOCO_GL=osmesa or egl).

Renderers differ in a few pixels. A picture therefore holds a hash of the scene that it shows, and one whose scene is
unchanged stays as it is.
"""

import hashlib
import re
import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
import numpy.typing as npt

WIDTH, HEIGHT = 1200, 900
# The key of the text in a PNG file that has the hash.
SCENE = b"replan scene"
DIGITS = 9
# What a letter of a label takes in the picture, and how far labels stand above each other, in pixels.
LETTER, LINE = 10.0, 24.0
# What an arm stands on is no obstacle to it.
STONE = (0.55, 0.55, 0.53, 1.0)


@dataclass(frozen=True)
class View:
    """Where the camera stands; with a `zoom` of 1 everything but endless planes is well in the picture."""

    azimuth_deg: float
    elevation_deg: float
    zoom: float


def scene_hash(model_path: Path, q_rad: list[float], view: View) -> str:
    """The hash of what a picture shows: the model without keyframes, the configuration and the camera.

    Numbers count to nine decimal places, since the last ones change with the processor.
    """
    lines = (line for line in model_path.read_text(encoding="utf-8").splitlines() if "<key " not in line)
    text = "\n".join([*lines, repr(q_rad), repr(view)])
    rounded = re.sub(r"-?\d+\.\d+(e-?\d+)?", lambda found: f"{float(found[0]) + 0.0:.{DIGITS}f}", text)
    return hashlib.sha256(rounded.replace(f"-{0:.{DIGITS}f}", f"{0:.{DIGITS}f}").encode()).hexdigest()


def shown_scene(picture: Path) -> str | None:
    """The hash of the scene that a picture shows; `None` if there is no picture or it holds none."""
    data = picture.read_bytes() if picture.is_file() else b""
    _, found, rest = data.partition(b"tEXt" + SCENE + b"\0")
    return rest[:64].decode("ascii", "replace") if found else None


def draw(model_path: Path, to: Path, key: str, view: View, scene: str) -> None:
    """Draw the model at `model_path` in the configuration of a keyframe; the picture holds the hash `scene`."""
    model = mujoco.MjModel.from_xml_path(str(model_path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    for geom in map(model.geom, range(model.ngeom)):
        if geom.name == "still:pedestal":
            geom.rgba = STONE
    camera = mujoco.MjvCamera()
    mujoco.mjv_defaultFreeCamera(model, camera)
    camera.azimuth, camera.elevation = view.azimuth_deg, view.elevation_deg
    centre, radius = ball_around(model, data)
    camera.lookat[:] = centre
    camera.distance = radius / np.sin(np.deg2rad(model.vis.global_.fovy / 2)) / view.zoom
    with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(data, camera)
        name_obstacles(model, data, renderer.scene)
        to.write_bytes(png(renderer.render(), scene))


def name_obstacles(model: mujoco.MjModel, data: mujoco.MjData, scene: mujoco.MjvScene) -> None:
    """Write across each obstacle's middle its name; one that would cover another stands above it."""
    eye = scene.camera[0]
    right, up = np.cross(eye.forward, eye.up), np.asarray(eye.up)
    placed: list[tuple[float, float, float]] = []
    named = [geom for geom in map(model.geom, range(model.ngeom)) if geom.name.startswith("still:")]
    for geom in (geom for geom in named if model.geom_rbound[geom.id] > 0):
        name = geom.name.removeprefix("still:")
        beyond = data.geom_xpos[geom.id] - eye.pos
        metres_per_pixel = beyond @ eye.forward * eye.frustum_top / eye.frustum_near / (HEIGHT / 2)
        width, lift = LETTER * len(name), 0.0
        x, y = beyond @ right / metres_per_pixel - width / 2, beyond @ up / metres_per_pixel
        while any(covers((x, y + lift, width), other) for other in placed):
            lift += LINE / 4
        placed.append((x, y + lift, width))
        # A label starts at its place.
        add_label(scene, data.geom_xpos[geom.id] + metres_per_pixel * (lift * up - width / 2 * right), name)


def covers(one: tuple[float, float, float], other: tuple[float, float, float]) -> bool:
    """Whether two labels (left end, height, width; pixels) cover each other."""
    (x, y, width), (left, height, wide) = one, other
    return abs(y - height) < LINE and x < left + wide and left < x + width


def add_label(scene: mujoco.MjvScene, at: npt.NDArray[np.float64], text: str) -> None:
    """A text in the scene, and nothing else."""
    label = scene.geoms[scene.ngeom]
    ink = np.ones(4, dtype=np.float32)
    mujoco.mjv_initGeom(label, mujoco.mjtGeom.mjGEOM_LABEL, np.zeros(3), at, np.eye(3).ravel(), ink)
    label.label = text
    scene.ngeom += 1


def ball_around(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[npt.NDArray[np.float64], float]:
    """Centre and radius of the ball around the box around the balls around all geoms but planes."""
    bounded = model.geom_rbound > 0
    centres, radii = data.geom_xpos[bounded], model.geom_rbound[bounded, np.newaxis]
    low, high = (centres - radii).min(axis=0), (centres + radii).max(axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low) / 2)


def png(pixels: npt.NDArray[np.uint8], scene: str) -> bytes:
    """Pixels (rows, columns, red green blue) as a PNG file with a hash: the same for the same pixels."""
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    text = SCENE + b"\0" + scene.encode()
    parts = ((b"IHDR", header), (b"tEXt", text), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunk(kind, body) for kind, body in parts)


def chunk(kind: bytes, body: bytes) -> bytes:
    """One chunk of a PNG file."""
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
