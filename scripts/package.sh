#!/usr/bin/env bash
# package.sh BUILD: the Debian packages, from a build of its own whose folders are those of /usr; leaves them in BUILD. PAGE=OFF and
# PYTHON=OFF in the environment leave out the page and the package for Python.
set -euo pipefail
build=${1:-build}
cmake -S . -B "$build/package" -G Ninja -DCMAKE_INSTALL_PREFIX=/usr -DGOUGH_TESTS=OFF ${PAGE:+"-DGOUGH_PAGE=$PAGE"} ${PYTHON:+"-DGOUGH_PYTHON=$PYTHON"} >/dev/null
rm -f "$build"/package/*.deb
cmake --build "$build/package"
(cd "$build/package" && cpack -G DEB >cpack.log) || { cat "$build/package/cpack.log" >&2; exit 1; }
cp "$build"/package/*.deb "$build/"
ls "$build"/package/*.deb | sed "s|/package/|/|"
