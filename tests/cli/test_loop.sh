#!/usr/bin/env bash
# What check and simulate say of drives and sampled controllers: lines, JSON, warnings, and sweeps of their keys.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"

cat >"$scratch/loop.yaml" <<'END'
units: {length: mm, time: ms}
platform: {base: {radius: 250, half_angle: 10}, top: {radius: 150, half_angle: 10}, height: 280}
load: {mass: 6, inertia: [5e4, 5e4, 8e4]}
actuators: {kind: lag, time_constant: 5, max_force: [-60, 80], max_rate: 40}
control:
  stiffness: 5
  damping: 150
  integral: 0.004
  tracking_time: 60
  sampling: {period: 1, delay: 0.5, velocity: difference, cutoff: 0.1, resolution: 0.001, noise: 0.0002, jitter: 0.25, preview: 1}
simulation: {duration: 40, output_step: 5}
END
says() { grep -qF -- "$1" "$scratch/out" || fail "check does not print '$1': $(cat "$scratch/out")"; }
run check "$scratch/loop.yaml"
says '  integral K_I         0.004 N/(mm ms), tracking time 60 ms'
says '  measured             lengths in counts of 0.001 mm with noise of 0.0002 mm RMS, rates from'
says 'differences (cutoff 0.1 1/ms); up to 0.25 ms of jitter; program forces of 1'
says '  lag, first order     time constant 5 ms'
says '  limits of commands   -60 to 80 N'
says '  greatest force rate  40 N/ms'
[[ ! -s $scratch/err ]] || fail "check warns: $(cat "$scratch/err")"

run check "$scratch/loop.yaml" --set 'actuators=[{max_force: 1}, {max_force: 2}, {}, {}, {}, {max_force: [-5, 4]}]'
says '  force                the command at once'
says '  limits of commands   -1 to 1 N, -2 to 2 N, none,'
says 'none, none, -5 to 4 N'
run check "$scratch/loop.yaml" --set 'actuators={kind: lag, frequency: [0.1, 0.2, 0.1, 0.1, 0.1, 0.1], damping_ratio: 0.7}'
says '  lag, second order    natural frequency 0.1, 0.2, 0.1, 0.1, 0.1, 0.1 1/ms, damping ratio 0.7'
row='[1, -2, 3, 4, 5, 6]'
run check "$scratch/loop.yaml" --set "control.stiffness=[$row, $row, $row, $row, $row, $row]"
says '  stiffness G          -2 to 6 N/mm on the diagonal of a 6x6 matrix'
says '  damping D            150 N ms/mm'
grep -qF 'N ms/mm on the diagonal' "$scratch/out" && fail "a damping of single legs is called a matrix"

warns() {
    local verb=$1 sentence=$2
    shift 2
    "$GOUGH" "$verb" "$scratch/loop.yaml" -q "$@" >/dev/null 2>"$scratch/err"
    grep -qF -- "warning: $sentence" "$scratch/err" || fail "$verb $*: no warning '$sentence': $(cat "$scratch/err")"
}
exact='lengths are measured in counts of 0.001 mm, but rates exactly'
for verb in check simulate; do
    warns $verb "$exact" --set control.sampling.velocity=exact --set control.sampling.cutoff=
    warns $verb 'control.tracking_time has no effect, because control.integral is not given' --set control.integral=
    warns $verb 'control.tracking_time has no effect, because the drives have no actuators.max_force' --set actuators.max_force=
done

if command -v jq >/dev/null; then
    run check "$scratch/loop.yaml" --json --set "control.damping=[$row, $row, $row, $row, $row, $row]"
    [[ $(jq -c .actuators.max_force[5] "$scratch/out") == "[-60,80]" ]] || fail "JSON: $(jq -c .actuators "$scratch/out")"
    [[ $(jq -c '[.actuators.kind, .actuators.time_constant[0], .actuators.frequency[0], .actuators.max_rate[2]]' "$scratch/out") == '["lag",5,null,40]' ]] ||
        fail "JSON: $(jq -c .actuators "$scratch/out")"
    [[ $(jq -c '[.control.damping[4][1], .control.stiffness[1][1], .control.stiffness[1][0], .control.sampled]' "$scratch/out") == '[-2,5,0,true]' ]] ||
        fail "JSON: $(jq -c .control "$scratch/out")"
fi

# numbers of the loop vary in sweeps, of one leg too
sweeps() {
    "$GOUGH" sweep "$scratch/loop.yaml" -q -o "$scratch/sweep.csv" "$@" 2>"$scratch/err" || fail "sweep $*: $(cat "$scratch/err")"
    mapfile -t ends < <(awk -F, 'NR > 1 { print $4 "," $5 "," $6 }' "$scratch/sweep.csv")
    [[ ${#ends[@]} == 2 && ${ends[0]} != "${ends[1]}" ]] || fail "sweep $*: runs do not differ: $(cat "$scratch/sweep.csv")"
}
quiet=(--set control.sampling.noise=0 --set 'control.feedforward=none')
for key in control.sampling.period control.sampling.delay actuators.time_constant control.integral control.damping; do
    sweeps "${quiet[@]}" --set "sweep={keys: {$key: [0.5, 0.9]}}"
done
sweeps "${quiet[@]}" --set 'sweep={keys: {actuators.max_force: [1, 2]}}'
six='[{max_force: 9}, {max_force: 9}, {max_force: 9}, {max_force: 9}, {max_force: 9}, {max_force: 9}]'
sweeps "${quiet[@]}" --set "actuators=$six" --set 'sweep={keys: {actuators.3.max_force: [1, 2]}}'
sweeps "${quiet[@]}" --set "control.stiffness=[$row, $row, $row, $row, $row, $row]" --set 'sweep={keys: {control.stiffness.2.1: [1, -2]}}'

refuses() {
    local sentence=$1
    shift
    "$GOUGH" check "$scratch/loop.yaml" -q "$@" 2>"$scratch/err"
    [[ $? == 2 ]] && grep -qF -- "$sentence" "$scratch/err" || fail "check $*: no error '$sentence': $(cat "$scratch/err")"
}
# shellcheck disable=SC2016
{
    refuses '`actuators.max_force`: `actuators` is a list in this study; vary the number of one leg, as in `actuators.1.max_force`' \
        --set "actuators=$six" --set 'sweep={keys: {actuators.max_force: [1, 2]}}'
    refuses 'the study has no list `actuators` with such an element' --set 'sweep={keys: {actuators.1.max_force: [1, 2]}}'
    refuses 'the study has no list `control.stiffness` with such an element' --set 'sweep={keys: {control.stiffness.2.1: [1, 2]}}'
    refuses '`control.stiffness.2` is a list in this study; vary an element of it, as in `control.stiffness.2.1`' \
        --set "control.stiffness=[$row, $row, $row, $row, $row, $row]" --set 'sweep={keys: {control.stiffness.2: [1, 2]}}'
    refuses 'the first run of the sweep is invalid' --set 'control={stiffness: 3}' --set 'sweep={keys: {control.sampling.delay: [1, 2]}}'
}
finish
