#!/usr/bin/env bash
# Machines that nobody thought of: standing, hanging, weightless, nearly weightless, on a wall, very damped, with three upright and three
# level legs. Each sentence that the command prints about one of them is compared with what is known of it by other means.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/machines.sh"

# ---- a machine that stands: (stab-5), some mode grows whatever the geometry ----
stability "standing, open loop" own.yaml --set control.stiffness=0 --set control.damping=0
json '.stable == false and .drifts == [] and .decays == false'
near "$what: -2Mg/h" "$(jq .trace data.json)" "$(awk 'BEGIN { print -2 * 6 * 9.80665 / 0.28 }')" 1e-9
says "Without feedback some mode always grows"
says "Unstable: a deviation in "
near "$what: tenfold" "$(sed -n 's/.*grows tenfold every \([^ ]*\) s.*/\1/p' out)" "$(jq '2.302585092994 / .growth_rate' data.json)" 1e-3
simulate "standing, open loop" own.yaml --set control.stiffness=0 --set control.damping=0 --set simulation.duration=1
says "the open loop is unstable at rest at home: any deviation in"
simulate "standing, closed loop" own.yaml
never "unstable|open loop"

# heave of the symmetric machine, (stab-7) and (stab-8): λ² = g d²/(h l²), G = M g d²/(6 h³)
read -r rate G < <(awk 'BEGIN { d = 4 * atan2(1, 1) / 180; R = 0.25; r = 0.15; h = 0.28
    d2 = R * R + r * r - 2 * R * r * cos(40 * d); l2 = h * h + d2
    printf "%.12g %.12g\n", sqrt(9.80665 * d2 / (h * l2)), 6 * 9.80665 * d2 / (6 * h ^ 3) }')
stability "standing, open loop" own.yaml --set control.stiffness=0 --set control.damping=0
near "$what: heave grows" "$(jq '[.eigenvalues, .modes] | transpose | map(select(.[1].name == "heave") | .[0][0]) | max' data.json)" "$rate" 1e-6
near "$what: heave's threshold" "$(jq '[.thresholds[] | select(.mode == "heave") | .stiffness] | .[0]' data.json)" "$G" 1e-6

# a closed loop below its threshold: its growth is said, and not for a stiffer one
simulate "standing, too soft" own.yaml --set control.stiffness=100 --set control.damping=0 --set simulation.duration=3
says "the closed loop is unstable at rest at home: any deviation in"
simulate "standing, too soft, along a program" own.yaml --set control.stiffness=100 --set simulation.duration=3
says "the closed loop is unstable"

# ---- one that hangs: the mirror image, so the trace is +2Mg/h, and like a pendulum it holds without feedback ----
stability "hanging, open loop" "${hanging[@]}" --set control.stiffness=0 --set control.damping=0 --set platform.legs=
near "$what: +2Mg/h" "$(jq .trace data.json)" "$(awk 'BEGIN { print 2 * 6 * 9.80665 / 0.28 }')" 1e-9
json '[.eigenvalues[][0] | . <= 0] | all'
json '.stable and .decays == false and ([.thresholds[].stiffness | . == 0] | all)'
says "Without feedback nothing grows in this pose: constant leg forces hold it"
says "needs no feedback"
says "Bounded: nothing grows, but without damping (D = 0) nothing dies out."
never "Unstable|some mode|neutral"
# heave is the mirror image of (stab-7): a frequency instead of a rate
near "$what: heave swings" "$(jq '[.eigenvalues, .modes] | transpose | map(select(.[1].name == "heave") | .[0][1]) | max' data.json)" "$rate" 1e-6
simulate "hanging, open loop" "${hanging[@]}" --set control.stiffness=0 --set control.damping=0 --set platform.legs=
never "unstable|growing mode|grows"
stability "hanging, damped" "${hanging[@]}" --set control.stiffness=0 --set platform.legs=
json '.stable and .decays'
says "Stable: every deviation dies out; the slowest falls to a tenth in "

# ---- weightless: no leg forces at rest, so neither growth nor hold without feedback ----
stability "weightless, nothing" "${weightless[@]}" --set control.stiffness=0 --set control.damping=0
json '.stable == false and .growth_rate == 0 and (.drifts | sort) == ["heave", "sway", "tilt", "yaw"] and .decays == false'
json '[.eigenvalues[][] | . == 0] | all'
says "Unstable: nothing resists motion in sway, tilt, heave or yaw."
says "neutral without feedback; any G > 0 holds it"
never "needs no feedback|Stable|dies out|some mode"
simulate "weightless, nothing" "${weightless[@]}" --set control.stiffness=0 --set control.damping=0
never "growing|grows tenfold|feedback"

