#!/usr/bin/env bash
# What check and stability say of a sampled controller at rest: windows of the theory as sentences and as JSON, in the study's units
# and in others, verdicts, refusals.
# Not sanitized: the numbers are those of tests/linear, which run under sanitizers.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
: "${SOURCE:?the source folder}"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

cat >"$scratch/machine.yaml" <<'END'
units: dimensionless
platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 6.4688478326275441}, height: 1}
load: {mass: 1, inertia: [0.08, 0.08, 0.15]}
control: {stiffness: 2, damping: 0.3, sampling: {period: 0.05, delay: 0.05}}
simulation: {duration: 10, output_step: 0.1}
END
says() { tr -s ' \n' '  ' <"$scratch/out" | grep -qF -- "$1" || fail "no '$1' in: $(cat "$scratch/out")"; }
lacks() { ! tr -s ' \n' '  ' <"$scratch/out" | grep -qF -- "$1" || fail "'$1' in: $(cat "$scratch/out")"; }
set_key() { run "$1" "$scratch/machine.yaml" "${@:2}"; }

# ---- sentences ----
for verb in check stability; do
    set_key $verb
    says 'window of G 0.894107 (below it sway–tilt grows) to 3.75109 (above it sway–tilt at 6.051 grows), with the damping D = 0.3'
    says 'longest period 0.0886986 with these gains and a delay in proportion'
    says 'longest delay 0.106693 with these gains and this period'
    says 'stiffest loop G up to 11.0575, with the damping D = 1.37854'
    says 'no gains hold from a period of 0.181991 on, with a delay in proportion'
    set_key $verb --set control.sampling.period=0.2 --set control.sampling.delay=0.2
    says 'window of G closed: no stiffness and damping hold the platform with this period and delay; they can with periods up to 0.181991 and a delay in proportion'
    set_key $verb --set control.damping=0
    says 'window of G closed: no stiffness holds the platform with the damping D = 0; with D = 1.37854 stiffnesses up to 11.0575 do'
    set_key $verb --set 'control.stiffness=[2, 1, 1, 1, 1, 1]'
    says 'of the stiffest leg, the others in proportion, with the damping D = 0.3'
done
set_key check
says 'sampling every 0.05, commands act 0.05 later; as if they were 0.075 late'
set_key check --set control.sampling.delay=0
says 'sampling every 0.05, commands act at once; as if they were 0.025 late'
set_key check
says 'largest multiplier |mu| = 0.996395078 a sample: deviations die out'
lacks 'noise of commands'
set_key check --set control.sampling.noise=0.001 --set control.sampling.resolution=0.01 --set control.sampling.velocity=difference
says 'one count of length moves a command by 0.08' # G q + D q/T
says 'noise of commands'
set_key check --set control.stiffness=5
says 'deviations grow'

# ---- stability: the continuous loop beside, one verdict ----
set_key stability
says 'the largest 18 of 18 mu'
says 'Stable: every deviation dies out; the slowest falls to a tenth in 31.88.'
says 'With the same gains in continuous time'
[[ $(grep -c 'dies out' "$scratch/out") == 1 ]] || fail "two verdicts: $(cat "$scratch/out")"
set_key stability --set control.stiffness=4
says 'Unstable: a deviation in sway–tilt grows tenfold every'
lacks 'Stable:'
set_key stability --set control.sampling= --set 'actuators={kind: lag, time_constant: 0.05}'
says 'of the 18 lambda'

# ---- JSON ----
set_key check --json
jq -e '.sampling | (.window | map(. * 1e5 | round)) == [89411, 375109] and .lower.mode == "sway–tilt" and .upper.damping == 0.3 and
    .period == 0.05 and (.effective_delay - 0.075 | fabs) < 1e-15 and (.radius - 0.996395078 | fabs) < 1e-9 and .decays' "$scratch/out" >/dev/null ||
    fail "check: $(jq -c .sampling "$scratch/out")"
set_key stability --json
jq -e '.samples == 1 and .stable and (.multipliers | length) == 18 and (.eigenvalues | length) == 12 and .period == null and
    ((.multipliers[0] | (.[0] * .[0] + .[1] * .[1] | sqrt)) - .sampling.radius | fabs) < 1e-14' "$scratch/out" >/dev/null || fail "stability: $(jq -c '[.samples, .multipliers]' "$scratch/out")"
