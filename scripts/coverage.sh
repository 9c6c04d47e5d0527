#!/usr/bin/env bash
# coverage.sh BUILD [--list] [--readers]: builds with gcov in BUILD/coverage, runs the tests that count and prints the share of
# branches taken; fails below the shares in coverage.py, and if a test fails. --list names each branch that no test takes;
# --readers runs only the tests of the readers of outside bytes and prints their groups.
#
# tests/faults does not count: the command ends at its first allocation without memory (src/cli/common/memory.c). What the library does
# then is tested by programs (tests/support/faults.h).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}/coverage
shift $(($# > 0))
cc=${CC:-gcc}
mkdir -p "$build"
"$cc" -O0 -c tests/support/counted_exit.c -o "$build/counted_exit.o"
# no function is copied into its callers: each copy would count its branches anew. The program is optimised after its branches are
# counted, as far as GCC leaves branches alone. Threads may lose counts to each other, which leaves a branch that was taken counted;
# counters without losses made tests of floquet and tune four times slower.
flags="-O2 -fno-inline -fno-early-inlining -fno-ssa-phiopt -DNDEBUG -Dalways_inline=unused --coverage -fprofile-update=single -fprofile-abs-path"
cmake -S . -B "$build" -G Ninja -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE=Coverage "-DCMAKE_C_FLAGS_COVERAGE=$flags" \
    "-DCMAKE_EXE_LINKER_FLAGS_COVERAGE=-Wl,--wrap=_exit $(realpath "$build")/counted_exit.o" \
    -DGOUGH_PAGE=OFF -DGOUGH_PYTHON=OFF "-DGOUGH_TEST_SLOWNESS=$((4 * $(scripts/slowness.sh)))" >/dev/null
rooms='base|kernel|program|plant|drive|control|system|model|pose|workspace|cueing|design|integrate|run|batch|linear|floquet|map|tune|independent|study|table|sweep|fuzz|cli'
tests="^($rooms)/"
targets='quick_tests gough_pages'
if [[ " $* " == *" --readers "* ]]; then
    tests='^((study|table|sweep|fuzz)/|base/(csv|decimal|text)|program/formula|cli/(usage|places|record|inputs|exit|units|words))'
    targets="gough_pages $(ninja -C "$build" -t targets all | sed -nE 's/^(test_(study|table|sweep)_.*|test_base_(csv|decimal|text)|test_program_formula|replay_.*|seeds_hdf5|gough_command): phony$/\1/p')"
fi
# shellcheck disable=SC2086 # several targets
cmake --build "$build" --target $targets
find "$build" -name '*.gcda' -delete
failed=0
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -LE campaign -R "$tests" -E '^independent/campaign' || failed=1
python3 scripts/coverage.py "$build" "$@" || failed=1
((failed == 0)) || echo "coverage.sh: a test failed, or a share is too low" >&2
exit $failed
