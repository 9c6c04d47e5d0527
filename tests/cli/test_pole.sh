#!/usr/bin/env bash
# Recorded motion close to a pitch of 90 degrees, as instruments write it, against the same motion far from any pole: base, load and
# gravity turned by a constant rotation Q, whose angles are formulas there.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1

# make NAME Q INTERVAL DECIMALS: NAME.csv, its study rec.yaml, and the turned study ref.yaml. Q: "cyclic" or "tilted"
cat >make.awk <<'AWK'
function multiply(A, B, C,    i, j, k) { for (i = 1; i <= 3; i++) for (j = 1; j <= 3; j++) { C[i, j] = 0; for (k = 1; k <= 3; k++) C[i, j] += A[i, k] * B[k, j] } }
function transpose(A, B,    i, j) { for (i = 1; i <= 3; i++) for (j = 1; j <= 3; j++) B[j, i] = A[i, j] }
# rotation about axis n
function about(n, angle, A,    a, b, i, j) {
    for (i = 1; i <= 3; i++) for (j = 1; j <= 3; j++) A[i, j] = (i == j)
    a = n % 3 + 1; b = a % 3 + 1
    A[a, a] = A[b, b] = cos(angle); A[a, b] = -sin(angle); A[b, a] = sin(angle)
}
function row(x, y, z,    k) { k = ++vectors; v[k, 1] = x; v[k, 2] = y; v[k, 3] = z; return k }
# Q^T (v - shift e_z) + shift e_z
function turned(k, shift,    i, out) {
    out = ""
    for (i = 1; i <= 3; i++) out = out sprintf("%s%.17g", i > 1 ? ", " : "", Q[1, i] * v[k, 1] + Q[2, i] * v[k, 2] + Q[3, i] * (v[k, 3] - shift) + (i == 3 ? shift : 0))
    return "[" out "]"
}
function plain(k) { return sprintf("[%.17g, %.17g, %.17g]", v[k, 1], v[k, 2], v[k, 3]) }
function inertia(    A, B, C, QT, i) {
    for (i = 1; i <= 9; i++) A[int((i + 2) / 3), (i - 1) % 3 + 1] = 0
    A[1, 1] = 18; A[2, 2] = 22; A[3, 3] = 14
    transpose(Q, QT); multiply(QT, A, B); multiply(B, Q, C)
    return sprintf("[[%.17g, %.17g, %.17g], [%.17g, %.17g, %.17g], [%.17g, %.17g, %.17g]]", C[1, 1], C[1, 2], C[1, 3], C[1, 2], C[2, 2], C[2, 3], C[1, 3], C[2, 3], C[3, 3])
}
BEGIN {
    pi = atan2(0, -1); degree = pi / 180; height = 3
    if (kind == "cyclic") { Q[2, 1] = Q[3, 2] = Q[1, 3] = 1; Q[1, 1] = Q[1, 2] = Q[2, 2] = Q[2, 3] = Q[3, 1] = Q[3, 3] = 0 }
    # e_z of Q is an axis at 0.1 degrees from e_y: rotation about it passes 0.1 degrees from the pole
    else { tilt = 0.1 * degree; about(1, -pi / 2, A); about(3, -tilt, B); multiply(B, A, Q) }
    transpose(Q, QT)
    print "t,roll,pitch,yaw" >(name ".csv")
    for (k = 0; k * interval < 8 + interval / 2; k++) {
        t = k * interval
        if (kind == "cyclic") { r = 95 * (1 - cos(pi * t / 4)) / 2; p = 3 * sin(2 * t + 0.3); y = 2 * sin(1.3 * t) }
        else { r = 0; p = 0; y = 47.5 * (1 - cos(pi * t / 4)) }
        about(1, r * degree, X); about(2, p * degree, Y); about(3, y * degree, Z)
        multiply(Z, Y, A); multiply(A, X, B); multiply(Q, B, A); multiply(A, QT, R)
        if (order == "xyz") # R = Rx Ry Rz
            printf "%.6f,%.*f,%.*f,%.*f\n", t, decimals, atan2(-R[2, 3], R[3, 3]) / degree, decimals, atan2(R[1, 3], sqrt(R[2, 3] ^ 2 + R[3, 3] ^ 2)) / degree,
                decimals, atan2(-R[1, 2], R[1, 1]) / degree >(name ".csv")
        else printf "%.6f,%.*f,%.*f,%.*f\n", t, decimals, atan2(R[3, 2], R[3, 3]) / degree, decimals, atan2(-R[3, 1], sqrt(R[1, 1] ^ 2 + R[2, 1] ^ 2)) / degree,
            decimals, atan2(R[2, 1], R[1, 1]) / degree >(name ".csv")
    }
    for (k = 0; k < 6; k++) {
        a = (120 * int((k + 1) / 2) + (k % 2 ? -9.05 : 9.05)) * degree
        b = (120 * int(k / 2) + 60 + (k % 2 ? 5.1 : -5.1)) * degree
        base[k] = row(0.747 * cos(a), 0.747 * sin(a), 0); top[k] = row(0.5623 * cos(b), 0.5623 * sin(b), 0)
    }
    center = row(0.05, 0.02, 0.35); gravity = row(0, 0, -9.81)
    for (k = 0; k < 6; k++) {
        joints = joints (k ? ", " : "") plain(base[k]); tops = tops (k ? ", " : "") plain(top[k])
        turned_joints = turned_joints (k ? ", " : "") turned(base[k], height); turned_tops = turned_tops (k ? ", " : "") turned(top[k], 0)
    }
    rest = "simulation: {duration: 8, output_step: 0.02, tolerance: 1e-10}\ncontrol: {stiffness: 2e5, damping: 2000}\n"
    printf "platform: {height: %g, base: {joints: [%s]}, top: {joints: [%s]}}\n", height, joints, tops >"rec.yaml"
    printf "load: {mass: 180, center_of_mass: %s, inertia: [18, 22, 14]}\ngravity: %s\nmotion: {order: %s, samples: %s.csv}\n%s", plain(center), plain(gravity), order, name, rest >"rec.yaml"
    printf "platform: {height: %g, base: {joints: [%s]}, top: {joints: [%s]}}\n", height, turned_joints, turned_tops >"ref.yaml"
    printf "load: {mass: 180, center_of_mass: %s, inertia: %s}\ngravity: %s\n%s", turned(center, 0), inertia(), turned(gravity, 0), rest >"ref.yaml"
    if (kind == "cyclic") print "motion: {roll: 95*(1-cos(pi*t/4))/2, pitch: 3*sin(2*t+0.3), yaw: 2*sin(1.3*t)}" >"ref.yaml"
    else print "motion: {yaw: 47.5*(1-cos(pi*t/4))}" >"ref.yaml"
}
AWK
make() { awk -v name="$1" -v kind="$2" -v interval="$3" -v decimals="$4" -v order="${5:-zyx}" -f make.awk || fail "make $*"; }

