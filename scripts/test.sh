#!/usr/bin/env bash
# test.sh BUILD: builds with the sanitized copies of the unit tests and runs everything; arguments after BUILD go to ctest.
set -euo pipefail
build=${1:-build}
shift || true
jobs=$(nproc)
cmake -S . -B "$build" -G Ninja -DGOUGH_TESTS_SANITIZED=ON "-DGOUGH_TEST_SLOWNESS=$(scripts/slowness.sh)" >/dev/null
cmake --build "$build"
ctest --test-dir "$build" --output-on-failure -j "$jobs" "$@"
