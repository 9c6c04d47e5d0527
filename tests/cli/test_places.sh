#!/usr/bin/env bash
# A formula that is not finite at some time ends every verb that runs it with exit code 2 and the place of the formula.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
cat >study.yaml <<'END'
title: A formula that ends
units: dimensionless
platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 15}, height: 1}
load: {mass: 1, inertia: [0.08, 0.08, 0.15]}
motion:
  yaw: 3*sin(t)
  heave: 0.01*log(1.5 - t)*0
disturbance: {force: [0, ramp(t, 2), 0*sqrt(1.2 - t)]}
control: {stiffness: 20, damping: 1}
simulation: {duration: 2, output_step: 0.1, method: rk4, step: 0.05}
END
placed() { # placed PLACE ARGUMENT…
    local place=$1
    shift
    run "$@"
    expect_code 2 "$@"
    if [[ $* == *--json* ]]; then
        command -v jq >/dev/null || return 0
        jq -r '.error | "error: \(.file):\(.line):\(.column): \(.message)"' err >said && mv said err || fail "$*: no line of JSON: $(cat err)"
    fi
    grep -qE "(^|error: )$place: .*(not finite|motion.heave)" err || fail "$*: not at $place but: $(cat err)"
}
run check study.yaml --set simulation.duration=1
expect_code 0 "up to t = 1"
placed study.yaml:7:10 check study.yaml
placed study.yaml:7:10 forces study.yaml -o a.csv
placed study.yaml:7:10 simulate study.yaml --set disturbance= -o a.csv
placed study.yaml:8:38 simulate study.yaml -o a.csv
has_page && placed study.yaml:8:38 report study.yaml -o a.html
placed "--set motion.heave" forces study.yaml --set 'motion.heave=1/(1 - t)*0'
placed "--set disturbance.force.1" simulate study.yaml --set 'disturbance.force.1=log(1 - t)'
placed "--set disturbance.leg_force" simulate study.yaml --set 'disturbance.leg_force=log(1 - t)'
placed study.yaml:7:10 stability study.yaml --at 1.7 --matrix
placed study.yaml:7:10 stability study.yaml
placed study.yaml:7:10 stability study.yaml --sweep-stiffness 1:10:3
placed study.yaml:8:38 tune study.yaml --deviation 0.1 -o a.csv
placed study.yaml:7:10 tune study.yaml --deviation 0.1 --feedforward none --set disturbance= --json
placed "--set motion.heave" tune study.yaml --deviation 0.1 --set disturbance= --set 'motion.heave=0*sqrt(1 - t)'
[[ ! -s out ]] || fail "tune prints a result of formulas that are not finite: $(head -3 out)"
[[ ! -e a.csv && ! -e a.html ]] || fail "a file is left"

# a sweep goes on, and names the first of its runs that met one
cat study.yaml - >sweep.yaml <<'END'
sweep: {keys: {simulation.duration: [1, 1.3, 1.4]}}
END
run sweep sweep.yaml -o b.csv
expect_code 0 "a sweep"
grep -qF 'gough sweep: 2 of 3 runs end early; the first is run 2 (simulation.duration=1.3): sweep.yaml:8:38: disturbance.force.3 (value or derivatives) is not finite at t = ' err ||
    fail "the sweep does not name the formula: $(cat err)"
run sweep sweep.yaml -o b.csv --quiet
[[ ! -s err ]] || fail "a quiet sweep: $(cat err)"
finish
