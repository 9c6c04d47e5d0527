#!/usr/bin/env bash
# Each call site of an allocation fails once, for each verb: the command does as if nothing had been, or says so and exits with 3;
# no crash, no shortened answer, no half file. With `all` as argument every single allocation fails (scripts/fail-every-allocation.sh).
# Label: campaign: table/read_faults, study/memory and others let calls fail in `make test`.
source "$(dirname "$0")/../cli/support.sh"
mode=${1:-sites}
preload=$BUILD/tests/libfail_malloc.so
if [[ ! -e $preload ]]; then
    echo "no library that lets allocations fail: skipped"
    exit 77
fi
export FAIL_DEPTH=${FAIL_DEPTH:-3}
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml
short=(--set 'simulation={duration: 0.2, output_step: 0.02, method: rk4, step: 0.01}' --set control.stiffness=5000)
printf 't,heave\n0,0\n0.05,0.01\n0.1,0.02\n0.15,0.01\n0.2,0\n' >deck.csv
keys=(--set 'sweep.keys={control.stiffness: [5000, 6000], load.mass: {normal: [6, 0.1]}}')
"$GOUGH" sweep own.yaml "${short[@]}" "${keys[@]}" -q --shard 1/2 -o 1.shard
"$GOUGH" sweep own.yaml "${short[@]}" "${keys[@]}" -q --shard 2/2 -o 2.shard
"$GOUGH" simulate own.yaml "${short[@]}" -q -o result.csv
"$GOUGH" simulate own.yaml "${short[@]}" -q -o result.h5

let_fail() { # let_fail OUTPUT… -- ARGUMENT…
    local output=()
    while [[ $1 != -- ]]; do
        output+=("$1")
        shift
    done
    shift
    "$BUILD/tests/fail_each" "$preload" "$mode" "${output[@]}" -- "$GOUGH" "$@" || fail "$*"
}
let_fail -- example own-machine
let_fail -- example --json
let_fail -- check own.yaml
let_fail -- check own.yaml "${keys[@]}" --json
let_fail -- forces own.yaml "${short[@]}" --set platform.legs.max_force=5
let_fail -- forces own.yaml "${short[@]}" --set platform.legs.max_force=5 --json
let_fail a.csv -- simulate own.yaml "${short[@]}" --set 'motion={samples: deck.csv}' -q -o a.csv
FAIL_DEPTH=1 let_fail a.h5 -- simulate own.yaml "${short[@]}" -q -o a.h5
let_fail -- simulate own.yaml "${short[@]}" --json
let_fail a.csv -- sweep own.yaml "${short[@]}" "${keys[@]}" --threads 1 -q -o a.csv
let_fail -- sweep own.yaml "${short[@]}" "${keys[@]}" --run 2 --json
let_fail m.csv -- merge 1.shard 2.shard -o m.csv
let_fail m.csv -- merge 1.shard 2.shard -o m.csv --json
let_fail -- stability own.yaml "${short[@]}" --json
let_fail map.csv -- stability own.yaml "${short[@]}" --sweep-stiffness 4000:6000:2 --threads 1 -q -o map.csv
let_fail -- tune own.yaml "${short[@]}" --deviation 1e-2 --feedforward program --threads 1 --json
let_fail p.svg -- plot result.csv -q -o p.svg
FAIL_DEPTH=1 let_fail p.svg -- plot result.h5 -q -o p.svg
"$GOUGH" report own.yaml "${short[@]}" -q -o probe.html 2>/dev/null && let_fail r.html -- report own.yaml "${short[@]}" -q -o r.html
# allocations of a megabyte or more return NULL to their callers: recorded motion of that size is in the page, or there is no page
awk 'BEGIN { print "t,heave"; for (k = 0; k <= 14100; k++) printf "%.3f,%.17g\n", k / 1000, 0.01 * sin(k / 100) }' >long.csv
[[ ! -e probe.html ]] || FAIL_LEAST=1048576 let_fail r.html -- report own.yaml "${short[@]}" --set 'motion={samples: long.csv}' -q -o r.html
let_fail -- simulate own.yaml --set control.stifness=5
finish
