#!/usr/bin/env bash
# Recorded motion: what rounding, jumping angles and wrong columns do, as the user reads it.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml

# the greatest "peak" of the printed table of forces: its line "all", fourth number
peak() { awk '/force \[N\]|force$/ { table = 1 } table && $1 == "all" { print $4; exit }' out; }

# expect_peak TRUTH SHARE: the printed peak force is TRUTH within SHARE of it
expect_peak() {
    local found
    found=$(peak)
    awk -v a="$found" -v b="$1" -v s="$2" 'BEGIN { d = a / b - 1; exit !(a != "" && d <= s && -d <= s) }' ||
        fail "peak force '$found' N instead of $1 N within $2 of it: $3"
}
# so many warnings on standard error
expect_warnings() { [[ $(grep -c "warning: motion.samples" err) == "$1" ]] || fail "not $1 warnings ($2): $(cat err)"; }

# ---- a heading that passes north
cat >yaw.yaml <<'YAML'
platform: {base: {radius: 0.747, half_angle: 9.05}, top: {radius: 0.5623, half_angle: 5.1}, height: 0.66}
load: {mass: 180, center_of_mass: [0, 0, 0.35], inertia: [18, 22, 14]}
motion: {samples: yaw.csv}
simulation: {duration: 6}
YAML
printf 't,yaw\n0,1\n0.5,0.5\n1,0\n1.5,359.5\n2,359\n2.5,359.5\n3,0\n3.5,0.5\n6,0.5\n' >yaw.csv
printf 't,yaw\n0,1\n0.5,0.5\n1,0\n1.5,-0.5\n2,-1\n2.5,-0.5\n3,0\n3.5,0.5\n6,0.5\n' >unwrapped.csv
run forces yaw.yaml
expect_code 0 "forces of a heading past north"
grep -q "yaw jumps by a whole turn (several times, first between t = 1 s and t = 1.5 s)" err || fail "no word of the jump: $(cat err)"
cp out wrapped
awk '$1 == "all" && $2 > 300 { ok = $2 >= 373 && $2 <= 375 && $3 >= 384 && $3 <= 386 } END { exit !ok }' out || fail "forces are not 374 to 385 N"
run forces yaw.yaml --set motion.samples=unwrapped.csv
cmp -s out wrapped || fail "a heading past north is not the motion without its jumps"
grep -q "whole turn" err && fail "a jump is told where there is none"
run check yaw.yaml --json
jq -e '.program.yaw[0] < -0.99 and .program.yaw[0] > -1.1 and .program.yaw[1] < 2 and (.program.record.remarks[0].message | test("whole turn"))' out >/dev/null ||
    fail "check does not show the continuous angle: $(jq -c .program out)"
# -q leaves out what was done, not what may be wrong
run forces yaw.yaml -q
grep -q "whole turn" err && fail "-q told of whole turns"

# over the pole: pitch 80 to 100 degrees as written within bounds, and continuous
awk 'BEGIN { print "t,roll,pitch,yaw"; for (i = 0; i <= 20; i++) { p = 80 + i; far = (p > 90); printf "%g,%d,%d,%d\n", i / 10, far ? 180 : 0, far ? 180 - p : p, far ? -170 : 10 } }' >pole.csv
awk 'BEGIN { print "t,roll,pitch,yaw"; for (i = 0; i <= 20; i++) printf "%g,0,%d,10\n", i / 10, 80 + i }' >through.csv
for file in pole through; do
    run check yaw.yaml --json --set motion.samples="$file.csv" --set simulation.duration=2
    jq -c '[.program.roll, .program.pitch, .program.yaw]' out >"$file.json"
done
[[ $(cat through.json) == "[[0,0],[80,100],[10,10]]" ]] || [[ $(jq -c 'map(map(. * 1e6 | round / 1e6))' through.json) == "[[0,0],[80,100],[10,10]]" ]] ||
    fail "pitch from 80 to 100: $(cat through.json)"