# expect_forces SHARE CLAIM ARGUMENTS...: both studies' columns f1 to f6 agree in every row within SHARE of the peak
expect_forces() {
    local share=$1 claim=$2 file
    shift 2
    for file in rec ref; do
        run "${verb:-forces}" $file.yaml -q -o $file.csv "$@"
        expect_code 0 "$file.yaml, $claim"
        grep -q "warning: motion.samples" err && fail "$claim: $(cat err)"
        for leg in 1 2 3 4 5 6; do column $file.csv f$leg >$file.$leg; done
        paste $file.[1-6] >$file.forces
    done
    paste rec.forces ref.forces | awk -v share="$share" '
        { for (i = 1; i <= 6; i++) { d = $i - $(i + 6); if (d < 0) d = -d; f = $(i + 6) < 0 ? -$(i + 6) : $(i + 6); if (f > peak) peak = f; if (d > most) most = d } }
        END { printf "%.3g of the peak %.6g in %d rows\n", most / peak, peak, NR; exit !(NR >= 30 && peak > 100 && most <= share * peak) }' >difference ||
        fail "$claim: forces differ by $(cat difference)"
    [[ -z ${VERBOSE:-} ]] || echo "$claim: $(cat difference)"
}

# pitch to 90 degrees with a slow wobble; and a rotation about one axis that passes the pole at 0.1 degrees
for kind in cyclic tilted; do
    for interval in 0.02 0.1; do
        make $kind $kind $interval 9
        # splines are wrong in proportion to the square of the interval
        expect_forces "$([[ $interval == 0.1 ]] && echo 1e-3 || echo 1e-4)" "$kind, rows each $interval s"
    done
    make $kind $kind 0.02 9
    # half the angles about the axes that were found is nearly half the angles about Q: the rotation is nearly about one axis
    expect_forces 1e-3 "$kind, amplitude 0.5" --set motion.amplitude=0.5
    expect_forces 1e-3 "$kind, amplitude 0.7, frequency 0.5" --set motion.amplitude=0.7 --set motion.frequency=0.5
    run forces rec.yaml
    [[ $(grep -c "about turned axes" err) == 1 ]] || fail "$kind: not one remark: $(cat err)"
    grep -q "motion.samples: between t = .* pitch is within 0[.0-9]* deg of 90 deg, .* closer than [0-9]* deg to such a pose" err || fail "$kind: $(cat err)"
    run forces rec.yaml -q
    [[ -s err ]] && fail "$kind: -q told $(cat err)"

    # 33 digits take the same rotations
    for precision in double quad; do
        run forces rec.yaml -q --set simulation.duration=4.8 --set simulation.output_step=0.4 --precision $precision -o $precision.csv
        expect_code 0 "$kind, $precision"
        column $precision.csv f2 >$precision.f2
    done
    paste double.f2 quad.f2 | awk '{ d = $1 / $2 - 1; if (!(d < 1e-9 && d > -1e-9)) bad++ } END { exit bad > 0 || NR < 12 }' || fail "$kind: double and quad differ"
done

