#!/usr/bin/env bash
# Label: thorough.
# Numbers of the page and in its data against the study: tests/web/numbers.mjs, in Debian's chromium.
set -euo pipefail
: "${GOUGH:?}" "${BUILD:?}" "${SOURCE:?}"
[[ -e $BUILD/web/report.html ]] || { echo "skipped: the page was not bundled in this build"; exit 77; }
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || { echo "skipped: no chromium"; exit 77; }
SCRATCH=$(mktemp -d)
trap 'rm -rf "$SCRATCH"' EXIT
export CHROMIUM SCRATCH PICTURES=$BUILD/web/pictures
node "$SOURCE/tests/web/numbers.mjs"
