#!/usr/bin/env bash
# forces and simulate print the peaks, energies and exceeded limits of the motion, not of the rows, however far apart these are.
# Compared with closed forms of pure heave: l² = h² + d², l' = h h'/l, F = M (g + h'') l/(6h).
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
grep -A1 'rows .*too far apart to draw the motion: between two rows leg [1-6] moves up to' "$scratch/out" | grep -qE '^ +0\.[0-9]+ beyond both; simulation.output_step 0\.00[0-9]+ or less draws it$' ||
    fail "nothing is said of rows too far apart: $(grep -A1 ' rows ' "$scratch/out")"
step=$(sed -n 's/.*output_step \([0-9.]*\) or less.*/\1/p' "$scratch/out")
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
