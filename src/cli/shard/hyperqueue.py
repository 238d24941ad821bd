#!/usr/bin/env python3
"""Runs the shards of a run of replan through HyperQueue, and puts their parts together.

    python3 run_hyperqueue.py              on this machine: a server and a worker are started in this process
    python3 run_hyperqueue.py SERVER_DIR   through a server that runs already, on all of its workers

It needs the package `hyperqueue` of PyPI. A shard that failed is submitted again, three times in all; what it had done is
kept, so that it goes on from there. Run again, the program runs only what is not done.
"""

import contextlib
import json
import os
import pathlib
import subprocess
import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.client import Client
from hyperqueue.cluster import WorkerConfig
from hyperqueue.ffi.protocol import ResourceRequest

FOLDER = pathlib.Path(@FOLDER@)
PROGRAM = os.environ.get("REPLAN", @PROGRAM@)
PARTS = FOLDER / @PARTS@
SHARDS = @SHARDS@
ROUNDS = @ROUNDS@
RUN = @RUN@
MERGE = @MERGE@
THREADS = @THREADS@
TRIES = 3


def job_of(shards):
    """One task a shard; a task that fails stops no other."""
    logs = PARTS / "logs"
    logs.mkdir(parents=True, exist_ok=True)
    job = Job(default_workdir=FOLDER, max_fails=None, name="replan-@NAME@")
    for shard in shards:
        words = [PROGRAM] + [word.replace("@K@", str(shard)) for word in RUN]
        job.program(
            words,
            name=str(shard),
            stdout=str(logs / f"{shard}.out"),
            stderr=str(logs / f"{shard}.err"),
            resources=ResourceRequest(cpus=THREADS),
        )
    return job


def not_done():
    """The shards that are not done, by what their folders tell."""
    said = subprocess.run([PROGRAM, "status", str(PARTS), "--json"], cwd=FOLDER, check=True, capture_output=True)
    done = set(json.loads(said.stdout)["done"])
    return [shard for shard in range(1, SHARDS + 1) if shard not in done]


def run(client):
    """Runs what is not done, again where it failed; whether all is done."""
    left = not_done()
    for turn in range(1, TRIES + 1):
        if not left:
            break
        print(f"{len(left)} of {SHARDS} shards to run, try {turn} of {TRIES}", flush=True)
        client.wait_for_jobs([client.submit(job_of(left))], raise_on_error=False)
        left = not_done()
        for shard in left:
            print(f"shard {shard} failed; see {PARTS / 'logs' / f'{shard}.err'}", flush=True)
    return not left


def run_rounds(client):
    """Runs and merges round after round: a merge may leave shards of another round to run. The exit code."""
    for number in range(1, ROUNDS + 1):
        if number > 1 and not not_done():
            break
        if not run(client):
            return 1
        code = subprocess.run([PROGRAM] + MERGE, cwd=FOLDER).returncode
        if code:
            return code
    return 0


def main():
    with contextlib.ExitStack() as stack:
        if len(sys.argv) > 1:
            client = Client(pathlib.Path(sys.argv[1]))
        else:
            cluster = stack.enter_context(LocalCluster())
            cluster.start_worker(WorkerConfig())
            client = cluster.client()
        return run_rounds(client)


if __name__ == "__main__":
    sys.exit(main())
