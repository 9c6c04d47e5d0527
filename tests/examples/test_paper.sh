#!/usr/bin/env bash
# The paper's study from the example files: Figure 3, the open-loop round trip, Figure 4 in both readings, feedback, feedback alone.
# The numbers are those of the closed form F = M(z̈ + g)l/6h and of an integration of z alone in 33 digits (docs/theory/stability.md).
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"

# ---- Figure 3 ----
run forces paper-heave.yaml forces
claim 'the forces of the program are found' same $status 0
while read -r t force; do
    for leg in 1 2 3 4 5 6; do
        claim "Figure 3: leg $leg at t = $t" near "$(value forces.csv "f$leg" "$t")" "$force" 1e-11
    done
done <<'END'
0   0.203442593596
1   0.209101612995
2   0.175090955204
5   0.255489804668
8   0.155927995559
15  0.170547755345
20  0.158317128383
END
# rows fall beside the extremes of the limit cycle, hence the width
run forces paper-heave.yaml cycle --set simulation.duration=60 --set simulation.output_step=0.001
claim 'Figure 3: least force of the limit cycle' near "$(extreme cycle.csv f1 min)" 0.154360488771665 1e-7
claim 'Figure 3: greatest force of the limit cycle' near "$(extreme cycle.csv f1 max)" 0.265753645318366 1e-7

# ---- the round trip ----
run simulate paper-heave.yaml trip
claim 'the round trip runs to its end' same "$status $(ended trip.json)" '0 done'
for e in ex ey ez; do
    claim "round trip: $e to t = 10" within "$(extreme trip.csv $e abs 10)" 0 1e-8
done
for e in eroll epitch eyaw; do # 1e-8 radians
    claim "round trip: $e to t = 10" within "$(extreme trip.csv $e abs 10)" 0 5.7e-7
done
for t in 5 10 15 20; do
    echo "      round trip to t = $t: heave off by $(extreme trip.csv ez abs $t), yaw by $(extreme trip.csv eyaw abs $t) degrees"
done
# round-off in yaw grows some 1e4 times in each period: physics, and so it must be there and must not be more
claim 'round trip: round-off has grown by t = 20' within "$(extreme trip.csv eyaw abs 20)" 1e-9 10

# ---- Figure 4, each leg's force disturbed ----
run simulate paper-perturbed.yaml perturbed
claim 'the disturbed run reaches t = 20' same "$status $(ended perturbed.json)" '0 done'
while read -r t deviation; do
    claim "Figure 4: deviation at t = $t" near "$(value perturbed.csv ez "$t")" "$deviation" \
        "$(awk -v x="$deviation" 'BEGIN { print 1e-6 * x }')"
done <<'END'
2   1.743071e-4
6   1.033157e-3
8   3.243242e-3
10  8.389190e-3
12  3.401663e-2
16  2.859080e-1
END

# an independent road: z alone, z̈ = 6 (F + ε) z/l − 1, by Runge–Kutta steps of 0.0025 in awk
awk 'function program(t,    e, u) {      # height and acceleration of (3.1)
         e = exp(-t / 2); u = 1 - e
         h = 1 + 0.2 * sin(t) * u * u
         a = 0.2 * (-sin(t) * u * u + 2 * cos(t) * u * e + sin(t) * (e * e / 2 - u * e / 2))
     }
     function acceleration(t, z) {
         program(t)
         return 6 * ((a + 1) * sqrt(h * h + 0.49) / (6 * h) + 1e-4 * sin(2 * t) * (1 - exp(-t / 2))) \
                * z / sqrt(z * z + 0.49) - 1
     }
     BEGIN {
         z = 1; v = 0; s = 0.0025
         for (n = 0; n <= 16 / s; n++) {
             t = n * s
             if (n % 20 == 0) { program(t); printf "%.2f %.12g\n", t, z - h }
             v1 = v;               a1 = acceleration(t, z)
             v2 = v + s / 2 * a1;  a2 = acceleration(t + s / 2, z + s / 2 * v1)
             v3 = v + s / 2 * a2;  a3 = acceleration(t + s / 2, z + s / 2 * v2)
             v4 = v + s * a3;      a4 = acceleration(t + s, z + s * v3)
             z += s / 6 * (v1 + 2 * v2 + 2 * v3 + v4)
             v += s / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
         }
     }' >alone.txt
