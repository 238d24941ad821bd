"""A picture of a model, rendered without a screen (MUJOCO_GL=osmesa or egl)."""

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
import numpy.typing as npt

WIDTH, HEIGHT = 1200, 900


@dataclass(frozen=True)
class View:
    """Where the camera stands: as many times nearer than MuJoCo's own as `zoom` says."""

    azimuth_deg: float
    elevation_deg: float
    zoom: float


def draw(model_path: Path, to: Path, key: str, view: View) -> None:
    """Draw the model at `model_path` in the configuration of a keyframe."""
    model = mujoco.MjModel.from_xml_path(str(model_path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    camera = mujoco.MjvCamera()
    mujoco.mjv_defaultFreeCamera(model, camera)
    camera.azimuth, camera.elevation = view.azimuth_deg, view.elevation_deg
    camera.distance /= view.zoom
    with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(data, camera)
        to.write_bytes(png(renderer.render()))


def png(pixels: npt.NDArray[np.uint8]) -> bytes:
    """Pixels (rows, columns, red green blue) as a PNG file: the same for the same pixels."""
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = ((b"IHDR", header), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunk(kind, body) for kind, body in parts)


def chunk(kind: bytes, body: bytes) -> bytes:
    """One chunk of a PNG file."""
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
