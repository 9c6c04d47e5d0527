#!/usr/bin/env bash
# gough stability: the theory's numbers through the command; the keys of its JSON; matrix and eigenvalues agree; what does not fit is
# refused.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example paper-heave >heave.yaml
"$GOUGH" example own-machine >own.yaml

near() { # near WHAT VALUE EXPECTED TOLERANCE; what is no number fails
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; exit !(a != "" && a !~ /nan|null/ && d <= t + 0 && -d <= t + 0) }' ||
        fail "$1: $2 instead of $3 within $4"
}
refused() { # refused SENTENCE ARGUMENT…
    local sentence=$1
    shift
    run "$@"
    expect_code 2 "$@"
    [[ ! -s out ]] || fail "$*: standard output is not empty"
    grep -qF -- "$sentence" err || fail "$*: does not say '$sentence' but: $(cat err)"
}

# ---- at rest: the closed forms (stab-4) to (stab-10) for h = 1, R = 1, r = 0.6, d = 0.7 ----
run stability heave.yaml --json
expect_code 0 "an unstable loop"
cp out open.json
awk 'BEGIN { h = 1; R = 1; r = 0.6; d2 = 0.49; l2 = h * h + d2; c = (R * R + r * r - d2) / (2 * R * r); s2 = 1 - c * c; q = r * r - r * R * c
    kx = -(l2 + h * h) / (2 * l2 * h); ko = -q / (2 * l2); kt = -(r * r * d2 / l2 - q) / (2 * h)
    jx = 3 * d2 / l2; jo = -3 * h * q / l2; jt = 3 * r * r * h * h / l2
    A = jx * jt - jo * jo; B = kx * jt + kt * jx - 2 * ko * jo; C = kx * kt - ko * ko; D = sqrt(B * B - 4 * A * C)
    printf "%.15g %.15g %.15g %.15g %.15g\n", sqrt(d2 / (h * l2)), d2 / (6 * h ^ 3), (l2 * c / (R * r * s2) - 1) / (6 * h), (-B + D) / (2 * A), (-B - D) / (2 * A) }' >forms
read -r rate heave yaw tilt low <forms
threshold() { jq -r --arg mode "$1" "[.thresholds[] | select(.mode == \$mode) | .stiffness] | .[${2:-0}]" open.json; }
near "heave's threshold" "$(threshold heave)" "$heave" 1e-13
near "yaw's threshold" "$(threshold yaw)" "$yaw" 1e-13
near "the greater threshold of sway with tilt" "$(threshold sway–tilt 0)" "$tilt" 1e-12
near "its twin" "$(threshold sway–tilt 1)" "$tilt" 1e-12
near "the lesser" "$(threshold sway–tilt 2)" "$low" 1e-12
near "heave's growth rate" "$(jq '[.eigenvalues, .modes] | transpose | map(select(.[1].name == "heave") | .[0][0]) | max' open.json)" "$rate" 1e-13
near "the trace" "$(jq .trace open.json)" -2 1e-13
[[ $(jq -c '[.thresholds[].stiffness] | . == (sort | reverse)' open.json) == true ]] || fail "thresholds do not fall"
grep -q '^  Without feedback some mode always grows' <("$GOUGH" stability heave.yaml) || fail "the trace theorem is not told"

# ---- JSON ----
keys='["format","verb","title","units","friction_left_out","pose","eigenvalues","modes","thresholds","growth_rate","trace","trace_theorem","asymmetry","drifts","decays","last","period","period_start","samples","periods","sampling_period","sampling_adjusted","multipliers","multiplier_modes","growth_per_period","determinant","determinant_defect","pair_defect","drifting","sampling","stable"]'
[[ $(jq -c keys_unsorted open.json) == "$keys" ]] || fail "keys $(jq -c keys_unsorted open.json)"
jq -e '.verb == "stability" and .stable == false and ([.eigenvalues, .multipliers] | all(length == 12 and all(length == 2)))
    and (.modes | length) == 12 and .growth_rate == .eigenvalues[0][0]' open.json >/dev/null || fail "JSON: $(head -c 400 open.json)"
