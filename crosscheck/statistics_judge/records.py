"""Papers, studies and stored trials as numpy arrays."""

import copy
import itertools
import json
import operator
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from alike import whole
from statistics_judge.printed_tables import claims_of

Reals = npt.NDArray[np.float64]
Places = npt.NDArray[np.int64]
Flags = npt.NDArray[np.bool_]


# What a column is called that has the option taken of a choice, before the choice's name.
OPTION = "choice_"


@dataclass(frozen=True)
class Metric:
    """A metric, as replan describes it."""

    name: str
    column: str
    scale: float
    at_most: str | None
    better: str
    clock: bool
    status: bool
    # Whether it counts what the search did, which holds even where the verifier refuses the path.
    of_search: bool = False

    def given(self, status: npt.NDArray[np.str_]) -> Flags:
        """Whether trials that ended so have a number."""
        return (status == "solved") | (self.of_search & (status == "rejected"))


class Table:
    """One Parquet file, read column by column."""

    def __init__(self, path: Path) -> None:
        """Open the file."""
        self.table = pq.read_table(path)
        self.names = self.table.column_names

    def words(self, name: str) -> tuple[Places, list[str]]:
        """A column of words as places in a list of words; null is the empty word."""
        column = pc.fill_null(pc.cast(self.table.column(name), pa.string()), "")
        coded = pa.chunked_array(column).combine_chunks().dictionary_encode()
        return coded.indices.to_numpy().astype(np.int64), coded.dictionary.to_pylist()

    def numbers(self, name: str) -> Reals:
        """A column of numbers; null is NaN."""
        return pc.cast(self.table.column(name), pa.float64()).to_numpy(zero_copy_only=False).astype(float)

    def sweep(self, name: str) -> list[str | None]:
        """A column of a sweep's values as TOML writes them."""
        return [None if value is None else spelled(value) for value in self.listed(name)]

    def listed(self, name: str) -> list[Any]:
        """A column as Python values."""
        return self.table.column(name).to_pylist()


def coded(words: list[str]) -> tuple[Places, list[str]]:
    """Words as places in a list of words."""
    known = {word: place for place, word in enumerate(dict.fromkeys(words))}
    return np.array([known[word] for word in words], dtype=np.int64), list(known)


