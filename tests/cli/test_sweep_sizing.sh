#!/usr/bin/env bash
# gough sweep --sizing and --forces: each number is that of the run alone, in all lanes, threads and shards, with its unit.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
command -v jq >/dev/null || finish
cat >study.yaml <<'END'
units: {length: mm, force: N}
platform:
  base: {radius: 250, half_angle: 10}
  top: {radius: 150, half_angle: 10}
  height: 280
  legs:
    max_force: 60
    cylinder: {mass: 0.5, center: 80, inertia: 2000}
    piston: {mass: 0.3, center: 90, inertia: 1000}
    reflected_mass: 2
    friction: {viscous: 0.02, coulomb: 3, smoothing_speed: 20, efficiency: 0.9}
load: {mass: 6, center_of_mass: [10, 0, 50], inertia: [5e4, 6e4, 8e4]}
external: [{force: [0, 0, 30], at: [20, 0, 100]}]
motion: {surge: 15*sin(4*t), heave: 20*sin(5*t), roll: 3*sin(4*t), yaw: 2*sin(3*t)}
control: {stiffness: 20, damping: 0.3}
disturbance: {force: [2*sin(7*t), 0, 0]}
simulation: {duration: 1, output_step: 0.05, method: rk4, step: 0.0025}
sweep: {keys: {load.mass: [5, 6, 40]}}
END
sizing=length_least,length_greatest,swing_base,swing_top,rms_force,top_load,base_load,side_load,friction_loss,returned_energy,holds_from,holds_to

# ---- each run alone ----
of() { column "$1" "$2" | sed -n "$3p"; }
near() { # near WHAT WANTED GOT PART
    awk -v a="$2" -v b="$3" -v part="$4" 'BEGIN { d = a - b; s = a < 0 ? -a : a
        exit !(a ~ /^-?[0-9]/ && b ~ /^-?[0-9]/ && (d < 0 ? -d : d) <= part * s) }' || fail "$1: $3, alone $2"
}
numbers='{length_least: [.legs[].length[0]] | min, length_greatest: [.legs[].length[1]] | max, swing_base: [.legs[].swing.base] | max,
    swing_top: [.legs[].swing.top] | max, rms_force: [.legs[].rms_force] | max, top_load: [.legs[].joint_load.top] | max,
    base_load: [.legs[].joint_load.base] | max, side_load: [.legs[].side_load] | max, friction_loss: [.legs[].friction_loss] | add,
    returned_energy: [.legs[].returned_energy] | add, holds_from: [.legs[].holding[0]] | min, holds_to: [.legs[].holding[1]] | max,
    force: [.legs[].force[] | fabs] | max, speed: [.legs[].speed] | max, power_least: [.legs[].power[0]] | min, end_time: .end.time,
    end_cause: .end.status} | to_entries[] | "\(.key) \(.value)"'
