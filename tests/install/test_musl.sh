#!/usr/bin/env bash
# The core builds with musl, a C library that has nothing of glibc's own, and passes its tests there; a program linked to that archive
# runs without any shared library.
# Label: campaign: compiles the core once more
set -euo pipefail
: "${BUILD:?}" "${SOURCE:?}"
command -v musl-gcc >/dev/null || { echo "skipped: no musl-gcc (Debian package musl-tools)"; exit 77; }
core=$BUILD/musl
cmake -S "$SOURCE" -B "$core" -G Ninja -DCMAKE_C_COMPILER=musl-gcc -DGOUGH_CORE_ONLY=ON -DGOUGH_LINK_STATICALLY=-static >"$BUILD/musl.log" 2>&1 \
    || { cat "$BUILD/musl.log"; exit 1; }
grep -q 'stability and tuning (LAPACK)' "$BUILD/musl.log" || { echo "configuring does not say what is left out"; cat "$BUILD/musl.log"; exit 1; }
cmake --build "$core" >"$BUILD/musl.log" 2>&1 || { tail -30 "$BUILD/musl.log"; exit 1; }
ctest --test-dir "$core" --output-on-failure
tests=$(ctest --test-dir "$core" -N | sed -n 's/^Total Tests: //p')
((tests >= 40)) || { echo "only $tests tests ran"; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
musl-gcc -std=c17 -O2 -static -I"$SOURCE/include" -I"$core/include" -o "$scratch/program" "$SOURCE/tests/install/program.c" "$core/libgough.a" \
    -Wl,--gc-sections -lquadmath -lm
[[ $("$scratch/program") == 1.000000000000 ]] || { echo "the program prints $("$scratch/program")"; exit 1; }
if readelf -l "$scratch/program" | grep -q INTERP; then echo "the program needs a shared library"; exit 1; fi
echo "a static program that calls gough_inverse_dynamics(): $(stat -c %s "$scratch/program") bytes"
