#!/usr/bin/env bash
# bench.sh BUILD: builds the program of timings with its peers and runs it; arguments after BUILD go to it (--json, --quick).
set -euo pipefail
build=${1:-build}
shift || true
cmake -S . -B "$build" -G Ninja -DGOUGH_BENCH=ON >/dev/null
cmake --build "$build" --target gough_bench gough_command >&2
exec "$build/bench/gough-bench" --gough="$build/gough" "$@"
