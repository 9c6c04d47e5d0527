#!/usr/bin/env bash
# Memory of sweeps and merges does not grow with the runs, and their time is in proportion: 10^6 runs.
# Label: thorough
# Not sanitized: sanitizers have memory of their own
# shellcheck source=tests/cli/many_runs.sh
source "$(dirname "$0")/many_runs.sh"
try_many_runs 1000000
# a sweep that writes its table by itself, as HDF5: the bytes of the merged one
measured "sweep of 1000000 runs into HDF5" sweep study.yaml -q --set sweep.runs=1000000 -o own.h5
((memory <= 200)) || fail "a sweep into HDF5 takes $memory MB"
cmp -s own.h5 all.h5 || fail "the sweep's own table differs from the merged one"
finish
