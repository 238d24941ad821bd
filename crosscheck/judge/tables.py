"""Questions and answers as Parquet files beside a model."""

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq

from judge.located import Stale


def beside(model: Path, part: str) -> Path:
    """Where the table `part` of a model lies."""
    return model.with_name(f"{model.stem}.{part}.parquet")


def angles_of(table: pa.Table, joints: int) -> npt.NDArray[np.float64]:
    """The configurations of a table of questions, one a row."""
    angles = [table.column(f"q{joint + 1}").to_numpy() for joint in range(joints)]
    return np.column_stack(angles).astype(np.float64)


def read_questions(model: Path, joints: int) -> tuple[npt.NDArray[np.float64], dict[str, npt.NDArray[np.bool_]]]:
    """Read the configurations, one a row, and by name what is asked besides contact."""
    table = pq.read_table(beside(model, "questions"))
    flags = ("frames", "gaps", "limits")
    return angles_of(table, joints), {flag: table.column(flag).to_numpy().astype(np.bool_) for flag in flags}


def write_table(model: Path, part: str, columns: dict[str, npt.NDArray[Any]]) -> None:
    """Write named columns, all equally long."""
    pq.write_table(pa.table(columns), beside(model, part), compression="zstd")


def read_answers(path: Path, names: list[str], rows: int) -> npt.NDArray[Any]:
    """Read the answers at `path`: one row a question, one column a name, in the order of `names`."""
    try:
        table = pq.read_table(path)
    except (OSError, pa.ArrowInvalid) as error:
        raise Stale(f"{path}: answers cannot be read: {error}") from error
    if table.num_rows != rows:
        raise Stale(f"{path}: the table has {table.num_rows} rows; {rows} were asked for")
    if missing := [name for name in names if name not in table.column_names]:
        raise Stale(f"{path}: there is no column `{missing[0]}`, which was asked for")
    columns = [table.column(name) for name in names]
    if empty := [name for name, column in zip(names, columns, strict=True) if column.null_count]:
        raise Stale(f"{path}: column `{empty[0]}` has no answer in every row")
    return np.stack([column.to_numpy() for column in columns], axis=1) if names else np.empty((rows, 0))
