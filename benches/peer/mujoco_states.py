"""MuJoCo as a checker of an arm's configurations: is any pair of the model in contact?

The model is the one that `replan crosscheck` writes. A round is one configuration, from angles to contacts.
"""

import json
import sys
import time

import mujoco


def main() -> None:
    """Answer whether each configuration is in contact, then time rounds."""
    model = mujoco.MjModel.from_xml_path(sys.argv[1])
    data = mujoco.MjData(model)
    configurations = json.loads(sys.stdin.readline())

    def is_in_contact(q_rad: list[float]) -> bool:
        data.qpos[:] = q_rad
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        return data.ncon > 0

    print(json.dumps([is_in_contact(q_rad) for q_rad in configurations]), flush=True)
    at = 0
    for line in sys.stdin:
        begun = time.thread_time_ns()
        for _ in range(int(line)):
            is_in_contact(configurations[at])
            at = (at + 1) % len(configurations)
        print(time.thread_time_ns() - begun, flush=True)


if __name__ == "__main__":
    main()
