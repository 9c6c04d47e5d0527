#!/usr/bin/env bash
# The code is as clang-format leaves it.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v clang-format >/dev/null || { echo "skipped: no clang-format"; exit 77; }
wrong=$(find src include tests bench python web/core -name '*.[ch]' -print0 | xargs -0 clang-format --dry-run -Werror 2>&1 | grep -E 'error:' | cut -d: -f1 | sort -u || true)
[[ -z $wrong ]] || { echo "not as clang-format leaves it:"; echo "$wrong"; exit 1; }