near "the period" "$(jq .period open.json)" 6.283185307179586 1e-12
near "the determinant's defect" "$(jq .determinant_defect open.json)" 0 1e-9
near "the pairs' defect" "$(jq .pair_defect open.json)" 0 1e-9
near "growth per period" "$(jq '.growth_per_period - (.multipliers[0] | .[0] * .[0] + .[1] * .[1] | sqrt)' open.json)" 0 1e-9

# ---- the words for a mode: how large each component is beside the first, and how far it runs ahead of it or behind ----
skew=(own.yaml --set 'control.damping=[150,10,150,150,20,150]' --set 'load.center_of_mass=[0.02,0.01,0.05]')
run stability "${skew[@]}" --json
jq -r '["surge", "sway", "heave", "roll", "pitch", "yaw"] as $names | . as $all | [range(12) | select($all.eigenvalues[.][1] > 0)][0] as $k |
    $all.modes[$k].shape as $shape | $shape[0] as $lead | range(1; 6) | $shape[.] as $c |
    ($c[0] * $lead[0] + $c[1] * $lead[1]) as $re | ($c[1] * $lead[0] - $c[0] * $lead[1]) as $im |
    ($re / ($re | fabs)) as $sign | (($sign * $im) / ($sign * $re) | atan * 57.29577951308232) as $phase |
    ($sign * 0.1 * (if . < 3 then 1 else 57.29577951308232 end)
        * (($re * $re + $im * $im | sqrt) / ($lead[0] * $lead[0] + $lead[1] * $lead[1]))) as $size |
    "\($names[.]) \($size) \($phase)"' out >shape
"$GOUGH" stability "${skew[@]}" 2>/dev/null | sed -n '/surge 0.1 m with/,/)$/p' | head -3 | tr -s '\n ' ' ' >words
while read -r name size phase; do
    said=$(grep -oE "$name [-0-9.e]+ (m|deg) \([0-9]+ deg (ahead|behind)\)" words | head -1)
    # shellcheck disable=SC2086
    set -- $said
    near "$name in '$(<words)'" "${2:-}" "$size" "$(awk -v s="$size" 'BEGIN { print 0.006 * (s < 0 ? -s : s) }')"
    near "phase of $name in '$(<words)'" "$(tr -d '(' <<<"${4:-}" | awk -v w="${6:-}" '{ print w ~ /behind/ ? -$1 : $1 }')" "$phase" 0.51
done <shape
(($(wc -l <shape) == 5)) || fail "the shape of the first mode: $(<shape)"

# ---- the trace: the theorem is for joints in two level planes, and gives no number for others ----
run stability own.yaml --json
jq -e '(.trace / .trace_theorem - 1 | fabs) < 1e-12' out >/dev/null || fail "the trace is $(jq -c '[.trace, .trace_theorem]' out)"
joints='[[0.245,0.045,0.011],[-0.095,0.235,-0.013],[-0.165,0.195,0.017],[-0.155,-0.185,0.019],[-0.105,-0.215,-0.023],[0.255,-0.055,0.029]]'
run stability own.yaml --set "platform.base={joints: $joints}" --json
jq -e '.trace < 0 and .trace_theorem == null' out >/dev/null || fail "joints out of their plane: $(jq -c '[.trace, .trace_theorem]' out)"

# ---- a drift along the program: nothing but momentum carries a weightless load ----
free=(heave.yaml --set gravity=0 --set control.stiffness=0 --set control.damping=0)
run stability "${free[@]}" --set 'motion.heave="1e-6*sin(t)"' --json
jq -e '.stable == false and .drifting == 6 and .growth_per_period < 1.0001' out >/dev/null ||
    fail "a weightless load drifts, but: $(jq -c '{stable, drifting, growth_per_period}' out)"
grep -q 'drifts, growing in proportion to time' <("$GOUGH" stability "${free[@]}" --set 'motion.heave="1e-6*sin(t)"') ||
    fail "the drift is not told"
# with damping it stops, with springs it swings
for held in control.damping=1 control.stiffness=5; do
    run stability "${free[@]}" --set $held --set 'motion.heave="1e-6*sin(t)"' --json
    jq -e '.stable and .drifting == 0' out >/dev/null || fail "$held: $(jq -c '{stable, drifting, growth_per_period}' out)"
