#!/usr/bin/env bash
# External loads, the order of angles and a pose of the machine as the user reads them: numbers against closed forms and against
# leg lengths computed here, sentences, refusals and their places.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
: "${SOURCE:?the source folder}"
cp "$SOURCE/examples/own-machine.yaml" "$scratch/own.yaml"
cd "$scratch" || exit 1

says() { tr -s '\n ' ' ' <out | grep -qF -- "$1" || fail "$what: does not say: $1"; }
near() { awk -v a="$2" -v b="$3" -v e="$4" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= e) }' || fail "$1: $2 instead of $3"; }

what="a support of 30 N"
support='external=[{force: [0, 0, 30]}]'
right=$(awk 'BEGIN { l = 0.32549449575388623; printf "%.15g", (6 * 9.80665 - 30) * l / (6 * 0.28) }')
run forces own.yaml --set motion= --set "$support" --set simulation.duration=0.1 -o rows.csv
expect_code 0 "$what"
for leg in 1 2 3 4 5 6; do near "$what" "$(column rows.csv "f$leg" | head -1)" "$right" 1e-12; done
says "the external loads did 0 J of work"
run check own.yaml --set "$support"
says "External loads (part of the program forces) 1 force 0, 0, 30 N, moment 0, 0, 0 N m at 0, 0, 0.05 m in the top frame, axes of the base"
run check own.yaml --set 'external=[{force: [0, 2*t, 0], at: [0, 0, 0], axes: top}]' --set control.model.external=false
says "External loads (left out of the program forces) 1 force 0, 0, 0 N, moment 0, 0, 0 N m at t = 0 at 0, 0, 0 m in the top frame, axes of the top"

# a controller that does not know the load sags by load times compliance; one that does keeps the program
what="a load that the controller does not know"
small='external=[{force: [0, 0, -0.01], at: [0, 0, 0]}]'
run check own.yaml --json
compliance=$(jq '.pose.compliance[2][2]' out)
run simulate own.yaml --set motion= --set "$small" --set control.model.external=false --set simulation.duration=2 -o sag.csv
near "$what" "$(column sag.csv ez | tail -1)" "$(awk -v c="$compliance" 'BEGIN { printf "%.15g", -0.01 * c }')" 1e-11
run simulate own.yaml --set "$small" -o known.csv
near "$what, if known" "$(jq -n 1 >/dev/null; awk -F, 'NR > 1 { for (i = 1; i <= NF; i++) if (name[i] ~ /^e[xyz]$/) { x = $i < 0 ? -$i : $i; if (x > most) most = x } } NR == 1 { for (i = 1; i <= NF; i++) name[i] = $i } END { printf "%.3g", most }' known.csv)" 0 1e-9
run stability own.yaml --set motion= --set 'external=[{force: [0, 0, -20]}]' --set control.model.external=false
says "With feed-forward that ignores the external loads, the loop rests where springs and load balance"

# numbers of loads vary in a sweep as they do by hand
what="a sweep of a load"
run sweep own.yaml --set "$support" --set control.model.external=false --set 'sweep={keys: {external.1.force.3: [10, 20]}}' --set simulation.step=0.005 -o sweep.csv
expect_code 0 "$what"
for i in 1 2; do
    run simulate own.yaml --set "$support" --set control.model.external=false --set "external.1.force.3=$((10 * i))" --set simulation.step=0.005 --json
    near "$what" "$(column sweep.csv position_deviation | sed -n "${i}p")" "$(jq .deviation.position out)" 1e-9
done

# errors name the place in the file
what="errors"
printf 'external:\n  - {force: [0, 0, 1], at: [0, 0, .inf]}\n' | cat own.yaml - >wrong.yaml
run check wrong.yaml
expect_code 2 "$what"
grep -qE "wrong.yaml:[0-9]+:35: error: \`external.1.at.3\`" err || fail "$what: $(head -1 err)"
run check own.yaml --set 'external=[{}, {}, {}, {}, {}, {}, {}, {}, {}]'
grep -qF "must be a list of 1 to 8 loads" err || fail "$what: nine loads: $(head -1 err)"
run simulate own.yaml --set 'external=[{moment: [0, 0.01*sqrt(0.5 - t), 0]}]'
expect_code 2 "a load that is not finite"
grep -qF 'external.1.moment.2 (value or derivatives) is not finite' err || fail "$what: $(cat err)"
run stability own.yaml --set motion= --set 'external=[{force: [0, 0, 1]}, {force: [1, 0, 0], axes: top}]'
expect_code 2 "a load that turns"
grep -qF "load 2 turns with the top or is a moment" err || fail "$what: $(cat err)"
wave='motion={heave: 0.02*sin(5*t)}'
run stability own.yaml --set "$wave" --set 'external=[{force: [0, 0, sin(3*t)]}]'
expect_code 2 "a load with another period"
grep -qF "load 1 does not repeat with the period" err || fail "$what: $(cat err)"
run stability own.yaml --set "$wave" --set 'external=[{force: [0, 0, sin(10*t)], at: [0, 0.1, 0]}]'
expect_code 0 "a load with half the period"
# maps look at each stiffness by itself where a load varies, turns or is a moment: the multipliers without a map
while IFS=';' read -r load loop; do
    loaded=(--set "$wave" --set "external=[$load]" --set "control.$loop")
    run stability own.yaml "${loaded[@]}" --sweep-stiffness 3000:9000:2 -o map.csv
    expect_code 0 "a map with the load $load, $loop"
    [[ $load == *top* || $load == *moment* ]] && continue # without a map these are refused for the loop at rest
    run stability own.yaml "${loaded[@]}" --set control.stiffness=9000 --json
    near "map, $load, $loop" "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } $at["stiffness"] == 9000 { print $at["growth_per_period"] }' map.csv)" \
        "$(jq '[.multipliers[] | (.[0] * .[0] + .[1] * .[1] | sqrt)] | max' out)" 1e-9