[[ $(jq -c 'map(map(. * 1e6 | round / 1e6))' pole.json) == "[[0,0],[80,100],[10,10]]" ]] || fail "over the pole: $(cat pole.json)"

# close to the pole roll and yaw turn fast while the platform hardly turns: see test_pole.sh. A record that comes close to every such
# pose, whatever the axes, is warned of
awk 'BEGIN { print "t,roll,pitch,yaw"; srand(7); for (i = 0; i <= 300; i++) printf "%g,%.3f,%.3f,%.3f\n", i / 50, 360 * rand() - 180, 180 * rand() - 90, 360 * rand() - 180
    for (i = 301; i <= 310; i++) printf "%g,%d,%d,%d\n", i / 50, 8 * (i - 300), 89, 8 * (i - 300)
    printf "7,160,89,160\n8,160,89,160\n" }' >near.csv
run check yaw.yaml --set motion.samples=near.csv
grep -Eq "warning: motion.samples: yaw changes by [0-9.]+ deg between t = [0-9.]+ s and t = [0-9.]+ s while the platform turns by only [0-9.]+ deg.* there are no axes that stay away" err || fail "near all poles: $(cat err)"
printf 't,roll,pitch,yaw\n0,0,86,0\n1,0,88,0\n2,80,89,80\n3,160,88,160\n4,160,86,160\n5,160,84,160\n6,160,82,160\n' >near.csv
run check yaw.yaml --set motion.samples=near.csv --set motion.smooth=none
grep -q "false accelerations" err && fail "a warning of false accelerations: $(cat err)"
[[ $(grep -c "is interpolated as the same rotations about turned axes" err) == 1 ]] || fail "near the pole: $(cat err)"
# rows too far apart to tell the way from one to the next
printf 't,roll,pitch,yaw\n0,0,86,0\n1,0,88,0\n2,80,89,80\n3,160,88,160\n4,160,86,160\n5,0,-20,160\n6,0,-20,160\n' >far.csv
run check yaw.yaml --set motion.samples=far.csv
grep -Eq "warning: motion.samples: the platform turns by [0-9.]+ deg between t = 4 s and t = 5 s; rows so far apart" err || fail "rows far apart: $(cat err)"

# a jump that is no whole turn stays, and is reported with its acceleration
printf 't,yaw\n0,0\n1,0\n2,0\n3,120\n4,120\n5,120\n6,120\n' >jump.csv
run check yaw.yaml --set motion.samples=jump.csv
grep -Eq "warning: motion.samples: yaw jumps by 120 deg between t = 2 s and t = 3 s, .* makes [0-9]+ deg/s\^2" err || fail "no word of a jump by 120 degrees: $(cat err)"

# ---- rounding: 12.318 N is the peak of 0.02 (1 - cos 2 pi t), from a record of 9 decimals and from a formula
decimals() {
    awk -v d="$1" 'BEGIN { print "t,heave"; for (i = 0; i <= 2000; i++) printf "%.3f,%.*f\n", i * 0.005, d, 0.02 * (1 - cos(6.283185307179586 * i * 0.005)) }'
}
for d in 3 4 5 6 9; do decimals $d >h$d.csv; done
ten=(--set simulation.duration=10 --set simulation.output_step=0.005 --set platform.legs=)
run forces own.yaml "${ten[@]}" --set 'motion={heave: "0.02*(1-cos(2*pi*t))"}'
truth=$(peak)
expect_peak 12.318 0.001 "formula"
run forces own.yaml "${ten[@]}" --set 'motion={samples: h9.csv}'
expect_peak "$truth" 0.001 "9 decimals"
expect_warnings 0 "9 decimals"
for d in 3 4 5 6; do
    run forces own.yaml "${ten[@]}" --set "motion={samples: h$d.csv}"
    expect_warnings 1 "$d decimals"
    run forces own.yaml "${ten[@]}" -q --set "motion={samples: h$d.csv}"
    expect_warnings 1 "$d decimals, -q"
    run forces own.yaml "${ten[@]}" --set "motion={samples: h$d.csv, smooth: rounding}"
    expect_peak "$truth" 0.01 "$d decimals, smooth: rounding"
    expect_warnings 0 "$d decimals, smooth: rounding"
    run forces own.yaml "${ten[@]}" --set "motion={samples: h$d.csv, cutoff: 4}"
    expect_peak "$truth" 0.01 "$d decimals, cutoff: 4"
    expect_warnings 0 "$d decimals, cutoff: 4"
    run forces own.yaml "${ten[@]}" --set "motion={samples: h$d.csv, smooth: {heave: $(awk -v d=$d 'BEGIN { printf "%.9f", 0.288675 * 10 ^ -d }')}}"
    expect_peak "$truth" 0.02 "$d decimals, smooth: {heave: step/sqrt(12)}"
