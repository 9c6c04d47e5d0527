#!/usr/bin/env bash
# Records of motion as instruments, simulators and spreadsheets write them: each recipe of the guide on its own file, each layout by
# what is read of it, proposals of mappings that are pasted, wrong records, and forces of rounded records.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml

# ---- the guide: each file, and the section `motion` below it
awk '/^File `/ { split($0, part, "`"); name = part[2]; next }
     /^```yaml/ { yaml = name ".yaml"; inside = 1; next }
     /^```$/ && inside { inside = 0; yaml = ""; next }
     /^```$/ && name != "" && !filed[name] { filed[name] = 1; file = name; inside = 1; next }
     /^```/ { file = ""; yaml = ""; next }
     inside && yaml != "" { print > yaml; next }
     inside { print > file }' "$SOURCE/docs/guide/motion-records.md"
recipes=(plain.csv capitals.csv semicolons.csv units.txt two.dat steps.txt telemetry.csv quaternion.csv matrix.csv rounded.csv)
[[ $(grep -c '^File `' "$SOURCE/docs/guide/motion-records.md") == "${#recipes[@]}" ]] || fail "the guide has other recipes than this test"

# recipe FILE: a study of it, with the numbers of its program in JSON
recipe() {
    [[ -s $1 && -s $1.yaml ]] || fail "the guide lacks $1 or its study"
    { cat "$1.yaml"; printf 'platform: {base: {radius: 0.25, half_angle: 10}, top: {radius: 0.15, half_angle: 10}, height: 0.28}\nload: {mass: 6, inertia: [0.05, 0.05, 0.08]}\nsimulation: {duration: %s, output_step: 0.01}\n' "$2"; } >study.yaml
    run check study.yaml --json
    expect_code 0 "the recipe of $1"
}
# expect_range COMPONENT LEAST GREATEST FILE: of the program; the spline goes a little beyond its rows
expect_range() {
    jq -e --arg c "$1" --argjson a "$2" --argjson b "$3" '.program[$c] | (.[0] - $a | fabs) < 0.002 * $b and (.[1] - $b | fabs) < 0.002 * $b' out >/dev/null ||
        fail "$1 is $(jq -c ".program.$1" out) instead of $2 to $3 ($4)"
}
# the same motion in six layouts: the cubic through 0, 4, 10, 12 mm at 0, 0.1, 0.2, 0.3 s reaches 12.2088 mm
for file in plain.csv capitals.csv semicolons.csv units.txt quaternion.csv; do
    recipe $file 0.3
    expect_range heave 0 0.0122088 $file
done
for file in plain.csv capitals.csv semicolons.csv; do
    recipe $file 0.3
    jq -e '.program.pitch[1] - 0.15 | fabs < 2e-3' out >/dev/null || fail "pitch of $file: $(jq -c .program.pitch out)"
done
recipe units.txt 0.3
jq -e '.program.pitch[1] - 0.003 * 180 / 3.14159265358979 | fabs < 2e-3' out >/dev/null || fail "pitch in rad: $(jq -c .program.pitch out)"
recipe quaternion.csv 0.3
jq -e '.program.pitch[1] - 2 * 0.00131 * 180 / 3.14159265358979 | fabs < 2e-3' out >/dev/null || fail "pitch of a quaternion: $(jq -c .program.pitch out)"
recipe matrix.csv 0.3
expect_range heave 0 0.0122088 matrix.csv
jq -e '.program.pitch[1] - 0.002618 * 180 / 3.14159265358979 | fabs < 2e-3' out >/dev/null || fail "pitch of a matrix: $(jq -c .program.pitch out)"
recipe two.dat 0.06
expect_range surge 0 0.004 two.dat
recipe steps.txt 0.06
expect_range heave 0 0.004 steps.txt
recipe rounded.csv 0.1
grep -q "are read as equal steps of 0.0166667 s" err || fail "rounded times: $(cat err)"
# a vehicle that heads 179.8 degrees from x goes ahead where its x falls: surge, and hardly any sway
recipe telemetry.csv 0.3
expect_range yaw 0 0.3 telemetry.csv
expect_range heave 0 0.04 telemetry.csv
jq -e '.program.surge[1] - 0.06 * (0.2 * 3.14159265358979 / 180 | cos) | fabs < 1e-6' out >/dev/null || fail "surge of a heading: $(jq -c .program.surge out)"
jq -e '.program.sway[1] - 0.06 * (0.2 * 3.14159265358979 / 180 | sin) | fabs < 1e-6' out >/dev/null || fail "sway of a heading: $(jq -c .program.sway out)"

