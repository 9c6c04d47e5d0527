#!/usr/bin/env bash
# Label: thorough.
# The page in Debian's chromium: tests/web/page.mjs. Its screenshots stay in the build folder, in web/pictures.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/page.mjs"
