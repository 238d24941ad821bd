"""Which trials a criterion looks at, as arrays: one entry a case, and the unit that each case belongs to."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from statistics_judge.records import Flags, Metric, Paper, Places, Reals, Study

# How trials end that did not come to an end.
CUT = ["budget_spent", "time_spent", "crashed"]


@dataclass
class Cases:
    """Trials with, if there is another contender, its trials on the same problems.

    A unit is what was drawn independently: an instance with the contender's seed.
    """

    study: Study
    metric: Metric | None
    session: int
    against: str | None
    own: Places
    base: Places | None
    unit: Places
    group: Places
    all_ends: bool = False
    # The points of the sweeps that are looked at.
    points: list[str] = field(default_factory=list)
    # Whether something did not end in units that do not count, as only whole ones do.
    cut_left_out: bool = False
    units: int = field(init=False)
    names: Places = field(init=False)
    values: Reals = field(init=False)
    bases: Reals = field(init=False)

    def __post_init__(self) -> None:
        """Number the units without gaps and look the metric up."""
        self.names, self.unit = np.unique(self.unit, return_inverse=True)
        self.units = len(self.names)
        self.values = self.solved_values(self.own)
        self.bases = (
            self.solved_values(self.base) if self.base is not None else np.full(len(self.own), np.nan)
        )

    def raw(self, metric: Metric) -> Reals:
        """A metric of every case, solved or not."""
        return self.study.values(metric, self.session)[self.own]

    def solved_values(self, rows: Places) -> Reals:
        """The metric where the trial gives one or, if all ends count, ended at all; NaN elsewhere."""
        if self.metric is None:
            return np.full(len(rows), np.nan)
        measured = self.study.values(self.metric, self.session)[rows]
        status = self.study.status[rows]
        ended = np.isin(status, ["no_path", "rejected"]) if self.all_ends else False
        return np.where(self.metric.given(status) | ended, measured, np.nan)

    @property
    def own_solved(self) -> Flags:
        """Whether each case's own trial was solved."""
        return self.study.solved[self.own]

    @property
    def base_solved(self) -> Flags:
        """Whether the other contender's was; yes where there is none."""
        return self.study.solved[self.base] if self.base is not None else np.ones(len(self.own), dtype=bool)

    @property
    def paired(self) -> Flags:
        """Whether both contenders have a number."""
        return ~np.isnan(self.values) & ~np.isnan(self.bases)

    @property
    def numbers(self) -> Reals:
        """The metric or, against another contender, what is saved in per cent; NaN where there is neither."""
        if self.against is None:
            return self.values
        positive = self.bases > 0
        ratio = np.divide(self.values, self.bases, out=np.full(len(self.own), np.nan), where=positive)
        return 100 * (1 - ratio)

    @property
    def censored(self) -> Flags:
        """Whether some side has no number although it might have one: unsolved, unless neither has a path."""
        none = self.study.status[self.own] == "no_path"
        lacks = np.isnan(self.values)
        if self.base is not None:
            none &= self.study.status[self.base] == "no_path"
            lacks |= np.isnan(self.bases)
        return lacks & ~none & ~(self.own_solved & self.base_solved)

    def cut(self) -> tuple[Flags, Flags]:
        """Whether each case's own trial did not come to an end, and whether the other contender's did not."""
        own = np.isin(self.study.status[self.own], CUT)
        return own, np.zeros_like(own) if self.base is None else np.isin(self.study.status[self.base], CUT)

    @property
    def unended(self) -> Flags:
        """Whether some side did not come to an end: what it would have given is not known."""
        own, base = self.cut()
        return own | base

    @property
    def might_be_solved(self) -> Flags:
        """Whether everyone might have solved it: a side did not come to an end, and none ended without a valid path."""
        own, base = self.cut()
        return (own | base) & (own | self.own_solved) & (base | self.base_solved)

    def ended_as(self, rows: Places, solved: bool) -> Flags:
        """Whether trials are solved; those that did not come to an end as reported."""
        return self.study.solved[rows] | (solved & np.isin(self.study.status[rows], CUT))

    def given(self, numbers: Reals) -> "Cases":
        """The cases as if those that did not come to an end had given these numbers."""
        found = self.kept(np.ones(len(self.own), dtype=bool))
        found.values = np.where(self.unended, numbers, self.values)
        return found

    def solved_of_all(self) -> tuple[int, int]:
        """Cases that everyone who is compared solves, and all."""
        return int((self.own_solved & self.base_solved).sum()), len(self.own)

    def kept(self, mask: Flags) -> "Cases":
        """Some of the cases."""
        base = None if self.base is None else self.base[mask]
        return Cases(
            self.study,
            self.metric,
            self.session,
            self.against,
            self.own[mask],
            base,
            self.unit[mask],
            self.group[mask],
            self.all_ends,
            self.points,
        )


