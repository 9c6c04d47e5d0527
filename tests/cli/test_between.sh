#!/usr/bin/env bash
# forces and simulate print the peaks, energies and exceeded limits of the motion, not of the rows, however far apart these are.
# Compared with closed forms of pure heave: l² = h² + d², l' = h h'/l, F = M (g + h'') l/(6h).
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

machine() { # HEAVE DURATION OUTPUT_STEP
    cat <<EOF
units: dimensionless
platform:
  base: {radius: 1, half_angle: 10}
  top: {radius: 0.6, half_angle: 6.4688478326275441}
  height: 1
load: {mass: 1, inertia: [0.08, 0.08, 0.15]}
motion: {heave: "$1"}
control: {stiffness: 50, damping: 5}
simulation: {duration: $2, output_step: $3, tolerance: 1e-11}
EOF
}
# closed FROM TO STEPS: extremes and integrals of the heave that $heave defines in awk: z, v, a of t
closed() {
    awk -v from="$1" -v to="$2" -v n="$3" "function heave(t) { $heave }"'
        function note(x, k) { if (!(k in low)) low[k] = top[k] = x; if (x > top[k]) top[k] = x; if (x < low[k]) low[k] = x }
        BEGIN {
            pi = atan2(0, -1); delta = (60 - 10 - 6.4688478326275441) * pi / 180; d2 = 1 + 0.36 - 1.2 * cos(delta)
            for (i = 0; i <= n; i++) {
                t = from + (to - from) * i / n; heave(t); h = 1 + z; l = sqrt(h * h + d2); F = (1 + a) * l / (6 * h); r = h * v / l
                note(l, "l"); note(r, "r"); note(F, "F"); note(F * r, "P")
                w = i == 0 || i == n ? 1 : i % 2 ? 4 : 2
                square += w * F * F; work += w * F * r
            }
            speed = top["r"] > -low["r"] ? top["r"] : -low["r"]
            printf "%.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g\n", low["l"], top["l"], speed, low["F"], top["F"],
                low["P"], top["P"], sqrt(square / 3 / n), work * (to - from) / 3 / n
        }'
}
# near NAME JSON WANTED…: all six legs have these numbers to five digits
near() {
    local name=$1 file=$2
    jq -e --argjson w "[$(tr ' ' ',' <<<"$3")]" '
        def near(a; b; size): (a - b | fabs) <= 1e-5 * size;
        .legs | all(near(.length[0]; $w[0]; 1) and near(.length[1]; $w[1]; 1) and near(.speed; $w[2]; $w[2]) and
                    near(.force[0]; $w[3]; $w[4]) and near(.force[1]; $w[4]; $w[4]) and near(.power[0]; $w[5]; $w[6]) and
                    near(.power[1]; $w[6]; $w[6]) and near(.rms_force; $w[7]; $w[7]) and near(.energy; $w[8]; $w[6]))' "$file" >/dev/null ||
        fail "$name: $(jq -c '.legs[0]' "$file"), not $3"
}

# eight periods from row to row: the rows show rest
machine '0.2*sin(16*pi*t)' 10 1 >"$scratch/fast.yaml"
heave='z = 0.2 * sin(16 * pi * t); v = 3.2 * pi * cos(16 * pi * t); a = -51.2 * pi * pi * sin(16 * pi * t)'
wanted=$(closed 0 10 200000)
run forces "$scratch/fast.yaml" --json
expect_code 0 "a fast motion"
near "eight periods a row" "$scratch/out" "$wanted"
run forces "$scratch/fast.yaml" --set 'platform.legs={length: [1.2, 1.4], max_force: 5}' --json
expect_code 1 "a fast motion beyond limits"
jq -e '([.limits[] | select(.kind == "leg_short") | .count] | all(. == 80)) and ([.limits[] | select(.kind == "leg_long") | .count] | all(. == 0)) and
       ([.limits[] | select(.kind == "leg_force") | .count] | all(. == 160))' "$scratch/out" >/dev/null ||
    fail "how often limits are exceeded: $(jq -c '[.limits[] | [.leg, .kind, .count]]' "$scratch/out")"
run forces "$scratch/fast.yaml"
grep -A1 'rows .*too far apart to draw the motion: between two rows leg [1-6] moves up to' "$scratch/out" | grep -qE '^ +0\.[0-9]+ beyond both; to draw it, set simulation.output_step to 0\.00[0-9]+ or less$' ||
    fail "nothing is said of rows too far apart: $(grep -A1 ' rows ' "$scratch/out")"
