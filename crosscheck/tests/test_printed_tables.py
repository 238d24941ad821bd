"""Claims that cells of tables are, and parts of sweeps, on small cases."""

from __future__ import annotations

import tomllib

import pytest

from statistics_judge.printed_tables import claims_of
from statistics_judge.records import meets

PAPER = """
[[table]]
id = "table1"
claims = "t"
select = { study = "s" }
check.within = { statistic = "mean", margin = 1.0 }
[[table.column]]
id = ["10", "20"]
select = { sweep = "n={column}" }
[[table.column]]
id = "time"
untestable = "no machine"
[[table.row]]
id = "a"
select = { contender = "A" }
printed = ["1.0", "N/A", "3"]
cell.10.check.within.margin = 2.0
[[table.row]]
id = "b"
printed = ["4", "5", "6"]
with = ["c"]
cell.20.check.exists = { in = [] }
cell.20.select = { contender = "B", metric = "m" }
[[claim]]
id = "c"
check.row_one_draw.rows = [{ claims = ["t.*", "d"] }]
"""


def test_the_nearest_layer_says_how_a_cell_is_judged() -> None:
    claims = {claim["id"]: claim for claim in claims_of(tomllib.loads(PAPER))}
    assert list(claims) == ["t.a.10", "t.a.time", "t.b", "t.b.10", "t.b.20", "t.b.time", "c"]
    selection = {"study": "s", "sweep": "n=10", "contender": "A"}
    assert claims["t.a.10"]["check"] == {"within": {"statistic": "mean", "margin": 2.0, "select": selection}}
    assert claims["t.b"]["cells"] == ["t.b.10", "t.b.20", "c"]
    assert claims["t.a.time"] == {"id": "t.a.time", "printed": "3", "untestable": "no machine"}
    assert claims["t.b.20"]["check"] == {"exists": {"in": [], "contenders": "B", "metric": "m"}}
    named = ["t.a.10", "t.a.time", "t.b.10", "t.b.20", "t.b.time", "d"]
    assert claims["c"]["check"]["row_one_draw"]["rows"] == [{"claims": named}]


COMPARED = """
[[table]]
id = "t"
check.mean_of = { instances = 5 }
[[table.column]]
id = "a"
[[table.column]]
id = "b"
[[table.column]]
id = "more"
difference = ["a", "b"]
select = { contender = "A", against = "B" }
[[table.row]]
id = "one"
printed = ["1.25", "3.5"]
[[table.row]]
id = "two"
printed = ["1", "N/A"]
[[table.row]]
id = "three"
printed = ["1", "2"]
untestable = "no maps"
"""


def test_what_one_column_has_more_than_another_is_a_cell() -> None:
    claims = {claim["id"]: claim for claim in claims_of(tomllib.loads(COMPARED))}
    more = claims["t.one.more"]
    assert (more["printed"], more["difference"]) == ("-2.25", ["t.one.a", "t.one.b"])
    assert more["check"]["mean_of"] == {"instances": 5, "select": {"contender": "A", "against": "B"}}
    assert claims["t.one"]["cells"] == ["t.one.a", "t.one.b", "t.one.more"]
    assert not {"t.two.more", "t.three.more"} & set(claims)
    repeated = COMPARED.replace('["1", "2"]', '["1", "2"]\ncell.b.same_as = "u.one.b"')
    assert set(claims) - {claim["id"] for claim in claims_of(tomllib.loads(repeated))} == {"t.three.b"}


@pytest.mark.parametrize(
    ("text", "met"),
    [
        ("n=5", [5]),
        ("n<=5", [1, 5]),
        ("n<5", [1]),
        ("n > 1,n < 9", [5]),
        ("n>=5", [5, 9]),
        ("m=5", []),
        ("n", []),
    ],
)
def test_a_condition_on_a_sweep_is_met_by_its_points(text: str, met: list[int]) -> None:
    assert [point for point in (1, 5, 9) if meets(f"n={point},w=a", text)] == met
    assert not meets("", text)
    assert meets("n=1,w=a", "w=a")
    assert not meets("n=1,w=a", "w>a")
