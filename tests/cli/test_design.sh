#!/usr/bin/env bash
# gough design: the study it writes keeps its comments and holds the required box, says the same twice, and stays as it was where a value
# cannot be written; what binds, what is missing, what is refused.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
cat >study.yaml <<'END'
title: A table       # of a workshop
platform:
  base: {radius: 900, half_angle: 10}   # mm, deg
  top:
    radius: 600 # of the joints
    half_angle: 10
  height: 900
load: {mass: 300, inertia: [9e6, 9e6, 9e6]}
workspace: {box: {heave: 150, yaw: 4}, acceleration: [0, 0, 1000]}
units: {length: mm}
design:
  vary: {platform.top.radius: [400, 700], platform.height: [600, 1500]}
  minimize: {force: 1, stroke: 2}       # both
  telescope: 300
  evaluations: 150
END

# the study that is written differs in the two numbers only, and holds the box
run design study.yaml -o better.yaml --json
expect_code 0 design
cp out first.json
[[ $(diff study.yaml better.yaml | grep -c '^>') == 2 ]] || fail "changes: $(diff study.yaml better.yaml)"
grep -q '# of the joints$' better.yaml && grep -q '# of a workshop$' better.yaml || fail "comments are lost"
radius=$(jq '.keys["platform.top.radius"]' first.json) height=$(jq '.keys["platform.height"]' first.json)
grep -q "^    radius: $radius # of the joints$" better.yaml || fail "radius $radius: $(grep radius better.yaml)"
grep -q "^  height: $height$" better.yaml || fail "height $height: $(grep height better.yaml)"
run workspace better.yaml --json
expect_code 0 "workspace of the design"
jq -e '.box.scale >= 1 and (.envelope | .longest <= 2 * .shortest - 300)' out >/dev/null || fail "the box: $(jq -c .box out)"
jq -e '.certified and .missing == null and .objective.before == 3 and .objective.after < 3 and .objective.minimize.stroke == 2 and .units.length == "mm"' first.json >/dev/null || fail "JSON: $(cat first.json)"
jq -e '.bounds["platform.height"] == [600, 1500] and (.envelope.push > 500) and (.evaluations >= 150)' first.json >/dev/null || fail "JSON: $(cat first.json)"
# the forces of a leg at home under the greatest acceleration are below the bound: m (g + a) / 6 l / h
jq -e --argjson h "$height" '.envelope.push >= 300 * 10.80665 / 6' first.json >/dev/null || fail "forces: $(jq -c .envelope first.json)"

# the same twice; another seed comes as near
run design study.yaml --json
cmp -s out first.json || fail "another answer the second time"
run design study.yaml --json --set design.seed=5
jq -e --argjson first "$(jq .objective.after first.json)" '.seed == 5 and .certified and (.objective.after / $first - 1 | fabs) < 0.01' out >/dev/null || fail "another seed: $(jq -c .objective out) $(jq -c .objective first.json)"

# a search from the design finds nothing better by more than rounding
run design better.yaml --json
jq -e '.objective.after > 2.97' out >/dev/null || fail "from the design: $(jq -c .objective out)"

# text: keys with units, what binds
run design study.yaml --set design.minimize=force
grep -q 'platform.height \[mm\] .* 600 and 1500' out || fail "keys: $(cat out)"
grep -q 'greatest force of a leg \[N\]' out || fail "aim: $(cat out)"
grep -q 'platform.height at its greatest, 1500 mm: give it room' out || fail "what binds: $(cat out)"
grep -q 'every pose of workspace.box keeps every limit' out || fail "certificate: $(cat out)"
run design study.yaml -o - -q
grep -q '^title: A table       # of a workshop$' out || fail "study on standard output: $(head -3 out)"

# settings are written too, where the file has a single value for them
run design study.yaml --set load.mass=200 --set 'design.vary.platform.height=[700, 800]' -o heavy.yaml -q
expect_code 2 "a list as a setting of the written study"
grep -q 'cannot be written with --set design.vary.platform.height' err || fail "setting: $(cat err)"
[[ ! -e heavy.yaml ]] || fail "a study with half of the settings"
run design study.yaml --set load.mass=200 -o light.yaml -q
expect_code 0 "a setting"
grep -q 'load: {mass: 200, inertia' light.yaml || fail "mass: $(grep load light.yaml)"

# no design: exit 1, no file, what is missing
run design study.yaml --set 'platform.legs={length: [10, 900]}' --set workspace.box.heave=300 -o none.yaml
expect_code 1 "too much asked for"
[[ ! -e none.yaml ]] || fail "a study without a design"
grep -q 'no numbers within the bounds meet workspace.box: the nearest exceed a limit by' err || fail "no design: $(cat err)"
grep -q 'at its greatest length: heave 300 mm' out || fail "where: $(cat out)"
grep -q 'platform.height at its least, 600 mm: give it room' out || fail "what would help: $(cat out)"
run design study.yaml --set 'platform.legs={length: [10, 900]}' --set workspace.box.heave=300 --json
jq -e '(.certified | not) and .missing.limit == "longest" and .missing.excess > 0 and .missing.scale < 1 and .envelope == null' out >/dev/null || fail "JSON without a design: $(cat out)"

# what is refused, at its place
refuse() { # refuse PART SETTING…
    local part=$1 set=()
    shift
    for one in "$@"; do set+=(--set "$one"); done
    run design study.yaml "${set[@]}" -o refused.yaml
    expect_code 2 "$*"
    grep -qF "$part" err || fail "$*: $(cat err)"
    [[ ! -e refused.yaml ]] || fail "$*: a file"
}
refuse 'has no section `design`' design=
refuse '`workspace.box` is missing' workspace.box=
refuse 'is not a key of a study; did you mean `platform.top.radius`?' 'design.vary={platform.top.radios: [1, 2]}'
refuse 'belongs to the requirement' 'design.vary={workspace.least_singular_value: [0.1, 1]}'
refuse 'the study does not give `platform.legs.diameter`' 'design.vary={platform.legs.diameter: [0.1, 1]}'
refuse 'must be [least, greatest], the first below the second' 'design.vary={platform.height: [2, 1]}'
refuse 'must be from 0 to 60 degrees' 'design.vary={platform.top.half_angle: [5, 70]}'
refuse 'is not one number but three numbers' 'design.vary={load.center_of_mass: [0, 1]}' 'load.center_of_mass=[0, 0, 1]'
refuse '`control.stiffness` is not a number in this study' 'design.vary={control.stiffness: [0, 1]}' 'control.stiffness=[1, 2, 3, 4, 5, 6]'
refuse 'is not a key of a study' 'design.vary={design.telescope: [1, 2]}'
refuse 'needs a weight greater than 0' 'design.minimize={force: 0}'
refuse '`design.minimize` must be one of force, stroke, speed, footprint' design.minimize=cost
refuse 'it has no workspace.velocity' design.minimize=speed
refuse 'must be a whole number from 10 to 1000000' design.evaluations=5
run design study.yaml -o study.yaml
expect_code 2 "the study itself"
run design study.yaml -o better.csv
expect_code 2 "another ending"
run design study.yaml -o a.yaml -o b.yaml
expect_code 2 "two studies"
run check study.yaml --set 'design.vary={platform.top.radios: [1, 2]}'
expect_code 2 "check sees the section"
finish
