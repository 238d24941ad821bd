"""Planner Arena's own package reads an exported database, and OMPL's way of reading logs an exported log."""

import sys
from importlib.metadata import version
from pathlib import Path

from plannerarena.database import load_database

database, logs = Path(sys.argv[1]), Path(sys.argv[2])
arena = load_database(database)
runs = arena["runs"]
assert not runs.is_empty(), "no run was read"
assert {"solved", "status", "time"} <= set(arena["attributes"]), arena["attributes"]
solved = runs.filter(runs["solved"] == 1)
named = dict(arena["enums"].select("value", "description").iter_rows())
assert {named[status] for status in solved["status"]} == {"Exact solution"}, named
assert runs["planner"].null_count() == runs["experiment"].null_count() == 0


def runs_in(log: Path) -> int:
    lines = log.read_text().splitlines()
    return sum(int(line.split()[0]) for line in lines if line.endswith(" runs"))


in_logs = sum(runs_in(log) for log in logs.glob("*.log"))
assert in_logs == runs.height, f"{in_logs} runs in logs, {runs.height} in the database"
print(f"Planner Arena {version('plannerarena')} reads {runs.height} runs of {len(arena['problem_names'])} experiments; the logs have as many")
