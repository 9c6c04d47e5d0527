#!/usr/bin/env bash
# The examples of sampled loops: what their first lines claim, and the sampled heave against an integration of z alone.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"

# ---- heave: sampled it grows, continuous or damped it does not ----
run simulate sampled-heave.yaml sampled --set simulation.output_step=0.09817477042468103
claim 'the sampled run reaches its end' same "$status $(ended sampled.json)" '0 done'
claim 'an error of a thousandth grows twentyfold' near "$(extreme sampled.csv ez abs)" 0.02 1e-3
run simulate sampled-heave.yaml smooth --set control.sampling=
claim 'the continuous controller never exceeds the first error' near "$(extreme smooth.csv ez abs)" 0.001 1e-9
run simulate sampled-heave.yaml damped --set control.damping=0.2
claim 'nor, but for 0.2 %, does a damped one' near "$(extreme damped.csv ez abs)" 0.001 2e-6

# an independent road: z'' = 6 F z/l - 1 with F held, by Runge-Kutta steps of 1/400 of a period
awk 'function program(t,    e, u) {
         e = exp(-t / 2); u = 1 - e
         h = 1 + 0.2 * sin(t) * u * u
         v = 0.2 * (cos(t) * u * u + sin(t) * u * e)
         a = 0.2 * (-sin(t) * u * u + 2 * cos(t) * u * e + sin(t) * (e * e - u * e) / 2)
     }
     function pull(z) { return 6 * F * z / sqrt(0.49 + z * z) - 1 }
     BEGIN {
         T = 0.09817477042468103; n = 400; dt = T / n; z = 1.001; w = 0
         for (k = 0; k < 150; k++) {
             program(k * T + T / 2); F = (a + 1) * sqrt(0.49 + h * h) / (6 * h)
             program(k * T)
             F += 2 * (sqrt(0.49 + h * h) - sqrt(0.49 + z * z)) + 0.02 * (h * v / sqrt(0.49 + h * h) - z * w / sqrt(0.49 + z * z))
             for (i = 0; i < n; i++) {
                 a1 = pull(z); w2 = w + dt / 2 * a1; a2 = pull(z + dt / 2 * w); w3 = w + dt / 2 * a2
                 a3 = pull(z + dt / 2 * w2); w4 = w + dt * a3; a4 = pull(z + dt * w3)
                 z += dt / 6 * (w + 2 * w2 + 2 * w3 + w4); w += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
             }
             program((k + 1) * T)
             if (k % 50 == 49) printf "%d %.15f\n", k + 1, z - h
         }
     }' >alone.txt
claim 'three times are compared' same "$(wc -l <alone.txt)" 3
while read -r sample deviation; do
    found=$(awk -F, -v row="$sample" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "ez") c = i } NR == row + 2 { print $c }' sampled.csv)
    claim "deviation after $sample samples" near "$found" "$deviation" 1e-9
done <alone.txt

# ---- the machine ----
run simulate sampled-flight-simulator.yaml loop --actuators
claim 'the simulator runs to its end' same "$status $(ended loop.json)" '0 done'
claim 'the draught moves it by less than a millimetre' within "$(extreme loop.csv ey abs)" 0 1e-3
claim 'no drive is held back' within "$(extreme loop.csv sat1 abs)" 0 0
# measured lengths differ by whole counts of a micrometre
counts=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "m2") c = i } NR > 1 { if (NR == 2) first = $c; else { d = ($c - first) * 1e6; r = d - int(d + (d < 0 ? -0.5 : 0.5)); if (r < 0) r = -r; if (r > m) m = r } } END { print m + 0 }' loop.csv)
claim 'measured lengths are whole counts' within "$counts" 0 1e-6

# ---- too slow ----
run simulate sampled-too-slow.yaml slow
claim 'at 25 samples a second a leg becomes too fast' same "$status $(ended slow.json)" '1 leg_speed'
run simulate sampled-too-slow.yaml fast --set control.sampling.period=0.001 --set control.sampling.delay=0.001
claim 'at 1000 the same gains hold' same "$status $(ended fast.json)" '0 done'
finish
