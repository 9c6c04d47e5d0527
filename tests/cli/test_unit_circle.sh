#!/usr/bin/env bash
# Joints listed on the unit circle, gravity 1: the base radius is exactly 1, so rows are at k output_step exactly, in quad too.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
joints() { # RADIUS HALF_ANGLE FIRST SIGN: pairs at ±HALF_ANGLE in the order of the legs
    awk -v r="$1" -v half="$2" -v top="$3" 'BEGIN {
        pi = atan2(0, -1)
        for (n = 0; n < 6; n++) {
            pair = top ? 60 + 120 * int(n / 2) : 120 * (int((n + 1) / 2) % 3)
            side = (n % 2 == 0) != top ? 1 : -1
            angle = (pair + side * half) * pi / 180
            printf "%s[%.17g, %.17g, 0]", n ? ", " : "", r * cos(angle), r * sin(angle)
        }
    }'
}
for half in 10 11 13 17 19 23; do
    cat >"$scratch/circle.yaml" <<EOF
units: dimensionless
platform: {base: {joints: [$(joints 1 "$half" 0)]}, top: {joints: [$(joints 0.6 6.4688478326275441 1)]}, height: 1}
load: {mass: 1, inertia: [0.08, 0.08, 0.15]}
motion: {heave: 0.2*sin(t)}
simulation: {duration: 3, output_step: 0.1}
EOF
    run check "$scratch/circle.yaml" --json
    expect_code 0 "check at half angle $half"
    grep -q '"base_radius": 1.0,' "$scratch/out" || fail "half angle $half: $(grep base_radius "$scratch/out")"
    for option in '' --dimensionless; do
        "$GOUGH" forces "$scratch/circle.yaml" $option -q -o "$scratch/double.csv" || fail "forces $option"
        column "$scratch/double.csv" t | awk '$1 != sprintf("%.17g", (NR - 1) * 0.1) { exit 1 }' || fail "half angle $half: rows are off their times $option"
        "$GOUGH" forces "$scratch/circle.yaml" $option --precision quad -q -o "$scratch/quad.csv" || fail "forces in quad $option"
        # the double nearest to 0.1 in decimals: what a quad has to show of it
        [[ $(column "$scratch/quad.csv" t | sed -n 2p) == 0.10000000000000000555111512312578* ]] ||
            fail "half angle $half: quad row at $(column "$scratch/quad.csv" t | sed -n 2p) $option"
    done
done
# the same machine written with its radius has the same numbers
sed -e "s/base: {joints: .*}, top: {joints: .*}, height/base: {radius: 1, half_angle: 23}, top: {radius: 0.6, half_angle: 6.4688478326275441}, height/" "$scratch/circle.yaml" >"$scratch/radius.yaml"
grep -q 'half_angle: 23' "$scratch/radius.yaml" || fail "the second machine was not made"
"$GOUGH" forces "$scratch/radius.yaml" -q -o "$scratch/radius.csv" || fail "forces of the second machine"
paste -d' ' <(column "$scratch/double.csv" f1) <(column "$scratch/radius.csv" f1) |
    awk '!($1 - $2 < 1e-14 && $2 - $1 < 1e-14) { bad = 1 } END { exit bad || NR != 31 }' || fail "forces differ from those of the machine with a radius"
finish