# ---- what was found is said in one line each
check_record() { run check own.yaml --set "motion={samples: $1}" --set simulation.duration="${2:-0.3}"; }
check_record plain.csv
[[ $(grep -c "motion.samples: read\|motion.samples has \(tabs\|semi\)" err) == 0 ]] || fail "a plain file has something to say: $(cat err)"
check_record semicolons.csv
grep -q 'motion.samples has semicolons between its columns and decimal commas$' err || fail "semicolons: $(cat err)"
grep -q 'motion.samples: read `Time (s)` as the time in s, `Heave (mm)` as heave in mm, `Pitch (deg)` as pitch in deg$' err || fail "units: $(cat err)"
check_record units.txt
grep -q 'motion.samples has a row of units$' err || fail "a row of units: $(cat err)"
printf '#time\theave\n0\t0\n0.5\t0.01\n1\t0.02\n' >hash.tsv
check_record hash.tsv
grep -q 'motion.samples has tabs between its columns$' err || fail "tabs: $(cat err)"
expect_code 0 "a row of names behind #"

# ---- what is not certain: all columns at once, and a mapping that works as it stands
paste_mapping() {
    local mapping
    mapping=$(sed -n 's/.*as in samples: //p' err | head -1)
    [[ -n $mapping ]] || fail "no mapping for $1: $(cat err)"
    run check own.yaml --set "motion={samples: $mapping}" --set simulation.duration="${2:-0.3}" --set platform.legs=
    expect_code 0 "the mapping for $1 pasted: $mapping"
}
for file in two.dat steps.txt telemetry.csv quaternion.csv matrix.csv; do
    check_record $file 0.02
    expect_code 2 "$file by its name alone"
    [[ $(grep -c ': error: ' err) == 1 ]] || fail "$file has several errors: $(cat err)"
    paste_mapping $file 0.02
done
check_record telemetry.csv
for column in $(head -1 telemetry.csv | tr , ' '); do grep -q "\`$column\`" err || fail "the error does not name the column $column: $(cat err)"; done
printf 't,heave (g)\n0,0\n1,1\n' >g.csv
check_record g.csv
grep -q 'g.csv:1:3: error: .*`g` is a unit of acceleration, but heave is a length' err || fail "a unit of another kind: $(cat err)"
printf '[{"t": 0, "heave": 0}]\n' >log.json
check_record log.json
expect_code 2 "JSON"
grep -q "is JSON; .*jq -r" err || fail "JSON: $(cat err)"
printf 't,heave,heavy\n0,0,0\n1,1,1\n' >near.csv
check_record near.csv
grep -q '3 `heavy` (did you mean `heave`?)' err || fail "a name close to another: $(cat err)"

# gough check FILE
run check telemetry.csv
expect_code 0 "check of a file"
grep -q "4 rows of 17 columns" out || fail "check of a file: $(cat out)"
mapping=$(sed -n 's/^motion: {samples: \(.*\)}$/\1/p' out)
run check own.yaml --set "motion={samples: $mapping}" --set simulation.duration=0.3 --set platform.legs=
expect_code 0 "the mapping of gough check"
run check telemetry.csv --json
jq -e '.motion_file | .rows == 4 and .time == 1 and .interval == 100 and (.certain | not) and (.columns | length) == 17 and
    .columns[9].quantity == "yaw" and .columns[9].certain and .columns[9].greatest == 179.9 and .columns[9].jump_row == 3 and
    .columns[1].numbers == 0 and (.columns[6].step - 0.01 | fabs) < 1e-12 and (.columns[6].acceleration / 6e-6 - 1 | fabs) < 1e-9' out >/dev/null ||
    fail "check --json of a file: $(cat out)"
run check plain.csv
grep -q "The name alone is enough" out || fail "check of a plain file: $(cat out)"
run check own.yaml plain.csv --json
jq -e '.studies[1].motion_file.certain and .studies[1].valid' out >/dev/null || fail "check of a study and a file: $(cat out)"
run check missing.csv
expect_code 3 "check of a file that is not there"

