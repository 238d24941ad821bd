"""Exported traces are YAML of the shape that posthoc reads: `protocol/Trace-v140.ts` of ShortestPathLab/posthoc-app."""

import sys
from pathlib import Path

import yaml

files = sorted(Path(sys.argv[1]).glob("*.trace.yaml"))
assert files, "no trace was exported"
count = 0
for file in files:
    trace = yaml.safe_load(file.read_text(encoding="utf-8"))
    assert set(trace) == {"version", "views", "pivot", "events"} and trace["version"] == "1.4.0", file
    assert trace["views"]["main"] and all(isinstance(component["$"], str) for component in trace["views"]["main"]), file
    assert set(trace["pivot"]) <= {"x", "y", "z", "scale"}, file
    for event in trace["events"]:
        assert isinstance(event["id"], str) and isinstance(event["type"], str), f"{file}: {event}"
        assert isinstance(event["x"], float) and isinstance(event["y"], float), f"{file}: {event}"
    count += len(trace["events"])
print(f"{len(files)} traces with {count} events are of posthoc's shape")
