"""The search for the end points of the planar paper."""

import sys

import pytest

import end_points


def test_two_pairs_have_both_printed_lengths_and_one_target_in_seventeen_is_met(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["end_points.py", "10"])
    end_points.main()
    assert capsys.readouterr().out.splitlines() == [
        "circles of 10 cm: 7735 of 133885 targets are met (5.78 %)",
        "  (0, 45) and (49, 3)",
        "  (2, 45) and (49, 3)",
    ]
