#!/usr/bin/env bash
# Label: thorough.
# gough stability: the map's tongues are where the theory has them, in tables and pictures, and as JSON.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example paper-heave >heave.yaml
"$GOUGH" example own-machine >own.yaml
"$GOUGH" stability heave.yaml --json >open.json

near() { # near WHAT VALUE EXPECTED TOLERANCE; what is no number fails
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; exit !(a != "" && a !~ /nan|null/ && d <= t + 0 && -d <= t + 0) }' ||
        fail "$1: $2 instead of $3 within $4"
}

# ---- the map: heave's tongues ----
run stability heave.yaml --sweep-stiffness 0:2:201 -o line.csv -o line.png -o line.svg -o line.pdf -o line.h5
expect_code 0 "a map of one axis"
[[ $(head -1 line.csv) == stiffness,growth_per_period,growth_rate,stable,mode && $(wc -l <line.csv) == 202 ]] || fail "line.csv: $(head -1 line.csv)"
[[ $(head -1 line-tongues.csv) == mode,modes,kind,from,to,cut,stiffness,growth_per_period,growth_rate ]] || fail "line-tongues.csv: $(head -1 line-tongues.csv)"
tongue() { awk -F, -v n="$1" '$1 == "heave" && $3 ~ /^resonance/ && ++k == n { print $4, $5 }' line-tongues.csv; }
read -r from to < <(tongue 1)
near "the first tongue begins" "$from" 0.11616 5.1e-6
near "the first tongue ends" "$to" 0.19283 5.1e-6
read -r from to < <(tongue 2)
near "the second tongue begins" "$from" 0.33333 5.1e-6
near "the second tongue ends" "$to" 0.36773 5.1e-6
[[ $(column line.csv stable | sed -n '1p;161p' | paste -sd' ') == "0 1" ]] || fail "stable at G = 0 and 1.6: $(column line.csv stable | sed -n '1p;161p' | paste -sd' ')"
near "growth in the map and alone" "$(column line.csv growth_per_period | head -1)" "$(jq .growth_per_period open.json)" 1e-4
grep -q '^  heave  *0.116159  *0.19283 ' out || fail "the tongue is not told: $(grep heave out)"
[[ $(head -c 4 line.png | tail -c 3) == PNG && $(head -c 4 line.pdf) == %PDF ]] && grep -q '<svg' line.svg || fail "the pictures"
if command -v h5dump >/dev/null; then
    h5dump -y -w 0 -m %.17g -d /growth_rate line.h5 | grep -E '^ *-?[0-9]' | tr -d ' ' | tr ',' '\n' | sed '/^$/d' >h5
    column line.csv growth_rate | cmp -s - h5 || fail "growth_rate differs between CSV and HDF5"
    [[ -s line-tongues.h5 ]] || fail "no tongues beside the HDF5"
fi

# two axes: the row of the study itself is the map of one axis; the same bytes for any threads and lanes
plane=(--sweep-stiffness 0.5:1.5:41 --sweep-amplitude 0:1.5:4)
run stability heave.yaml "${plane[@]}" -o plane.csv -o plane.png -o plane.svg --title 'Ta`touch ran`il'"'s"' $(touch ran)'
expect_code 0 "a map of two axes"
[[ $(head -1 plane.csv) == stiffness,amplitude,growth_per_period,growth_rate,stable,mode && $(wc -l <plane.csv) == 165 ]] || fail "plane.csv: $(head -1 plane.csv)"
[[ ! -e ran ]] || fail "a title is executed"
grep -q 'touch ran' plane.svg || fail "the title is not drawn"
"$GOUGH" stability heave.yaml --sweep-stiffness 0.5:1.5:41 -q -o - >alone.csv
awk -F, '$2 == 1' plane.csv | cut -d, -f1,3- | cmp -s - <(tail -n +2 alone.csv) || fail "amplitude 1 is another map than none"
awk -F, '$2 == 0 && $3 != "nan"' plane.csv | grep -q . && fail "a program at rest has growth per period"
for options in "--threads 1 --lanes 1" "--threads 2 --lanes 2"; do
    # shellcheck disable=SC2086
    "$GOUGH" stability heave.yaml "${plane[@]}" -q $options -o again.csv -o again.png --title 'Ta`touch ran`il'"'s"' $(touch ran)'
    cmp -s plane.csv again.csv && cmp -s plane-tongues.csv again-tongues.csv || fail "$options: other bytes"
    cmp -s plane.png again.png || fail "$options: another picture"
done
"$GOUGH" stability heave.yaml "${plane[@]}" --json >plane.json
jq -e '.map.axis == "amplitude" and (.map.stiffness | length) == 41 and (.map.rows | length) == 4 and (.map.growth_per_period | length) == 4
    and (.map.growth_per_period | all(length == 41)) and (.tongues | all(.from < .to)) and (.thresholds | length) == 6' plane.json >/dev/null || fail "JSON of a map"
[[ $(jq '.tongues | length' plane.json) == $(($(wc -l <plane-tongues.csv) - 1)) ]] || fail "JSON and CSV have other tongues"
# a row without values is said and left empty: at a factor of 5 the program goes down to the base
run stability heave.yaml --sweep-stiffness 0.5:1.5:11 --sweep-amplitude 1:5:2 -o gap.csv -o gap.png
expect_code 0 "a map with a row without values"
grep -q '1 of 2 rows have no values' out || fail "nothing said of a row without values"
# damping takes the tongues away
"$GOUGH" stability heave.yaml --sweep-stiffness 1:2:51 --sweep-damping 0:0.2:2 --json >damped.json
jq -e '.map.axis == "damping" and ([.tongues[] | select(.value == 0)] | length) > 0 and ([.tongues[] | select(.value > 0)] | length) == 0' damped.json >/dev/null ||
    fail "damping: $(jq -c '[.tongues[].value]' damped.json)"
# of a program that rests: below the thresholds, and nowhere else, damped or not
"$GOUGH" stability own.yaml --json | jq -c '[.thresholds[] | [.mode, (.stiffness * 1e6 | round)]] | unique' >thresholds
"$GOUGH" stability own.yaml --sweep-stiffness 1:1000:20:log --json | jq -c '[.tongues[] | select(.from == 0 and .kind == "static") | [.mode, (.to * 1e6 | round)]] | unique' >below
cmp -s thresholds below || fail "at rest: $(cat below) instead of $(cat thresholds)"

# a bar on a terminal for a map that takes its time
if script -qec true /dev/null </dev/null >/dev/null 2>&1; then
    env TERM=xterm script -qec "'$GOUGH' stability heave.yaml --sweep-stiffness 0:2:100 --sweep-amplitude 0.1:1:1000 --threads 1 --lanes 1 -o long.csv" /dev/null </dev/null >bar 2>/dev/null &
    pid=$!
    for _ in $(seq $((120 * ${GOUGH_TEST_SLOWNESS:-4}))); do
        sleep 0.25
        grep -q '\[#*-*\]' bar && break
    done
    grep -q '\[#*-*\]' bar || fail "no bar on a terminal: $(head -c 300 bar)"
    kill $pid 2>/dev/null
    wait $pid 2>/dev/null
    [[ ! -e long.csv ]] || fail "a killed map leaves a file"
fi
finish
