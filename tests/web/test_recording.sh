#!/usr/bin/env bash
# A long recording in Debian's chromium, whose file has 46 MB: tests/web/recording.mjs. Its screenshot stays in the build folder, in
# web/pictures.
# Label: campaign
set -euo pipefail
. "$(dirname "$0")/browser.sh"
node "$SOURCE/tests/web/recording.mjs"
