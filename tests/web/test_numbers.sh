#!/usr/bin/env bash
# Label: thorough.
# Numbers of the page and in its data against the study: tests/web/numbers.mjs, in Debian's chromium.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/numbers.mjs"
