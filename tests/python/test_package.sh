#!/usr/bin/env bash
# The package for Python in build/python: what pytest finds in this folder, and a wheel that a bare environment installs without
# network.
set -euo pipefail
python=/usr/bin/python3
[[ -e $BUILD/python/gough/_gough.abi3.so ]] || { echo "skipped: built without the package for Python"; exit 77; }
"$python" -c 'import pytest' 2>/dev/null || { echo "skipped: no pytest (Debian package python3-pytest)"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export PYTHONPATH=$BUILD/python:$SOURCE/tests/python PYTHONDONTWRITEBYTECODE=1 GOUGH SOURCE BUILD
cd "$scratch"
"$python" -m pytest -q -p no:cacheprovider "$SOURCE"/tests/python/test_*.py

# the wheel: what it names and holds, unpacked where nothing else of gough is
unset PYTHONPATH
cp -r "$BUILD/python" packed
(cd packed && "$python" setup.py -q bdist_wheel --dist-dir ..) >log 2>&1 || { cat log; exit 1; }
wheel=$(echo gough-*.whl)
[[ $wheel == gough-*-cp311-abi3-linux_*.whl ]] || { echo "the wheel is called $wheel"; exit 1; }
"$python" -m zipfile -e "$wheel" unpacked
chmod +x unpacked/gough/command/gough # as an installer does
export PYTHONPATH=$scratch/unpacked PATH=/usr/bin:/bin
"$python" - "$SOURCE/examples/paper-heave.yaml" <<'CODE'
import sys, gough
assert "unpacked" in gough.__file__, gough.__file__
force = gough.forces(sys.argv[1])
assert force["f1"].size == 401 and force.summary["end"]["status"] == "done"
CODE
