#!/usr/bin/env bash
# A pose given by leg lengths: check, stability, simulate and sweep answer as for the same pose by its components; and how errors of
# lengths move it, against poses found again by gough pose.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1

"$GOUGH" example camera > camera.yaml
pose=surge=2,sway=-3,heave=4,roll=0.1,pitch=0.12,yaw=0.05
"$GOUGH" check camera.yaml --json --pose "$pose" > by_pose.json
lengths=$(jq -r '.pose.length | map(tostring) | join(",")' by_pose.json)

# near NAME A B TOLERANCE
near() { awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; exit !(d <= t && d >= -t) }' || fail "$1: $2 is not $3 within $4"; }

# check: the components come back, and all else with them
"$GOUGH" check camera.yaml --json --lengths "$lengths" > by_lengths.json
jq -e -n --slurpfile a by_pose.json --slurpfile b by_lengths.json '
  def near($x; $y; $e): ($x - $y) | (if . < 0 then -. else . end) < $e;
  ([2, -3, 4, 0.1, 0.12, 0.05] as $c | all(range(6); near($b[0].pose.component[.]; $c[.]; 1e-9)))
  and all(range(6); near($a[0].pose.length[.]; $b[0].pose.length[.]; 1e-9))
  and near($a[0].pose.condition; $b[0].pose.condition; 1e-6)' > /dev/null || fail "check: $(jq -c .pose.component by_lengths.json)"

# stability at rest there
"$GOUGH" stability camera.yaml --json --pose "$pose" > a.json
"$GOUGH" stability camera.yaml --json --lengths "$lengths" > b.json
jq -e -n --slurpfile a a.json --slurpfile b b.json '
  all(range(6); ($a[0].thresholds[.].stiffness - $b[0].thresholds[.].stiffness | if . < 0 then -. else . end)
                < 1e-6 * (1e-9 + ($a[0].thresholds[.].stiffness | if . < 0 then -. else . end)))' > /dev/null ||
  fail "stability"

# a run starts there
cat > swing.yaml <<'END'
platform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, half_angle: 15}, height: 1.2}
load: {mass: 1, inertia: [0.08, 0.08, 0.15]}
control: {stiffness: 500, damping: 20}
simulation: {duration: 0.5, output_step: 0.1, method: rk4, step: 0.005}
END
at=surge=0.02,heave=-0.05,pitch=3
lengths=$("$GOUGH" check swing.yaml --json --pose $at | jq -r '.pose.length | map(tostring) | join(",")')
"$GOUGH" simulate swing.yaml -q --lengths "$lengths" -o run.csv
"$GOUGH" simulate swing.yaml -q --set initial.surge=0.02 --set initial.heave=-0.05 --set initial.pitch=3 \
    --set initial.sway=0 --set initial.roll=0 --set initial.yaw=0 -o same.csv
paste -d, <(grep -v '^#' run.csv) <(grep -v '^#' same.csv) | awk -F, '
  NR == 1 { n = NF / 2; next }
  { for (i = 1; i <= n; i++) { d = $i - $(i + n); if (d < 0) d = -d; if (d > 1e-8) bad++ } }
  END { exit !(NR == 7 && bad == 0) }' || fail "simulate: $(head -3 run.csv)"
# what is set besides does not count against the lengths
"$GOUGH" simulate swing.yaml -q --set initial.heave=0.1 --lengths "$lengths" -o set.csv
cmp <(grep -v '^#' set.csv) <(grep -v '^#' run.csv) || fail "initial.heave beside --lengths"

# and so does each run of a sweep
cp swing.yaml sweep.yaml
echo 'sweep: {keys: {control.stiffness: [400, 500]}}' >> sweep.yaml
if "$GOUGH" sweep sweep.yaml -q --lengths "$lengths" -o sweep.csv 2> why; then :; else cat why; fail "sweep"; fi
for name in x y z roll pitch yaw; do
    near "$name of the sweep" "$(column sweep.csv $name | tail -1)" "$(column run.csv $name | tail -1)" 1e-10
done

