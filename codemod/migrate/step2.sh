#!/usr/bin/env bash
# step2.sh TREE: explorations of TREE under new keys, and stamped as what they were: current. To be run where they were current before.
set -euo pipefail
tree=$(realpath "$1")
python3 /tmp/codemod/migrate/stored_words.py "$tree/data/runs"
cd "$tree"
cp /tmp/codemod/migrate/restamp.rs src/analysis/across/restamp.rs
printf '\n#[cfg(test)]\nmod restamp;\n' >> src/analysis/across/mod.rs
cat /tmp/codemod/migrate/restamp_impl.rs >> src/analysis/across/stored.rs
REPLAN_RESTAMP="$tree" cargo test --locked --offline -p replan --lib across::restamp -- --nocapture || true
rm src/analysis/across/restamp.rs; git checkout -q src/analysis/across/mod.rs src/analysis/across/stored.rs
