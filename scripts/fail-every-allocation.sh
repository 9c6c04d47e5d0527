#!/usr/bin/env bash
# A campaign: every allocation of every verb fails once (make test lets each call site fail once). Takes an hour or more.
#   scripts/fail-every-allocation.sh [BUILD]
set -euo pipefail
source_folder=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "${1:-$source_folder/build}" && pwd)
GOUGH=$build/gough SOURCE=$source_folder BUILD=$build exec bash "$source_folder/tests/faults/test_faults.sh" all
