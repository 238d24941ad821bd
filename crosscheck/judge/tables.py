"""Questions and answers as Parquet files beside a model."""

from pathlib import Path

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq


def beside(model: Path, part: str) -> Path:
    """Where the table `part` of a model lies."""
    return model.with_name(f"{model.stem}.{part}.parquet")


def read_questions(
    model: Path, joints: int
) -> tuple[npt.NDArray[np.float64], dict[str, npt.NDArray[np.bool_]]]:
    """Read the configurations, one a row, and by name what is asked besides contact."""
    table = pq.read_table(beside(model, "questions"))
    angles = [table.column(f"q{joint + 1}").to_numpy() for joint in range(joints)]
    flags = ("frames", "gaps", "limits")
    asked = {flag: table.column(flag).to_numpy().astype(np.bool_) for flag in flags}
    return np.column_stack(angles).astype(np.float64), asked


def write_table(model: Path, part: str, columns: dict[str, npt.NDArray]) -> None:
    """Write named columns, all equally long."""
    pq.write_table(pa.table(columns), beside(model, part), compression="zstd")
