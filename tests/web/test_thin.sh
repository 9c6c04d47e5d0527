#!/usr/bin/env bash
# Label: thorough.
# Pages of `gough report --thin` in Debian's chromium: tests/web/thin.mjs.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/thin.mjs"
