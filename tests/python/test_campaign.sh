#!/usr/bin/env bash
# Every verb of the package for Python on every example: the bits of the command.
# Label: campaign
set -euo pipefail
python=/usr/bin/python3
[[ -e $BUILD/python/gough/_gough.abi3.so ]] || { echo "skipped: built without the package for Python"; exit 77; }
"$python" -c 'import pytest' 2>/dev/null || { echo "skipped: no pytest (Debian package python3-pytest)"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export PYTHONPATH=$BUILD/python:$SOURCE/tests/python PYTHONDONTWRITEBYTECODE=1 GOUGH SOURCE BUILD
cd "$scratch"
"$python" -m pytest -q -p no:cacheprovider --rootdir "$SOURCE/tests/python" --confcutdir "$SOURCE/tests/python" \
    "$SOURCE/tests/python/campaign" "$@"
