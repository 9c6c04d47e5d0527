#!/usr/bin/env bash
# Label: thorough.
# Poses and reach in the page: the core in Node against the command, and the panel in Debian's chromium: tests/web/reach.mjs. Its
# screenshots stay in the build folder, in web/pictures.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
export CORE=$BUILD/web/core.wasm FLAT=$BUILD/tests/web/web_flat
node "$SOURCE/tests/web/reach.mjs"
