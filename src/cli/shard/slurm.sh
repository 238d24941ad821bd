#!/usr/bin/env bash
# Runs the shards of a run of replan as an array job of Slurm, and puts their parts together when all are done.
#     bash run_slurm.sh      submits both jobs; options of sbatch may follow, as: bash run_slurm.sh --time=2:00:00 --partition=short
# An array has at most @TASKS@ tasks; each runs every @TASKS@th shard. Submitted again, it runs only what is not done.
#SBATCH --job-name=replan-@NAME@
#SBATCH --array=1-@TASKS@
#SBATCH --cpus-per-task=@THREADS@
set -euo pipefail
program=${REPLAN:-@PROGRAM@}
if [[ -z ${SLURM_ARRAY_TASK_ID:-} ]]; then
  cd @FOLDER@
  mkdir -p @PARTS@/logs
  merge=$(printf '%q ' "$program" @MERGE@)
  after=()
  # A merge may leave shards of another round to run; where it does not, they find nothing to do.
  for ((round = 1; round <= @ROUNDS@; round++)); do
    job=$(sbatch --parsable --output=@PARTS@/logs/%a.out "${after[@]}" "$@" @PARTS@/run_slurm.sh)
    job=$(sbatch --parsable --job-name=replan-merge --dependency="afterok:${job%%;*}" --output=@PARTS@/logs/merge.out --wrap="$merge")
    echo "round $round: ${job%%;*} merges"
    after=(--dependency="afterok:${job%%;*}")
  done
  exit
fi
cd @FOLDER@
failed=0
for ((shard = SLURM_ARRAY_TASK_ID; shard <= @SHARDS@; shard += @TASKS@)); do
  "$program" @RUN@ || failed=1
done
exit "$failed"
