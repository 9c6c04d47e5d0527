#!/usr/bin/env bash
# Label: thorough.
# Poses and reach in the page: the core in Node against the command, and the panel in Debian's chromium: tests/web/reach.mjs. Its
# screenshots stay in the build folder, in web/pictures.
set -euo pipefail
: "${GOUGH:?}" "${BUILD:?}" "${SOURCE:?}"
[[ -e $BUILD/web/report.html ]] || { echo "skipped: the page was not bundled in this build"; exit 77; }
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || { echo "skipped: no chromium"; exit 77; }
SCRATCH=$(mktemp -d)
trap 'rm -rf "$SCRATCH"' EXIT
export CHROMIUM SCRATCH PICTURES=$BUILD/web/pictures CORE=$BUILD/web/core.wasm FLAT=$BUILD/tests/web/web_flat
node "$SOURCE/tests/web/reach.mjs"