done

# ---- along the program: the trace of heave's two multipliers ----
while read -r G trace tolerance; do
    "$GOUGH" stability heave.yaml --set control.stiffness="$G" --json >at.json
    near "heave's trace at G = $G" "$(jq '[.multipliers, .multiplier_modes] | transpose | map(select(.[1].name == "heave") | .[0][0]) | add' at.json)" "$trace" "$tolerance"
done <<END
0 42.8326 6e-5
0.0817 2.30856 6e-6
0.2 -1.731017 6e-7
1 1.578140 6e-7
5 -1.716563 6e-7
END
jq -e '.stable == true' at.json >/dev/null || fail "not stable at G = 5"
run stability heave.yaml --set control.stiffness=5 --set control.damping=0.5 --json
jq -e '.stable and .growth_per_period < 1 and .pair_defect == null' out >/dev/null || fail "damped: $(jq -c '[.stable, .growth_per_period]' out)"

# ---- the matrix: traces of its powers are sums of powers of the eigenvalues ----
for options in "" "--set control.stiffness=3 --set control.damping=0.7" "--pose heave=0.1,yaw=10 --set control.stiffness=2"; do
    # shellcheck disable=SC2086
    "$GOUGH" stability heave.yaml --matrix $options >matrix.csv
    # shellcheck disable=SC2086
    "$GOUGH" stability heave.yaml --json --matrix $options >m.json
    [[ $(head -1 matrix.csv) == x,y,z,rx,ry,rz,vx,vy,vz,wx,wy,wz && $(wc -l <matrix.csv) == 13 ]] || fail "the matrix: $(head -1 matrix.csv)"
    [[ $(jq -r '.matrix[] | map(tostring) | join(",")' m.json | wc -l) == 12 ]] || fail "no matrix in JSON"
    read -r first second fourth < <(awk -F, 'NR > 1 { for (j = 1; j <= 12; j++) a[NR - 1, j] = $j }
        END { for (i = 1; i <= 12; i++) for (j = 1; j <= 12; j++) for (k = 1; k <= 12; k++) b[i, j] += a[i, k] * a[k, j]
            for (i = 1; i <= 12; i++) { s += a[i, i]; t += b[i, i]; for (j = 1; j <= 12; j++) u += b[i, j] * b[j, i] }
            printf "%.15g %.15g %.15g\n", s, t, u }' matrix.csv)
    near "trace of the matrix ($options)" "$(jq '[.eigenvalues[][0]] | add' m.json)" "$first" 1e-9
    near "of its square" "$(jq '[.eigenvalues[] | .[0] * .[0] - .[1] * .[1]] | add' m.json)" "$second" 1e-8
    near "of its fourth power" "$(jq '[.eigenvalues[] | (.[0] * .[0] - .[1] * .[1]) as $a | (2 * .[0] * .[1]) as $b | $a * $a - $b * $b] | add' m.json)" "$fourth" 1e-6
done
# about the program: heave's coefficient (stab-12) at t = 2 of the start-up
"$GOUGH" stability heave.yaml --matrix --at 2 --set control.stiffness=0.4 | sed -n 10p | cut -d, -f3 >element
near "heave's coefficient at t = 2" "$(cat element)" "$(awk 'BEGIN { h = 1.072666758631; a = -0.120214942866; l2 = h * h + 0.49; printf "%.15g", (1 + a) * 0.49 / (h * l2) - 2.4 * h * h / l2 }')" 1e-10
# in units of its own machine, growth rates are those of the unit of time
si=(--set units=si --set gravity=9 --set load.mass=2 --set load.inertia='[0.16, 0.16, 0.3]' --set motion.heave=0 --pose surge=0)
a=$("$GOUGH" stability heave.yaml "${si[@]}" --json --dimensionless | jq -c '.eigenvalues | map(.[0] * 1e9 | round)')
b=$(jq -c '.eigenvalues | map(.[0] * 1e9 | round)' open.json)
[[ $a == "$b" ]] || fail "--dimensionless: $a instead of $b"

# ---- programs that rest, and others ----
run stability own.yaml --json
expect_code 0 "a program that comes to rest"
jq -e '.period == null and .multipliers == [] and .growth_per_period == null and .stable' out >/dev/null || fail "own machine: $(jq -c '[.period, .stable]' out)"
run stability heave.yaml --set motion.heave='0.1*ramp(t, 3)' --set motion.period= --set control.stiffness=2 --json
jq -e '.period == null and (.last.pose.heave - 0.1 | fabs) < 1e-12 and .last.thresholds[0].stiffness > 0 and .stable == .last.stable' out >/dev/null ||
    fail "a program that ends elsewhere: $(jq -c '[.period, .last.pose]' out)"
run stability heave.yaml --set motion.period=
expect_code 0 "the period found"
grep -q '^Along the program, of period 6.28318531, found' out || fail "the period is not found: $(grep Along out)"
refused "period" stability heave.yaml --set motion.period=3
refused "period" stability heave.yaml --set 'motion.heave=0.1*sin(t) + 0.1*sin(sqrt(2)*t)' --set motion.period=
refused "--pose" stability heave.yaml --set 'motion.heave=0.1*sin(t^2)' --set motion.period=
run stability heave.yaml --set 'motion.heave=0.1*sin(t^2)' --set motion.period= --pose surge=0 --json
expect_code 0 "rest alone of a program without a period"
jq -e '.period == null and (.eigenvalues | length) == 12' out >/dev/null || fail "rest alone"
run stability heave.yaml --pose yaw=90
expect_code 1 "a singular pose"
grep -q singular err || fail "a singular pose: $(cat err)"
run stability heave.yaml --set motion.heave='0.2*sin(t)' --set motion.yaw='100*sin(t)'
expect_code 1 "a program through a singular pose"
grep -q 'use --pose surge=0' err || fail "rest alone may be asked for: $(cat err)"
run stability heave.yaml --set control.feedforward=none
expect_code 1 "no rest without any force"

# ---- usage ----
refused "did you mean 'heave'?" stability heave.yaml --pose heav=0.1
refused "in the study's units" stability heave.yaml --pose heave
refused "must be a number" stability heave.yaml --pose heave=0.1x
refused "given twice" stability heave.yaml --pose heave=0.1,heave=0.2
refused "give both" stability heave.yaml --at 1
refused "give only one of them" stability heave.yaml --matrix --at 1 --pose yaw=1
refused "from:to:count" stability heave.yaml --sweep-stiffness 0:2
refused "whole number" stability heave.yaml --sweep-stiffness 0:2:2.5
refused "whole number" stability heave.yaml --sweep-stiffness 0:2:1e9
refused "'to' is greater than 'from'" stability heave.yaml --sweep-stiffness 2:1:5
refused "no value is below 0" stability heave.yaml --sweep-stiffness -1:1:5
refused "greater than 0" stability heave.yaml --sweep-stiffness 0:1:5:log
refused "greater than 0" stability heave.yaml --sweep-stiffness 0:1:5 --sweep-frequency 0:1:5
refused "three decimal numbers" stability heave.yaml --sweep-stiffness nan:1:5
refused "a map has at most two axes" stability heave.yaml --sweep-stiffness 0:1:5 --sweep-damping 0:1:3 --sweep-amplitude 0:1:3
refused "give --sweep-stiffness too" stability heave.yaml --sweep-damping 0:1:3
refused "-o is for maps" stability heave.yaml -o x.csv
refused "cannot be combined with it" stability heave.yaml --sweep-stiffness 0:1:5 --matrix
refused "both write to standard output" stability heave.yaml --sweep-stiffness 0:1:5 -o - --json
refused "is too large" stability heave.yaml --sweep-stiffness 0:1:9999 --sweep-amplitude 0:1:9999
refused "(picture)" stability heave.yaml --sweep-stiffness 0:1:5 -o map.txt
refused "period" stability heave.yaml --sweep-stiffness 0:1:5 --set motion.period=3
run stability heave.yaml --sweep-stiffness 0:1:5 -o nowhere/map.csv
expect_code 3 "a folder that does not exist"
run stability heave.yaml -q
[[ ! -s out && ! -s err ]] || fail "-q talks"
finish
