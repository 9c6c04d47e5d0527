#!/usr/bin/env bash
# What a run cost, as the user reads it: steps, rejected steps, evaluations, and a loop whose decay keeps the steps short.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml
rest=(--set motion= --set simulation.duration=2 --set platform.legs= --set 'initial={heave: 0.001}')

# fixed steps are counted, and each evaluates the equations as often as its method asks for: rk4 three times besides the rate at its
# beginning; rows and peaks come on top
run simulate own.yaml "${rest[@]}" --set simulation.method=rk4 --set simulation.step=0.001 --set simulation.output_step=0.1 --json
expect_code 0 "fixed steps"
jq -e '.statistics | .steps == 2000 and .rejected == 0 and .stiff == null and .evaluations >= 8000 and .evaluations <= 10100' out >/dev/null ||
    fail "2000 steps of rk4: $(jq -c .statistics out)"
run simulate own.yaml "${rest[@]}" --set simulation.method=rk4 --set simulation.step=0.001 --set simulation.output_step=0.1
grep -Eq '^  steps       2000; [0-9]{4,5} evaluations of the equations of motion$' out || fail "fixed steps in words: $(grep steps out)"
run forces own.yaml --json
jq -e '.statistics == null' out >/dev/null || fail "forces makes steps: $(jq -c .statistics out)"

# adaptive steps: eleven evaluations a trial and one at the end of each kept step, four for the dense output, rows, peaks and limits on top
run simulate own.yaml "${rest[@]}" --json
jq -e '.statistics | .steps > 20 and .stiff == null and .evaluations >= 11 * (.steps + .rejected) + .steps' out >/dev/null ||
    fail "adaptive steps: $(jq -c .statistics out)"
grep -q stiff err && fail "a loop that is not stiff is called so"

# a pulse that comes late makes steps be made again
run simulate own.yaml "${rest[@]}" --set 'disturbance={force: [20*exp(-(1000*(t-1))^2), 0, 0]}' --json
jq -e '.statistics.rejected > 0' out >/dev/null || fail "no rejected step at a pulse: $(jq -c .statistics out)"

# stiff: the rate is |lambda| of the fastest mode of the linearised loop, in each system of units, and steps are as short as said
damped=(--set control.stiffness=1000 --set control.damping=20000)
run stability own.yaml "${rest[@]}" "${damped[@]}" --json
fastest=$(jq '[.eigenvalues[][0]] | min | -.' out)
for unit in "" --dimensionless; do
    run simulate own.yaml "${rest[@]}" "${damped[@]}" --json $unit
    second=1
    [[ -z $unit ]] || second=$("$GOUGH" check own.yaml --json | jq .time_unit)
    jq -e --argjson f "$fastest" --argjson s "$second" '.statistics | (.stiff.rate / ($f * $s) - 1 | fabs) < 0.1 and
        .stiff.time > 0 and .stiff.time < 1 / $s and (.steps > 2 * $f / 6.1 * 0.8)' out >/dev/null ||
        fail "stiff loop $unit: $(jq -c .statistics out), fastest decay $fastest"
done
run simulate own.yaml "${rest[@]}" "${damped[@]}"
grep -Eq 'the loop is stiff from t = [0-9.e-]+ s on: its fastest mode, with [|]lambda[|] about [0-9.e+]+ 1/s, limits steps to [0-9.e-]+ s however' err ||
    fail "no word of stiffness: $(cat err)"
# without damping nothing decays, and steps follow the oscillation
for motion in '{heave: 0.01}' '{heave: 0.01*sin(3*t)}'; do
    run simulate own.yaml --set platform.legs= --set control.stiffness=1e9 --set control.damping=0 --set simulation.duration=0.3 --set "motion=$motion" --json
    jq -e '.statistics | .stiff == null and .steps > 0' out >/dev/null || fail "a loop without damping is called stiff: $(jq -c .statistics out)"
    grep -q stiff err && fail "a loop without damping is called stiff: $(cat err)"
done
run simulate own.yaml "${rest[@]}" "${damped[@]}" -q
grep -q stiff err && fail "-q told of stiffness"
finish
