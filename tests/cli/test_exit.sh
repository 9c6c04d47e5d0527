#!/usr/bin/env bash
# Exit codes of runs: a numerical end is 1, its table complete up to there and saying when and why; a bad study is 2.
source "$(dirname "$0")/support.sh"
study=$scratch/heave.yaml
"$GOUGH" example paper-heave >"$study"
attribute() { h5dump -N "$2" "$1" | sed -n 's/^ *(0): "\{0,1\}\([^"]*\)"\{0,1\}$/\1/p' | tail -1; }

# h from 0.8 to 1.2, d = 0.7: legs from 1.063 to 1.389. A greatest length of 1.3 is exceeded three times in 20 units.
limits=(--set 'platform.legs.length=[1.0, 1.3]')
run forces "$study" "${limits[@]}" -o "$scratch/f.h5"
expect_code 1 "forces beyond a limit"
[[ $(grep -c 'greatest length .* 3 times, t = 6.81885 to the end' "$scratch/out") == 6 ]] ||
    fail "forces does not say once for each leg that it is too long: $(grep 'greatest length' "$scratch/out")"
grep -q 'all six legs' "$scratch/err" || fail "forces does not say which leg: $(cat "$scratch/err")"
[[ $("$GOUGH" forces "$study" "${limits[@]}" -o - -q 2>/dev/null | wc -l) == 402 ]] || fail "forces stops at a limit"
run forces "$study" "${limits[@]}" --all
[[ $(grep -c 'greatest length .*, at worst 1.3' "$scratch/out") == 18 ]] || fail "forces --all lists $(grep -c 'at worst' "$scratch/out") excesses, not 18"

run simulate "$study" "${limits[@]}" --set control.stiffness=5 -o "$scratch/s.csv"
expect_code 1 "simulate beyond a limit"
rows=$(wc -l <"$scratch/s.csv")
((rows > 100 && rows < 402)) || fail "simulate has $rows rows up to the limit"
awk -F, 'NR > 1 && NF != columns { exit 1 } { columns = NF }' "$scratch/s.csv" || fail "a row is cut"
run simulate "$study" "${limits[@]}" --set control.stiffness=5 -o "$scratch/s.h5" -q
if command -v h5dump >/dev/null; then
    for file in f s; do
        [[ $(attribute "$scratch/$file.h5" end_cause) == leg_long ]] || fail "$file.h5: end_cause $(attribute "$scratch/$file.h5" end_cause)"
        attribute "$scratch/$file.h5" end_time | awk '{ exit !($1 > 6.5 && $1 < 7) }' || fail "$file.h5: end_time $(attribute "$scratch/$file.h5" end_time)"
    done
fi

# without feedforward and with too little stiffness the platform falls through its singular pose (h = 0)
run simulate "$study" --set control.feedforward=none --set control.stiffness=0 -o "$scratch/fall.csv" --json
expect_code 1 "a falling platform"
grep -qi 'singular' "$scratch/err" || fail "a fall is not called singular: $(cat "$scratch/err")"
! grep -qiE '(nan|inf)' "$scratch/out" "$scratch/fall.csv" || fail "a fall leaves numbers that are none"

# singular from the start: no rows, and no numbers that none stand behind
run forces "$study" --set motion.heave=0 --set motion.yaw=90 --json -o "$scratch/none.csv"
expect_code 1 "a program singular at once"
[[ $(wc -l <"$scratch/none.csv") == 1 ]] || fail "a program singular at once has rows"
grep -q '"condition": null' "$scratch/out" || fail "a condition without rows: $(grep condition "$scratch/out")"
! grep -qE '"(speed|energy|rms_force)": [0-9]' "$scratch/out" || fail "numbers without rows"

run simulate "$study" --set 'motion.heave=0.1*sin(t) + 0*sqrt(5 - t)'
expect_code 2 "a formula that ceases to be finite"
run check "$study" --set 'motion.heave=0.1*sin(t) + 0*sqrt(5 - t)'
expect_code 2 "the same in check"
run forces "$study" --set platform.top.half_angle=15 --set platform.base.half_angle=45
expect_code 2 "similar hexagons"
printf 'platform: {base: {radius: 1}\n' >"$scratch/bad.yaml"
run check "$scratch/bad.yaml"
expect_code 2 "a broken study"
grep -qE "bad.yaml:[0-9]+:[0-9]+" "$scratch/err" || fail "a broken study is not located: $(cat "$scratch/err")"
run plot "$scratch/bad.yaml"
expect_code 2 "a plot of no table"

# an open loop is worth a word; a closed one is not
run simulate "$study"
expect_code 0 "an open loop"
grep -q 'open loop' "$scratch/err" || fail "nothing said of an open loop"
run simulate "$study" --set control.stiffness=5
[[ ! -s $scratch/err ]] || fail "a closed loop is talked about: $(cat "$scratch/err")"
finish
