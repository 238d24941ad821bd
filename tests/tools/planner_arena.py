"""What Planner Arena's own package reads of an exported database are the numbers that the records hold, and it draws them."""

import io
import sys
import warnings
from importlib.metadata import version
from pathlib import Path

import polars as pl
from plannerarena.database import load_database
from plannerarena.performance import boxplot, enums_plot
from plotnine.exceptions import PlotnineWarning

database, records = (Path(argument) for argument in sys.argv[1:])
arena = load_database(database)
runs, attributes = arena["runs"], arena["attributes"]
statuses = arena["enums"].filter(pl.col("name") == "status")
ends = runs.join(statuses, left_on="status", right_on="value", how="left")
assert (ends["solved"] == 1).equals(ends["description"] == "Exact solution"), ends.select("solved", "description")


def table(frame, solved, numbers):
    """The planner, whether it solved and its numbers, in an order of their own."""
    columns = [pl.col("planner").cast(pl.String), solved.cast(pl.Float64).alias("solved")]
    found = frame.select(*columns, *(pl.col(name).cast(pl.Float64) for name in numbers))
    return found.sort(pl.all(), nulls_last=True)


compared = 0
for file in sorted(records.glob("*.trials.parquet")):
    study = file.name.removesuffix(".trials.parquet")
    # Planner Arena shows the `_` of a name as a space; a seed is no number that a planner reaches.
    stored = pl.read_parquet(file).rename(lambda name: "planner" if name == "contender" else name.replace("_", " "))
    measured = [column for column in stored if column.dtype.is_numeric() and column.null_count() < stored.height]
    numbers = [column.name for column in measured if column.name != "seed"]
    assert set(numbers) <= set(attributes), set(numbers) - set(attributes)
    read = runs.filter(pl.col("experiment").str.starts_with(f"{study}/"))
    ours = table(stored, pl.col("status") == "solved", numbers)
    theirs = table(read, pl.col("solved"), numbers)
    assert ours.equals(theirs), f"{study}: the records hold {ours}\nPlanner Arena reads {theirs}"
    clock = pl.read_parquet(records / f"{study}.times.parquet").filter(pl.col("session") == 1)
    trials = clock.group_by(pl.exclude("session", "clock_repeat", "plan_wall_ns")).agg(pl.col("plan_wall_ns").min())
    seconds = trials["plan_wall_ns"].sort() * 1e-9
    assert seconds.equals(read["time"].drop_nulls().sort()), f"{study}: times differ"
    compared += ours.height
assert compared == runs.height > 0, f"{compared} trials are recorded and {runs.height} runs read"

# Trials without a number are left out of a box.
warnings.simplefilter("ignore", PlotnineWarning)
for experiment in arena["problem_names"]:
    own = runs.filter(pl.col("experiment") == experiment)
    for plot in (enums_plot(own, statuses, ""), boxplot(own, "expansions", "", "o", False)):
        plot.save(io.BytesIO(), format="svg", verbose=False)
experiments = len(arena["problem_names"])
print(f"Planner Arena {version('plannerarena')} reads and draws {compared} recorded trials in {experiments} experiments")