done
run forces own.yaml "${ten[@]}" --set 'motion={samples: h4.csv}'
expect_peak 31.518 0.001 "4 decimals as recorded, of which the warning says:"
grep -Eq "warning: motion.samples has values of heave in steps of 0.0001 m: rounding to them can make accelerations of up to 24 m/s\^2, beside 0.79[0-9]? m/s\^2 of the motion itself; use .motion.smooth: rounding. or .motion.cutoff. \(cycles per s\)" err ||
    fail "the warning of 4 decimals: $(cat err)"
# every verb that reads a study
for verb in "check" "forces" "simulate" "stability" "sweep" "report -o page.html"; do
    [[ $verb != report* ]] || has_page || continue
    # shellcheck disable=SC2086
    run $verb own.yaml "${ten[@]}" --set simulation.duration=0.5 --set 'motion={samples: h3.csv}' --set control.stiffness=5000 --set 'sweep.keys={load.mass: [5, 6]}'
    expect_warnings 1 "$verb"
done
# values declared exact: no warning, but said by check
run forces own.yaml "${ten[@]}" --set 'motion={samples: h4.csv, smooth: none}' -q
expect_warnings 0 "smooth: none"

# check shows the columns, in its units
run check own.yaml "${ten[@]}" --set 'motion={samples: h4.csv, smooth: rounding}'
grep -Eq "record of heave +in steps of 0.0001 m, accelerations up to 0.79[0-9]? m/s\^2;" out || fail "check: $(grep -A3 "record of" out)"
grep -Eq "smoothed above [0-9.]+ cycles per s: values changed by 2.[89]e-05 m" out || fail "check: $(grep -A3 "record of" out)"
run check own.yaml "${ten[@]}" --json --set 'motion={samples: h4.csv}'
jq -e '.program.record | .interval == 0.005 and .even and .time_step == 0 and .columns[0].name == "heave" and .columns[0].step == 0.0001
       and (.columns[0].rounding - 24 | fabs) < 1e-6 and (.columns[0].motion / 0.789568 - 1 | fabs) < 0.02
       and .columns[0].cutoff == null and (.remarks | length) == 1 and .remarks[0].warning' out >/dev/null || fail "check --json: $(jq -c .program.record out)"

# a dimensionless study has no metres and seconds
run check own.yaml "${ten[@]}" --set units=dimensionless --set 'motion={samples: h4.csv}'
grep -Eq "warning: motion.samples has values of heave in steps of 0.0001: rounding to them can make accelerations of up to 24, beside 0.79[0-9]? of the motion itself; .*\(cycles per unit of time\)" err || fail "dimensionless: $(cat err)"

