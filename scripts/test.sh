#!/usr/bin/env bash
# test.sh BUILD LABEL: builds and runs the tests up to a label: quick, standard, thorough (with the sanitized copies) or campaign.
# Further arguments go to ctest.
set -euo pipefail
build=${1:-build} label=${2:-standard}
shift $(($# < 2 ? $# : 2))
case $label in
quick) sanitized=() targets=(quick_tests) labels=(-L quick) ;;
standard) sanitized=(-DGOUGH_TESTS_SANITIZED=OFF) targets=(all) labels=(-LE 'thorough|campaign') ;;
thorough) sanitized=(-DGOUGH_TESTS_SANITIZED=ON) targets=(all) labels=(-LE campaign) ;;
campaign) sanitized=(-DGOUGH_TESTS_SANITIZED=ON) targets=(all campaign_tests) labels=() ;;
*)
    echo "test.sh: the label is quick, standard, thorough or campaign, not '$label'" >&2
    exit 2
    ;;
esac
cmake -S . -B "$build" -G Ninja "${sanitized[@]}" ${PAGE:+"-DGOUGH_PAGE=$PAGE"} ${PYTHON:+"-DGOUGH_PYTHON=$PYTHON"} "-DGOUGH_TEST_SLOWNESS=$(scripts/slowness.sh)" >/dev/null
cmake --build "$build" --target "${targets[@]}"
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "${labels[@]}" "$@"
