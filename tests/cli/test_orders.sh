#!/usr/bin/env bash
# Angles in the order xyz where they are read again: recorded motion against the same motion as formulas, and a limit of the platform at
# a point off its origin against R = Rx Ry Rz computed here. And external moments that do not repeat with the program.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
command -v python3 >/dev/null && command -v jq >/dev/null || { echo "skipped: no python3 or no jq"; exit 77; }
cd "$scratch" || exit 1
cat >machine.yaml <<'END'
platform:
  base: {radius: 1.5, half_angle: 8}
  top: {radius: 1.1, half_angle: 8}
  height: 2.0
  limits: {surge: [-0.01, 0.01], about: [0.2, 0.3, 0.6]}
load: {mass: 100, inertia: [40, 50, 45]}
simulation: {duration: 2, output_step: 0.01}
END
motion='order: xyz, surge: 0.05*sin(t)*ramp(t, 1), roll: 12*sin(2*t)*ramp(t, 1), pitch: 15*sin(t)*ramp(t, 1), yaw: 20*cos(t)*ramp(t, 1)'
run forces machine.yaml -q --set "motion={$motion}" -o formulas.csv
((code <= 1)) || fail "forces: $(cat "$err")"
run forces machine.yaml -q --set "motion={$motion}" --json
cp "$out" formulas.json

# the same as a record: the columns of the table itself, less the height
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; print "t,surge,sway,heave,roll,pitch,yaw"; next }
    { print $at["t"] "," $at["x"] "," $at["y"] "," $at["z"] - 2 "," $at["roll"] "," $at["pitch"] "," $at["yaw"] }' formulas.csv >record.csv
run forces machine.yaml -q --set 'motion={order: xyz, samples: record.csv}' -o record-forces.csv
((code <= 1)) || fail "forces of a record: $(cat "$err")"
python3 - <<'END' || fail "angles in the order xyz"
import csv, json, sys
from math import cos, sin, radians
bad = []
def rows(name):
    with open(name, encoding="utf-8") as stream:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(stream)]
a, b = rows("formulas.csv"), rows("record-forces.csv")
if len(a) != 201 or len(b) != 201:
    bad.append(f"{len(a)} and {len(b)} rows")
for one, other in zip(a, b):
    for leg in range(1, 7):
        if not abs(one[f"l{leg}"] - other[f"l{leg}"]) <= 1e-9:
            bad.append(f"t = {one['t']}: leg {leg} of the record is {other[f'l{leg}']}, not {one[f'l{leg}']}")
# surge of the point: x of the origin and of R = Rx Ry Rz times the point, less where it is at home
point = (0.2, 0.3, 0.6)
def surge(row):
    p, y = radians(row["pitch"]), radians(row["yaw"])
    first = (cos(p) * cos(y), -cos(p) * sin(y), sin(p))  # the first row of Rx Ry Rz: roll has no part in it
    return row["x"] + sum(u * v for u, v in zip(first, point)) - point[0]
greatest = max(map(surge, a))
entry = [e for e in json.load(open("formulas.json"))["limits"] if e["limit"] == 0.01]
if len(entry) != 1 or not abs(entry[0]["worst"] - greatest) <= 1e-4 * greatest or greatest < 0.02:
    bad.append(f"greatest surge of the point {greatest}, not {entry}")
print("\n".join(bad[:5]))
sys.exit(1 if bad else 0)
END

# tune reads the rows of its runs in the order of the study: a program that pitches only is the same in both orders
cat >pitching.yaml <<'END'
platform: {base: {radius: 1.5, half_angle: 8}, top: {radius: 1.1, half_angle: 8}, height: 2.0}
load: {mass: 100, inertia: [40, 50, 45], center_of_mass: [0, 0, 0.3]}
motion: {pitch: 25*sin(2*t)}
disturbance: {moment: [30*sin(5*t), 0, 25*cos(5*t)], force: [20*sin(5*t), 0, 0]}
control: {stiffness: 2e4}
simulation: {duration: 3.2, output_step: 0.01}
END
for order in zyx xyz; do
    run tune pitching.yaml --set motion.order=$order --deviation 1e-3 --damping-ratio 0.4 --feedforward program --json
    expect_code 0 "tune with the order $order"
    cp "$out" tuned-$order.json
done
jq -e -s '[.[] | [.choices | paths(type == "number") as $p | [($p | map(tostring) | join(".")), getpath($p)]]] as [$a, $b]
    | ($a | length) > 5 and ([$a[][0]] == [$b[][0]]) and any($a[]; .[0] | endswith("share"))
    and all(range($a | length); ($a[.][1] - $b[.][1] | fabs) <= 1e-6 * ($a[.][1] | fabs) + 1e-12)' tuned-zyx.json tuned-xyz.json >said ||
    fail "tune: the orders differ: $(diff tuned-zyx.json tuned-xyz.json | head -8)"

# a moment counts among what must repeat
wave='motion={heave: 0.02*sin(5*t)}'
run stability machine.yaml --set platform.limits= --set "$wave" --set 'external=[{moment: [0, 0, sin(3*t)]}]'
expect_code 2 "a moment with another period"
grep -qF "load 1 does not repeat with the period" "$err" || fail "a moment with another period: $(cat "$err")"
finish
