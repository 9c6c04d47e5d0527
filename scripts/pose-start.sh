#!/usr/bin/env bash
# Writes src/pose/start_system.h, from which the paths to all poses begin: scripts/pose-start.sh [BUILD]. It takes about a minute.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"${CC:-cc}" -std=c17 -O2 -ffp-contract=off -Iinclude -I"$build/include" -Isrc scripts/pose-start.c src/base/random.c \
    -o "$scratch/pose-start" -lm
"$scratch/pose-start" >"$scratch/start_system.h"
mv "$scratch/start_system.h" src/pose/start_system.h
