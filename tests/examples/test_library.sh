#!/usr/bin/env bash
# The guide to the library: its program in Python computes what the C program of the README does, its handler compiles, it names the
# libraries' files and every header.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
: "${BUILD:?}"
guide=docs/guide/library.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
fail() { echo "$*"; failed=1; }
block() { sed -n "/^\`\`\`$1/,/^\`\`\`\$/p" "$2" | sed '/^```/d'; }

block c README.md >"$scratch/lift.c"
block c "$guide" >"$scratch/handler.c"
flags=(-std=c17 -Wall -Wextra -Iinclude -I"$BUILD/include")
"${CC:-cc}" "${flags[@]}" "$scratch/lift.c" "$scratch/handler.c" -o "$scratch/lift" -L"$BUILD" -lgough -lm || fail "the programs do not compile"
forces=$(LD_LIBRARY_PATH=$BUILD "$scratch/lift" | sed -n 's/^leg [1-6]: \(.*\) N$/\1/p' | tr '\n' ' ')
[[ $(wc -w <<<"$forces") -eq 6 ]] || fail "the README's program prints $forces"
if command -v python3 >/dev/null; then
    block python "$guide" >"$scratch/lift.py"
    said=$(python3 "$scratch/lift.py" "$BUILD/libgough.so") || fail "the program in Python does not run"
    [[ "$said " == "$forces" ]] || fail "Python computes $said, C $forces"
fi

soname=$(readelf -d "$BUILD/libgough.so" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')
[[ $(grep -o 'libgough\.so\.[0-9.]*[0-9]' "$guide" | sort -u) == "$soname" ]] || fail "the guide names another library than $soname"
for header in include/gough/*.h; do
    name=$(basename "$header")
    [[ $name == gough.h || $name == analyse.h ]] || grep -q "include/gough/$name)" "$guide" || fail "the guide does not name $name"
done
exit $failed