class Study:
    """A study's spec with its stored run, as seen under one interpretation."""

    def __init__(self, path: Path, spec: dict[str, Any], runs: Path) -> None:
        """Remember where it is; nothing is read before it is asked for."""
        self.name, self.spec, self.runs = path.stem, spec, runs
        self.taken: dict[str, str] = {}
        # The instances of a group and the seeds of a contender that are looked at; all if not given.
        self.most: tuple[int | None, int | None] = (None, None)
        self._columns: dict[str, Reals] = {}
        self._clocked: dict[int, Reals] = {}
        # What many claims ask of one contender on one problem, and who asks.
        self.known: dict[tuple, Any] = {}

    @cached_property
    def inherited(self) -> list[str]:
        """The choices that touch its trials: the stored run names them."""
        return toml(self.runs / f"{self.name}.manifest.toml")["choices"]

    @property
    def groups(self) -> list[str]:
        """The labels of its problem groups; one with `each` stands for a group a file, as stored."""
        found = []
        for group in self.spec.get("problems", []):
            stored = sorted(
                name for name in self.trials.words("group")[1] if name.startswith(group["label"] + " ")
            )
            found += stored if "each" in group else [group["label"]]
        return found

    def sweep_points(self, groups: list[str]) -> list[str]:
        """The points of its sweeps on problem groups, as trials name them: those over problems first."""
        found: dict[str, None] = {}
        for group in groups:
            over = [sweep for sweep in self.sweeps if is_over(sweep, group)]
            values = [[f"{sweep['key']}={spelled(value)}" for value in sweep["values"]] for sweep in over]
            found |= dict.fromkeys(",".join(point) for point in itertools.product(*values))
        return list(found)

    @property
    def sweeps(self) -> list[dict[str, Any]]:
        """Its sweeps, those over problems first."""
        return sorted(self.spec.get("sweep", []), key=lambda sweep: "stage" in sweep)

    def sweeps_called(self, groups: list[str], written: str | list[str] | None) -> list[str]:
        """The points of its sweeps on problem groups that meet one of the conditions; all without any."""
        points = self.sweep_points(groups)
        if written is None:
            return points
        texts = [written] if isinstance(written, str) else written
        return [point for point in points if any(point == text or meets(point, text) for text in texts)]

    @cached_property
    def trials(self) -> Table:
        """The stored trials."""
        return Table(self.runs / f"{self.name}.trials.parquet")

    @cached_property
    def query(self) -> tuple[Places, list[str]]:
        """The query of each trial."""
        return self.trials.words("query")

    @cached_property
    def sweep(self) -> tuple[Places, list[str]]:
        """The point of the sweeps of each trial."""
        return self.points_of(self.sweeps)

    @cached_property
    def pooled(self) -> tuple[Places, list[str]]:
        """The same without the sweeps that number what is drawn within an instance."""
        return self.points_of([sweep for sweep in self.sweeps if not sweep.get("nested", False)])

    def pooled_points(self, points: list[str]) -> list[str]:
        """Points without the values of those sweeps, each once."""
        nested = {sweep["key"] for sweep in self.sweeps if sweep.get("nested", False)}
        kept = [
            [part for part in point.split(",") if part.split("=", 1)[0] not in nested] for point in points
        ]
        return list(dict.fromkeys(",".join(parts) for parts in kept))

    def points_of(self, sweeps: list[dict[str, Any]]) -> tuple[Places, list[str]]:
        """The point of some of its sweeps of each trial."""
        keys = list(dict.fromkeys(sweep["key"] for sweep in sweeps))
        if not keys:
            return np.zeros(self.count, dtype=np.int64), [""]
        columns = [self.trials.sweep(f"sweep_{key}") for key in keys]
        # A sweep over problems is null on groups that are none of its own.
        return coded(
            [
                ",".join(f"{k}={v}" for k, v in zip(keys, row, strict=True) if v is not None)
                for row in zip(*columns, strict=True)
            ]
        )

    @property
    def count(self) -> int:
        """How many trials are stored."""
        return self.trials.table.num_rows

    @cached_property
    def instance(self) -> Places:
        """The instance of each trial."""
        return self.trials.numbers("instance").astype(np.int64)

    @cached_property
    def repeat(self) -> Places:
        """Which of the contender's seeds each trial has."""
        return self.trials.numbers("repeat").astype(np.int64)

    @cached_property
    def posed(self) -> Places:
        """One number for what is posed to contenders alike: instance, query and point of the sweeps."""
        posed = self.instance
        for part in (self.query[0], self.sweep[0]):
            posed = posed * (int(part.max(initial=0)) + 1) + part
        return posed

    @cached_property
    def case(self) -> Places:
        """The same with the seed of a contender that draws."""
        return self.posed * (int(self.repeat.max(initial=0)) + 1) + self.repeat

    @cached_property
    def status(self) -> npt.NDArray[np.str_]:
        """How each trial ended."""
        places, words = self.trials.words("status")
        return np.array([*words, ""])[places]

    @cached_property
    def solved(self) -> Flags:
        """Whether each trial was solved."""
        return self.status == "solved"

    def first(self, instances: int | None, repeats: int | None) -> "Study":
        """The study with its first instances and seeds alone; itself if that is all that is stored."""
        stored = (int(one.max(initial=0)) + 1 for one in (self.instance, self.repeat))
        if all(
            most is None or most >= all_of for most, all_of in zip((instances, repeats), stored, strict=True)
        ):
            return self
        first = copy.copy(self)
        first.most, first.known = (instances, repeats), {}
        vars(first).pop("_places", None)
        return first

    def has_instances(self, count: int) -> bool:
        """Whether so many instances, or all that its spec asks for, of each group are stored."""
        groups, names = self.trials.words("group")
        wanted = {own["label"]: min(own.get("instances", 1), count) for own in self.spec.get("problems", [])}
        return all(
            len(np.unique(self.instance[groups == names.index(label)])) >= least
            for label, least in wanted.items()
            if label in names
        )

    @cached_property
    def _places(self) -> dict[tuple[str, str], Places]:
        groups, group_names = self.trials.words("group")
        contenders, contender_names = self.trials.words("contender")
        kept = np.ones(self.count, dtype=bool)
        for most, numbered in zip(self.most, (self.instance, self.repeat), strict=True):
            kept &= most is None or numbered < most
        for choice in self.inherited:
            options, names = self.trials.words(OPTION + choice)
            wanted = self.taken[choice]
            kept &= options == (names.index(wanted) if wanted in names else -1)
        both = np.where(kept, groups * len(contender_names) + contenders, -1)
        found = {}
        for code in np.unique(both[kept]):
            group, contender = divmod(int(code), len(contender_names))
            found[group_names[group], contender_names[contender]] = np.flatnonzero(both == code)
        return found

    def rows(self, group: str, contender: str) -> Places:
        """The trials of a contender in a problem group, in the order that they are stored in."""
        return self._places.get((group, contender), np.empty(0, dtype=np.int64))

    def column(self, name: str) -> Reals:
        """A column of every trial; NaN where it is null, or there is no such column."""
        if name not in self._columns:
            known = name in self.trials.names
            self._columns[name] = self.trials.numbers(name) if known else np.full(self.count, np.nan)
        return self._columns[name]

    def values(self, metric: Metric, session: int) -> Reals:
        """A metric of every trial; NaN where it was not measured."""
        if metric.status:
            return np.isin(self.status, ["solved", "rejected"]).astype(np.float64) * metric.scale
        if not metric.clock:
            values = self.column(metric.column)
            if metric.at_most is not None:
                most = self.column(metric.at_most)
                unknown = np.isnan(values) | np.isnan(most)
                values = np.where(unknown, np.nan, values <= most * (1 + 1e-9))
            return values * metric.scale
        known = self._clocked.get(session)
        if known is None:
            times = self.clock.get(session, {})
            medians = [float(np.median(times[key])) if key in times else np.nan for key in self._keys]
            self._clocked[session] = known = np.array(medians, dtype=np.float64)
        return known * metric.scale

    def repeats(self, row: int, metric: Metric, session: int) -> list[float]:
        """Every times of a trial."""
        times = self.clock.get(session, {}).get(self._keys[row], [])
        return [time * metric.scale for time in times]

    @cached_property
    def _keys(self) -> list[tuple]:
        return keys_of(self.trials)

    @cached_property
    def clock(self) -> dict[int, dict[tuple, list[float]]]:
        """Times by session and trial."""
        table = Table(self.runs / f"{self.name}.times.parquet")
        found: dict[int, dict[tuple, list[float]]] = {}
        columns = (keys_of(table), table.listed("session"), table.listed("plan_wall_ns"))
        for key, session, time in zip(*columns, strict=True):
            found.setdefault(session, {}).setdefault(key, []).append(float(time))
        return found

    @property
    def sessions(self) -> int:
        """How many sessions of the clock are stored."""
        return max(self.clock, default=0)