stability "weightless, damping alone" "${weightless[@]}" --set control.stiffness=0
json '.stable and .drifts == [] and .decays == false and .growth_rate == 0'
says "a displacement in sway, tilt, heave or yaw remains, because no stiffness acts on it"
says "Bounded"
never "needs no feedback|every deviation dies out|Unstable|drifts away"
simulate "weightless, damping alone" "${weightless[@]}" --set control.stiffness=0
never "unstable|grows"

stability "weightless, springs alone" "${weightless[@]}" --set control.damping=0
json '.stable and .drifts == [] and .decays == false'
says "Bounded: nothing grows, but without damping (D = 0) nothing dies out."
stability "weightless, three legs driven" "${weightless[@]}" --set 'control.stiffness=[5000, 5000, 5000, 0, 0, 0]' --set control.damping=0
json '.stable == false and (.drifts | length) > 0'
says "drifts away"
says "this study has 0 to 5000 N/m"
stability "weightless, three legs driven, three damped" "${weightless[@]}" --set 'control.stiffness=[5000, 5000, 5000, 0, 0, 0]' \
    --set 'control.damping=[0, 0, 0, 150, 150, 150]'
json '.stable and .decays == false and .drifts == []'
says "remains, because no stiffness"
stability "weightless, closed loop" "${weightless[@]}"
json '.stable and .decays'
says "Stable: every deviation dies out; the slowest falls to a tenth in "

# ---- nearly weightless: growth as √g, thresholds as g ----
for g in 1e-6 0.1; do
    stability "gravity $g, open loop" own.yaml --set gravity=$g --set control.stiffness=0 --set control.damping=0
    json '.stable == false and .drifts == []'
    near "$what: heave's threshold" "$(jq '[.thresholds[] | select(.mode == "heave") | .stiffness] | .[0]' data.json)" \
        "$(awk -v G="$G" -v g=$g 'BEGIN { print G * g / 9.80665 }')" 1e-5
    says "some mode always grows"
    simulate "gravity $g, open loop" own.yaml --set gravity=$g --set control.stiffness=0 --set control.damping=0
    if [[ $g == 0.1 ]]; then says "the open loop is unstable at rest at home"; else never "unstable|growing mode|grows"; fi
    stability "gravity $g, closed loop" own.yaml --set gravity=$g
    json '.stable and .decays'
done
# with damping alone growth is slow, √g no measure of it: in heave λ = κ/C, here 1e-6 of a closed loop's rates
stability "gravity 1e-6, damping alone" own.yaml --set gravity=1e-6 --set control.stiffness=0 --set control.damping=20000
json '.stable == false and .drifts == []'
never "Stable|Bounded"

# ---- on a wall: gravity along the base; planes are not level, so no theorem ----
stability "on a wall, open loop" own.yaml --set 'gravity=[0, -9.80665, 0]' --set control.stiffness=0 --set control.damping=0
json '.trace_theorem == null'
never "2Mg"
if jq -e '[.thresholds[].stiffness | . > 0] | any' data.json >/dev/null; then
    says "Unstable: a deviation in"
else
    never "Unstable"
fi

# ---- very damped: fast and slow eigenvalues side by side; D λ + G = 0 for the slow ones, up to gravity ----
for D in 2000 20000; do
    stability "very damped, D = $D" own.yaml --set control.damping=$D
    json '.stable and .decays'
    near "$what: the slow ones" "$(jq '[.eigenvalues[][0]] | sort | reverse | .[0]' data.json)" "$(awk -v D=$D 'BEGIN { print -5000 / D }')" 0.06
    slowest=$(sed -n 's/.*falls to a tenth in \([^ ]*\) s\..*/\1/p' out)
    near "$what: the slowest" "$slowest" "$(jq '-2.302585092994 / .growth_rate' data.json)" 1e-3
    never "×[3-9]"
done

# ---- three legs upright, three level ----
# upright struts under constant forces are inverted pendulums, level legs bear nothing: sway of the top falls, heave is neutral
stability "three and three, open loop" frame.yaml --pose surge=0
json '.stable == false and .trace_theorem == null and ([.thresholds[] | select(.mode == "heave") | .stiffness] == [0])'
near "$what: the trace" "$(jq .trace data.json)" "$(awk 'BEGIN { print -2 * 10 * 9.80665 / 0.5 }')" 1e-9
says "heave 0 N/m neutral without feedback; any G > 0 holds it"
never "2Mg|always"
stability "three and three, closed loop" frame.yaml --pose surge=0 --set control.stiffness=5000 --set control.damping=50
json '.stable and .decays'
finish
