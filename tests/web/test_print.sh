#!/usr/bin/env bash
# Label: thorough.
# The page on paper, by Debian's chromium and poppler's tools: tests/web/print.mjs. The PDFs stay in the build folder, in web/pictures.
set -euo pipefail
. "$(dirname "$0")/browser.sh"
command -v pdftotext > /dev/null || { echo "skipped: no pdftotext (package poppler-utils)"; exit 77; }
node "$SOURCE/tests/web/print.mjs"
