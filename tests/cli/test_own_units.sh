#!/usr/bin/env bash
# Units of a study: what is refused and where, the question whether mm is meant, and what check says of a pose and of external loads
# in mm, N and kg beside the same machine in m, N and kg.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1

machine() { # length unit, numbers per metre
    awk -v unit="$1" -v k="$2" 'BEGIN {
        printf "units: {length: %s}\n", unit
        printf "platform: {base: {radius: %.17g, half_angle: 10}, top: {radius: %.17g, half_angle: 12}, height: %.17g}\n", 1.5 * k, k, 1.2 * k
        printf "load: {mass: 500, inertia: [%.17g, %.17g, %.17g]}\n", 100 * k * k, 110 * k * k, 150 * k * k
        printf "external: [{force: [0, 0, \"300 + 10*sin(t)\"], moment: [%.17g, 0, 0], at: [%.17g, 0, 0]}]\n", 20 * k, 0.1 * k
        printf "control: {stiffness: %.17g, damping: %.17g}\n", 2e5 / k, 2e4 / k
        print "simulation: {duration: 1, output_step: 0.1}" }'
}
machine m 1 >metres.yaml
machine mm 1000 >millimetres.yaml

# ---- refused ----
refuse() { # units, place, what is said
    { echo "units: $1"; tail -n +2 metres.yaml; } >wrong.yaml
    run check wrong.yaml
    expect_code 2 "units: $1"
    grep -qF "wrong.yaml:1:$2: error: " "$err" && grep -qF -- "$3" "$err" || fail "units: $1: $(head -3 "$err")"
}
refuse '{length: mn}' 17 'mm'
refuse '{lenght: mm}' 9 'length'
refuse '{length: N}' 17 '`units.length` must be a unit of length; `N` is one of force'
refuse '{force: N/mm}' 16 'must be a single unit, found `N/mm`'
refuse '{length: mm, length: m}' 21 'duplicate key'
refuse 'metric' 8 'dimensionless'
refuse '[mm, N]' 8 'a mapping such as'

# ---- 9806.65 ----
run check millimetres.yaml --set gravity=9806.65
expect_code 0 "gravity in mm/s^2"
grep -q 'are in mm' "$err" && fail "asks for mm where mm is said: $(cat "$err")"
run check metres.yaml --set gravity=9806.65
grep -q 'gravity is 9806.65 m/s^2.*units: {length: mm}' "$err" || fail "does not ask whether mm is meant: $(cat "$err")"
"$GOUGH" check millimetres.yaml --json -q >default.json
jq -e '(.time_unit * .time_unit * 9806.65 / 1500 - 1 | fabs) < 1e-12' default.json >/dev/null ||
    fail "standard gravity: $(jq -c .time_unit default.json)"

# ---- a pose and external loads: the same numbers but for the unit ----
for study in metres millimetres; do
    [[ $study == metres ]] && surge=0.1 || surge=100
    "$GOUGH" check $study.yaml --pose surge=$surge,yaw=5 --json -q >$study.json || fail "$study: check --pose"
    "$GOUGH" check $study.yaml --pose surge=$surge,yaw=5 -q >/dev/null 2>&1 || fail "$study: check --pose as text"
    "$GOUGH" check $study.yaml --pose surge=$surge,yaw=5 2>/dev/null >$study.txt
done
jq -en --slurpfile m metres.json --slurpfile mm millimetres.json '
    def near(a; b): (a - b | fabs) <= 1e-11 * ((a | fabs) + 1e-9);
    def block(i; j): (if i < 3 then 1 else 1000 end) * (if j < 3 then 0.001 else 1 end);
    $m[0].pose as $a | $mm[0].pose as $b |
    [range(6) as $i | near($a.length[$i] * 1000; $b.length[$i]), near($a.force[$i]; $b.force[$i]),
     (range(6) as $j | near($a.stiffness[$i][$j] * block($i; $j); $b.stiffness[$i][$j]),
        near($a.compliance[$j][$i] / block($i; $j); $b.compliance[$j][$i]))] + [near($a.condition; $b.condition)] +
    [$mm[0].external[0].force == [0, 0, 300], $mm[0].external[0].moment == [20000, 0, 0], $mm[0].external[0].at == [100, 0, 0]] | all' \
    >/dev/null || fail "check --pose: $(jq -c .pose metres.json millimetres.json)"
for line in '[N/mm, N/rad; N, N mm/rad]' '[mm/N, 1/N; rad/N, rad/(N mm)]' 'At rest at surge 100 mm, yaw 5 deg' \
    'force 0, 0, 300 N, moment 20000, 0, 0 N mm at t = 0' 'at 100, 0, 0 mm in the top frame'; do
    grep -qF "$line" millimetres.txt || fail "check --pose in mm lacks '$line': $(grep -A3 -E 'External|rest at|control and' millimetres.txt)"
done
grep -qF '[N/m, N/rad; N, N m/rad]' metres.txt || fail "check --pose in m: $(grep control metres.txt)"

# ---- what other units do to layout: headings stay apart, six equal strokes are one ----
run stability millimetres.yaml --set units='{length: mm, time: ms, angle: mrad}' --set external='[{force: [0, 0, 300]}]'
sed 's/^    mode.*growth/mode growth/' "$out" | grep -qE '^mode growth \[1/ms\] +frequency \[rad/ms\] +tenfold in \[ms\] +period \[ms\]' ||
    fail "headings of stability: $(grep growth "$out" | head -1)"
run check millimetres.yaml --set platform.legs.stroke='[-200, 300]'
[[ $(grep 'length limits' "$out" | grep -o ' to ' | wc -l) == 1 ]] || fail "six equal strokes: $(grep 'length limits' "$out")"
run forces millimetres.yaml --set platform.legs.stroke='[-200, 300]'
[[ $(grep -c 'mm available' "$out") == 1 ]] || fail "six equal strokes: $(grep available "$out")"

# ---- both ends of a stroke, and ranges of angles ----
run check millimetres.yaml --set platform.legs.stroke='[-200, 300]' --json
jq -e '[.home_length, .limits.legs.length] | transpose | length == 6 and all(.[]; (.[1][0] - .[0] + 200 | fabs) < 1e-9 and (.[1][1] - .[0] - 300 | fabs) < 1e-9)' "$out" >/dev/null ||
    fail "a stroke of -200 to 300 mm: $(jq -c '[.home_length, .limits.legs.length]' "$out")"
machine m 1 | sed 's/half_angle: 10/half_angle: 0.17/; s/half_angle: 12/half_angle: 0.2/; s/{length: m}/{angle: rad}/' >radians.yaml
for limits in 'roll: 3.2' 'roll: [-3.2, 1]' 'pitch: [-1, 1.6]'; do
    run check radians.yaml --set "platform.limits={$limits}"
    expect_code 2 "limits of $limits rad"
    grep -q 'must be from -[0-9]* to [0-9]* degrees ([0-9.]* rad), found' "$err" || fail "limits of $limits rad: $(head -1 "$err")"
done
run check radians.yaml --set 'platform.limits={roll: [-3.1, 3.1], pitch: 1.5}'
expect_code 0 "limits below 180 and 90 degrees: $(head -1 "$err")"
run check radians.yaml --set 'platform.joints={base_swing: [3.2, 1, 1, 1, 1, 1]}'
expect_code 2 "a swing of 3.2 rad"
run check radians.yaml --set 'units={angle: arcsec}' --set platform.base.half_angle=36000 --set platform.top.half_angle=43200 --set 'platform.limits={roll: 648000, pitch: [-100000, 324000]}'
expect_code 0 "limits in arcsec: $(head -1 "$err")"
finish
