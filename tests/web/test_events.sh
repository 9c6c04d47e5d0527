#!/usr/bin/env bash
# Label: thorough.
# Events of a run, strokes and used limits in Debian's chromium: tests/web/events.mjs.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/events.mjs"
