#!/usr/bin/env bash
# One look at the page in Debian's chromium: tests/web/opens.mjs. Its screenshot stays in the build folder, in web/pictures.
set -euo pipefail
: "${GOUGH:?}" "${BUILD:?}" "${SOURCE:?}"
[[ -e $BUILD/web/report.html ]] || { echo "skipped: the page was not bundled in this build"; exit 77; }
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || { echo "skipped: no chromium"; exit 77; }
SCRATCH=$(mktemp -d)
trap 'rm -rf "$SCRATCH"' EXIT
export CHROMIUM SCRATCH PICTURES=$BUILD/web/pictures
node "$SOURCE/tests/web/opens.mjs"
