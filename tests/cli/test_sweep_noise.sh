#!/usr/bin/env bash
# Noise in a sweep: each run has its own, any run alone equals the run in the sweep, and a number given is the same in all runs.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"

cat >"$scratch/noise.yaml" <<'END'
title: A loop under noise
units: dimensionless
platform: {base: {radius: 1.0, half_angle: 10}, top: {radius: 0.6, half_angle: 10}, height: 1}
load: {mass: 1, inertia: [0.08, 0.08, 0.15]}
motion: {heave: 0.1*sin(t)}
disturbance: {noise: {leg_force: 0.01, force: 0.02, moment: 0.002, interval: 0.2, seed: 5}}
control: {stiffness: 20, damping: 1}
simulation: {duration: 5, output_step: 0.05, method: rk4, step: 0.01}
sweep: {keys: {control.damping: [1, 1, 1, 2]}}
END
"$GOUGH" sweep "$scratch/noise.yaml" -q -o "$scratch/sweep.csv" || fail "the sweep fails"
mapfile -t pose < <(awk -F, 'NR > 1 { print $3 "," $4 "," $5 "," $6 "," $7 "," $8 }' "$scratch/sweep.csv")
((${#pose[@]} == 4)) || fail "${#pose[@]} rows instead of 4"
[[ ${pose[0]} != "${pose[1]}" && ${pose[1]} != "${pose[2]}" ]] || fail "runs with equal numbers have the same noise"

for run in 1 3 4; do
    read -ra setting < <("$GOUGH" sweep "$scratch/noise.yaml" --run $run)
    [[ ${setting[*]} == *disturbance.noise.run=$run* ]] || fail "--run $run does not name its noise: ${setting[*]}"
    "$GOUGH" simulate "$scratch/noise.yaml" "${setting[@]}" -q -o "$scratch/alone.csv" || fail "run $run alone fails"
    alone=$(tail -1 "$scratch/alone.csv" | cut -d, -f2-7)
    [[ $alone == "${pose[run - 1]}" ]] || fail "run $run alone ends at $alone, in the sweep at ${pose[run - 1]}"
done

for given in 0 9; do
    "$GOUGH" sweep "$scratch/noise.yaml" -q --set disturbance.noise.run=$given -o "$scratch/same.csv" || fail "one noise for all fails"
    mapfile -t pose < <(awk -F, 'NR > 1 { print $3 "," $4 "," $5 }' "$scratch/same.csv")
    [[ ${#pose[@]} == 4 && ${pose[0]} == "${pose[1]}" && ${pose[1]} == "${pose[2]}" && ${pose[2]} != "${pose[3]}" ]] ||
        fail "disturbance.noise.run=$given is given, but the noise is not the same in all runs"
    "$GOUGH" simulate "$scratch/noise.yaml" -q --set disturbance.noise.run=$given --set control.damping=2 -o "$scratch/alone.csv"
    [[ $(tail -1 "$scratch/alone.csv" | cut -d, -f2-4) == "${pose[3]}" ]] || fail "run $given alone is another"
    run sweep "$scratch/noise.yaml" --set disturbance.noise.run=$given --run 3
    [[ $(cat "$scratch/out") == "--set control.damping=1" ]] || fail "--run 3 with a given number says $(cat "$scratch/out")"
done
"$GOUGH" sweep "$scratch/noise.yaml" -q --threads 3 --lanes 2 -o "$scratch/again.csv" || fail "the sweep fails with 3 threads"
cmp -s "$scratch/sweep.csv" "$scratch/again.csv" || fail "threads and lanes change the noise"

# the same for what a sampled controller draws; each of both numbers is by itself
sampled=(--set 'control.sampling={period: 0.05, noise: 0.001, seed: 3}' --set disturbance.noise=)
"$GOUGH" sweep "$scratch/noise.yaml" -q "${sampled[@]}" -o "$scratch/sweep.csv" || fail "the sampled sweep fails"
mapfile -t pose < <(awk -F, 'NR > 1 { print $3 "," $4 "," $5 "," $6 "," $7 "," $8 }' "$scratch/sweep.csv")
[[ ${#pose[@]} == 4 && ${pose[0]} != "${pose[1]}" && ${pose[1]} != "${pose[2]}" ]] || fail "runs with equal numbers draw the same samples"
read -ra setting < <("$GOUGH" sweep "$scratch/noise.yaml" "${sampled[@]}" --run 3)
[[ ${setting[*]} == "--set control.damping=1 --set control.sampling.run=3" ]] || fail "--run 3 of the sampled sweep says ${setting[*]}"
"$GOUGH" simulate "$scratch/noise.yaml" "${sampled[@]}" "${setting[@]}" -q -o "$scratch/alone.csv" || fail "sampled run 3 alone fails"
alone=$(tail -1 "$scratch/alone.csv" | cut -d, -f2-7)
[[ $alone == "${pose[2]}" ]] || fail "sampled run 3 alone ends at $alone, in the sweep at ${pose[2]}"
"$GOUGH" sweep "$scratch/noise.yaml" -q "${sampled[@]}" --set control.sampling.run=0 -o "$scratch/same.csv" || fail "one draw for all fails"
mapfile -t pose < <(awk -F, 'NR > 1 { print $3 "," $4 "," $5 }' "$scratch/same.csv")
[[ ${pose[0]} == "${pose[1]}" && ${pose[1]} == "${pose[2]}" && ${pose[2]} != "${pose[3]}" ]] ||
    fail "control.sampling.run=0 is given, but the samples are not the same in all runs"
finish
