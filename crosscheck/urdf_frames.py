"""MuJoCo's forward kinematics of the URDF robots in data/robots, and of one with all kinds of joints.

Writes tests/it/crosscheck/urdf/<robot>.json for a Rust test. Angles and slides are drawn from a written seed
within the limits, or within two turns where a joint has none. The file has the place of every link that
MuJoCo knows, and its rotation, row by row. Run from the root of the repository after a URDF file has changed:

    python crosscheck/urdf_frames.py
"""

import json
from pathlib import Path

import mujoco
import numpy as np

COUNT = 200
SEED = 22
FAR_RAD = 4 * np.pi
COMPILER = '<mujoco><compiler fusestatic="false" boundmass="0.01" boundinertia="0.01"/></mujoco>'


def answers(path: Path) -> dict:
    """Angles and frames of the robot at `path`."""
    text = path.read_text().replace("</robot>", f"{COMPILER}</robot>")
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    limited = model.jnt_limited.astype(bool)
    low, high = (
        np.where(limited, side, end) for side, end in zip(model.jnt_range.T, (-FAR_RAD, FAR_RAD), strict=True)
    )
    angles = np.random.default_rng(SEED).uniform(low, high, (COUNT, model.njnt))
    names = [model.body(index).name for index in range(1, model.nbody)]
    frames: dict[str, list[list[float]]] = {name: [] for name in names}
    for q_rad in angles:
        data.qpos[:] = q_rad
        mujoco.mj_kinematics(model, data)
        for name in names:
            body = data.body(name)
            frames[name].append([*body.xpos.tolist(), *body.xmat.tolist()])
    return {
        "mujoco": mujoco.__version__,
        "angles_rad": angles.tolist(),
        "tip": names[-1],
        "frames": frames[names[-1]],
    }


def main() -> None:
    """Answer for every URDF robot."""
    folder = Path("tests/it/crosscheck/urdf")
    folder.mkdir(exist_ok=True)
    for path in sorted([*Path("data/robots").glob("*.urdf"), *folder.glob("*.urdf")]):
        text = json.dumps(answers(path)).replace("], [", "],\n [")
        (folder / f"{path.stem}.json").write_text(text + "\n")
        print(path.stem)


if __name__ == "__main__":
    main()
