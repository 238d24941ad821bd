#!/usr/bin/env bash
# Bundles the page's viewer: ../viewer/*.js with three.js and uPlot into viewer.js, styles into viewer.css, licences into
# LICENCES.txt. Needs Node.js and, once, the npm registry; the versions stand in package.json. Equal inputs give equal bytes.
# Run it after a change of ../viewer, and commit what it writes; tests hold that viewer.js was built from what stands there, and that
# nothing was changed in what was written.
set -euo pipefail
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp package.json "$work"
cp -r ../viewer "$work/viewer"
(cd "$work" && npm install --silent --no-audit --no-fund --no-package-lock)
bundle=("$work/node_modules/.bin/esbuild" --bundle --minify --charset=ascii --legal-comments=none --log-level=warning)
"${bundle[@]}" --format=iife --target=es2022 "$work/viewer/main.js" --outfile=viewer.js
cat "$work/node_modules/uplot/dist/uPlot.min.css" "$work/viewer/style.css" > "$work/all.css"
"${bundle[@]}" "$work/all.css" --outfile=viewer.css
{
  for package in three uplot; do
    echo "== $package $(node -p "require('$work/node_modules/$package/package.json').version")"
    cat "$work/node_modules/$package/LICENSE"
    echo
  done
} > LICENCES.txt
(cd .. && cat viewer/*.js viewer/style.css bundle/package.json | sha256sum | cut -d' ' -f1) > built-from.sha256
sha256sum viewer.js viewer.css LICENCES.txt > written.sha256
