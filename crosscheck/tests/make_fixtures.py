"""Writes the questions of the mini model; run it after a change of the questions' format."""

from math import pi
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

FIXTURES = Path(__file__).parent / "fixtures"

ROWS = [
    # Stretched along x; the elbow straight up; folded through the box; beyond the second joint's limit.
    {"q1": 0.0, "q2": 0.0, "frames": True, "gaps": True, "limits": False},
    {"q1": pi / 2, "q2": -pi / 2, "frames": True, "gaps": True, "limits": True},
    {"q1": pi / 2, "q2": 0.0, "frames": False, "gaps": False, "limits": True},
    {"q1": 3.0 + 1e-9, "q2": -2.1, "frames": False, "gaps": False, "limits": True},
]

if __name__ == "__main__":
    pq.write_table(pa.Table.from_pylist(ROWS), FIXTURES / "mini.questions.parquet")
