#!/usr/bin/env bash
# Each column of a row of a sweep is what gough simulate finds when it does that run alone: of runs that reach their end, that end on
# the way and at once; a run that cannot begin has no state and no peaks.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
cat >study.yaml <<'END'
title: Rows of a sweep
platform: {base: {radius: 2, half_angle: 10}, top: {radius: 1.1, half_angle: 15}, height: 1.7, legs: {max_force: 150}}
load: {mass: 30, center_of_mass: [0.02, 0, 0.1], inertia: [3, 3, 5]}
motion: {heave: 0.1*sin(5*t), pitch: 3*sin(2*t), yaw: 2*t}
control: {stiffness: 4000, damping: 300}
disturbance: {force: [20*sin(7*t), 0, 0]}
simulation: {duration: 1, output_step: 0.02, method: rk4, step: 0.01}
sweep: {keys: {load.mass: [30, 50, 200, -1]}}
END
run sweep study.yaml -q -o rows.csv
expect_code 1 "a sweep with a run that is not valid"

columns=run,load.mass,x,y,z,roll,pitch,yaw,vx,vy,vz,wx,wy,wz,position_deviation,angle_deviation,force,speed,power,energy,drift,end_cause,end_leg,end_time,power_least,power_greatest
[[ $(head -1 rows.csv) == "$columns" ]] || fail "columns: $(head -1 rows.csv)"
of() { column rows.csv "$1" | sed -n "$2p"; }
same() { # same COLUMN RUN WANTED [PART]: up to round-off or a part
    awk -v a="$3" -v b="$(of "$1" "$2")" -v part="${4:-1e-12}" 'BEGIN { d = a - b; s = a < 0 ? -a : a
        exit !(a ~ /^-?[0-9]/ && b ~ /^-?[0-9]/ && (d < 0 ? -d : d) <= part * s + 1e-18) }' || fail "run $2: $1 is $(of "$1" "$2"), alone $3"
}
causes=('done' leg_force leg_force)
for run in 1 2 3; do
    mass=$(of load.mass $run)
    "$GOUGH" simulate study.yaml --set load.mass="$mass" -q --json -o alone.csv >alone.json 2>/dev/null
    [[ $(of run $run) == "$run" && $(of end_cause $run) == "$(jq -r .end.status alone.json)" && $(of end_cause $run) == "${causes[run - 1]}" ]] ||
        fail "run $run ends by $(of end_cause $run), alone by $(jq -c .end alone.json)"
    same end_leg $run "$(jq '.end.leg // 0' alone.json)"
    same end_time $run "$(jq .end.time alone.json)"
    for name in x y z roll pitch yaw vx vy vz wx wy wz; do same $name $run "$(column alone.csv $name | tail -1)"; done
    same position_deviation $run "$(jq .deviation.position alone.json)"
    same angle_deviation $run "$(jq .deviation.angle alone.json)"
    same drift $run "$(jq .drift alone.json)"
    same energy $run "$(jq '[.legs[].energy] | add' alone.json)" 1e-10
    same force $run "$(jq '[.legs[].force[] | fabs] | max' alone.json)"
    same speed $run "$(jq '[.legs[].speed] | max' alone.json)"
    same power $run "$(jq '[.legs[].power[1]] | max' alone.json)"
    same power_least $run "$(jq '[.legs[].power[0]] | min' alone.json)"
    same power_greatest $run "$(jq '[.legs[].power[1]] | max' alone.json)"
done
awk -v t="$(of end_time 2)" 'BEGIN { exit !(t > 0.02 && t < 0.98) }' || fail "run 2 ends at t = $(of end_time 2), not on the way"
[[ $(of end_time 3) == 0 ]] || fail "run 3 ends at t = $(of end_time 3), not at once"
# a mass below 0
[[ $(sed -n 5p rows.csv) == "4,-1,$(printf 'nan,%.0s' {1..19})invalid,0,$(of end_time 4),nan,nan" ]] || fail "the run that is not valid: $(sed -n 5p rows.csv)"
finish
