#!/usr/bin/env bash
# The page's parts that need no browser, in Node: tests/web/parts.mjs.
set -euo pipefail
: "${GOUGH:?}" "${SOURCE:?}"
command -v node >/dev/null || { echo "skipped: no node"; exit 77; }
node "$SOURCE/tests/web/parts.mjs"
