"""OMPL's own reader reads exported logs into the same runs as the exported database has; then OMPL writes a log for replan to import."""

import sqlite3
import sys
from importlib.metadata import version
from pathlib import Path

from ompl import base, geometric, tools

logs, database, out = (Path(argument) for argument in sys.argv[1:])
# What rows are numbered by, in the order of reading.
NUMBERS = {"id", "experimentid", "plannerid"}
out.mkdir(parents=True, exist_ok=True)


def runs(path):
    """Every run with its experiment and its planner, by the names of columns."""
    connection = sqlite3.connect(path)
    connection.row_factory = sqlite3.Row
    query = """SELECT experiments.name AS experiment, plannerConfigs.name AS planner, runs.* FROM runs
        JOIN experiments ON experiments.id = experimentid JOIN plannerConfigs ON plannerConfigs.id = plannerid"""
    rows = [dict(row) for row in connection.execute(query)]
    # A log writes `_` for the spaces in the name of an experiment.
    names = ({**row, "experiment": row["experiment"].replace(" ", "_")} for row in rows)
    return sorted(str(sorted((key, row[key]) for key in row if key not in NUMBERS)) for row in names)


read = out / "read.db"
read.unlink(missing_ok=True)
tools.readBenchmarkLog(str(read), [str(log) for log in sorted(logs.glob("*.log"))], "")
theirs, ours = runs(read), runs(database)
assert ours and theirs == ours, f"{len(theirs)} runs by OMPL's reader, {len(ours)} exported"

space = base.RealVectorStateSpace(2)
bounds = base.RealVectorBounds(2)
bounds.setLow(0)
bounds.setHigh(1)
space.setBounds(bounds)
setup = geometric.SimpleSetup(space)
setup.setStateValidityChecker(lambda state: not (0.3 < state[0] < 0.7 and state[1] > 0.2))
start, goal = space.allocState(), space.allocState()
start[0], start[1], goal[0], goal[1] = 0.1, 0.9, 0.9, 0.9
setup.setStartAndGoalStates(start, goal)
benchmark = tools.Benchmark(setup, "gap")
for planner in (geometric.RRT, geometric.RRTConnect):
    benchmark.addPlanner(planner(setup.getSpaceInformation()))
request = tools.Request()
request.maxTime, request.runCount = 1.0, 12
request.displayProgress = request.saveConsoleOutput = False
benchmark.benchmark(request)
assert benchmark.saveResultsToFile(str(out / "gap.log"))
print(f"OMPL {version('ompl')} reads {len(ours)} runs of exported logs, the same as in the database, and wrote gap.log")
