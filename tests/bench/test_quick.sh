#!/usr/bin/env bash
# The program behind `make bench` runs, and what it prints hangs together: times are positive, errors below their targets, the
# forces that forward dynamics was given come back from inverse dynamics, and whatever else it compares with agrees.
# Label: campaign: the program and its lanes take longer to compile than the other tests of the command.
set -euo pipefail
: "${BUILD:?}" "${GOUGH:?}"
bench=$BUILD/bench/gough-bench
[[ -x $bench ]] || { echo "skipped: no $bench"; exit 77; }
table=$("$bench" --quick --json --gough="$GOUGH")
check() { # check CLAIM JQ-CONDITION
    jq -e "$2" <<<"$table" >/dev/null || { echo "$1"; failed=1; }
}
failed=0
check "fewer than 60 rows" '.figures | length >= 60'
check "a time that is not positive" \
    '[.figures[] | .["ns a run"], .["ms"], .["ms alone"], .["million steps/s"] | numbers] | length > 40 and all(. > 0)'
check "an error over its target" \
    '[.figures[] | select(.["error below"]) | select(.error > .["error below"])] | length == 0'
check "dop853 does not reach 1e-12" \
    '[.figures[] | select(.section == "Work against precision" and .row == "dop853, adaptive")] | length == 4'
check "forces do not come back" \
    '[.figures[] | select(.row == "forces to motion and back") | .["ns a run"] | tonumber] | length > 1 and all(. < 1e-12)'
check "no claims" '[.figures[] | select(.section == "What is meant to be reached") | .wanted] | length >= 10 and all(. > 0)'
check "a peer does not agree" '[.figures[] | select(.agrees == "no")] | length == 0'
"$bench" --nonsense >/dev/null 2>&1 && { echo "an unknown option is taken"; failed=1; }
"$bench" --help | grep -q -- --json || { echo "--help lacks --json"; failed=1; }
exit $failed
