#!/usr/bin/env bash
# lint.sh BUILD: formatting, clang-tidy, cppcheck and shellcheck; BUILD holds compile_commands.json.
set -uo pipefail
build=${1:-build}
failed=0
mapfile -t sources < <(find src include tests bench -name '*.[ch]' 2>/dev/null)
mapfile -t scripts < <(find scripts tests .ci -name '*.sh' -o -path .ci/run)
echo "clang-format" && clang-format --dry-run -Werror "${sources[@]}" || failed=1
echo "clang-tidy" && find src -name '*.c' -print0 |
    xargs -0 -n 4 -P "$(nproc)" clang-tidy --quiet -p "$build" 2> >(grep -v 'warnings\? generated' >&2) || failed=1
echo "cppcheck" && cppcheck --quiet --std=c11 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
    --suppress=missingInclude --suppress=unknownMacro --suppress=uninitvar --suppress=ctuArrayIndex --suppress=ctuPointerArith --suppress=ctuuninitvar --suppress=autoVariables -Iinclude -Isrc -I"$build/include" src || failed=1
echo "shellcheck" && shellcheck --shell=bash --severity=warning -e SC1091,SC2154,SC2046,SC2034 "${scripts[@]}" || failed=1
exit $failed
