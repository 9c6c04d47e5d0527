#!/usr/bin/env bash
# Each public header stands alone, in C and in C++; everything a header declares exists in the libraries.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
: "${BUILD:?}"
failed=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for header in include/gough/*.h; do
    echo "#include \"gough/$(basename "$header")\"" >"$scratch/one.c"
    "${CC:-cc}" -std=c17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -Iinclude -I"$BUILD/include" "$scratch/one.c" || failed=1
    if command -v clang >/dev/null; then
        cp "$scratch/one.c" "$scratch/one.cpp"
        clang -x c++ -nostdinc++ -isystem /dev/null -Wall -Wextra -Werror -fsyntax-only -Iinclude -I"$BUILD/include" "$scratch/one.cpp" || failed=1
    fi
done
nm -D --defined-only "$BUILD/libgough.so" "$BUILD/libgough-analyse.so" "$BUILD/libgough-files.so" | awk '{ print $3 }' | sort -u >"$scratch/have"
# as the headers declare them, with the linker's name that names.h gives them
edition=$(sed -n 's/^#define GOUGH_EDITION //p' "$BUILD/include/gough/version.h")
cat include/gough/*.h | tr '\n' ' ' | sed 's/;/;\n/g' | grep -oE 'GOUGH_API [^;(]*\bgough_[a-z0-9_]+\(' | grep -oE 'gough_[a-z0-9_]+\($' | tr -d '(' |
    sed -E "/^gough_(version|edition|struct_size)$/!s/$/_e$edition/" | sort -u >"$scratch/want"
[[ $(wc -l <"$scratch/want") -gt 40 ]] || { echo "found too few declarations: $(wc -l <"$scratch/want")"; failed=1; }
missing=$(comm -23 "$scratch/want" "$scratch/have")
[[ -z $missing ]] || { echo "declared, but in no library:" $missing; failed=1; }
unknown=$(comm -13 "$scratch/want" "$scratch/have")
[[ -z $unknown ]] || { echo "in a library, but in no header:" $unknown; failed=1; }
exit $failed
