#!/usr/bin/env bash
# Processor time of a first build by package, seconds: what `cargo run` compiles with crates downloaded and an empty target folder.
# `benches/first-build.sh -p replan-audit` measures what another `cargo build` compiles, and `REPLAN_REVISION=02acae0c` before it what
# that revision compiled.
set -euo pipefail

# Cargo runs this file in front of the compiler.
if [ -n "${REPLAN_TIMES:-}" ]; then
  code=0
  "$@" || code=$?
  [ -z "${CARGO_PKG_NAME:-}" ] || times > "$REPLAN_TIMES/$CARGO_PKG_NAME.$$"
  exit "$code"
fi

wrapper=$(realpath "$0")
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- --bin replan
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if [ -n "${REPLAN_REVISION:-}" ]; then
  mkdir "$folder/revision"
  git archive "$REPLAN_REVISION" | tar -x -C "$folder/revision"
  cd "$folder/revision"
fi
cargo fetch --locked --quiet
mkdir "$folder/times"
TIMEFORMAT='all: %U s for programs and %S s for the system, %R s on the clock'
time REPLAN_TIMES="$folder/times" RUSTC_WRAPPER="$wrapper" CARGO_TARGET_DIR="$folder/target" \
  cargo build --locked --offline --quiet "$@"
# The second line that `times` writes is of the compiler and its linker: `1m2.345s 0m1.000s`.
awk -F '[ms ]+' '
  FNR == 2 { name = FILENAME; gsub(/.*\/|\.[0-9]+$/, "", name); seconds[name] += 60 * ($1 + $3) + $2 + $4 }
  END { for (name in seconds) printf "%8.1f  %s\n", seconds[name], name }' "$folder"/times/* | sort -rn
