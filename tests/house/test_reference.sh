#!/usr/bin/env bash
# The API reference is complete: Doxygen has no warning.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v doxygen >/dev/null || { echo "skipped: no doxygen"; exit 77; }
scripts/docs.sh "${BUILD:?}"
for word in gough_forces gough_inverse_dynamics gough_formula_compile; do
    grep -qr "$word" "$BUILD/docs/html" || { echo "the reference lacks $word"; exit 1; }
done