# ---- refusals ----
refused() { # STATUS WORDS COMMAND...
  local status=$1 words=$2 got=0
  shift 2
  "$@" > out 2> why || got=$?
  [ "$got" = "$status" ] || fail "$*: exit $got, not $status: $(cat why)"
  grep -q "$words" why || fail "$*: says $(cat why)"
}
refused 2 'give only one' "$GOUGH" check swing.yaml --pose heave=0 --lengths "$lengths"
refused 2 'give only one' "$GOUGH" stability swing.yaml --pose heave=0 --lengths "$lengths"
refused 2 'along the program' "$GOUGH" stability swing.yaml --sweep-stiffness 0:2:3 --lengths "$lengths"
refused 2 'read only once' "$GOUGH" simulate - --lengths "$lengths" < swing.yaml
refused 2 'takes six lengths' "$GOUGH" check swing.yaml --lengths 1,2,3
refused 1 'no step from this pose\|certain for' "$GOUGH" check swing.yaml --lengths 1,1,1,1,1,9
refused 2 'varies platform.height' "$GOUGH" sweep sweep.yaml --set 'sweep.keys={platform.height: [1.2, 1.3]}' --lengths "$lengths" -o x.csv
[ ! -e x.csv ] || fail "a refused sweep leaves a table"

# ---- resolution ----
count=1e-4
"$GOUGH" check swing.yaml --json --pose $at --set pose.length_error=$count --set platform.joints.tolerance=2e-4 \
    --set 'control.sampling={period: 0.005, resolution: 3e-4, velocity: difference}' > res.json
jq -e '.pose.resolution | (.per_length.legs | unique) == [1] and (.length_error.legs | unique) == [1e-4]
  and (.joints.legs | unique) == [4e-4] and (.count.legs | unique) == [3e-4]
  and (.joints.position / .length_error.position - 4 | . * . < 1e-20)
  and (.count.angle / .length_error.angle - 3 | . * . < 1e-20)' res.json > /dev/null || fail "sources: $(jq -c .pose.resolution res.json)"
# the pose of lengths that are off as named is off as said
off=$(jq -r '[.pose.length, .pose.resolution.length_error.position_legs] | transpose | map(add | tostring) | join(",")' res.json)
"$GOUGH" pose swing.yaml --json --lengths "$off" > off.json
jq -e -n --slurpfile r res.json --slurpfile o off.json '
  ($o[0].poses[0] | [.surge, .sway, .heave]) as $p | $r[0].pose.component as $c | $r[0].pose.resolution.length_error as $e
  | [range(3)] | all(($p[.] - $c[.] - $e.position * $e.direction[.]) | . * . < 1e-12)
  ' > /dev/null || fail "worst: $(jq -c .poses[0] off.json)"
# a matrix in degrees a metre: the yaw that a change of leg 1 makes, which is the rotation about z and, pitched by 3 degrees, tan 3°
# times that about x
step=$(jq -r '.pose.length as $l | [$l[0] + 1e-5, $l[1], $l[2], $l[3], $l[4], $l[5]] | map(tostring) | join(",")' res.json)
"$GOUGH" pose swing.yaml --json --lengths "$step" > step.json
jq -e -n --slurpfile r res.json --slurpfile s step.json '
  (($s[0].poses[0].yaw - $r[0].pose.component[5]) / 1e-5) as $slope | ($r[0].pose.resolution.map | .[5][0] + 0.0524077792830412 * .[3][0]) as $m
  | ($m * $m > 1) and (($slope - $m) / $m | . * . < 1e-4)' > /dev/null || fail "map: $(jq -c .pose.resolution.map res.json)"
# read by eye
"$GOUGH" check swing.yaml --pose $at --set pose.length_error=$count > text
grep -q 'pose by leg lengths \[1; deg/m\]' text || fail "$(cat text)"
grep -q 'legs off by up to 0.0001 m (pose.length_error)' text || fail "$(cat text)"
said=$(sed -n '/pose.length_error)/,$p' text | awk '/point moves/ { print $3; exit }')
jq -e --arg said "$said" '.pose.resolution.length_error.position / ($said | tonumber) - 1 | . * . < 1e-6' res.json > /dev/null || fail "said $said"
# units of one's own: mm and mrad
"$GOUGH" check camera.yaml --json --pose surge=2 --set pose.length_error=0.001 > mm.json
jq -e '.pose.resolution.length_error | (.legs | unique) == [0.001] and .position > 0.0005 and .position < 0.1' mm.json > /dev/null || fail "mm: $(jq -c .pose.resolution mm.json)"
refused 2 'pose.length_error' "$GOUGH" check swing.yaml --set pose.length_error=-1
refused 2 'platform.joints.tolerance' "$GOUGH" check swing.yaml --set 'platform.joints.tolerance=[0, 0, 0, 0, 0, -1]'
finish