set_key stability --json --set control.stiffness=4
[[ $(jq -c '[.stable, .sampling.decays]' "$scratch/out") == '[false,false]' ]] || fail "stable beyond the window"
set_key check --json --set control.damping=0
[[ $(jq -c '.sampling | [.window, .upper]' "$scratch/out") == '[null,null]' ]] || fail "a window without damping"
set_key check --json --set control.sampling=
[[ $(jq -c .sampling "$scratch/out") == null ]] || fail "sampling of a continuous controller"

# ---- along a program ----
turning=(--set 'motion={heave: 0.01*sin(6.283185307179586*t)}')
set_key stability "${turning[@]}"
says 'Along the program, of period 1 or 20 samples'
says 'A small deviation is multiplied by mu in each period; the largest 12 of 18 mu'
says 'The other 6 mu are less than 1e-9 of the largest'
[[ $(grep -c 'dies out' "$scratch/out") == 2 ]] || fail "verdicts at rest and along the program: $(cat "$scratch/out")"
set_key stability --json "${turning[@]}"
jq -e '.samples == 20 and .period == 1 and .stable and (.multipliers | length) == 12 and .determinant == null and
    ((.multipliers[0] | (.[0] * .[0] + .[1] * .[1] | sqrt)) - .growth_per_period | fabs) < 1e-14' "$scratch/out" >/dev/null ||
    fail "along the program: $(jq -c '[.samples, .period, .stable]' "$scratch/out")"

# a period that fits three periods of the program, and one that fits none
set_key stability "${turning[@]}" --set control.sampling.period=0.12 --set control.sampling.delay=0.06
says 'Along the program, of period 1, 3 of which have 25 samples'
says 'is multiplied by mu in every 3 periods'
lacks 'No whole number of samples'
set_key stability --json "${turning[@]}" --set control.sampling.period=0.12 --set control.sampling.delay=0.06
jq -e '.samples == 25 and .periods == 3 and .sampling_period == 0.12 and .sampling_adjusted == false and
    ((.multipliers[0] | (.[0] * .[0] + .[1] * .[1] | sqrt)) - .growth_per_period * .growth_per_period * .growth_per_period | fabs) < 1e-13' "$scratch/out" >/dev/null ||
    fail "three periods: $(jq -c '[.samples, .periods, .sampling_period, .sampling_adjusted]' "$scratch/out")"
set_key stability "${turning[@]}" --set control.sampling.period=0.0513
says 'Along the program, of period 1 or 19 samples'
says 'No whole number of samples of 0.0513 fills up to 16 periods of the program'
says 'the nearest period of the controller that fits, 0.0526315789, with a delay in proportion.'
set_key stability --json "${turning[@]}" --set control.sampling.period=0.0513
jq -e '.samples == 19 and .periods == 1 and (.sampling_period * 19 - 1 | fabs) < 1e-12 and .sampling_adjusted' "$scratch/out" >/dev/null ||
    fail "nearest: $(jq -c '[.samples, .periods, .sampling_period, .sampling_adjusted]' "$scratch/out")"
set_key stability --json
jq -e '.periods == null and .sampling_period == 0.05 and .sampling_adjusted == false' "$scratch/out" >/dev/null || fail "at rest: $(jq -c '[.periods, .sampling_period]' "$scratch/out")"

# ---- maps ----
set_key stability --sweep-stiffness 0.5:6:12 --sweep-period 0.02:0.08:3 -o "$scratch/map.csv"
says 'over the period of the controller: 3 values from 0.02 to 0.08'
says 'At period 0.05, where the program is at rest, sampled every 0.05: ranges of G in which a mode grows'
says 'sway–tilt ×2 0.5 0.894107'
[[ $(head -1 "$scratch/map.csv") == stiffness,period,growth_per_period,growth_rate,stable,mode,sampling && $(wc -l <"$scratch/map.csv") == 37 ]] ||
    fail "the table: $(head -1 "$scratch/map.csv")"
awk -F, '$1 == 0.05 && $4 == "oscillation" && (!least || $5 < least) { least = $5 } END { exit !(least > 3.75107 && least < 3.75111) }' "$scratch/map-tongues.csv" ||
    fail "the upper edge: $(cat "$scratch/map-tongues.csv")"
