#!/usr/bin/env bash
# Memory of sweeps and merges does not grow with the runs, and their time is in proportion: 10^7 runs, which take 8 GB of the disk.
# Label: campaign
# Not sanitized: sanitizers have memory of their own
# shellcheck source=tests/cli/many_runs.sh
source "$(dirname "$0")/many_runs.sh"
(($(df --output=avail -B1G "$scratch" | tail -1) >= 12)) || { echo "skipped: less than 12 GB of free disk"; exit 77; }
try_many_runs 10000000
finish
