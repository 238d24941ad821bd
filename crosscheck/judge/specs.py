"""`crosscheck.toml` in a paper's folder: which robots, scenes and stored paths are judged."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from judge.located import Fault, Key, Written
from judge.robots import Model, Numbers, read_robot
from judge.scenes import Still, read_cell, read_polyhedra
from judge.sets import around, check_ends, read_problem, stepped
from judge.stored import Stored, read_group, read_paths, read_workspace, slug
from judge.urdf import BODY, parsed, read_urdf

SPEC = "crosscheck.toml"
SCHEMA = Path(__file__).parents[2] / "docs/schema/crosscheck.schema.json"
PROMISES = ("nothing", "scene", "contact")
"""What a path may be free of, the least promise first."""
READERS = {"cell": read_cell, "polyhedra": read_polyhedra}


@dataclass(frozen=True)
class Case:
    """A robot in a scene, what goes straight between the stops of its paths, and the stored ones if there are any."""

    name: str
    model: Model
    straight: str
    paths: list[Stored]
    free_of: str
    of: str = ""
    """The label of the set that the case is of, if any."""


@dataclass(frozen=True)
class Places:
    """The paper's folder, the folder that shared inputs start from, its records, and those of trials run again."""

    folder: Path
    home: Path
    runs: Path
    again: Path = Path()


class Spec:
    """A cross-check as its paper poses it."""

    def __init__(self, places: Places) -> None:
        """Read and check the spec."""
        self.places = places
        self.written = Written(places.folder / SPEC)
        self.written.check(SCHEMA)
        self.table: dict[str, Any] = self.written.table

    def names(self) -> list[str]:
        """The names of the cases: every robot in every scene, every workspace, and the samples of sets by number."""
        scenes = [
            slug(f"{robot['label']} in {scene['label']}")
            for robot in self.table.get("robot", [])
            for scene in self.table.get("scene", [])
        ]
        names = scenes + [slug(entry["label"]) for entry in self.table.get("workspace", [])]
        names += [slug(f"{label} {number}") for label, number in self.samples()]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise self.fault((), f"two cases are called `{name}`; accepted: labels that tell them apart")
        return names

    def samples(self) -> list[tuple[str, int]]:
        """Every problem of the samples of sets: the set's label and a number from 1."""
        sets = self.table.get("set", [])
        return [(entry["label"], number) for entry in sets for number in range(1, entry["sample"] + 1)]

    def fault(self, key: Key, message: str) -> Fault:
        """A fault at a key of the spec."""
        return self.written.fault(key, message)

    def located(self, name: str, key: Key) -> Path:
        """An input file, from the paper's folder or the home of shared inputs."""
        tried = [self.places.folder / name, self.places.home / name]
        for path in tried:
            if path.is_file():
                return path
        looked = ", ".join(map(str, tried))
        raise self.fault(key, f"input file `{name}` does not exist; looked for {looked}")

    def case(self, name: str) -> Case:
        """The case called `name`."""
        number, scenes = self.names().index(name), self.table.get("scene", [])
        robots = len(self.table.get("robot", []))
        beyond, workspaces = number - robots * len(scenes), len(self.table.get("workspace", []))
        if beyond >= workspaces:
            return self.set_case(name, *self.samples()[beyond - workspaces])
        if beyond >= 0:
            return self.workspace_case(name, beyond)
        return self.scene_case(name, *divmod(number, len(scenes)))

    def scene_case(self, name: str, robot_index: int, scene_index: int) -> Case:
        """A robot in a scene."""
        robot, scene = self.table["robot"][robot_index], self.table["scene"][scene_index]
        file = self.located(scene["file"], ("scene", scene_index, "file"))
        base, stills = READERS[scene["format"]](file)
        file = self.located(robot["file"], ("robot", robot_index, "file"))
        model = self.model(robot_index, file, name, base, stills)
        entries = [
            entry["paths"]
            for entry in self.table.get("stored", [])
            if (entry["robot"], entry["scene"]) == (robot["label"], scene["label"])
        ]
        return self.with_paths(model, robot["straight"], entries)

    def model(self, index: int, file: Path, name: str, base: Numbers, stills: tuple[Still, ...]) -> Model:
        """The robot of this number: rows, or a URDF file with an SRDF file beside it."""
        robot = self.table["robot"][index]
        if file.suffix != ".urdf":
            return read_robot(file, robot["body"], name, base, stills)
        if "srdf" not in robot or robot["body"] != BODY:
            raise self.fault(("robot", index), f"a URDF robot is judged with `srdf` and the body `{BODY}`")
        srdf = self.located(robot["srdf"], ("robot", index, "srdf"))
        return read_urdf(file, srdf, name, base, stills)

    def workspace_case(self, name: str, index: int) -> Case:
        """A planar arm as a study poses it."""
        paths = self.table["workspace"][index]["paths"]
        model, straight = read_workspace(self.places.folder, paths, name)
        return self.with_paths(model, straight, [paths])

    def set_case(self, name: str, label: str, number: int) -> Case:
        """The robot of a set in the problem of the path of this number."""
        index, entry = next((index, entry) for index, entry in enumerate(self.table["set"]) if entry["label"] == label)
        key, paths = ("set", index), entry["paths"]
        settings = read_group(self.places.folder, paths, "joint_problems")
        if settings["self_contact"] != "srdf":
            raise self.fault(key, f"`self_contact` is `{settings['self_contact']}` there; accepted: srdf")
        urdf, srdf, archive = (self.located(settings[part], key) for part in ("robot", "srdf", "problems"))
        model = read_urdf(urdf, srdf, name, np.eye(4), ())
        path = read_paths(paths, self.places.runs, len(model.rows), self.places.again)[number - 1]
        problem = read_problem(archive, settings.get("set", ""), path.instance)
        stills = around(settings, problem, parsed(urdf).attrib["name"])
        check_ends(model, urdf, problem, path)
        path = stepped(model, path, float(np.deg2rad(settings["step_deg"])))
        return Case(name, replace(model, stills=stills), "joints", [path], paths["free_of"], of=label)

    def with_paths(self, model: Model, straight: str, entries: list[dict[str, Any]]) -> Case:
        """The case with its stored paths; of several promises the least counts."""
        joints = len(model.rows)
        paths = [path for entry in entries for path in read_paths(entry, self.places.runs, joints)]
        promises = [PROMISES.index(entry["free_of"]) for entry in entries]
        return Case(model.name, model, straight, paths, PROMISES[min(promises, default=2)])

    def seed(self, name: str) -> np.random.SeedSequence:
        """The seed of a case, from the spec's and the case's name."""
        return np.random.SeedSequence([self.table["seed"], *name.encode()])
