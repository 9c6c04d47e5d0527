#!/usr/bin/env bash
# Limits of data sheets: what check, forces, simulate and sweep print of them, against closed forms and finite differences of the
# tables; six equal numbers are one.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null && command -v python3 >/dev/null || { echo "skipped: no jq or no python3"; exit 77; }

cat >"$scratch/sheet.yaml" <<'EOF'
platform:
  base: {radius: 1.5, half_angle: 10}
  top: {radius: 1.0, half_angle: 10}
  height: 1.2
  legs: {stroke: [-0.2, 0.2], max_speed: 0.5, force: [-3000, 4000], max_acceleration: 0.5}
  joints: {base_swing: 8, top_swing: [9, 9, 9, 9, 9, 5]}
  limits:
    heave: 0.08
    yaw: [-5, 15]
    speed: {heave: 0.3, yaw: 20}
    acceleration: {heave: [-0.3, 0.5]}
load: {mass: 500, inertia: [100, 100, 150]}
motion: {heave: 0.1*sin(2*t), yaw: 10*sin(t)}
control: {stiffness: 200000, damping: 20000}
simulation: {duration: 6}
EOF

# check: each limit once, as the file gives it, the length from the stroke
run check "$scratch/sheet.yaml"
for line in 'length limits        1.34657 to 1.74657 m' 'greatest speed       0.5 m/s' 'force limits         -3000 to 4000 N' \
    'greatest accel.      0.5 m/s^2' 'swing at base        8 deg' 'swing at top         9, 9, 9, 9, 9, 5 deg' 'heave                ±0.08 m' \
    'yaw                  -5 to 15 deg' 'heave velocity       ±0.3 m/s' 'yaw velocity         ±20 deg/s' 'heave accel.         -0.3 to 0.5 m/s^2'; do
    grep -qxF "  $line" "$scratch/out" || fail "check lacks '$line': $(sed -n '/limits/,/^$/p' "$scratch/out")"
done
grep -qE 'warning: along the program: the platform falls below its least acceleration in heave -0\.3 m/s\^2 at t = 0\.4240' "$scratch/err" ||
    fail "check: warnings $(cat "$scratch/err")"
run check "$scratch/sheet.yaml" --json
jq -e '.limits as $l | $l.legs.force == [range(6) | [-3000, 4000]] and ($l.legs.top_swing[5] - 5 | fabs) < 1e-12 and
       $l.platform.pose[0] == [null, null] and $l.platform.pose[2] == [-0.08, 0.08] and
       ($l.platform.speed[5] | map(. * 1e6 | round) == [-20000000, 20000000]) and
       (.stroke[1] - .home_length[0] - 0.2 | fabs) < 1e-12' "$scratch/out" >/dev/null || fail "check --json: $(jq -c .limits "$scratch/out")"

# forces: z = 0.1 sin 2t and ψ = 10° sin t cross their limits where the inverse functions say
run forces "$scratch/sheet.yaml" --json
expect_code 1 "beyond limits"
cp "$scratch/out" "$scratch/forces.json"
python3 - "$scratch/forces.json" <<'EOF' || fail "forces --json"
import json, math, sys
found = json.load(open(sys.argv[1]))
pi, asin = math.pi, math.asin
def use(kind, component, least):
    one, = [u for u in found["limits"] if (u["kind"], u["component"], u["least"]) == (kind, component, least)]
    return one
def near(a, b, slack=1e-8):
    assert (a is None) == (b is None) and (a is None or abs(a - b) <= slack), (a, b)
def expect(kind, component, least, limit, worst, share, count, enter, leave):
    u = use(kind, component, least)
    near(u["limit"], limit, 1e-12 * abs(limit)), near(u["worst"], worst, 1e-6 * abs(worst)), near(u["share"], share, 1e-6 * abs(share))
    assert u["count"] == count and u["leg"] is None, u
    near(u["enter"], enter), near(u["leave"], leave)
