#!/usr/bin/env bash
# bench.sh: the time of whole processes, reading and writing included, by hyperfine.
set -euo pipefail
gough=${GOUGH:-build/gough}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$gough" example paper-heave >"$scratch/heave.yaml"
"$gough" example flight-simulator >"$scratch/flight-simulator.yaml"
"$gough" example ship-deck.awk | awk -f /dev/stdin >"$scratch/ship-deck.csv"
measure() { # measure NAME ARGUMENT…
    local name=$1
    shift
    hyperfine --shell=none --warmup 3 --min-runs 10 --command-name "$name" \
        --style basic "$gough $*" 2>/dev/null | sed -n -e 's|^Benchmark 1: ||p' -e '/Time\|Range/p'
}
measure "nothing but starting" --version
measure "forces of the paper's heave, HDF5" forces "$scratch/heave.yaml" -q -o "$scratch/a.h5"
measure "simulate the paper's heave, HDF5" simulate "$scratch/heave.yaml" -q -o "$scratch/a.h5"
measure "simulate the paper's heave, CSV" simulate "$scratch/heave.yaml" -q -o "$scratch/a.csv"
measure "simulate the paper's heave, quad" simulate "$scratch/heave.yaml" -q --precision quad -o "$scratch/a.csv"
measure "simulate 120 s of a flight simulator, HDF5" simulate "$scratch/flight-simulator.yaml" -q -o "$scratch/a.h5"
