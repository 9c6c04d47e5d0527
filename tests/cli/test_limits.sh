#!/usr/bin/env bash
# Limits of the legs: which legs, which limit, in units; one line for each leg and kind; the same legs from every verb.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# The symmetric machine is its own image in the plane y = 0, which exchanges legs 1 and 6, 2 and 5, 3 and 4: under surge those
# pairs move alike.
cat >"$scratch/surge.yaml" <<'EOF'
platform: {base: {radius: 0.75, half_angle: 9}, top: {radius: 0.56, half_angle: 5}, height: 0.66, legs: {max_speed: 0.2}}
load: {mass: 180, center_of_mass: [0, 0, 0.35], inertia: [18, 22, 14]}
motion: {surge: "0.2*sin(2*t)*ramp(t, 1)"}
control: {stiffness: 400000, damping: 9000}
simulation: {duration: 4, output_step: 0.01}
EOF
for verb in forces simulate; do
    run "$verb" "$scratch/surge.yaml" --json
    expect_code 1 "$verb beyond a speed"
    cp "$scratch/out" "$scratch/$verb.json"
    jq -e '.end.status == "leg_speed" and .end.limit == 0.2 and .end.leg == .end.legs[0] and (.end.legs | length) == 2 and
           .end.legs[0] + .end.legs[1] == 7' "$scratch/out" >/dev/null || fail "$verb: end $(jq -c .end "$scratch/out")"
    [[ $(wc -l <"$scratch/err") == 1 ]] || fail "$verb --json: standard error has more than the end: $(cat "$scratch/err")"
done
jq -es '.[0].end.legs == .[1].end.legs and (.[0].end.time - .[1].end.time | fabs) < 1e-4' "$scratch"/{forces,simulate}.json >/dev/null ||
    fail "forces and simulate name other legs: $(jq -c .end.legs "$scratch"/{forces,simulate}.json | paste -sd' ')"
pair=$(jq -r '.end.legs | "legs \(.[0]) and \(.[1])"' "$scratch/forces.json")
jq -r '.error | "error: \(.file): \(.message)"' "$scratch/err" >"$scratch/said"
grep -qE "error: .*: $pair exceed their greatest speed 0\.2 m/s at t = [0-9.]+ s$" "$scratch/said" || fail "the sentence: $(cat "$scratch/err")"

# by other means: peaks, first and last times beyond, number of excesses, from a table of close rows
"$GOUGH" forces "$scratch/surge.yaml" --set simulation.output_step=0.0005 -q -o "$scratch/fine.csv" 2>/dev/null
for leg in 1 2 3 4 5 6; do
    read -r worst enter leave count < <(paste -d' ' <(column "$scratch/fine.csv" t) <(column "$scratch/fine.csv" "dl$leg") |
        awk '{ v = $2 < 0 ? -$2 : $2; if (v > w) w = v; b = v > 0.2
               if (b && !was) { n++; if (n == 1) enter = $1 } if (!b && was) leave = $1; was = b }
             END { printf "%.9g %s %s %d\n", w, n ? enter : "null", was || !n ? "null" : leave, n }')
    jq -e --argjson leg "$leg" --argjson w "$worst" --argjson n "$count" --argjson e "$enter" --argjson l "$leave" '
        def near(a; b): if b == null then a == null else (a - b | fabs) <= 0.0006 end;
        .limits | map(select(.leg == $leg and .kind == "leg_speed")) | length == 1 and (.[0] |
        (.worst / $w - 1 | fabs) < 1e-5 and (.share / (.worst / 0.2) - 1 | fabs) < 1e-12 and .limit == 0.2 and .count == $n and
        near(.enter; $e) and near(.leave; $l))' "$scratch/forces.json" >/dev/null ||
        fail "leg $leg: $(jq -c --argjson leg "$leg" '.limits[] | select(.leg == $leg)' "$scratch/forces.json"), not $worst $enter $leave $count"
done