def labels(written: str | list[str]) -> list[str]:
    """One label or several."""
    return [written] if isinstance(written, str) else list(written)


def groups_of(study: Study, written: str | list[str]) -> list[str]:
    """The problem groups that labels name; one that ends in `*` stands for all that begin so."""
    found = []
    for label in labels(written):
        if label.endswith("*"):
            found += [group for group in study.groups if group.startswith(label[:-1])]
        else:
            found.append(label)
    return found


# Families in which the seed decides what is posed: one instance is then one of many.
DRAWN = frozenset(
    (
        "cell_queries",
        "conditioned",
        "joint_problems",
        "joint_queries",
        "plane_queries",
        "random_bars",
        "random_cells",
        "random_polyhedra",
        "random_rectangles",
        "recorded",
    )
)


def is_drawn(study: Study, group: str) -> bool:
    """Whether a problem group's seed decides what is posed in it."""
    own = [own for own in study.spec.get("problems", []) if own["label"] == group]
    return any(one["family"] in DRAWN or draws_ends(one.get("settings", {})) for one in own)


def draws_ends(settings: dict[str, Any]) -> bool:
    """Whether a start or a goal is drawn: it is neither left out nor written as coordinates."""
    ends = [settings.get(f"{end}{unit}", []) for end in ("start", "goal") for unit in ("", "_cm")]
    return not all(isinstance(end, list) for end in ends)


def matched(study: Study, rows: Places, others: Places) -> tuple[Places, Places]:
    """Trials of two contenders on the same cases, in the order of the first.

    One of a single seed stands beside each seed of the other.
    """
    by_seed = all(study.repeat[own].any() for own in (rows, others))
    case = study.case if by_seed else study.posed
    order = np.argsort(case[others], kind="stable")
    first, last = (np.searchsorted(case[others][order], case[rows], side) for side in ("left", "right"))
    counts = last - first
    within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.repeat(rows, counts), others[order[np.repeat(first, counts) + within]]


def select(paper: Paper, of: dict[str, Any], session: int) -> Cases:
    """The cases that the table `of` of a claim names."""
    study = paper.studies[of["study"]]
    metric = paper.metric(of["metric"]) if "metric" in of else None
    against = of.get("against")
    parts: list[tuple[int, Places, Places | None]] = []
    for index, group in enumerate(groups_of(study, of["problems"])):
        for contender in labels(of.get("contender", [])):
            rows = posed(study, group, contender, of, metric)
            if against is None:
                parts.append((index, rows, None))
            else:
                parts.append((index, *matched(study, rows, posed(study, group, against, of, metric))))
    own = np.concatenate([rows for _, rows, _ in parts])
    base = None if against is None else np.concatenate([bases for _, _, bases in parts])
    places = np.concatenate([np.full(len(rows), index) for index, rows, _ in parts])
    instances, seeds = int(study.instance.max(initial=0)) + 1, int(study.repeat.max(initial=0)) + 1
    # Seeds on a problem that is drawn are no instances of it.
    drawn = [index for index, name in enumerate(groups_of(study, of["problems"])) if is_drawn(study, name)]
    seed = study.repeat[own] if base is None else np.maximum(study.repeat[own], study.repeat[base])
    seed = np.where(np.isin(places, drawn), 0, seed)
    unit = (places * instances + study.instance[own]) * seeds + seed
    points = study.pooled_points(study.sweeps_called(groups_of(study, of["problems"]), of.get("sweep")))
    ends = of.get("all_ends", False)
    cases = Cases(study, metric, session, against, own, base, unit, places, ends, points)
    if not of.get("whole_instances", False):
        return cases
    unsolved = ~(cases.own_solved & cases.base_solved)
    left_out = np.isin(cases.unit, cases.unit[unsolved])
    whole = cases.kept(~left_out)
    hopeless = np.isin(cases.unit, cases.unit[unsolved & ~cases.might_be_solved])
    whole.cut_left_out = bool((left_out & ~hopeless).any())
    return whole


def posed(
    study: Study, group: str, contender: str, of: dict[str, Any], metric: Metric | None = None
) -> Places:
    """The trials that a selection looks at: their problem could be posed, their metric was looked for."""
    rows = study.rows(group, contender)
    kept = study.status[rows] != "invalid_problem"
    timing = study.spec.get("timing")
    if metric is not None and metric.clock and timing is not None:
        # The clock is read on the first instances of each group alone.
        kept &= study.instance[rows] < timing["problems"]
    sweeps = None
    if "sweep" in of:
        sweeps = study.sweeps_called(groups_of(study, of["problems"]), of["sweep"])
    query = labels(of["query"]) if "query" in of else None
    for wanted, (places, words) in ((query, study.query), (sweeps, study.sweep)):
        if wanted is not None:
            kept &= np.isin(places[rows], [words.index(one) for one in wanted if one in words])
    return rows[kept]
