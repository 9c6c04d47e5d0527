#!/usr/bin/env bash
# fuzz.sh: each fuzzing target for FUZZ_SECONDS under sanitizers, from the corpus in tests/fuzz and the seeds that seeds_NAME writes; new
# inputs stay in build/fuzz.
set -euo pipefail
seconds=${FUZZ_SECONDS:-60}
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
for target in tests/fuzz/fuzz_*.c; do
    name=$(basename "$target" .c)
    name=${name#fuzz_}
    found=build/fuzz/found-$name
    mkdir -p "$found"
    echo "== $name for $seconds s"
    seeds=()
    writer=$(find build/fuzz -name "seeds_$name" -type f)
    if [[ $writer ]]; then
        seeds=("build/fuzz/seeds-$name")
        mkdir -p "${seeds[0]}"
        "$writer" "${seeds[0]}"
    fi
    longest=8192
    [[ $name == hdf5 ]] && longest=32768 # a file of the corpus has 21 KiB
    dictionary=()
    [[ -e tests/fuzz/$name.dict ]] && dictionary=("-dict=tests/fuzz/$name.dict")
    "$(find build/fuzz -name "fuzz_$name" -type f)" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
        -max_len=$longest -print_final_stats=1 -artifact_prefix="build/fuzz/failed-$name-" "${dictionary[@]}" \
        "$found" "tests/fuzz/corpus/$name" "${seeds[@]}"
done