# ---- keys that do not fit the file or each other
wrong() { # MAPPING SENTENCE
    run check own.yaml --set "motion={samples: $1}" --set simulation.duration=0.3
    expect_code 2 "$1"
    grep -qF -- "$2" err || fail "$1 does not say '$2': $(cat err)"
}
wrong '{file: plain.csv, columns: {heave: lift}}' 'the record has no column `lift`; its columns are 1 `t`, 2 `heave`, 3 `pitch`'
wrong '{file: plain.csv, columns: {heave: heav}}' 'did you mean `heave`?'
wrong '{file: plain.csv, columns: {heave: 4}}' 'the record has 3 columns, numbered from 1'
wrong '{file: plain.csv, columns: {heave: 0x2}}' 'no column `0x2`'
wrong '{file: plain.csv, columns: {heave: {column: heave, unit: deg}}}' '`deg` is a unit of angle, but heave is a length'
wrong '{file: plain.csv, columns: {pitch: {column: pitch, unit: m/s}}}' '`m/s` is a unit of speed, but pitch is an angle'
wrong '{file: plain.csv, columns: {heave: {column: heave, unit: cubit}}}' '`cubit` is no unit that gough knows'
wrong '{file: plain.csv, columns: {heave: {unit: mm}}}' '`motion.samples.columns.heave.column` is missing'
wrong '{file: plain.csv, columns: {lift: 2}}' 'unknown key `lift`; known here: surge, sway'
wrong '{file: plain.csv, time: {column: t, step: 0.1}}' 'has both `step` and `column`'
wrong '{file: plain.csv, time: {from: last}}' 'must be one of first, found `last`'
wrong '{file: quaternion.csv, columns: {heave: z, qw: q0, qx: q1, qy: q2}}' 'lacks `qz`'
wrong '{file: quaternion.csv, columns: {heave: z, qw: q0, roll: q1}}' 'give one kind'
wrong '{columns: {heave: 2}}' '`motion.samples.file` is missing'
wrong '{file: plain.csv, skip: 3.5}' 'a whole number from 0 to 100000'
wrong '{file: plain.csv, smooth: rounding, cutoff: 5}' '`motion.samples` has both `cutoff` and `smooth`'
wrong '{file: plain.csv}, cutoff: 5' 'as `motion.samples.cutoff`'
wrong '{file: telemetry.csv, time: timestamp, columns: {heave: pos_z}}' 'from: first'
wrong '{file: telemetry.csv, time: {column: timestamp, from: first}, columns: {heave: mode}}' '`auto` is not a number'
wrong '{file: plain.csv, columns: {heave: {column: heave, scale: 1e308, unit: km}}}' 'heave is not finite'

# ---- records that are wrong
printf 't,heave\n0,0\n0.1,1\n0.2' >short.csv
check_record short.csv
grep -q 'short.csv:4:4: error: this row ends after 1 of 2 cells' err || fail "a record that ends early: $(cat err)"
printf 't,heave (deg),pitch (mm)\n0,0,0\n1,1,1\n' >swapped.csv
check_record swapped.csv
grep -q '`deg` is a unit of angle, but heave is a length.*`mm` is a unit of length, but pitch is an angle' err || fail "units that are swapped: $(cat err)"
printf 't,heave\n0,0\n0.1,1\n0.1,2\n0.1,3\n0.2,4\n' >still.csv
check_record still.csv
[[ $(grep -c 'the time 0.1 must be greater than 0.1 in the row before' err) == 2 ]] || fail "a time that stands still: $(cat err)"
printf 't,heave,q,w,x,y,z\n0,0,1,0,0,0,0\n1,0,0,0,0,0,0\n' >nothing.csv
check_record '{file: nothing.csv, columns: {heave: heave, qw: w, qx: x, qy: y, qz: z}}'
grep -q 'nothing.csv:2:1: error: the quaternion of this row is 0' err || fail "a quaternion of 0: $(cat err)"
check_record '{file: nothing.csv, columns: {r11: q, r12: w, r13: w, r21: w, r22: q, r23: w, r31: w, r32: w, r33: w}}'
grep -q 'the matrix of this row is no rotation' err || fail "a matrix that is no rotation: $(cat err)"

# ---- forces of rounded records, by a mapping: 4 decimals, and times rounded to 10 ms at 60 Hz
peak() { awk '/force \[N\]|force$/ { table = 1 } table && $1 == "all" { print $4; exit }' out; }
ten=(--set simulation.duration=10 --set simulation.output_step=0.005 --set platform.legs=)
run forces own.yaml "${ten[@]}" --set 'motion={heave: "0.02*(1-cos(2*pi*t))"}'
truth=$(peak)
close_to_truth() {
    awk -v a="$(peak)" -v b="$truth" 'BEGIN { d = a / b - 1; exit !(a != "" && d <= 0.01 && -d <= 0.01) }' || fail "peak force $(peak) N instead of $truth N within 1 % ($1)"
}
awk 'BEGIN { print "Time (ms),Z"; for (i = 0; i <= 2000; i++) printf "%d,%.1f\n", i * 5, 20 * (1 - cos(6.283185307179586 * i * 0.005)) }' >mm.csv
awk 'BEGIN { print "t,heave"; for (i = 0; i <= 600; i++) printf "%.2f,%.4f\n", i / 60, 0.02 * (1 - cos(6.283185307179586 * i / 60)) }' >clock.csv
for how in 'smooth: rounding' 'cutoff: 4'; do
    run forces own.yaml "${ten[@]}" --set "motion={samples: {file: mm.csv, time: 'Time (ms)', columns: {heave: {column: Z, unit: mm}}, $how}}"
    close_to_truth "0.1 mm, $how"
    run forces own.yaml "${ten[@]}" --set "motion={samples: clock.csv, $how}"
    close_to_truth "times in steps of 10 ms, $how"
done
finish
