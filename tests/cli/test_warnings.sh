#!/usr/bin/env bash
# check warns of what is probably not meant, forces names what it leaves out, and small numbers keep their digits beside large ones.
source "$(dirname "$0")/support.sh"
"$GOUGH" example own-machine >"$scratch/own.yaml"
own=$scratch/own.yaml

warned() { # NAME PATTERN OPTION…: a warning by a study that is valid
    local name=$1 pattern=$2
    shift 2
    run check "$own" "$@"
    expect_code 0 "$name"
    grep -qE "^gough check: warning: $pattern" "$scratch/err" || fail "$name: $(cat "$scratch/err")"
}
run check "$own"
[[ ! -s $scratch/err ]] || fail "the example is warned of: $(cat "$scratch/err")"
warned "home beyond the limits" 'home is outside the limits: (all six legs|legs? [1-6, and]+), length 0\.[0-9]+ m, least length 0.36 m$' --set 'platform.legs.length=[0.36, 0.4]'
warned "home too long" 'home is outside the limits: .*, greatest length 0.3 m$' --set 'platform.legs.length=[0.25, 0.3]'
jump=(--set motion= --set 'motion={heave: 0.3*cos(2*t)}')
warned "a start away from home" 'the program starts away from home: heave 0.3 m at t = 0$' "${jump[@]}"
warned "a start that moves" 'the program does not start from rest: surge 0.05 m/s, yaw 10 deg/s at t = 0$' --set motion= --set 'motion={surge: 0.05*sin(t), yaw: 10*sin(t)}'
warned "limits on the way" 'along the program: .* greatest speed 0.01 m/s at t = [0-9.]+ s$' --set platform.legs.max_speed=0.01
warned "a singular pose on the way" "along the program: the program's pose is singular at t = [0-9.]+ s" --set motion= --set 'motion={yaw: "120*ramp(t, 2)"}'
warned "a run that ends at once" 'a run of gough simulate ends at once: .* greatest length 0.4 m at t = 0 s$' --set initial.heave=0.2
warned "one row" 'simulation.output_step 9 s is longer than the duration 8 s' --set simulation.output_step=9
warned "rows too far apart for a move" 'simulation.output_step 1 s is longer than 1 of the moves, the shortest of 0.5 s' --set motion= --set 'motion={moves: [{start: 1, duration: 0.5, heave: 0.01}, {start: 3, duration: 2, heave: 0}]}' --set simulation.output_step=1

# disturbances that forces leaves out, as simulate does not
run forces "$own"
! grep -q 'left out' "$scratch/out" || fail "forces leaves something out without disturbances"
run forces "$own" --set 'disturbance={force: [0, 0, 30], noise: {leg_force: 1, interval: 0.1}}'
grep -qE '^  left out +disturbance: force, noise$' "$scratch/out" || fail "forces does not name what it leaves out: $(grep 'left out' "$scratch/out")"
run simulate "$own" --set 'disturbance={force: [0, 0, 30]}'
! grep -q 'left out' "$scratch/out" || fail "simulate leaves disturbances out"

# a joint at 90 km beside one at 0.698 m
cat >"$scratch/far.yaml" <<'EOF'
platform:
  base: {joints: [[0.698, 0.1234, 0], [-0.25, 0.6, 0], [-0.45, 0.55, 0], [-0.45, -0.55, 0], [-0.25, -0.6, 0], [9.0e4, -0.00321, 0]]}
  top: {joints: [[0.3, 0.45, 0], [0.2, 0.5, 0], [-0.5, 0.05, 0], [-0.5, -0.05, 0], [0.2, -0.5, 0], [0.3, -0.45, 0]]}
  height: 0.7
load: {mass: 10, inertia: [1, 1, 1]}
EOF
run check "$scratch/far.yaml"
expect_code 0 "a joint far away"
for number in 0.698 0.123 0.00321 90000; do
    sed -n '/base joint/,/^$/p' "$scratch/out" | grep -qE "(^| )-?${number}[0-9]*( |\$)" || fail "no $number in the table: $(sed -n '/base joint/,/^$/p' "$scratch/out")"
done
finish