alone() { # alone VERB FILE PART: the columns of a sweep against the summaries of single runs
    local run=0 mass
    for mass in 5 6 40; do
        run=$((run + 1))
        "$GOUGH" "$1" study.yaml --set load.mass=$mass -q --json 2>/dev/null | jq -r "$numbers" >alone
        awk -v run=$run -v part="$3" 'NR == FNR { wanted[$1] = $2; count++; next } FNR == 1 { n = split($0, name, ","); next }
            FNR == run + 1 { split($0, value, ",") }
            END { for (i = 1; i <= n; i++) if (name[i] in wanted) { a = wanted[name[i]]; b = value[i]; seen++
                    d = a - b; s = a < 0 ? -a : a
                    good = name[i] == "end_cause" ? a == b : a ~ /^-?[0-9]/ && b ~ /^-?[0-9]/ && (d < 0 ? -d : d) <= part * s
                    if (!good) print name[i] " is " b ", alone " a }
                if (count != 17 || seen != count) print seen " of " count " numbers" }' alone <(tr ' ' '_' <"$2") >wrong
        [[ -s wrong ]] && fail "$1, mass $mass: $(cat wrong)"
    done
}
run sweep study.yaml --sizing -o lanes.csv
expect_code 0 "a sweep with --sizing"
[[ $(head -1 lanes.csv) == *,power_greatest,$sizing ]] || fail "columns: $(head -1 lanes.csv)"
[[ $(of lanes.csv end_cause 1) == 'done' && $(of lanes.csv end_cause 3) == leg_force ]] || fail "ends: $(column lanes.csv end_cause)"
alone simulate lanes.csv 1e-9
grep -q "largest side load between cylinder and piston of a leg" out || fail "the summary has no side load: $(cat out)"
run sweep study.yaml --sizing --set simulation.method=dop853 --set simulation.step= -o adaptive.csv
expect_code 0 "adaptive steps"
for name in ${sizing//,/ }; do near "adaptive steps, $name" "$(of adaptive.csv "$name" 2)" "$(of lanes.csv "$name" 2)" 1e-4; done
run sweep study.yaml --forces --sizing -o forces.csv
expect_code 0 "a sweep of forces"
alone forces forces.csv 1e-14
[[ $(column forces.csv position_deviation | sort -u) == nan ]] || fail "forces deviate from the program"
[[ $(of forces.csv end_cause 3) == leg_force ]] || fail "forces, mass 40: $(of forces.csv end_cause 3)"
grep -q "limit exceeded: a leg's force too great, in 1" out || fail "the summary of forces: $(cat out)"
grep -A2 "^  largest force between a leg and the top" out | grep -q "greatest .* N, run 3: load.mass=40" || fail "a run beyond its limits is left out: $(cat out)"
grep -q "deviation" out && fail "forces have a deviation: $(cat out)"
# the sweep without it has the same columns and digits as before
run sweep study.yaml -o plain.csv
cut -d, -f1-26 lanes.csv | cmp -s - plain.csv || fail "--sizing changes other columns"

# ---- the same bytes ----
for lanes in 1 2 4 8; do
    "$GOUGH" sweep study.yaml -q --sizing --threads 2 --lanes $lanes -o other.csv 2>err || { grep -q "this processor runs" err && continue; }
    cmp -s lanes.csv other.csv || fail "$lanes lanes: other bytes"
done
for kind in "lanes --sizing" "forces --forces --sizing"; do
    read -r name options <<<"$kind"
    # shellcheck disable=SC2086
    for i in 1 2; do "$GOUGH" sweep study.yaml -q $options --shard $i/2 -o $i.shard; done
    run merge 2.shard 1.shard -o merged.csv
    expect_code 0 "merge of $name"
    cmp -s merged.csv "$name.csv" || fail "merge of $name: other bytes"
done
"$GOUGH" sweep study.yaml -q --sizing --shard 1/2 -o 1.shard
run merge 1.shard 2.shard -o mixed.csv
expect_code 2 "shards of a simulation and of forces"
grep -q "are not from the same sweep" err || fail "shards of two kinds: $(cat err)"

# ---- units, JSON, pictures ----
run sweep study.yaml --forces --sizing --json -q
expect_code 0 json
jq -r 'to_entries[] | select(.value | type == "object" and has("greatest")) | "\(.key) \(.value.greatest.value)"' out >greatest
for name in force speed ${sizing//,/ }; do
    near "JSON, greatest $name" "$(column forces.csv "$name" | sort -g | tail -1)" "$(sed -n "s/^$name //p" greatest)" 1e-15
done
[[ $(jq -c '.position_deviation.greatest' out) == '{"value":null,"run":null}' ]] || fail "JSON: a deviation of forces"
jq -e 'has("side_load")' out >/dev/null || fail "JSON lacks side_load"
"$GOUGH" sweep study.yaml -q --json | jq -e 'has("side_load") | not' >/dev/null || fail "JSON has side_load without --sizing"
if command -v h5dump >/dev/null; then
    "$GOUGH" sweep study.yaml -q --forces --sizing -o forces.h5
    for pair in side_load:N friction_loss:J length_least:mm swing_top:degree; do
        h5dump -a "/${pair%:*}/units" forces.h5 2>err | grep -q "\"${pair#*:}\"" || fail "${pair%:*} is not in ${pair#*:}: $(h5dump -a "/${pair%:*}/units" forces.h5 2>&1)"
    done
fi
if command -v gnuplot >/dev/null; then
    run plot forces.csv -o forces.svg
    expect_code 0 "a plot of forces"
    grep -q "Largest leg force" forces.svg || fail "a plot of forces does not show them"
    run plot lanes.csv --columns side_load -o side.svg
    expect_code 0 "a plot of side loads"
    grep -q "Largest side load between cylinder and piston" side.svg || fail "the plot of side loads has no heading"
fi
finish
