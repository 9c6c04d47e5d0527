#!/usr/bin/env bash
# The library compiled to WebAssembly, in Node, against the command: tests/web/core.mjs.
set -euo pipefail
: "${GOUGH:?}" "${BUILD:?}"
here=$(cd "$(dirname "$0")" && pwd)
[[ -e $BUILD/web/core.wasm ]] || { echo "skipped: the page was not bundled in this build"; exit 77; }
command -v node >/dev/null || { echo "skipped: no node"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
CORE=$BUILD/web/core.wasm FLAT=$BUILD/tests/web/web_flat SCRATCH=$scratch node "$here/core.mjs"