step=$(sed -n 's/.*output_step to \([0-9.]*\) or less.*/\1/p' "$scratch/out")
run forces "$scratch/fast.yaml" --set "simulation.output_step=$step"
! grep -q 'too far apart' "$scratch/out" || fail "the output_step named, $step, is too long by its own measure"

# the rest of the duration after the last row is looked at too
machine '0.1*sin(t)' 3 2 >"$scratch/rest.yaml"
heave='z = 0.1 * sin(t); v = 0.1 * cos(t); a = -0.1 * sin(t)'
run forces "$scratch/rest.yaml" --json
near "after the last row" "$scratch/out" "$(closed 0 3 20000)"

# a pulse at half height as wide as a hundredth of output_step, at rest otherwise, wherever it is; ramps and moves too
width=0.003
for place in 0.5 1.7351 2.00391 3.28817 4.9993 5.51 6.123457 7.87 8.0077 9.31; do
    machine "0.00001*exp(-((t - $place)/$width)^2)" 10 0.5 >"$scratch/pulse.yaml"
    heave="s = (t - $place) / $width; e = 0.00001 * exp(-s * s); z = e; v = -2 * s * e / $width; a = (4 * s * s - 2) * e / $width ^ 2"
    read -r low top speed force_low force_top power_low power_top _ < <(closed "$(awk "BEGIN { print $place - 0.02 }")" "$(awk "BEGIN { print $place + 0.02 }")" 40000)
    run forces "$scratch/pulse.yaml" --json
    jq -e --argjson top "$force_top" --argjson low "$force_low" --argjson speed "$speed" --argjson power "$power_top" '.legs | all(
        (.force[1] / $top - 1 | fabs) < 1e-4 and (.force[0] - $low | fabs) < 1e-4 * $top and (.speed / $speed - 1 | fabs) < 1e-4 and
        (.power[1] / $power - 1 | fabs) < 1e-4)' "$scratch/out" >/dev/null || fail "a pulse at $place: $(jq -c '.legs[0]' "$scratch/out"), not $force_low $force_top $speed"
done

