#!/usr/bin/env bash
# The same machine in six sets of units (units.py): the same physics, each number with the right unit, and what is refused.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
here=$(cd "$(dirname "$0")" && pwd)
command -v python3 >/dev/null && command -v h5dump >/dev/null || { echo "skipped: no python3 or no h5dump"; exit 77; }
cd "$scratch" || exit 1
export GOUGH PYTHONDONTWRITEBYTECODE=1
python3 "$here/units_check.py" || fail "the same machine differs between units"
finish
