#!/usr/bin/env bash
# The JSON summary has exactly its keys in order, agrees with the table, and scales with --dimensionless.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
"$GOUGH" example flight-simulator >"$scratch/fs.yaml"
"$GOUGH" example ship-deck.awk >"$scratch/ship-deck.awk"
(cd "$scratch" && awk -f ship-deck.awk >ship-deck.csv)
short=(--set simulation.duration=20)

keys='["format","verb","title","units","end","legs","condition","deviation","drift","external_work","limits","statistics"]'
for verb in forces simulate; do
    run "$verb" "$scratch/fs.yaml" "${short[@]}" --json -o "$scratch/$verb.csv"
    expect_code 0 "$verb --json"
    cp "$scratch/out" "$scratch/$verb.json"
    [[ $(jq -c keys_unsorted "$scratch/out") == "$keys" ]] || fail "$verb: keys $(jq -c keys_unsorted "$scratch/out")"
    [[ $(jq -c '.end | keys_unsorted' "$scratch/out") == '["status","time","leg","message","legs","limit","component","least"]' ]] || fail "$verb: end"
    jq -e --arg verb "$verb" '.verb == $verb and .end.status == "done" and .end.time == 20 and .end.leg == null and (.legs | length) == 6' \
        "$scratch/out" >/dev/null || fail "$verb: $(jq -c '[.verb, .end, (.legs | length)]' "$scratch/out")"
    # lengths, forces and powers over the rows, by other means
    for leg in 1 2 3 4 5 6; do
        for what in l:length f:force p:power; do
            column "$scratch/$verb.csv" "${what%:*}$leg" | sort -g | sed -n '1p;$p' | tr '\n' ' ' >"$scratch/pair"
            read -r least greatest <"$scratch/pair"
            # the motion goes a little further between rows than at them, and no less far
            jq -e --arg a "$least" --arg b "$greatest" --argjson i $((leg - 1)) --arg k "${what#*:}" '
                ($a | tonumber) as $a | ($b | tonumber) as $b | .legs[$i][$k] as $pair |
                ($a - $pair[0]) as $below | ($pair[1] - $b) as $above | ([$a, $b] | map(fabs) | max) as $size |
                $below >= -1e-12 * $size and $above >= -1e-12 * $size and $below <= 0.01 * ($b - $a) and $above <= 0.01 * ($b - $a)' \
                "$scratch/out" >/dev/null || fail "$verb: leg $leg ${what#*:} is not $least … $greatest"
        done
        # RMS to the accuracy of the trapezoidal rule
        rms=$(column "$scratch/$verb.csv" "f$leg" | awk '{ s += $1 * $1 } NR == 1 { s /= 2 } { last = $1 * $1 } END { printf "%.17g", sqrt((s - last / 2) / (NR - 1)) }')
        jq -e --argjson i $((leg - 1)) --argjson rms "$rms" '(.legs[$i].rms_force / $rms - 1 | fabs) < 1e-4' "$scratch/out" >/dev/null ||
            fail "$verb: leg $leg RMS force is not $rms"
    done
done
[[ $(jq -c '[.deviation.position, .deviation.angle, .drift]' "$scratch/forces.json") == "[null,null,null]" ]] || fail "forces has a deviation"
jq -e '.deviation.position >= 0 and .deviation.angle >= 0 and .drift >= 0' "$scratch/simulate.json" >/dev/null || fail "simulate has no deviation"
largest=$(paste -d' ' <(column "$scratch/simulate.csv" ex) <(column "$scratch/simulate.csv" ey) <(column "$scratch/simulate.csv" ez) |
    awk '{ d = sqrt($1 * $1 + $2 * $2 + $3 * $3); if (d > m) m = d } END { printf "%.17g", m }')
jq -e --argjson d "$largest" '(.deviation.position / $d - 1) as $more | $more >= -1e-9 and $more <= 0.02' "$scratch/simulate.json" >/dev/null || fail "deviation is not $largest"

# R_b = 1.5 m, M = 1050 kg, g = 9.80665 m/s²
run forces "$scratch/fs.yaml" "${short[@]}" --json --dimensionless
jq -e --slurpfile si "$scratch/forces.json" '
    def near(a; b): (a - b | fabs) <= 1e-12 * (b | fabs);
    (1.5 / 9.80665 | sqrt) as $time | (1050 * 9.80665) as $weight | $si[0] as $si |
    near(.end.time; 20 / $time) and
    near(.legs[2].length[1]; $si.legs[2].length[1] / 1.5) and
    near(.legs[2].speed; $si.legs[2].speed * $time / 1.5) and
    near(.legs[2].force[0]; $si.legs[2].force[0] / $weight) and
    near(.legs[2].rms_force; $si.legs[2].rms_force / $weight) and
    near(.legs[2].power[1]; $si.legs[2].power[1] * $time / ($weight * 1.5)) and
    near(.legs[2].energy; $si.legs[2].energy / ($weight * 1.5)) and
    near(.legs[2].swing.top; $si.legs[2].swing.top) and
    near(.legs[2].stroke_used; $si.legs[2].stroke_used) and
    near(.condition; $si.condition)' "$scratch/out" >/dev/null || fail "--dimensionless does not scale: $(jq -c '.legs[2]' "$scratch/out")"

# check as JSON
run check "$scratch/fs.yaml" --json
expect_code 0 check --json
jq -e '.verb == "check" and (.home_length | length) == 6 and .groups.height > 1.3333 and .groups.height < 1.33334 and
       .program.kind == "samples" and .program.ends == "not-a-knot" and .program.span == [0, 120] and .condition > 1' \
    "$scratch/out" >/dev/null || fail "check --json: $(jq -c . "$scratch/out")"
run example --json
jq -e 'map(.name) | index("paper-heave")' "$scratch/out" >/dev/null || fail "example --json lacks paper-heave"

# the time of the worst condition is in the unit of the other times
"$GOUGH" example own-machine >"$scratch/own.yaml"
worst() { sed -n 's/^ *condition .*, at t = \([0-9.e+-]*\).*/\1/p' "$scratch/out"; }
run forces "$scratch/own.yaml"
seconds=$(worst)
run forces "$scratch/own.yaml" --dimensionless
unit=$("$GOUGH" check "$scratch/own.yaml" --json | jq .time_unit)
awk -v s="$seconds" -v d="$(worst)" -v u="$unit" 'BEGIN { exit !(s > 0 && d > 0 && u > 0 && d * u / s < 1.0001 && d * u / s > 0.9999) }' ||
    fail "the worst condition at $seconds s, dimensionless at $(worst), with the unit $unit s"
finish