agrees() {
    awk -v number="$number" '
        FNR == NR { other[$1] = $2; rows++; next }
        FNR == 1 { split($0, name, ","); for (i in name) if (name[i] == "ez") c = i; next }
        { split($0, x, ","); t = sprintf("%.2f", x[1]) }
        t in other {
            d = x[c] - other[t]; if (d < 0) d = -d
            if (x[c] !~ number || !(d <= 1e-6 * (other[t] < 0 ? -other[t] : other[t]) + 1e-11)) {
                print "      t = " t ": " x[c] " and " other[t]; bad = 1
            }
            met++
        }
        END { exit !(c && !bad && met == rows && rows > 300) }' alone.txt perturbed.csv
}
claim 'Figure 4: all rows to t = 16 agree with heave integrated alone' agrees

run simulate paper-perturbed.yaml fine --set simulation.output_step=0.0005
claim 'Figure 4: the platform leaves upwards, passing +1 at t = 18.2554' near \
    "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "ez") c = i; next } $c > 1 { print $1; exit }' fine.csv)" \
    18.2554 6e-4

# ---- Figure 4, the total vertical force disturbed ----
run simulate paper-perturbed-vertical.yaml vertical
claim 'the other reading reaches t = 20' same "$status $(ended vertical.json)" '0 done'
claim 'the other reading: small at first' within "$(extreme vertical.csv ez abs 8)" 1e-5 1e-3
# a sixth of the force in each leg, of which h/l = 0.82 is vertical: the early deviation is about 1/4.9 of the first reading
claim 'the other reading: about a fifth of the deviation at t = 2' within \
    "$(awk -v a="$(value vertical.csv ez 2)" -v b="$(value perturbed.csv ez 2)" 'BEGIN { print a / b }')" 0.18 0.23
claim 'the other reading: upwards too' within "$(value vertical.csv ez 20)" 0.1 10

# ---- feedback ----
run simulate paper-feedback.yaml feedback
claim 'the run with feedback reaches t = 20' same "$status $(ended feedback.json)" '0 done'
claim 'feedback: deviation stays below 1e-5' within "$(extreme feedback.csv ez abs)" 1e-8 1e-5
claim 'feedback: no other motion' within "$(extreme feedback.csv eyaw abs)" 0 1e-9

# ---- feedback alone ----
run simulate paper-no-feedforward.yaml stiff --set simulation.output_step=0.002
claim 'feedback alone reaches t = 20' same "$status $(ended stiff.json)" '0 done'
claim 'feedback alone, G = 100: lowest deviation' within "$(extreme stiff.csv ez min)" -6.15e-3 -6.13e-3
claim 'feedback alone, G = 100: highest deviation' within "$(extreme stiff.csv ez max)" 6.3e-4 6.4e-4
run simulate paper-no-feedforward.yaml soft --set control.stiffness=5 --set simulation.output_step=0.002
claim 'feedback alone, G = 5: lowest deviation' within "$(extreme soft.csv ez min)" -0.138 -0.137
claim 'feedback alone, G = 5: highest deviation' within "$(extreme soft.csv ez max)" 0.0150 0.0155
run simulate paper-no-feedforward.yaml slack --set control.stiffness=2
claim 'feedback alone, G = 2: the platform collapses' same "$status $(ended slack.json)" '1 singular'
claim 'feedback alone, G = 2: at t = 17.15' near "$(end_time slack.json)" 17.15 0.005
claim 'the collapsed run kept its rows' within "$(awk -F, 'END { print $1 }' slack.csv)" 17.09 17.15

finish