half = asin(0.8) / 2
expect("platform_pose", "heave", False, 0.08, 0.1, 1.25, 2, half, 1.5 * pi - half)
expect("platform_pose", "heave", True, -0.08, -0.1, 1.25, 2, pi / 2 + half, 2 * pi - half)
expect("platform_pose", "yaw", True, -5, -10, 2, 1, 7 * pi / 6, 11 * pi / 6)
expect("platform_pose", "yaw", False, 15, 10, 10 / 15, 0, None, None)
expect("platform_speed", "heave", False, 0.3, 0.2, 2 / 3, 0, None, None)
expect("platform_speed", "yaw", True, -20, -10, 0.5, 0, None, None)
expect("platform_acceleration", "heave", True, -0.3, -0.4, 4 / 3, 2, asin(0.75) / 2, 1.5 * pi - asin(0.75) / 2)
expect("platform_acceleration", "heave", False, 0.5, 0.4, 0.8, 0, None, None)
# swings are those of the legs' own summary, and each leg has its own limit
for kind, key, limits in (("base_swing", "base", [8] * 6), ("top_swing", "top", [9] * 5 + [5])):
    mine = [u for u in found["limits"] if u["kind"] == kind]
    assert [round(u["limit"], 9) for u in mine] == limits, mine
    for u, leg in zip(mine, found["legs"]):
        near(u["worst"], leg["swing"][key], 1e-5), near(u["share"], u["worst"] / u["limit"], 1e-9)
        assert (u["count"] > 0) == (u["share"] > 1), u
# of a force between -3000 and 4000 both sides are used, and pulling is used by no leg that pushes all the time
for u in (u for u in found["limits"] if u["kind"] == "leg_force"):
    leg = found["legs"][u["leg"] - 1]
    assert u["limit"] == (-3000 if u["least"] else 4000) and u["worst"] == leg["force"][0 if u["least"] else 1]
    near(u["share"], 0 if u["least"] else leg["force"][1] / 4000, 1e-12)
assert found["end"]["status"] == "platform_acceleration" and found["end"]["component"] == "heave" and found["end"]["least"] is True
near(found["end"]["time"], asin(0.75) / 2), near(found["end"]["limit"], -0.3, 0)
EOF

# for reading: a line for each leg and component that is beyond, one for each kind that is met; every excess with --all only
run forces "$scratch/sheet.yaml" --all
for line in 'least heave            -0\.1 m of -0\.08 m, 125 %, 2 times, t = 2\.03444 to ' 'leg 6 swing at top     [0-9.]+ deg of 5 deg, [0-9.]+ %, ' \
    'least yaw              -10 deg of -5 deg, 200 %, t = 3\.66519 to 5\.75959 s$' 'greatest heave velocity 0\.2 m/s of 0\.3 m/s, 66\.67 %$' \
    'greatest yaw velocity  10 deg/s of 20 deg/s, 50 %$' 'greatest force         [0-9.]+ N of 4000 N, [0-9.]+ %, leg [1-6]$' \
    'least force            [0-9.]+ N of -3000 N, 0 %, leg [1-6]$' 'greatest accel\.        [0-9.]+ m/s\^2 of 0\.5 m/s\^2, [0-9.]+ %, leg [1-6]$' \
    'least yaw              t = 3\.66519 to 5\.75959 s, at worst -10 deg at t = 4\.71' \
    'least heave acceleration t = 0\.424031 to 1\.14677 s, at worst -0\.39999[0-9] m/s\^2 at t = 0\.78'; do
    grep -qE "^    $line" "$scratch/out" || fail "forces --all lacks '$line': $(sed -n '/limits/,$p' "$scratch/out")"
done
[[ $(grep -c ', at worst ' "$scratch/out") == $(jq '[.limits[].count] | add' "$scratch/forces.json") ]] || fail "--all lists another number of intervals"
run forces "$scratch/sheet.yaml"
! grep -q ', at worst ' "$scratch/out" || fail "each excess is listed unasked"

# the point `about` and the acceleration of each leg's length, by differences of a table of close rows
tilting=(--set 'motion={pitch: "12*sin(2*t)", yaw: 15*sin(t), surge: 0.1*sin(t)}' --set 'platform.joints=' --set 'platform.legs={max_acceleration: 0.1}'
    --set 'platform.limits={surge: 0.1, speed: {surge: 0.1, sway: 0.1, yaw: 1}, acceleration: {surge: 0.1, heave: 0.1, pitch: 1}, about: [0.3, 0.2, 0.8]}')
