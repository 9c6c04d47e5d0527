#!/usr/bin/env bash
# The numbers of a sweep by an independent road: each peak is that of the table of gough simulate, and a dimensionless sweep is the
# one in SI divided by units of R_b, M and sqrt(R_b/g), column by column, in table, summary and JSON; units of HDF5 are their names.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
cat >study.yaml <<'END'
title: A heavy machine
platform: {base: {radius: 2, half_angle: 10}, top: {radius: 1.1, half_angle: 15}, height: 1.7}
load: {mass: 30, center_of_mass: [0, 0, 0.1], inertia: [3, 3, 5]}
motion: {heave: 0.1*sin(5*t), pitch: 3*sin(2*t)}
control: {stiffness: 4000, damping: 300}
disturbance: {force: [20*sin(7*t), 0, 0]}
simulation: {duration: 2, output_step: 0.02, method: rk4, step: 0.01}
sweep: {keys: {load.mass: [30, 40], control.damping: [200, 300]}}
END
run sweep study.yaml --json -o si.csv
expect_code 0 "sweep in SI"
cp out si.json
run sweep study.yaml --dimensionless --json -o none.csv
expect_code 0 "dimensionless sweep"
cp out none.json
run sweep study.yaml --dimensionless
cp out none.txt
run sweep study.yaml
cp out si.txt

# peaks of run 2 from a table of its own with steps and rows so close that nothing is between them
"$GOUGH" simulate study.yaml -q --set load.mass=30 --set control.damping=300 --set simulation.step=0.0005 \
    --set simulation.output_step=0.0005 -o alone.csv
peaks() { # peaks EXPRESSION over leg columns PREFIX: least and greatest of all rows and legs
    awk -F, -v prefix="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ "^" prefix "[1-6]$") leg[i]; next }
        { for (i in leg) { if (!seen++ || $i < least) least = $i; if (seen == 1 || $i > greatest) greatest = $i } }
        END { printf "%.17g %.17g", least, greatest }' alone.csv
}
near() { # near NAME WANTED GOT [PART]
    awk -v a="$2" -v b="$3" -v part="${4:-1e-12}" 'BEGIN { d = a - b; s = a < 0 ? -a : a; exit !((d < 0 ? -d : d) <= part * s && s > 1e-9) }' ||
        fail "$1: $3 instead of $2"
}
read -r power_least power_greatest < <(peaks p)
read -r force_least force_greatest < <(peaks f)
read -r speed_least speed_greatest < <(peaks dl)
of() { column "$1" "$2" | sed -n "$3p"; }
near power_least "$power_least" "$(of si.csv power_least 2)" 1e-4
near power_greatest "$power_greatest" "$(of si.csv power_greatest 2)" 1e-4
near power "$power_greatest" "$(of si.csv power 2)" 1e-4
awk -v p="$power_least" 'BEGIN { exit !(p < -1) }' || fail "no leg brakes in this test: $power_least"
near force "$(awk -v a="$force_least" -v b="$force_greatest" 'BEGIN { a = -a; printf "%.17g", (a > b) ? a : b }')" "$(of si.csv force 2)" 1e-4
near speed "$(awk -v a="$speed_least" -v b="$speed_greatest" 'BEGIN { a = -a; printf "%.17g", (a > b) ? a : b }')" "$(of si.csv speed 2)" 1e-4

