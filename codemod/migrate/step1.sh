#!/usr/bin/env bash
# step1.sh TREE RUNS: rewrites the records below RUNS (Parquet and manifests) with the writer of TREE, which has the new names.
set -euo pipefail
tree=$1; runs=$(realpath "$2")
cp /tmp/codemod/migrate/migrate.rs "$tree/src/study/store/migrate.rs"
grep -q 'mod migrate;' "$tree/src/study/store/mod.rs" || printf '\n#[cfg(test)]\nmod migrate;\n' >> "$tree/src/study/store/mod.rs"
(cd "$tree" && REPLAN_MIGRATE="$runs" cargo test --locked --offline -p replan-study --lib migrate_runs -- --nocapture) || true
(cd "$tree" && rm src/study/store/migrate.rs && git checkout -q src/study/store/mod.rs)
