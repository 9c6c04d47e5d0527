#!/usr/bin/env bash
# Label: thorough.
# What is shown and the address of the page, and the machine beside its curves, in Debian's chromium: tests/web/link.mjs.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/link.mjs"