set_key stability "${turning[@]}" --sweep-stiffness 1:3:3 --sweep-delay 0:0.05:2 --modes heave --set control.sampling.period=0.0513 --json
jq -e '.map.axis == "delay" and .map.modes == "heave" and (.map.rows | all((.sampling_period * 19 - 1 | fabs) < 1e-9 and .periods == 1 and .period == 1)) and
    (.map.mode | flatten | all(. == "heave"))' "$scratch/out" >/dev/null || fail "a map over the delay: $(jq -c .map "$scratch/out")"
set_key stability "${turning[@]}" --sweep-stiffness 1:3:3 --set control.sampling.period=0.0513
says 'The map is for a period of the controller near the study'"'"'s own'
set_key stability "${turning[@]}" --sweep-stiffness 1:3:3 --sweep-period 0.04:0.0513:3
says '2 of 3 rows are for a period of the controller that differs from the one asked for by up to'
lacks 'no values'

# ---- units: the same machine in millimetres and milliseconds ----
si='{radius: 1.5, half_angle: 10}'
cat >"$scratch/si.yaml" <<END
platform: {base: $si, top: {radius: 1.1, half_angle: 10}, height: 2}
load: {mass: 1050, center_of_mass: [0, 0, 0.55], inertia: [600, 600, 900]}
control: {stiffness: 4e5, damping: 2e4, sampling: {period: 0.001, delay: 0.001, velocity: difference, noise: 1e-6}}
simulation: {duration: 1, output_step: 0.1}
END
cat >"$scratch/mm.yaml" <<END
units: {length: mm, time: ms}
platform: {base: {radius: 1500, half_angle: 10}, top: {radius: 1100, half_angle: 10}, height: 2000}
load: {mass: 1050, center_of_mass: [0, 0, 550], inertia: [6e8, 6e8, 9e8]}
control: {stiffness: 4e2, damping: 2e4, sampling: {period: 1, delay: 1, velocity: difference, noise: 1e-3}}
simulation: {duration: 1000, output_step: 100}
END
run check "$scratch/si.yaml" --json
cp "$scratch/out" "$scratch/si.json"
run check "$scratch/mm.yaml" --json
jq -e -s 'def near(a; b): (a - b | fabs) <= 1e-6 * (b | fabs);
    .[0].sampling as $si | .[1].sampling as $mm |
    near($mm.window[0] * 1e3; $si.window[0]) and near($mm.window[1] * 1e3; $si.window[1]) and near($mm.upper.frequency * 1e3; $si.upper.frequency) and
    near($mm.best.damping; $si.best.damping) and near($mm.period_limit / 1e3; $si.period_limit) and near($mm.longest_period / 1e3; $si.longest_period) and
    near($mm.least_mass; $si.least_mass) and near($mm.command_noise[0]; $si.command_noise[0]) and near($mm.growth_rate * 1e3; $si.growth_rate)' \
    "$scratch/si.json" "$scratch/out" >/dev/null || fail "units: $(jq -c .sampling "$scratch/si.json" "$scratch/out")"
run check "$scratch/si.yaml"
says ' N/m (above it sway–tilt at'
says ' rad/s grows), with the damping D = 20000 N s/m'

# ---- the matrix from sample to sample: its trace is the sum of the multipliers, for continuous drives that lag that of the eigenvalues ----
near() {
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= t) }' || fail "$1: $2, not $3"
}
for options in '' '--set control.sampling.delay=0' '--set control.sampling= --set control.integral=0.5' '--set control.sampling.velocity=exact'; do
    # shellcheck disable=SC2086
    run stability "$scratch/machine.yaml" --matrix $options --set 'actuators={kind: lag, time_constant: 0.05}'
    awk -F, 'NR > 1 { s += $(NR - 1) } NR == 2 { n = NF } END { if (NR != n + 1) exit 1; printf "%.15g\n", s }' "$scratch/out" >"$scratch/trace" ||
        fail "the matrix is not square ($options)"
    head -1 "$scratch/out" >"$scratch/names"
    # shellcheck disable=SC2086
    run stability "$scratch/machine.yaml" --json --matrix $options --set 'actuators={kind: lag, time_constant: 0.05}'
    [[ $(jq -r '.matrix_columns | join(",")' "$scratch/out") == "$(cat "$scratch/names")" ]] || fail "names of the matrix ($options)"
    if jq -e '(.multipliers | length) == (.matrix | length)' "$scratch/out" >"$scratch/all"; then
        near "trace of the matrix ($options)" "$(jq '[.multipliers[][0]] | add' "$scratch/out")" "$(cat "$scratch/trace")" 1e-9
    elif jq -e '.sampling == null' "$scratch/out" >"$scratch/all"; then
        near "trace of the matrix ($options)" "$(jq '[.eigenvalues[][0]] | add' "$scratch/out")" "$(cat "$scratch/trace")" 1e-9
        grep -q ',f1,.*,f6,i1,.*,i6$' "$scratch/names" || fail "names of drives and integrals: $(cat "$scratch/names")"
    fi