"$GOUGH" forces "$scratch/sheet.yaml" "${tilting[@]}" --set simulation.output_step=0.002 -q -o "$scratch/fine.csv" 2>/dev/null
run forces "$scratch/sheet.yaml" "${tilting[@]}" --json
python3 - "$scratch/out" "$scratch/fine.csv" <<'EOF' || fail "limits at a point of the top"
import csv, json, math, sys
found, rows = json.load(open(sys.argv[1])), [{k: float(v) for k, v in row.items()} for row in csv.DictReader(open(sys.argv[2]))]
h, about = 0.002, (0.3, 0.2, 0.8)
def point(row):
    r, p, y = (math.radians(row[k]) for k in ("roll", "pitch", "yaw"))
    c, s = math.cos, math.sin
    R = [[c(y)*c(p), c(y)*s(p)*s(r) - s(y)*c(r), c(y)*s(p)*c(r) + s(y)*s(r)], [s(y)*c(p), s(y)*s(p)*s(r) + c(y)*c(r), s(y)*s(p)*c(r) - c(y)*s(r)],
         [-s(p), c(p)*s(r), c(p)*c(r)]]
    return [row["xyz"[i]] + sum(R[i][k] * about[k] for k in range(3)) for i in range(3)]
place = [point(row) for row in rows]
# central differences, of second order at the ends too
first = lambda x: [(x[1] * 4 - x[0] * 3 - x[2]) / (2 * h)] + [(x[i + 1] - x[i - 1]) / (2 * h) for i in range(1, len(x) - 1)]
second = lambda x: [(2 * x[0] - 5 * x[1] + 4 * x[2] - x[3]) / h**2] + [(x[i + 1] - 2 * x[i] + x[i - 1]) / h**2 for i in range(1, len(x) - 1)]
axis = lambda i: [p[i] for p in place]
wanted = {("platform_pose", "surge"): [x - about[0] for x in axis(0)], ("platform_speed", "surge"): first(axis(0)),
          ("platform_speed", "sway"): first(axis(1)), ("platform_acceleration", "surge"): second(axis(0)),
          ("platform_acceleration", "heave"): second(axis(2)), ("platform_speed", "yaw"): [row["wz"] for row in rows],
          ("platform_acceleration", "pitch"): [row["aly"] for row in rows]}
tried = 0
for u in found["limits"]:
    if u["kind"] == "leg_acceleration":
        value, slack = max(abs(x) for x in second([row[f"l{u['leg']}"] for row in rows])), 2e-5
    else:
        values = wanted[u["kind"], u["component"]]
        value, slack = (min if u["least"] else max)(values), 5e-5 * max(map(abs, values))
    assert abs(u["worst"] - value) <= slack, (u, value)
    tried += 1
assert tried == 6 + 2 * 7, tried
EOF

# simulate ends where the program does, with a sentence in degrees; the same end from a sweep with fixed steps, in lanes
run simulate "$scratch/sheet.yaml" --set platform.legs= --set platform.joints= --set 'platform.limits={yaw: 8}' --json
jq -e '.end.status == "platform_pose" and .end.component == "yaw" and .end.leg == null and .end.legs == [] and (.end.least | not) and
       (.end.limit - 8 | fabs) < 1e-12 and (.end.time - 0.927295218 | fabs) < 1e-6 and
       (.end.message | test("^the platform exceeds its greatest yaw 8 deg at t = 0\\.9272[0-9]* s$"))' "$scratch/out" >/dev/null ||
    fail "simulate: $(jq -c .end "$scratch/out")"
run sweep "$scratch/sheet.yaml" --set platform.legs= --set platform.joints= --set simulation='{duration: 2, output_step: 0.05, step: 0.005, method: rk4}' \
    --set 'platform.limits={yaw: 8, heave: 0.5, speed: {heave: 0.5}}' \
    --set 'sweep={combine: zip, keys: {platform.limits.yaw: [8, 20, 20], platform.limits.heave: [0.5, 0.09, 0.5], platform.limits.speed.heave: [0.5, 0.5, 0.6]}}' \
    -o "$scratch/ends.csv" --json
