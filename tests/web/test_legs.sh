#!/usr/bin/env bash
# Label: thorough.
# The page of machines whose legs have mass and friction, in Debian's chromium: tests/web/legs.mjs. Its screenshots stay in the build
# folder, in web/pictures.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/legs.mjs"
