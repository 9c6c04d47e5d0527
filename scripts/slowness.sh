#!/usr/bin/env bash
# slowness.sh: how many times longer than on a quiet machine a test may take before it counts as hung. Prints GOUGH_TEST_SLOWNESS if
# it is set; else a whole number from a loop that takes 0.4 s on a quiet machine and from the load, 4 at least and 200 at most.
set -euo pipefail
if [[ -n ${GOUGH_TEST_SLOWNESS:-} ]]; then
    [[ $GOUGH_TEST_SLOWNESS =~ ^[1-9][0-9]*$ ]] || { echo "GOUGH_TEST_SLOWNESS must be a whole number of 1 or more" >&2; exit 2; }
    echo "$GOUGH_TEST_SLOWNESS"
    exit
fi
begin=$(date +%s%N)
awk 'BEGIN { for (i = 0; i < 15000000; i++) s += i * i; exit !(s > 0) }'
took=$(($(date +%s%N) - begin))
load=$(cut -d' ' -f1 /proc/loadavg 2>/dev/null || echo 0)
awk -v took="$took" -v load="$load" -v jobs="$(nproc)" 'BEGIN {
    loop = took / 0.4e9; busy = 1 + load / jobs
    n = int(2 * (loop > busy ? loop : busy) + 0.999)
    print (n < 4 ? 4 : n > 200 ? 200 : n) }'