jq -e '.done == 1 and .ended == {platform_pose: 2}' "$scratch/out" >/dev/null || fail "sweep: $(jq -c '[.done, .ended]' "$scratch/out") $(cat "$scratch/err")"
[[ $(column "$scratch/ends.csv" end_cause | paste -sd' ') == 'platform_pose platform_pose done' ]] || fail "causes: $(cat "$scratch/ends.csv")"
column "$scratch/ends.csv" end_time | python3 -c '
import math, sys
times = [float(x) for x in sys.stdin]
assert abs(times[0] - math.asin(0.8)) < 1e-6 and abs(times[1] - math.asin(0.9) / 2) < 1e-6 and times[2] == 2, times' || fail "times of the ends"
run sweep "$scratch/sheet.yaml" --set 'sweep={keys: {platform.legs.stroke.2: [0.1, 0.2], platform.joints.top_swing.6: [4, 5]}}' -o "$scratch/stroke.csv" --json
expect_code 0 "elements of pairs and of six vary"

# one for all is six alike, to the last bit
six=(--set 'platform.legs={stroke: [[-0.2, 0.2], [-0.2, 0.2], [-0.2, 0.2], [-0.2, 0.2], [-0.2, 0.2], [-0.2, 0.2]], max_speed: [0.5, 0.5, 0.5, 0.5, 0.5, 0.5], force: [[-3000, 4000], [-3000, 4000], [-3000, 4000], [-3000, 4000], [-3000, 4000], [-3000, 4000]], max_acceleration: [0.5, 0.5, 0.5, 0.5, 0.5, 0.5]}'
    --set 'platform.joints.base_swing=[8, 8, 8, 8, 8, 8]')
run forces "$scratch/sheet.yaml" "${six[@]}" --json
cmp -s "$scratch/out" "$scratch/forces.json" || fail "six equal limits are not one: $(diff "$scratch/out" "$scratch/forces.json" | head -5) $(cat "$scratch/err")"

# without dimensions: lengths in R_b, accelerations in g
run forces "$scratch/sheet.yaml" --dimensionless --json
jq -e --slurpfile si "$scratch/forces.json" '
    def of($d; $kind): $d.limits[] | select(.kind == $kind and .component == "heave" and .least);
    (of(.; "platform_pose").limit + 0.08 / 1.5 | fabs) < 1e-12 and
    (of(.; "platform_acceleration").limit + 0.3 / 9.80665 | fabs) < 1e-12 and
    (of(.; "platform_acceleration").worst * 9.80665 / of($si[0]; "platform_acceleration").worst - 1 | fabs) < 1e-12 and
    (.end.message | test("least acceleration in heave -0\\.0305[0-9]* at t = [0-9.]+"))' "$scratch/out" >/dev/null || fail "--dimensionless: $(jq -c .end "$scratch/out")"

# limits on angles in either order, in lanes and alone: a program that is kept to leaves them where the inverse functions say
cat >"$scratch/angles.yaml" <<'EOF'
platform: {base: {radius: 1.5, half_angle: 10}, top: {radius: 1.0, half_angle: 10}, height: 1.2}
load: {mass: 500, inertia: [100, 100, 150]}
motion: {roll: 9.5*sin(t), pitch: 8*sin(1.3*t), yaw: 14*sin(0.8*t)}
control: {stiffness: 200000, damping: 20000}
simulation: {duration: 1.5, output_step: 0.1, method: rk4, step: 0.001}
sweep: {seed: 1, runs: 5, keys: {load.mass: {uniform: [400, 600]}}}
EOF
for order in zyx xyz; do
    while read -r limit when; do
        set=(--set "motion.order=$order" --set "platform.limits={${limit/:/: }}")
        run sweep "$scratch/angles.yaml" "${set[@]}" -q -o "$scratch/lanes.csv"
        run sweep "$scratch/angles.yaml" "${set[@]}" --lanes 1 -q -o "$scratch/alone.csv"
        cmp -s "$scratch/lanes.csv" "$scratch/alone.csv" || fail "$order, $limit: lanes differ from single runs"
        [[ $(column "$scratch/lanes.csv" end_cause | sort -u) == platform_pose ]] || fail "$order, $limit: $(column "$scratch/lanes.csv" end_cause)"
        column "$scratch/lanes.csv" end_time |
            awk -v t="$when" '!($1 - t < 1e-8 && t - $1 < 1e-8) { bad = 1 } END { exit bad || NR != 5 }' ||
            fail "$order, $limit: ends at $(column "$scratch/lanes.csv" end_time | paste -sd' ') instead of $when s"
    done < <(python3 -c 'from math import asin
print("roll:9", asin(9 / 9.5)); print("pitch:7", asin(7 / 8) / 1.3); print("yaw:[-12,11]", asin(11 / 14) / 0.8)')
done
finish
