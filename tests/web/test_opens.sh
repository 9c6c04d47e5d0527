#!/usr/bin/env bash
# One look at the page in Debian's chromium: tests/web/opens.mjs. Its screenshot stays in the build folder, in web/pictures.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/opens.mjs"