done

# ---- a map with matrices of gains: a diagonal one is six equal numbers, with samples and without ----
diagonal='control.stiffness=[[1,0,0,0,0,0],[0,1,0,0,0,0],[0,0,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]]'
for options in '' '--set control.sampling='; do
    # shellcheck disable=SC2086
    run stability "$scratch/machine.yaml" --json --sweep-stiffness 0.5:4:8 $options --set control.stiffness=1 --set 'actuators={kind: lag, time_constant: 0.02}'
    jq -c '[.map.growth_rate[0][], .tongues[].from, .tongues[].to]' "$scratch/out" >"$scratch/plain"
    # shellcheck disable=SC2086
    run stability "$scratch/machine.yaml" --json --sweep-stiffness 0.5:4:8 $options --set "$diagonal" --set 'actuators={kind: lag, time_constant: 0.02}'
    jq -c '[.map.growth_rate[0][], .tongues[].from, .tongues[].to]' "$scratch/out" >"$scratch/matrix"
    jq -e --slurpfile a "$scratch/plain" '. as $b | ($a[0] | length) == ($b | length) and ([range($b | length)] | all(. as $i | ($a[0][$i] - $b[$i]) | fabs < 1e-6))' \
        "$scratch/matrix" >"$scratch/all" || fail "a map with matrices ($options): $(cat "$scratch/matrix") not $(cat "$scratch/plain")"
    [[ $(jq '.thresholds | length' "$scratch/out") == 0 ]] || fail "thresholds of equal stiffnesses beside a matrix"
done

# ---- drives that lag along a program, without samples ----
run stability "$scratch/machine.yaml" --set 'motion={heave: 0.1*sin(t)}' --set control.sampling= --set 'actuators={kind: lag, time_constant: 0.05}'
says 'With drives that lag the loop has a periodic motion of its own'
says 'conjugate pairs of the 18 mu are'
run stability "$scratch/machine.yaml" --json --set 'motion={heave: 0.1*sin(t)}' --set control.sampling= --set 'actuators={kind: lag, time_constant: 0.05}'
[[ $(jq '.multipliers | length' "$scratch/out") == 18 ]] || fail "18 multipliers: $(jq '.multipliers | length' "$scratch/out")"

# ---- refusals ----
refused() {
    local sentence=$1
    shift
    "$GOUGH" "$@" >/dev/null 2>"$scratch/err" && fail "$*: not refused"
    grep -qF -- "$sentence" "$scratch/err" || fail "$*: no '$sentence': $(cat "$scratch/err")"
}
moving=(--set 'motion={heave: 0.1*sin(t)}')
refused 'longer than two periods of the program' stability "$scratch/machine.yaml" "${moving[@]}" --set control.sampling.period=15
refused 'use --pose surge=0' stability "$scratch/machine.yaml" "${moving[@]}" --set control.sampling.period=15
refused 'a map over the delay needs a sampled controller' stability "$scratch/machine.yaml" --sweep-stiffness 1:2:3 --sweep-delay 0:1:2 --set control.sampling=
refused "--modes takes sway, heave, tilt or yaw" stability "$scratch/machine.yaml" --sweep-stiffness 1:2:3 --modes heave+
refused "greater than 0" stability "$scratch/machine.yaml" --sweep-stiffness 1:2:3 --sweep-period 0:1:3
refused 'leads from sample to sample at rest' stability "$scratch/machine.yaml" --matrix --at 1
refused 'more than 12 periods' stability "$scratch/machine.yaml" --set control.sampling.delay=0.7
run check "$scratch/machine.yaml" --set control.sampling.delay=0.7
says 'window of G not determined: '
# ---- a loop that lets go of the program: refused where it passes a singular pose, before its period is over ----
run stability "$SOURCE/examples/sampled-too-slow.yaml"
expect_code 1 "stability along a program that the loop lets go"
grep -qE 'by t = 2\.[0-9]+ s? ?the platform has left the program for a singular pose: the loop does not hold it' "$err" ||
    fail "what becomes of the program is not said: $(cat "$err")"
finish