# units of R_b = 2 m, M = 30 kg (the study as it stands) and sqrt(R_b/g)
length=2 mass=30
time=$(awk 'BEGIN { printf "%.17g", sqrt(2 / 9.80665) }')
unit() { # unit LENGTH MASS TIME exponents
    awk -v l=$length -v m=$mass -v t="$time" -v a="$1" -v b="$2" -v c="$3" 'BEGIN { printf "%.17g", l^a * m^b * t^c }'
}
check() { # check COLUMN LENGTH MASS TIME UNIT-IN-SI
    local row
    for row in 1 2 3 4; do
        near "$1 of run $row" "$(awk -v a="$(of si.csv "$1" $row)" -v u="$(unit "$2" "$3" "$4")" 'BEGIN { printf "%.17g", a / u }')" "$(of none.csv "$1" $row)"
    done
    if [[ -e si.h5 ]]; then
        [[ $(h5_unit si.h5 "$1") == "$5" ]] || fail "$1 is in '$(h5_unit si.h5 "$1")', not $5"
        local bare=1
        [[ $5 == degree ]] && bare=degree
        [[ $(h5_unit none.h5 "$1") == "$bare" ]] || fail "$1 without dimensions is in '$(h5_unit none.h5 "$1")'"
    fi
}
h5_unit() { h5dump -a "/$2/units" "$1" | sed -n 's/^ *(0): "\(.*\)"$/\1/p'; }
if command -v h5dump >/dev/null; then
    "$GOUGH" sweep study.yaml -q -o si.h5
    "$GOUGH" sweep study.yaml -q --dimensionless -o none.h5
fi
check position_deviation 1 0 0 m
check angle_deviation 0 0 0 degree
check force 1 1 -2 N
check speed 1 0 -1 m/s
check power 2 1 -3 W
check energy 2 1 -2 J
check end_time 0 0 1 s
check power_least 2 1 -3 W
check power_greatest 2 1 -3 W
check vx 1 0 -1 m/s
check x 1 0 0 m

# the summary names the runs whose numbers they are
if command -v jq >/dev/null; then
    for file in si none; do
        for pair in position_deviation:position_deviation:position_deviation angle_deviation:angle_deviation:angle_deviation power:power_least:power_greatest; do
            IFS=: read -r key low high <<<"$pair"
            for end in least greatest; do
                name=$low
                [[ $end == greatest ]] && name=$high
                run=$(jq -r ".$key.$end.run" $file.json)
                near "$file.json $key.$end" "$(of $file.csv "$name" "$run")" "$(jq -r ".$key.$end.value" $file.json)"
                worst=$(column $file.csv "$name" | sort -g | if [[ $end == least ]]; then head -1; else tail -1; fi)
                near "$file.json $key.$end of all" "$worst" "$(jq -r ".$key.$end.value" $file.json)"
            done
        done
    done
fi
# merged shards have the same summary
for file in si none; do
    option=(-q)
    [[ $file == none ]] && option+=(--dimensionless)
    for i in 1 2 3; do "$GOUGH" sweep study.yaml "${option[@]}" --shard $i/3 -o $i.shard; done
    run merge 1.shard 2.shard 3.shard -o merged.csv --json
    expect_code 0 "merge of $file"
    cmp -s merged.csv $file.csv || fail "merge: another table of $file"
    if command -v jq >/dev/null; then
        jq -S 'del(.verb, .title, .time, .rate)' out >merged.json
        jq -S 'del(.verb, .title, .time, .rate)' $file.json | cmp -s - merged.json || fail "merge: another summary of $file: $(cat out)"
    fi
    run merge 1.shard 2.shard 3.shard -o merged.csv
    grep -A2 "^  power" out | cut -d, -f1 | cmp -s - <(grep -A2 "^  power" $file.txt | cut -d, -f1) || fail "merge says other numbers: $(cat out)"
done
said() { sed -n "/^  power of a leg/,\$p" "$1" | awk -v which="$2" '$1 == which { print $2, $3; exit }'; }
[[ $(said si.txt least) == "$(column si.csv power_least | sort -g | head -1 | xargs printf '%.6g') W," ]] || fail "the summary says least power $(said si.txt least)"
[[ $(said none.txt greatest) == "$(column none.csv power_greatest | sort -g | tail -1 | xargs printf '%.6g'), run" ]] ||
    fail "without dimensions the summary says greatest power $(said none.txt greatest)"
finish
