#!/usr/bin/env bash
# Lines of code by package, `benches/lines.sh [REVISION]`: production, then tests; without blank lines, comments and generated files.
set -euo pipefail
cd "$(dirname "$0")/.."

folders=(src tests crosscheck benches planners)
if [ $# -gt 0 ]; then
  copy=$(mktemp -d)
  trap 'rm -rf "$copy"' EXIT
  git archive "$1" "${folders[@]}" | tar -x -C "$copy"
  cd "$copy"
fi
mapfile -t files < <(find "${folders[@]}" -type f -regex '.*\.\(rs\|py\|js\|css\|sh\)' \
  -not -path '*/bundle/*' -not -path '*/target/*' -not -path '*/.*' | sort)

# Modules that are compiled for tests alone, by the paths of their files without endings.
test_modules=$(awk '
  FNR == 1 { folder = FILENAME; if (!sub(/\/(mod|lib|main)\.rs$/, "", folder)) sub(/\.rs$/, "", folder); is_test = 0 }
  is_test && /^ *(pub(\([a-z]+\))? )?mod [a-z_0-9]+;/ { name = $0; gsub(/.*mod |;.*/, "", name); print folder "/" name }
  { is_test = /^ *#\[cfg\(test\)\]/ || is_test && /^ *#\[/ }' "${files[@]}")
packages=$(ls src/*/Cargo.toml)

awk -v modules="$test_modules" -v packages="$packages" '
  BEGIN { split(modules, names, "\n"); for (at in names) is_module[names[at]] = 1 }
  FNR == 1 {
    split(FILENAME, part, "/")
    package = part[1]
    if (package == "src") package = index(packages, "src/" part[2] "/") ? "src/" part[2] : "replan: " part[2]
    is_test = FILENAME ~ /(^|\/)tests\// || FILENAME ~ /\/tests\.rs$/
    path = FILENAME
    sub(/\.[a-z]+$/, "", path)
    do { if (path in is_module) is_test = 1 } while (sub(/\/[^\/]*$/, "", path))
    is_python = FILENAME ~ /\.(py|sh)$/
    closing = ""
    is_next = is_quoted = 0
  }
  /^[ \t]*$/ { next }
  is_python && is_quoted { if (/"""/) is_quoted = 0; next }
  is_python && /^[ \t]*#/ { next }
  is_python && /^[ \t]*r?"""/ { is_quoted = !/""".*"""/; next }
  !is_python && /^[ \t]*(\/\/|\/\*|\*)/ { next }
  is_test { tests[package]++; next }
  closing { tests[package]++; if ($0 == closing) closing = ""; next }
  is_next && !/^ *#\[/ { is_next = 0; tests[package]++; if (!/;$/) { closing = $0; sub(/[^ ].*/, "}", closing) }; next }
  /^ *#\[cfg\(test\)\]/ { is_next = 1 }
  is_next { tests[package]++; next }
  { made[package]++ }
  END {
    print "package,production,tests"
    for (package in made) tests[package] += 0
    for (package in tests) { print package "," made[package] + 0 "," tests[package] | "sort"; all += made[package]; tested += tests[package] }
    close("sort")
    print "all," all "," tested
  }' "${files[@]}" | column -t -s , -R 2,3
