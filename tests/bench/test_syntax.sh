#!/usr/bin/env bash
# The program behind `make bench`, which only campaigns build, still fits the headers of the library.
# Label: standard
set -euo pipefail
: "${SOURCE:?}" "${BUILD:?}"
compiler=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$BUILD/CMakeCache.txt")
[[ -n $compiler ]] || { echo "$BUILD/CMakeCache.txt names no compiler"; exit 1; }
failed=0 files=0
for file in "$SOURCE"/bench/*.c; do
    case ${file##*/} in
    peer_*) continue ;; # needs the headers of the peers
    esac
    files=$((files + 1))
    "$compiler" -std=c17 -Wall -Wextra -Werror -Wno-psabi -fsyntax-only \
        -I"$SOURCE" -I"$SOURCE/include" -I"$BUILD/include" -I"$SOURCE/src" "$file" || failed=1
done
((files > 10)) || { echo "only $files files under bench"; failed=1; }
exit $failed
