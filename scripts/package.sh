#!/usr/bin/env bash
# package.sh BUILD: the Debian package, from a build of its own whose folders are those of /usr; leaves it in BUILD. PAGE=OFF in the
# environment leaves out the page.
set -euo pipefail
build=${1:-build}
cmake -S . -B "$build/package" -G Ninja -DCMAKE_INSTALL_PREFIX=/usr -DGOUGH_TESTS=OFF ${PAGE:+"-DGOUGH_PAGE=$PAGE"} >/dev/null
cmake --build "$build/package"
(cd "$build/package" && cpack -G DEB >cpack.log) || { cat "$build/package/cpack.log" >&2; exit 1; }
cp "$build"/package/gough_*.deb "$build/"
ls "$build"/gough_*.deb
