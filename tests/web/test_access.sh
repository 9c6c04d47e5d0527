#!/usr/bin/env bash
# Label: thorough.
# The page without a mouse, by touch and for all eyes, in Debian's chromium: tests/web/access.mjs.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/access.mjs"
