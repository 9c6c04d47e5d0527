#!/usr/bin/env bash
# The SI examples: the flight simulator on its ship, whose sea every awk draws alike, and the small machine to start from.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"

# ---- the sea ----
awk -f ship-deck.awk >ship-deck.csv
claim 'the deck motion is drawn' same $? 0
claim 'it has 120 s at 20 rows a second' same "$(wc -l <ship-deck.csv) $(tail -1 ship-deck.csv | cut -d, -f1)" '2402 120.00'
claim 'it starts at home' same "$(sed -n 2p ship-deck.csv)" \
    '0.00,0.000000000,0.000000000,0.000000000,0.000000000,0.000000000,0.000000000'
for program in mawk gawk original-awk 'busybox awk'; do
    read -ra words <<<"$program"
    command -v "${words[0]}" >/dev/null || continue
    "${words[@]}" -f ship-deck.awk >other.csv
    claim "$program draws the same digits" cmp ship-deck.csv other.csv
done
if localedef -i de_DE -f UTF-8 "$work/de_DE.UTF-8" 2>/dev/null; then
    for program in mawk gawk; do
        command -v "$program" >/dev/null || continue
        LOCPATH=$work LC_ALL=de_DE.UTF-8 POSIXLY_CORRECT=1 "$program" -f ship-deck.awk >other.csv
        claim "$program draws the same digits in a comma locale" cmp ship-deck.csv other.csv
    done
fi
awk -v seed=7 -f ship-deck.awk >other.csv
claim 'another seed is another sea' bash -c '! cmp -s ship-deck.csv other.csv'
# the sea's own scale: wave heights double, motions double
awk -v height=8 -f ship-deck.awk >other.csv
claim 'twice the wave height is twice the motion' near "$(value other.csv heave 60)" \
    "$(awk -v x="$(value ship-deck.csv heave 60)" 'BEGIN { printf "%.9f", 2 * x }')" 1e-8

# ---- the simulator ----
run forces flight-simulator.yaml forces
claim 'the program keeps within all limits' same "$status $(ended forces.json)" '0 done'
for leg in 1 2 3 4 5 6; do
    claim "leg $leg keeps within its stroke" within "$(extreme forces.csv l$leg min)" 1.55 2.95
    claim "leg $leg keeps within its stroke" within "$(extreme forces.csv l$leg max)" 1.55 2.95
    claim "leg $leg keeps within its speed" within "$(extreme forces.csv dl$leg abs)" 0 0.8
    claim "leg $leg keeps within its force" within "$(extreme forces.csv f$leg abs)" 0 6000
done
claim 'the stroke is used' within "$(awk "BEGIN { print $(extreme forces.csv l1 max) - $(extreme forces.csv l1 min) }")" 0.8 1.4
# at rest the legs' vertical components carry 1050 kg, but for what the rounding of the samples does to the acceleration
claim 'the legs carry the weight' near "$(awk -F, 'NR == 2 { print $0 }' forces.csv | awk -F, -v header="$(head -1 forces.csv)" '
    BEGIN { n = split(header, name, ","); for (i = 1; i <= n; i++) c[name[i]] = i }
    { for (leg = 1; leg <= 6; leg++) sum += $(c["f" leg]) * 2.0 / $(c["l" leg]); printf "%.12g", sum }')" 10296.9825 0.1

run simulate flight-simulator.yaml motion
claim 'the simulator follows the ship to the end' same "$status $(ended motion.json)" '0 done'
for e in ex ey ez; do
    claim "$e is held to two millimetres" within "$(extreme motion.csv $e abs)" 0 2e-3
done
for e in eroll epitch eyaw; do
    claim "$e is held to a twentieth of a degree" within "$(extreme motion.csv $e abs)" 0 0.05
done
claim 'the axes stay orthonormal' within "$(extreme motion.csv drift abs)" 0 1e-7

run simulate flight-simulator.yaml short --set platform.legs.length='[1.9, 2.95]'
claim 'with less stroke the run stops at the first limit' same "$status $(ended short.json)" '1 leg_short'
claim '… and keeps what came before' within "$(awk -F, 'END { print $1 }' short.csv)" 1 "$(end_time short.json)"
run forces flight-simulator.yaml all --set platform.legs.length='[1.9, 2.95]'
claim 'while forces goes on and lists them' same "$status $(wc -l <all.csv)" '1 2402'
run simulate flight-simulator.yaml long --set simulation.duration=121
claim 'a run beyond the recorded motion is refused' same $status 2

# ---- one's own ----
run forces own-machine.yaml own
claim 'own machine: forces' same "$status $(ended own.json)" '0 done'
claim 'own machine: the moves reach their targets' near "$(value own.csv z 1.8)" 0.31 1e-12
claim 'own machine: back at home' near "$(value own.csv yaw 7)" 0 1e-9
run simulate own-machine.yaml own
claim 'own machine: follows' same "$status $(ended own.json)" '0 done'
claim 'own machine: to a micrometre' within "$(extreme own.csv ex abs)" 0 1e-6

finish