# a ramp up and down, each a hundredth of output_step long, and one of a 5000th, between two rows: their ends are corners, so no
# look passes over them
for case in 0.7:0.005 1.2345:0.005 2.4949:0.005 3.9:0.005 0.7003:0.0001 1.2345:0.0001 2.4949:0.0001 5.503:0.0001; do
    place=${case%:*} length=${case#*:}
    machine "0.00001*(ramp(t - $place, $length) - ramp(t - $place - $length, $length))" 6 0.5 >"$scratch/ramp.yaml"
    heave="s = (t - $place) / $length; way = s > 1 ? -1 : 1; s = s > 1 ? 2 - s : s; z = 0.00001 * s * s * s * (10 - 15 * s + 6 * s * s)
        v = way * 0.0003 * s * s * (1 - s) * (1 - s) / $length; a = 0.0006 * s * (1 - s) * (1 - 2 * s) / $length ^ 2"
    read -r low top speed force_low force_top power_low power_top _ < <(closed "$place" "$(awk "BEGIN { print $place + 2 * $length }")" 40000)
    run forces "$scratch/ramp.yaml" --json
    jq -e --argjson top "$force_top" --argjson low "$force_low" --argjson speed "$speed" --argjson least "$power_low" --argjson power "$power_top" '
        .legs | all((.force[1] / $top - 1 | fabs) < 1e-6 and (.force[0] / $low - 1 | fabs) < 1e-6 and (.speed / $speed - 1 | fabs) < 1e-6 and
        (.power[1] / $power - 1 | fabs) < 1e-5 and (.power[0] / $least - 1 | fabs) < 1e-5)' "$scratch/out" >/dev/null ||
        fail "a ramp of $length at $place: $(jq -c '.legs[0]' "$scratch/out"), not $force_low $force_top $speed $power_low $power_top"
    run forces "$scratch/ramp.yaml"
    grep -qF " $(awk -v s="$speed" 'BEGIN { printf "%.4g", s }')" "$scratch/out" || fail "a ramp of $length at $place: the table does not have the speed $speed: $(cat "$scratch/out")"
done

# check: the range of the program is that of the motion. [KEY] LEAST GREATEST of --json to 1e-9, and a line of the text
range() { # range NAME STUDY COMPONENT LEAST GREATEST TEXT
    run check "$2" --json
    expect_code 0 "check, $1"
    jq -e --argjson low "$4" --argjson top "$5" ".program.$3 | (.[0] - \$low | fabs) <= 1e-9 * (\$top - \$low) and (.[1] - \$top | fabs) <= 1e-9 * (\$top - \$low)" \
        "$scratch/out" >/dev/null || fail "check, $1: $3 $(jq -c ".program.$3" "$scratch/out"), not $4 to $5"
    run check "$2"
    grep -qE "^  $3 +$6\$" "$scratch/out" || fail "check, $1: the text has '$(grep "^  $3" "$scratch/out")', not $6"
}
range "eight periods a row" "$scratch/fast.yaml" heave -0.2 0.2 '-0\.2 to 0\.2'
machine "0.00001*(ramp(t - 1.2345, 0.005) - 2*ramp(t - 1.2395, 0.005) + ramp(t - 3.1, 0.001))" 10 0.5 >"$scratch/pulse.yaml"
range "ramps up and down" "$scratch/pulse.yaml" heave -0.00001 0.00001 '-1e-05 to 1e-05'
machine "0.00001*exp(-((t - 1.2345)/0.003)^2)" 10 0.5 >"$scratch/pulse.yaml"
range "a pulse" "$scratch/pulse.yaml" heave 0 0.00001 '0 to 1e-05'
machine "0.01*(2*t - 10)^4/10000 - 0.01*(2*t - 10)^2/200 + 0*t" 10 20 >"$scratch/quartic.yaml" # least at (2t - 10)² = 25
range "a quartic in one row" "$scratch/quartic.yaml" heave -0.000625 0.005 '-0\.000625 to 0\.005'
machine "0.01*sin(t)" 2 3 >"$scratch/rest.yaml"
range "after the last row" "$scratch/rest.yaml" heave 0 0.01 '0 to 0\.01'
run check "$scratch/rest.yaml" --set "motion.pitch=3*sin(40*t)" --json
jq -e '.program.pitch | map(. + 3 < 1e-8 or (. - 3 | fabs) < 1e-8) | all' "$scratch/out" >/dev/null || fail "check, degrees: $(jq -c .program "$scratch/out")"
# a spline through four samples, between which it goes beyond them: y = 16 t (1 - t) in a cubic
printf 't,heave\n0,0\n0.3,0.00336\n0.6,0.00384\n1,0\n' >"$scratch/record.csv"
machine 0 1 0.5 | sed "s|^motion:.*|motion: {samples: record.csv}|" >"$scratch/record.yaml"
range "a recording" "$scratch/record.yaml" heave 0 0.004 '0 to 0\.004'
run check "$scratch/record.yaml" --set motion.amplitude=-2 --json
jq -e '.program.heave | (.[0] + 0.008 | fabs) < 1e-11 and (.[1] | fabs) < 1e-11' "$scratch/out" >/dev/null || fail "check, a recording, scaled: $(jq -c .program.heave "$scratch/out")"
# a component that is not finite between rows is refused, as forces does
machine "0.01*log(t - 0.25)*0 + 0.01*(t - 1.25)^3*0 + 0.001*sqrt(1.3 - t)" 2 2 >"$scratch/bad.yaml"
run check "$scratch/bad.yaml"
expect_code 2 "not finite"
grep -q 'motion.heave (value or derivatives) is not finite at t = ' "$scratch/err" || fail "not finite: $(cat "$scratch/err")"

# simulate, whose rows are as far apart, held by feedback: steps are looked at between them
machine '0.1*sin(4*pi*t)*ramp(t, 1)' 6 1 >"$scratch/held.yaml"
run simulate "$scratch/held.yaml" --json
cp "$scratch/out" "$scratch/coarse.json"
run simulate "$scratch/held.yaml" --set simulation.output_step=0.001 --json
jq -es '.[0].legs as $a | .[1].legs as $b | [range(6)] | all(. as $i |
    def near(x; y; size): (x - y | fabs) <= 2e-4 * size;
    near($a[$i].length[0]; $b[$i].length[0]; 1) and near($a[$i].length[1]; $b[$i].length[1]; 1) and
    near($a[$i].speed; $b[$i].speed; $b[$i].speed) and near($a[$i].force[0]; $b[$i].force[0]; $b[$i].force[1]) and
    near($a[$i].force[1]; $b[$i].force[1]; $b[$i].force[1]) and near($a[$i].power[1]; $b[$i].power[1]; $b[$i].power[1]) and
    near($a[$i].rms_force; $b[$i].rms_force; $b[$i].rms_force))' "$scratch/coarse.json" "$scratch/out" >/dev/null ||
    fail "simulate with far rows: $(jq -c '.legs[0]' "$scratch/coarse.json"), with close ones $(jq -c '.legs[0]' "$scratch/out")"
finish
