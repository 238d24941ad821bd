"""The search for the end points of the planar paper."""

import sys

import pytest

import end_points


def test_circles_leave_two_pairs_and_squares_none(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["end_points.py", "circle=10", "square=10"])
    end_points.main()
    assert capsys.readouterr().out.splitlines() == [
        "circles of 10 cm: 7735 of 133885 targets are met (5.78 %)",
        "  (0, 45) and (49, 3)",
        "  (2, 45) and (49, 3)",
        "squares of 10 cm: 0 of 133885 targets are met (0.00 %)",
    ]