# the same rotations as angles in the order xyz, which come as close to its pole
make cyclic cyclic 0.02 9 xyz
expect_forces 1e-4 "cyclic, order xyz"
run forces rec.yaml
[[ $(grep -c "about turned axes" err) == 1 ]] || fail "order xyz: not one remark: $(cat err)"

# ---- one motion, wobbling: rec.yaml and ref.yaml of "cyclic"
make cyclic cyclic 0.02 9
# lanes of a sweep, each with its own machine, and single runs
for file in rec ref; do
    run sweep $file.yaml -q --set simulation.duration=4 --set 'sweep={keys: {load.mass: [150, 160, 170, 180, 190]}}' -o sweep_$file.csv
    expect_code 0 "sweep $file.yaml"
    column sweep_$file.csv force >sweep_$file.peak
done
[[ $(wc -l <sweep_rec.peak) == 5 ]] || fail "columns of a sweep: $(head -1 sweep_rec.csv)"
paste sweep_rec.peak sweep_ref.peak | awk '{ d = $1 / $2 - 1; if (!(d < 1e-4 && d > -1e-4)) bad++ } END { exit bad > 0 || NR != 5 }' ||
    fail "peaks of sweeps: $(paste sweep_rec.peak sweep_ref.peak)"
# the loop is unstable later
verb=simulate expect_forces 1e-5 "simulate" --set simulation.duration=4

# ranges are those of roll, pitch and yaw: of a record dense enough to have the extremes in its rows
awk -v name=dense -v kind=cyclic -v interval=0.001 -v decimals=9 -v order=zyx -f make.awk
ranges() { awk -F, 'NR > 1 { for (i = 2; i <= 4; i++) { x = $i
        if (NR > 2) { while (x - last[i] > 180) x -= 360; while (x - last[i] < -180) x += 360 }
        last[i] = x; if (NR == 2 || x < low[i]) low[i] = x; if (NR == 2 || x > high[i]) high[i] = x } }
    END { for (i = 2; i <= 4; i++) print low[i], high[i] }' "$1"; }
ranges dense.csv >ranges
make cyclic cyclic 0.02 9
run check rec.yaml --json
jq -r '.program | (.roll, .pitch, .yaw) | "\(.[0]) \(.[1])"' out | paste - ranges |
    awk '{ for (i = 1; i <= 2; i++) { d = $i - $(i + 2); if (!(d < 2e-3 && d > -2e-3)) bad++ } } END { exit bad > 0 || NR != 3 }' ||
    fail "ranges $(jq -c '[.program.roll, .program.pitch, .program.yaw]' out) are not $(paste -s ranges)"
jq -e '.program.record | .turned and .pole_distance > 60 and (.columns | length) == 3 and ([.remarks[] | select(.warning)] | length) == 0' out >/dev/null ||
    fail "check --json: $(jq -c .program.record out)"
run check rec.yaml
grep -q "rotations  *interpolated about turned axes, [0-9]* deg or more" out || fail "check: $(grep -A9 samples out)"

# the angles of a start remain roll, pitch and yaw
first() { for c in roll pitch yaw; do column start.csv $c | head -1; done | paste -sd' '; }
run simulate rec.yaml -q --set simulation.duration=0.1 -o start.csv
before=$(first)
run simulate rec.yaml -q --set simulation.duration=0.1 --set initial.pitch=20 -o start.csv
awk -v a="$before" -v b="$(first)" 'BEGIN { split(a, x); split(b, y); for (i = 1; i <= 3; i++) { d = y[i] - (i == 2 ? 20 : x[i]); if (!(d < 1e-9 && d > -1e-9)) bad = 1 } exit bad || x[3] < 0.8 }' ||
    fail "initial.pitch 20 makes $(first) of $before"

# rounded angles: as recorded there is a warning that names the new angles; smoothing by the rounding, by standard deviations and
# by a cutoff finds the forces
make cyclic cyclic 0.005 3
run forces rec.yaml
grep -q "warning: motion.samples has values of roll about turned axes in steps of 0.001[0-9]* deg" err || fail "rounded angles: $(cat err)"
for smoothing in "smooth: rounding" "smooth: {roll: 0.0003, pitch: 0.0003, yaw: 0.0003}" "cutoff: 4"; do
    sed "s/cyclic.csv}/cyclic.csv, $smoothing}/" rec.yaml >smoothed.yaml
    cp smoothed.yaml rec.yaml
    expect_forces 5e-3 "3 decimals, $smoothing"
    make cyclic cyclic 0.005 3
done
# a deviation given for roll is one of several angles about turned axes, none larger than it is in roll
sed 's/cyclic.csv}/cyclic.csv, smooth: {roll: 0.0003}}/' rec.yaml >smoothed.yaml
run check smoothed.yaml --json
jq -e '[.program.record.columns[].change] | (map(. * .) | add | sqrt | . > 2e-4 and . <= 3.01e-4) and (map(select(. > 1e-4)) | length) == 2' out >/dev/null ||
    fail "smooth: {roll: 0.0003}: $(jq -c .program.record.columns out)"
finish
