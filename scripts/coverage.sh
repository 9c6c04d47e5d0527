#!/usr/bin/env bash
# coverage.sh BUILD [--list]: builds with gcov in BUILD/coverage, runs the tests that count and prints the share of branches taken;
# fails below the shares in coverage.py. --list names each branch that no test takes.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}/coverage
shift $(($# > 0))
cc=${CC:-gcc}
mkdir -p "$build"
"$cc" -O0 -c tests/support/counted_exit.c -o "$build/counted_exit.o"
# no function is copied into its callers: each copy would count its branches anew
flags="-O0 -DNDEBUG -Dalways_inline=unused --coverage -fprofile-update=atomic -fprofile-abs-path"
cmake -S . -B "$build" -G Ninja -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE=Coverage "-DCMAKE_C_FLAGS_COVERAGE=$flags" \
    "-DCMAKE_EXE_LINKER_FLAGS_COVERAGE=-Wl,--wrap=_exit $(realpath "$build")/counted_exit.o" \
    -DGOUGH_PAGE=OFF "-DGOUGH_TEST_SLOWNESS=$((4 * $(scripts/slowness.sh)))" >/dev/null
cmake --build "$build" --target quick_tests
find "$build" -name '*.gcda' -delete
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -LE campaign \
    -R '^(base|kernel|program|plant|model|integrate|run|batch|linear|floquet|map|tune|independent|study|table|sweep|fuzz|cli)/' \
    -E '^independent/campaign'
python3 scripts/coverage.py "$build" "$@"