def is_over(sweep: dict[str, Any], group: str) -> bool:
    """Whether a sweep varies what trials on a problem group do: all do that are over a planner or stage."""
    labels = sweep.get("problems", ["*"])
    return any(group.startswith(one[:-1]) if one.endswith("*") else group == one for one in labels)


# How a condition on a sweep compares; those that hold others go first.
COMPARES = {"<=": operator.le, ">=": operator.ge, "<": operator.lt, ">": operator.gt, "=": operator.eq}


def meets(point: str, text: str) -> bool:
    """Whether a point of sweeps meets every condition in a text."""
    values = dict(part.split("=", 1) for part in point.split(",") if part)
    for condition in text.split(","):
        compare = next((one for one in COMPARES if one in condition), None)
        if compare is None:
            return False
        key, wanted = (part.strip() for part in condition.split(compare, 1))
        if key not in values:
            return False
        try:
            met = COMPARES[compare](float(values[key]), float(wanted))
        except ValueError:
            met = "=" in compare and values[key] == wanted
        if not met:
            return False
    return True


def spelled(value: object) -> str:
    """A sweep's value as TOML writes it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def keys_of(table: Table) -> list[tuple]:
    """What names the trial of each row."""
    fixed = ["group", "instance", "query", "contender", "repeat"]
    named = [*fixed, *(name for name in table.names if name.startswith(("sweep_", OPTION)))]
    return list(zip(*(table.listed(name) for name in named), strict=True))


class Paper:
    """A paper's claims and studies."""

    def __init__(self, folder: Path, runs: Path, metrics: list[Metric], explored: Path) -> None:
        """Read the specs; `explored` has what the numbers of explorations amount to."""
        self.explored = explored
        self.id = runs.name
        spec = toml(folder / "paper.toml")
        self.claims: list[dict[str, Any]] = claims_of(spec)
        self.choices: list[dict[str, Any]] = spec.get("choice", [])
        self.explore: dict[str, Any] = spec.get("explore", {})
        self.stands_for: dict[str, str] = self.explore.get("stands_for", {})
        # Questions of our own, whose times our clock decides.
        self.ours: bool = spec["source"].get("ours", False)
        self.studies = {study.name: study for study in studies(folder, runs, spec)}
        self.metrics = {metric.name: metric for metric in metrics}
        self.runs = runs
        self.taken: dict[str, str] = {choice["id"]: choice["default"] for choice in self.choices}
        options = [choice["option"][choice["default"]] for choice in self.choices]
        for study in self.studies.values():
            study.taken = self.taken
        self.meanings = {name: own for option in options for name, own in option.get("metric", {}).items()}
        self.digits = next((option["digits"] for option in options if "digits" in option), "unknown")

    @cached_property
    def explorations(self) -> list[dict[str, Any] | None]:
        """What exploring found, first and on the second seed; none where nothing is stored."""
        found: list[dict[str, Any] | None] = json.loads(self.explored.read_text(encoding="utf-8"))
        for claim in (claim for one in found if one is not None for claim in one["claims"].values()):
            claim["at"] = {
                place: result for result in claim["results"] for place in result["interpretations"]
            }
        return found

    def metric(self, name: str) -> Metric:
        """The metric that a name stands for under the default interpretation."""
        return self.metrics[self.meanings.get(name, name)]

    def claim(self, name: str) -> dict[str, Any]:
        """The claim of this name."""
        return next(claim for claim in self.claims if claim["id"] == name)


def studies(folder: Path, runs: Path, paper: dict[str, Any]) -> Iterator[Study]:
    """The studies beside paper.toml, in the order of their names."""
    for path in sorted(folder.glob("*.toml")):
        spec = toml(path)
        if path.name not in ("paper.toml", "crosscheck.toml") and ("paper" in spec or "question" in spec):
            yield Study(path, whole(spec, paper), runs)


def toml(path: Path) -> dict[str, Any]:
    """A TOML file."""
    with path.open("rb") as file:
        return tomllib.load(file)
