#!/usr/bin/env bash
# A long recording in Debian's chromium, whose file has 13 MB, and 6 MB with --thin: tests/web/recording.mjs. Its screenshots stay in
# the build folder, in web/pictures.
# Label: campaign
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/recording.mjs"
