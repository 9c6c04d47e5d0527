#!/usr/bin/env bash
# gough workspace: travels are those of halving by `gough check --pose`, corners of the largest box are allowed and the pose that stops it
# is not; surfaces and outlines; units; what is refused.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
: "${SOURCE:?the source folder}"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml
"$GOUGH" example camera >camera.yaml

# near NAME A B TOLERANCE
near() { awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; exit !(d <= t && d >= -t) }' || fail "$1: $2 is not $3 within $4"; }
# fits FILE POSE: whether all legs keep their lengths in a pose, by the share of the stroke that check prints
fits() { "$GOUGH" check "$1" --pose "$2" --json | jq -e '[.pose.stroke_used[] | . >= -1e-9 and . <= 100 + 1e-9] | all' >/dev/null; }

# lengths are all that limits this machine: each end of a travel is where check finds the first leg at its limit
run workspace own.yaml --json
expect_code 0 workspace
cp out own.json
for axis in surge yaw; do
    for end in least greatest; do
        found=$(jq ".travel.$axis.$end.end" own.json)
        near "the end $end of $axis" "$(
            low=$(awk "BEGIN { print 0.995 * $found }") high=$(awk "BEGIN { print 1.005 * $found }")
            for _ in {1..14}; do
                middle=$(awk "BEGIN { printf \"%.17g\", ($low + $high) / 2 }")
                if fits own.yaml "$axis=$middle"; then low=$middle; else high=$middle; fi
            done
            echo "$low"
        )" "$found" "$(awk "BEGIN { x = $found; print 1e-6 * (x < 0 ? -x : x) }")"
    done
done
jq -e '[.travel[] | .least, .greatest | .limit == "longest" or .limit == "shortest"] | all' own.json >/dev/null || fail "limits: $(jq -c .travel own.json)"

# corners of the largest box are allowed, the pose that stops a larger one is not
pose() { jq -r "[[\"surge\", \"sway\", \"heave\", \"roll\", \"pitch\", \"yaw\"], $1] | transpose | map(\"\(.[0])=\(.[1])\") | join(\",\")" own.json; }
for corner in 0 21 42 63 27; do
    fits own.yaml "$(pose "[range(6) as \$k | if ($corner / pow(2; \$k) | floor) % 2 == 1 then .box.greatest[\$k] else .box.least[\$k] end]")" || fail "corner $corner of the box is not allowed"
done
fits own.yaml "$(pose "[.box.stopped_by.pose[] | . * 1.0001]")" && fail "the pose that stops the box is allowed"
jq -e '.box.scale > 0.1 and .box.scale < .box.upper and .box.scale > .box.upper * (1 - 1e-4) and (.box.shape_given | not)' own.json >/dev/null || fail "the box: $(jq -c .box own.json)"

# a shape of the study; worst values over it as it is; a volume between its bounds
run workspace own.yaml --set 'workspace.box={heave: [-0.02, 0.03], yaw: 4}' --set 'workspace.velocity=[0, 0, 0.2]' --set 'workspace.acceleration=[0, 0, 3]' --json
jq -e '.box.shape_given and .envelope.least[2] == -0.02 and .envelope.greatest[2] == 0.03 and .box.scale > 1' out >/dev/null || fail "a shape: $(jq -c '.box, .envelope' out)"
jq -e '.envelope | .push >= .sampled.push and .pull <= .sampled.pull and .longest >= .sampled.longest and .speed >= .sampled.speed and .speed < 0.21 and .speed > 0.1' out >/dev/null || fail "worst values: $(jq -c .envelope out)"
jq -e '.volume | (.exact | not) and .bounds[0] < .value and .value < .bounds[1]' out >/dev/null || fail "volume: $(jq -c .volume out)"
# the greatest force over one pose is that of check
run workspace own.yaml --set 'workspace.box={heave: 1e-9}' --json
near "the greatest force at home" "$(jq .envelope.push out)" "$("$GOUGH" check own.yaml --pose yaw=0 --json | jq '.pose.force | max')" 1e-4

# limits that stop an axis are named
run workspace own.yaml --set 'platform.joints.base_swing=3' --set 'platform.limits.heave=0.01'
grep -q 'surge.*at the greatest swing of its base joint' out || fail "swing: $(cat out)"
grep -q 'heave .*0.01 .*the platform.s limit of heave' out || fail "limit of the platform: $(cat out)"
grep -q 'volume.* m^3$' out || fail "no cubic metres: $(cat out)"
run workspace own.yaml --set 'platform.legs.max_force=14' --json
jq -e '[.travel[] | .least, .greatest | .limit] | any(. == "push" or . == "pull")' out >/dev/null || fail "forces: $(jq -c .travel out)"
run workspace own.yaml --set 'platform.legs.length=[0.01, 0.5]' --set platform.legs.max_force= --json
jq -e '.volume | .exact and .bounds[0] < .value and .value < .bounds[1]' out >/dev/null || fail "volume beside singular poses: $(jq -c .volume out)"
jq -e '.travel.yaw.greatest | .limit == "singular" and .end < 90.0001 and .end > 89.99' out >/dev/null || fail "yaw to the singular pose: $(jq -c .travel.yaw out)"

# units of the study, a point far from the joints, the other order of angles
run workspace camera.yaml --json
jq -e '.units.length == "mm" and .about[2] == -2758.4' out >/dev/null || fail "units: $(jq -c '.units, .about' out)"
surge=$(jq .travel.surge.greatest.end out)
fits camera.yaml "surge=$(awk "BEGIN { print 0.99999 * $surge }")" || fail "surge of the camera is less"
fits camera.yaml "surge=$(awk "BEGIN { print 1.00001 * $surge }")" && fail "surge of the camera is more"
jq -e '.volume.value > 1e3' out >/dev/null || fail "the volume is not in cubic millimetres: $(jq -c .volume out)"

# lines end where legs are at a limit
run workspace own.yaml --slice surge,heave -o slice.csv -q
expect_code 0 --slice
[[ $(head -1 slice.csv) == surge,sway,heave,roll,pitch,yaw,limit,leg ]] || fail "columns: $(head -1 slice.csv)"
[[ $(wc -l <slice.csv) == 361 ]] || fail "rows of an outline"
near "surge of the outline" "$(sed -n 2p slice.csv | cut -d, -f1)" "$(jq .travel.surge.greatest.end own.json)" 1e-7
run workspace own.yaml -o surface.h5 -o surface.csv -q
[[ $(wc -l <surface.csv) == 2523 ]] || fail "rows of a surface"
near "heave of the surface" "$(tail -1 surface.csv | cut -d, -f3)" "$(jq .travel.heave.greatest.end own.json)" 1e-7

# what is refused
run workspace own.yaml --set 'workspace.box={heave: [0.01, 0.02]}'
expect_code 2 "a box without home"
grep -q 'workspace.box.heave must contain home' err || fail "a box without home: $(cat err)"
run workspace own.yaml --set 'platform.legs.length=[0.4, 0.5]' --json
expect_code 1 "home outside"
grep -q 'home itself is not allowed: the least length of leg 1 is exceeded there' err || fail "home outside: $(cat err)"
jq -e '.travel == null and .box == null and (.message | test("home itself"))' out >/dev/null || fail "home outside in JSON: $(cat out)"
run workspace own.yaml --slice surge,surge -o a.csv
expect_code 2 "one component twice"
run workspace own.yaml --slice surge,heave
expect_code 2 "an outline without a file"
finish