done <<'END'
{force: [0, 0, 5*sin(10*t)]};damping=5
{force: [0, 0, 5*sin(10*t)]};model.external=false
{moment: [0, 0.2*cos(5*t), 0]};damping=0
{force: [3, 0, 0], axes: top};damping=5
END
run stability own.yaml --set "$wave" --set 'external=[{force: [0, 0, sin(3*t)]}]' --sweep-stiffness 1000:2000:2
expect_code 2 "a map with a load of another period"
grep -qF "load 1 does not repeat with the period" err || fail "$what: $(cat err)"

# tune looks at multipliers one by one where a load varies, and refuses one that does not repeat; check says what is ignored
quick=(--set "$wave" --set simulation.duration=2 --deviation 1e-3 --damping-ratio 0.4 --feedforward program)
run tune own.yaml "${quick[@]}" --set 'external=[{force: [0, 0, sin(10*t)]}]'
expect_code 0 "tune with a load that varies: $(head -2 err)"
says "With feed-forward stiffness G = "
run tune own.yaml "${quick[@]}" --set 'external=[{force: [0, 0, sin(3*t)]}]'
expect_code 2 "tune with a load of another period"
grep -qF "load 1 does not repeat with the period 1.25663706 s of the program" err || fail "tune: $(cat err)"
run check own.yaml --set "$support" --set control.model.external=false
says "feedforward the program's forces without the external loads"
run check own.yaml --set "$support"
! grep -q "without  *the external loads" out || fail "check: the loads are known"

# angles in both orders: rows, the start of a run and --pose against lengths from elementary rotations
lengths() { # ORDER SURGE ROLL PITCH YAW
    python3 - "$@" <<'END'
import sys
from math import cos, sin, radians, hypot
order, surge = sys.argv[1], float(sys.argv[2])
a = [radians(float(x)) for x in sys.argv[3:]]
def about(axis, w):
    b, c = (axis + 1) % 3, (axis + 2) % 3
    m = [[0.0] * 3 for _ in range(3)]
    m[axis][axis], m[b][b], m[c][c], m[b][c], m[c][b] = 1.0, cos(w), cos(w), -sin(w), sin(w)
    return m
def times(p, q): return [[sum(p[i][k] * q[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
x, y, z = (about(k, a[k]) for k in range(3))
R = times(times(z, y), x) if order == "zyx" else times(times(x, y), z)
def ring(radius, degrees): return (radius * cos(radians(degrees)), radius * sin(radians(degrees)), 0.0)
for leg in range(6):
    k, first = leg // 2, leg % 2 == 0
    base = ring(0.25, 120 * k + 10) if first else ring(0.25, 120 * (k + 1) - 10)
    top = ring(0.15, 60 + 120 * k - 10) if first else ring(0.15, 60 + 120 * k + 10)
    p = [sum(R[i][j] * top[j] for j in range(3)) + (surge, 0.0, 0.28)[i] - base[i] for i in range(3)]
    print(repr(hypot(*p)))
END
}
for order in zyx xyz; do
    what="order $order"
    lengths "$order" 0.02 4 -6 8 >right
    run forces own.yaml --set "motion={surge: 0.02, roll: 4, pitch: -6, yaw: 8, order: $order}" --set simulation.duration=0.1 -o rows.csv
    expect_code 0 "$what"
    near "$what: roll" "$(column rows.csv roll | head -1)" 4 1e-12
    near "$what: yaw" "$(column rows.csv yaw | head -1)" 8 1e-12
    printf 't,surge,roll,pitch,yaw\n0,0.02,4,-6,8\n1,0.02,4,-6,8\n' >rest.csv
    run forces own.yaml --set "motion={samples: rest.csv, order: $order}" --set simulation.duration=0.1 -o recorded.csv
    run simulate own.yaml --set "motion={order: $order}" --set 'initial={surge: 0.02, roll: 4, pitch: -6, yaw: 8}' --set simulation.duration=0.1 -o start.csv
    run check own.yaml --set "motion={order: $order}" --pose surge=0.02,roll=4,pitch=-6,yaw=8 --json
    cp out pose.json
    for leg in 1 2 3 4 5 6; do
        l=$(sed -n "${leg}p" right)
        near "$what: program, leg $leg" "$(column rows.csv "l$leg" | head -1)" "$l" 1e-14
        near "$what: record, leg $leg" "$(column recorded.csv "l$leg" | head -1)" "$l" 1e-14
        near "$what: start, leg $leg" "$(column start.csv "l$leg" | head -1)" "$l" 1e-14
        near "$what: --pose, leg $leg" "$(jq ".pose.length[$((leg - 1))]" pose.json)" "$l" 1e-14
    done
    [[ $(jq -r .program.order pose.json) == "$order" ]] || fail "$what: JSON"
done
cmp -s <(lengths zyx 0.02 4 -6 8) right && fail "the two orders are the same"

what="--pose"
run check own.yaml --pose surge=0.02,yaw=5
says "At rest at surge 0.02 m, yaw 5 deg"
says "of the control and of the static forces together [N/m, N/rad; N, N m/rad]"
run check own.yaml --pose heave=0.2
says "leg 1 is outside its limits"
run check own.yaml --pose yaw=90
expect_code 0 "$what"
run check own.yaml --set control.stiffness=0 --pose yaw=5
says "compliance none: some displacement is not resisted"
run check own.yaml --pose sideways=1
expect_code 2 "$what: a component that there is not"
finish
