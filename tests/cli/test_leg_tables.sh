#!/usr/bin/env bash
# The tables of the legs that forces and simulate print: each number is that of the JSON to the digits shown, the row `all` is the
# least, the greatest or the sum of the legs, and swings at base and top are the angles between a leg at home and at the end.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
cat >legs.yaml <<'END'
title: Tables of the legs
units: si
platform:
  base: {joints: [[0.5, 0.1, 0], [-0.2, 0.45, 0.02], [-0.3, 0.4, 0], [-0.3, -0.4, 0], [-0.2, -0.45, 0], [0.5, -0.1, 0.01]]}
  top: {joints: [[0.2, 0.3, 0], [0.1, 0.35, 0], [-0.35, 0.05, 0], [-0.35, -0.05, 0.01], [0.1, -0.35, 0], [0.2, -0.3, 0]]}
  height: 0.6
  legs: {length: [0.4, 0.9]}
load: {mass: 10, center_of_mass: [0.02, 0, 0.1], inertia: [0.3, 0.4, 0.5]}
motion: {moves: [{start: 0, duration: 1, surge: 0.1, heave: 0.05, yaw: 12}]}
control: {stiffness: 5000, damping: 200}
simulation: {duration: 1, output_step: 0.01}
END

# what the tables have in order, of the array of legs .; and of all of them
motion='[.[] | [.length[0], .length[1], .length[1] - .length[0], 100 * .stroke_used, .speed, .swing.base, .swing.top]]'
loads='[.[] | [.force[0], .force[1], ([.force[] | fabs] | max), .rms_force, .power[0], .power[1], .energy, .returned_energy]]'
joints='[.[] | [.joint_load.top, .joint_load.base, .side_load, .friction_loss, .holding[0], .holding[1]]]'
motion_all='[min, max, max, max, max, max, max]' loads_all='[min, max, max, max, min, max, add, add]' joints_all='[max, max, max, add, min, max]'
sed 's/  legs: {length: \[0.4, 0.9\]}/  legs: {length: [0.4, 0.9], cylinder: {mass: [1, 2, 3, 2, 1, 2], center: 0.2, inertia: 0.01}, piston: {mass: 1, center: 0.1, inertia: 0.01}, friction: {coulomb: 5, smoothing_speed: 0.01}}/' legs.yaml >heavy.yaml
for study in legs heavy; do
for verb in forces simulate; do
    run $verb $study.yaml --json -q
    cp out legs.json
    run $verb $study.yaml
    tables='motion loads'
    if [[ $study == heavy ]]; then tables+=' joints'; else grep -q 'holds at home' out && fail "$verb: a table of joints of legs without mass and friction"; fi
    for table in $tables; do
        all=${table}_all
        jq -r "$(jq -rn --arg all "${!all}" '$all | gsub("[][ ]"; "") | split(",") | to_entries | map("($rows | map(.[\(.key)]) | \(.value))") | "(.legs | ROWS) as $rows | $rows + [[\(join(", "))]] | .[] | map(tostring) | join(\" \")"' |
            sed "s/ROWS/${!table//&/\\&}/")" legs.json >wanted
        case $table in motion) nth=1 ;; loads) nth=2 ;; joints) nth=3 ;; esac
        columns=$(($(wc -w <<<"${!all//,/ }")))
        awk -v nth=$nth '/^  leg / { k++ } k == nth && /^  ( *[1-6]|all) / { sub(/^ *[^ ]+/, ""); print } /^  all/ && k == nth { exit }' out >shown
        [[ $(wc -l <shown) == 7 && $(wc -l <wanted) == 7 ]] || fail "$verb: the table of $table has $(wc -l <shown) rows"
        # half of the last place shown; works that their integrals do not know are 0
        paste -d' ' shown wanted | awk -v n=$columns -v what="$verb, $study, $table" '{
            for (i = 1; i <= n; i++) {
                places = index($i, ".") ? length($i) - index($i, ".") : 0
                d = $i - $(i + n)
                if (!((d < 0 ? -d : d) <= 0.5000001 * 10 ^ -places) || NF != 2 * n) { print what ", row " NR ", number " i ": " $i " for " $(i + n); bad = 1 }
            } } END { exit bad }' >said || fail "$(<said)"
    done
done
done

# the move turns each leg one way, so its swing is greatest at the end: s = p + R b - a against s of home, and seen from the top Rᵀs
run forces legs.yaml --json -q
joints() { sed -n "s/^  $1: {joints: \\[\\(.*\\)\\]}\$/\\1/p" legs.yaml | tr -d '[]' | tr ',' ' '; }
awk -v base="$(joints base)" -v top="$(joints top)" 'BEGIN {
    split(base, a, " "); split(top, b, " "); pi = atan2(0, -1); c = cos(12 * pi / 180); s = sin(12 * pi / 180)
    for (leg = 0; leg < 6; leg++) {
        x = a[3 * leg + 1]; y = a[3 * leg + 2]; z = a[3 * leg + 3]; u = b[3 * leg + 1]; v = b[3 * leg + 2]; w = b[3 * leg + 3]
        hx = u - x; hy = v - y; hz = 0.6 + w - z
        ex = 0.1 + c * u - s * v - x; ey = s * u + c * v - y; ez = 0.65 + w - z
        tx = c * ex + s * ey; ty = -s * ex + c * ey
        print angle(hx, hy, hz, ex, ey, ez), angle(hx, hy, hz, tx, ty, ez)
    } }
    function angle(x, y, z, u, v, w,   p, q, r) {
        p = y * w - z * v; q = z * u - x * w; r = x * v - y * u
        return atan2(sqrt(p * p + q * q + r * r), x * u + y * v + z * w) * 180 / pi }' </dev/null >swings
jq -r '.legs[].swing | "\(.base) \(.top)"' out | paste -d' ' - swings | awk '{ for (i = 1; i <= 2; i++) { d = $i - $(i + 2)
    if (!((d < 0 ? -d : d) < 1e-4 * $(i + 2)) || NF != 4) { print "leg " NR ": swings " $1 " " $2 " instead of " $3 " " $4; bad = 1 } } } END { exit bad }' >said ||
    fail "$(<said)"
finish
