#!/usr/bin/env bash
# Runs the shards of a run of replan through GNU parallel, as many at once as this machine has cores, and puts their parts
# together when all are done. Options of parallel may follow, as: bash run_parallel.sh --jobs 8 --sshloginfile nodes
# A shard that failed runs again, three times in all. Run again, only what is not done runs.
set -euo pipefail
program=${REPLAN:-@PROGRAM@}
cd @FOLDER@
mkdir -p @PARTS@
for ((round = 1; round <= @ROUNDS@; round++)); do
  # A merge may leave shards of another round to run.
  if ((round > 1)) && "$program" status @PARTS@ --json | grep -q '"running":\[\],"stopped":\[\],"waiting":0'; then break; fi
  seq @SHARDS@ | parallel --retries 3 --joblog @PARTS@/parallel.log "$@" "$program" @RUN@
  "$program" @MERGE@
done
