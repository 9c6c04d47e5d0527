#!/usr/bin/env bash
# The figure duty: limits are those of the study or of the options, in the table's units; points are the RMS of force and rate of each leg,
# and curves the rows, read from the picture with the limits as a rule.
# Label: standard
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
cd "$scratch"
"$GOUGH" example flight-simulator-legs >legs.yaml
"$GOUGH" forces legs.yaml -q --set simulation.output_step=0.01 -o legs.h5 -o legs.csv
"$GOUGH" forces legs.yaml -q --dimensionless -o bare.h5
"$GOUGH" plot legs.h5 -q --figure duty -o legs.svg
"$GOUGH" plot legs.csv -q --figure duty -o csv.svg
"$GOUGH" plot legs.csv -q --figure duty --max-speed 1.2 --max-force 8000 -o asked.svg
"$GOUGH" plot legs.csv -q --figure duty --max-speed 2 -o speed.svg
"$GOUGH" plot bare.h5 -q --figure duty -o bare.svg
"$GOUGH" plot legs.h5 -q --figure duty --from 5 --to 10 -o later.svg

texts() { grep -o '<text>[^<]*</text>' "$1" | sed 's/<[^>]*>//g' | grep -v '^ *$'; }
says() { grep -qxF "$2" <(texts "$1") || fail "$1 does not say '$2'"; }
says legs.svg 'Flight simulator with the mass and friction of its legs'
for figure in legs later; do says $figure.svg 'Drive force of each leg (N)'; says $figure.svg 'leg rate (m/s)'; done
says bare.svg 'Drive force of each leg (M g)'; says bare.svg 'leg rate (√(R_b g))'
for figure in legs asked speed bare later; do says $figure.svg limits; says $figure.svg 'RMS of a leg'; done
grep -q limits <(texts csv.svg) && fail 'CSV knows limits'
for leg in 1 2 3 4 5 6; do says legs.svg $leg; done

# the frame of the limits in pixels: left bottom right top; two lines where there is one limit
frame() { grep -o "stroke-dasharray='4[^']*'  d='[^']*'" "$1" | sed "s/.* d='//; s/'//" | tr 'ML,' '   '; }
read -r -a edge < <(frame legs.svg | awk 'NF == 14 { print $5, $6, $9, $10 }')
((${#edge[@]} == 4)) || fail "no frame: $(frame legs.svg)"
# without a title all stands higher
shape() { frame "$1" | awk '{ printf "%.1f %.1f\n", $9 - $5, $10 - $6 }'; }
[[ $(shape asked.svg) == "$(shape legs.svg)" ]] || fail 'limits asked for are not those of the study'
[[ $(frame speed.svg | wc -l) == 2 ]] || fail 'one limit has two lines'
frame speed.svg | awk '{ n = NF; if ($(n - 1) != $(n - 3)) exit 1 }' || fail 'the limit of speed is upright'

points() { grep -o "gpPt6' transform='translate([^)]*)" "$1" | sed 's/.*translate(//; s/)//' | tr ',' ' ' | awk 'NR != 2'; }
value() { awk -v l="${edge[0]}" -v b="${edge[1]}" -v r="${edge[2]}" -v t="${edge[3]}" '{ print -1.2 + 2.4 * ($1 - l) / (r - l), -8000 + 16000 * ($2 - b) / (t - b) }'; }
rms() { # rms FROM TO: over rows, by the trapezium
    awk -F, -v from="$1" -v to="$2" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["t"] >= from && $at["t"] <= to { t = $at["t"]; for (k = 1; k <= 6; k++) { v = $at["dl" k] ^ 2; f = $at["f" k] ^ 2
            if (n) { V[k] += (v + a[k]) / 2 * (t - last); F[k] += (f + c[k]) / 2 * (t - last) } a[k] = v; c[k] = f }
            if (!n++) first = t; last = t }
        END { for (k = 1; k <= 6; k++) print sqrt(V[k] / (last - first)), sqrt(F[k] / (last - first)) }' legs.csv
}
points legs.svg | value >drawn
rms 0 20 | paste -d' ' drawn - | awk 'NF != 4 || ($1 - $3) ^ 2 > 1e-6 || ($2 - $4) ^ 2 > 400 { print; bad = 1 } END { exit bad || NR != 6 }' >said ||
    fail "RMS points: $(cat said)"
# the same are the RMS forces of the summary
"$GOUGH" forces legs.yaml -q --json | jq -r '.legs[].rms_force' | paste -d' ' drawn - | awk '($2 - $3) ^ 2 > 400 { exit 1 }' || fail 'RMS of the summary'

# leg 5's curve: its furthest points are the peaks of its rows
tr '\n' ' ' <legs.svg | grep -o "<path stroke='rgb(197, 109, 157)'  d='[^']*'" | tail -1 | sed "s/.* d='//; s/'//" | tr 'ML' '\n\n' | tr ',' ' ' | awk 'NF == 2' | value | awk '$2 < 7900' >curve # but for the key
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { print $at["dl5"], $at["f5"] }' legs.csv >rows
extremes() { awk 'NR == 1 { a = b = $1; c = d = $2 } { if ($1 < a) a = $1; if ($1 > b) b = $1; if ($2 < c) c = $2; if ($2 > d) d = $2 } END { print a, b, c, d }' "$1"; }
paste -d' ' <(extremes curve) <(extremes rows) | awk '{ exit !(($1 - $5) ^ 2 < 1e-5 && ($2 - $6) ^ 2 < 1e-5 && ($3 - $7) ^ 2 < 900 && ($4 - $8) ^ 2 < 900) }' ||
    fail "curve of leg 5: $(extremes curve) for $(extremes rows)"

# attributes of the file, in its units: R_b = 1.5 m, M = 1050 kg, g = 9.80665 m/s²
if command -v h5dump >/dev/null; then
    attribute() { h5dump -a "/$2" "$1" | sed -n 's/^ *(0): //p'; }
    [[ $(attribute legs.h5 max_force) == 8000 && $(attribute legs.h5 max_speed) == 1.2 ]] || fail "limits of the file: $(attribute legs.h5 max_force)"
    awk -v f="$(attribute bare.h5 max_force)" -v v="$(attribute bare.h5 max_speed)" 'BEGIN { a = f * 1050 * 9.80665 / 8000 - 1; b = v * sqrt(1.5 * 9.80665) / 1.2 - 1
        exit !(a * a < 1e-10 && b * b < 1e-10) }' || fail "limits without dimensions: $(attribute bare.h5 max_force) $(attribute bare.h5 max_speed)"
fi
# limits that legs do not share, or that differ by direction, are no limits of all
for limits in 'platform.legs.max_force=[8000, 8000, 8000, 7000, 8000, 8000]' 'platform.legs={force: [-1500, 8000]}'; do
    "$GOUGH" forces legs.yaml -q --set "$limits" -o other.h5 || [[ $? == 1 ]] || fail "--set $limits"
    "$GOUGH" plot other.h5 -q --figure duty --max-speed 1 -o other.svg
    [[ $(frame other.svg | wc -l) == 2 ]] || fail "limits of all legs with $limits: $(frame other.svg)"
done
for wrong in 0 -1 nan 8kN; do
    "$GOUGH" plot legs.csv -q --figure duty --max-force=$wrong -o wrong.svg 2>err && fail "--max-force=$wrong is taken"
    grep -q -- "--max-force takes a number above 0; got '$wrong'" err || fail "--max-force=$wrong: $(cat err)"
done
