"""Specs that say what differs are read as the specs written out."""

from alike import whole

PAPER = {"contender": [{"label": "far", "planner": "a", "settings": {"weight": 1, "ties": "fifo"}}]}
STUDY = {
    "question": "?",
    "problems": [
        {"label": "one", "family": "f", "instances": 3, "settings": {"size": 9, "share": 0.1}},
        {"label": "two", "like": "one", "settings": {"share": 0.2}},
        {"label": "three", "like": "two", "instances": 4},
    ],
    "contender": [
        {"label": "far", "like": "far", "settings": {"ties": "lifo"}},
        {"label": "other", "like": "far", "then": [], "departs": {"corners": "allow"}},
    ],
}


def test_what_is_like_another_has_what_that_one_has() -> None:
    found = whole(STUDY, PAPER)
    assert found["question"] == "?"
    groups = [(group["family"], group["instances"], group["settings"]) for group in found["problems"]]
    assert groups == [
        ("f", 3, {"size": 9, "share": 0.1}),
        ("f", 3, {"size": 9, "share": 0.2}),
        ("f", 4, {"size": 9, "share": 0.2}),
    ]
    far, other = found["contender"]
    assert far["settings"] == other["settings"] == {"weight": 1, "ties": "lifo"}, (
        "the one above, not the shared one"
    )
    assert (other["planner"], other["then"], other["departs"]) == ("a", [], {"corners": "allow"})
    assert "departs" not in far


def test_a_study_without_contenders_stays_without() -> None:
    assert whole({"question": "?"}, PAPER) == {"question": "?"}
