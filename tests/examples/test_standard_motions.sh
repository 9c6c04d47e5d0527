#!/usr/bin/env bash
# The other standard motions and the combined one: each has its forces, and under feedback the machine follows.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"

# column of the program's motion, its amplitude in the limit cycle
while read -r name column amplitude; do
    run forces "$name.yaml" forces
    claim "$name: forces along the program" same "$status $(ended forces.json)" '0 done'
    claim "$name: the program swings to its amplitude" near "$(extreme forces.csv "$column" max)" "$amplitude" \
        "$(awk -v a="$amplitude" 'BEGIN { print 2e-3 * a }')"
    claim "$name: at rest at first, every leg carries the same" near "$(value forces.csv f3 0)" 0.203442593596 1e-11
    claim "$name: starts without a jerk" near "$(value forces.csv f3 0.05)" 0.2034 0.01

    run simulate "$name.yaml" motion
    claim "$name: the run reaches its end" same "$status $(ended motion.json)" '0 done'
    for e in ex ey ez eroll epitch eyaw; do
        claim "$name: follows in $e" within "$(extreme motion.csv $e abs)" 0 1e-8
    done
    claim "$name: forces of the run are the program's" near "$(value motion.csv f5 15)" "$(value forces.csv f5 15)" 1e-8
done <<'END'
surge x 0.2
sway y 0.2
roll roll 12
pitch pitch 12
yaw yaw 20
END

# surge keeps the mirror plane y = 0: the legs are twins 1–6, 2–5, 3–4
run forces surge.yaml surge
for pair in 'f1 f6' 'f2 f5' 'f3 f4'; do
    read -r a b <<<"$pair"
    claim "surge: legs $pair are twins" near "$(value surge.csv "$a" 12)" "$(value surge.csv "$b" 12)" 1e-12
done

run forces all-six.yaml forces --reactions
claim 'all six: forces, with reactions' same "$status $(ended forces.json)" '0 done'
claim 'all six: reactions are there' within "$(value forces.csv rxy 10)" -10 10
run simulate all-six.yaml motion --reactions
claim 'all six: the run reaches its end' same "$status $(ended motion.json)" '0 done'
# the disturbance, 0.002 of the weight, is seen and held
claim 'all six: position held' within "$(extreme motion.csv ex abs)" 1e-7 1e-3
claim 'all six: yaw held, degrees' within "$(extreme motion.csv eyaw abs)" 1e-6 0.1
run simulate all-six.yaml quiet --set disturbance.force='[0, 0, 0]' --set disturbance.moment='[0, 0, 0]'
for e in ex ey ez eroll epitch eyaw; do
    claim "all six, undisturbed: follows in $e" within "$(extreme quiet.csv $e abs)" 0 1e-7
done
run simulate all-six.yaml rattle --set simulation='{duration: 20, output_step: 0.05, method: rattle6, step: 0.01}'
for c in x y z roll pitch yaw; do
    claim "all six: another stepper gives the same $c" near "$(value rattle.csv $c 20)" "$(value motion.csv $c 20)" 1e-7
done

finish