# digits instead of decimals: the same relative rounding; text of 17 digits of a rounded number
awk 'BEGIN { print "t,heave"; for (i = 0; i <= 2000; i++) printf "%.3f,%.3g\n", i * 0.005, 0.02 * (1 - cos(6.283185307179586 * i * 0.005)) }' >digits.csv
run check own.yaml "${ten[@]}" --json --set 'motion={samples: digits.csv}'
jq -e '.program.record.columns[0].step == 0.0001' out >/dev/null || fail "three digits: $(jq -c .program.record out)"
awk 'BEGIN { print "t,heave"; q = 0.02 / 137; for (i = 0; i <= 2000; i++) printf "%.3f,%.17g\n", i * 0.005, q * int(0.5 + 0.02 / q * (1 - cos(6.283185307179586 * i * 0.005))) }' >counts.csv
run check own.yaml "${ten[@]}" --json --set 'motion={samples: counts.csv}'
jq -e '(.program.record.columns[0].step / (0.02 / 137) - 1 | fabs) < 1e-6' out >/dev/null || fail "counts: $(jq -c .program.record out)"
run forces own.yaml "${ten[@]}" --set 'motion={samples: counts.csv, smooth: rounding}'
expect_peak "$truth" 0.01 "counts, smooth: rounding"

# ---- rounded times: 60 rows a second, times in milliseconds
awk 'BEGIN { print "t,heave"; for (i = 0; i <= 600; i++) printf "%.3f,%.9f\n", i / 60, 0.02 * (1 - cos(6.283185307179586 * i / 60)) }' >ms.csv
run forces own.yaml "${ten[@]}" --set 'motion={samples: ms.csv}'
grep -q "warning: motion.samples has .*times in steps of 0.001 s" err || fail "rounded times: $(cat err)"
run forces own.yaml "${ten[@]}" --set 'motion={samples: ms.csv, smooth: rounding}'
expect_peak "$truth" 0.01 "rounded times, smooth: rounding"
grep -q "the times, rounded to 0.001 s, are read as equal steps of 0.0166667 s" err || fail "times made even: $(cat err)"
# a row lost is no rounding
sed 100d h9.csv >lost.csv
run check own.yaml "${ten[@]}" --json --set 'motion={samples: lost.csv}'
jq -e '.program.record | .time_step == 0 and .even and .interval == 0.005' out >/dev/null || fail "a lost row: $(jq -c .program.record out)"
awk -F, 'NR == 1 { print; next } { printf "%.2f,%s\n", $1, $2 }' h9.csv >cs.csv
run check own.yaml "${ten[@]}" --set 'motion={samples: cs.csv}'
expect_code 2 "times of two decimals"
grep -q "if the times are rounded to 2 decimals, record more digits" err || fail "two equal times: $(head -1 err)"

# ---- smoothing in a sweep and as a key
run sweep own.yaml "${ten[@]}" --set simulation.duration=1 --set 'motion={samples: h3.csv, cutoff: 4}' --set control.stiffness=5000 \
    --set 'sweep.keys={motion.cutoff: [2, 4, 8, 500]}' -q -o sweep.csv
expect_code 0 "sweep over motion.cutoff"
awk -F, 'NR > 1' sweep.csv | cut -d, -f2- | sort -u | wc -l | grep -qx "[4-9]" || fail "a sweep over motion.cutoff changes nothing: $(cat sweep.csv)"
run check own.yaml --set motion.smooth=rounding
grep -q "smooths recorded motion, but there is no .motion.samples." err || fail "smooth without samples: $(cat err)"
run check own.yaml --set 'motion={samples: h4.csv, smooth: rounding, cutoff: 3}'
grep -q "both .cutoff. and .smooth" err || fail "smooth beside cutoff: $(cat err)"
# the run with 33 digits takes the same smoothed rows
for precision in double quad; do
    run forces own.yaml --set 'motion={samples: h4.csv, smooth: rounding}' --set simulation.duration=1 --precision $precision -o $precision.csv
done
paste -d, <(column double.csv f1) <(column quad.csv f1) | awk -F, '{ d = $1 / $2 - 1; if (!(d < 1e-9 && d > -1e-9)) bad++ } END { exit bad > 0 || NR < 10 }' ||
    fail "double and quad differ"
finish