# one line for each leg that exceeds the limit, with share and units; the list only with --all
run forces "$scratch/surge.yaml"
exceeding=$(jq '[.limits[] | select(.count > 0)] | length' "$scratch/forces.json")
[[ $(grep -cE '^    leg [1-6] greatest speed +[0-9.]+ m/s of 0.2 m/s, [0-9.]+ %, ([0-9]+ times, )?t = [0-9.]+( s to the end| to [0-9.]+ s)$' "$scratch/out") == "$exceeding" ]] ||
    fail "lines of limits: $(sed -n '/limits/,$p' "$scratch/out")"
! grep -q 'at worst' "$scratch/out" || fail "each excess is listed unasked"
run forces "$scratch/surge.yaml" --all
[[ $(grep -c 'at worst .* m/s at t = .* s$' "$scratch/out") == $(jq '[.limits[].count] | add' "$scratch/forces.json") ]] || fail "--all: $(grep -c 'at worst' "$scratch/out") lines"

# without an excess the share of each limit is said all the same, with the leg that comes nearest
run forces "$scratch/surge.yaml" --set platform.legs.max_speed=5 --set platform.legs.max_force=3000 --set 'platform.legs.length=[0.3, 2]'
expect_code 0 "limits that are met"
for line in 'least length  .* m of 0.3 m, ' 'greatest length .* m of 2 m, ' 'greatest speed .* m/s of 5 m/s, ' 'greatest force .* N of 3000 N, '; do
    grep -qE "^    ${line}[0-9.]+ %, leg [1-6]$" "$scratch/out" || fail "no line '$line': $(sed -n '/limits/,$p' "$scratch/out")"
done
run forces "$scratch/surge.yaml" --set platform.legs.max_speed=
! grep -q ' limits ' "$scratch/out" || fail "limits are said where there are none"

# numbers and sentences of --dimensionless are in its units, and there are no words for those
run forces "$scratch/surge.yaml" --dimensionless --json
jq -e --slurpfile si "$scratch/forces.json" '
    def near(a; b): (a - b | fabs) <= 1e-12 * (b | fabs);
    (0.75 / 9.80665 | sqrt) as $time |
    near(.end.limit; 0.2 * $time / 0.75) and near(.end.time; $si[0].end.time / $time) and
    near(.limits[0].worst; $si[0].limits[0].worst * $time / 0.75) and near(.limits[0].share; $si[0].limits[0].share) and
    (.end.message | test("greatest speed 0\\.0737[0-9]* at t = [0-9.]+$"))' "$scratch/out" >/dev/null || fail "--dimensionless: $(jq -c .end "$scratch/out")"

# ends that are no limit's have their time in units too, in the table as well
run forces "$scratch/surge.yaml" --set motion.surge=0 --set 'motion.yaw=90*ramp(t, 3)' -o "$scratch/singular.h5"
grep -qE 'singular at t = [0-9.]+ s: there' "$scratch/err" || fail "a singular end: $(cat "$scratch/err")"
run forces "$scratch/surge.yaml" -q -o "$scratch/limit.h5"
if command -v h5dump >/dev/null; then
    h5dump -w 0 -a end_message "$scratch/limit.h5" | grep -q "$pair exceed their greatest speed 0.2 m/s from t = .* to .* s; limits are exceeded 10 times" || fail "end_message: $(h5dump -a end_message "$scratch/limit.h5")"
fi
# a figure says which legs, which limit and from when to when, and does not call the curves' end what is none
if command -v gnuplot >/dev/null; then
    run plot "$scratch/limit.h5" -o "$scratch/limit.svg"
    expect_code 0 "a plot of forces beyond a limit"
    tr -d '\n' <"$scratch/limit.svg" | grep -q "$pair exceed their greatest speed 0.2 m/s from t = " || fail "the figure's note: $(grep -o '>[^<]*leg[^<]*<' "$scratch/limit.svg" | head -3)"
    ! grep -qE 'leg_speed|ended at' "$scratch/limit.svg" || fail "the figure has a raw word or calls the run ended"
fi
finish
