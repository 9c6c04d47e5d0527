#!/usr/bin/env bash
# Machines that nobody thought of: standing, hanging, weightless, nearly weightless, on a wall, very damped, with three upright and three
# level legs. Each sentence that the command prints about one of them is compared with what is known of it by other means.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml

says() { # says TEXT: on standard output or standard error, line breaks aside
    tr -s ' \n' ' ' <out >flat
    tr -s ' \n' ' ' <err >>flat
    grep -qF -- "$1" flat || fail "$what: does not say '$1' but: $(cat out err)"
}
never() { # never PATTERN
    tr -s ' \n' ' ' <out >flat
    tr -s ' \n' ' ' <err >>flat
    grep -qE -- "$1" flat && fail "$what: says '$(grep -oE -- ".{0,60}$1.{0,40}" flat | head -1)'"
    return 0
}
narrow() { # lines of at most 100 columns, each number finite
    LC_ALL=C sed 's/[\x80-\xbf]//g' out | awk -v what="$what" 'length($0) > 100 { print what ": " length($0) " columns: " $0; bad = 1 } END { exit bad }' ||
        fail "$what: lines too long"
    never '(^|[^a-z])(inf|nan)([^a-z]|$)'
}
near() { # near WHAT VALUE EXPECTED RELATIVE
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; m = b < 0 ? -b : b
        exit !(a != "" && a !~ /nan|null|inf/ && d <= t * m && -d <= t * m) }' || fail "$1: $2 instead of $3 within a part of $4"
}
stability() { # stability DESCRIPTION OPTION…
    what="stability, $1"
    shift
    "$GOUGH" stability "$@" --json >data.json || fail "$what: JSON"
    run stability "$@"
    expect_code 0 "$what"
    narrow
}
json() { jq -e "$1" data.json >/dev/null || fail "$what: not $1: $(jq -c '{stable, drifts, decays, growth_rate}' data.json)"; }
simulate() { # simulate DESCRIPTION OPTION…
    what="simulate, $1"
    shift
    run simulate "$@"
    narrow
}

weightless=(own.yaml --set gravity=0)
hanging=(own.yaml --set platform.height=-0.28 --set 'load.center_of_mass=[0, 0, -0.05]')

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
cat >frame.yaml <<'END'
units: si
platform:
  base:
    joints: [[0.5, 0, 0], [-0.25, 0.433, 0], [-0.25, -0.433, 0], [1, 0, 0.5], [-0.5, 0.866, 0.5], [-0.5, -0.866, 0.5]]
  top:
    joints: [[0.5, 0, 0], [-0.25, 0.433, 0], [-0.25, -0.433, 0], [0.25, 0.433, 0], [-0.5, 0, 0], [0.25, -0.433, 0]]
  height: 0.5
load: {mass: 10, center_of_mass: [0, 0, 0], inertia: [1, 1, 1]}
motion: {heave: 0.01*sin(6*t)}
control: {stiffness: 0}
simulation: {duration: 2, output_step: 0.02}
END
# upright struts under constant forces are inverted pendulums, level legs bear nothing: sway of the top falls, heave is neutral
stability "three and three, open loop" frame.yaml --pose surge=0
json '.stable == false and .trace_theorem == null and ([.thresholds[] | select(.mode == "heave") | .stiffness] == [0])'
near "$what: the trace" "$(jq .trace data.json)" "$(awk 'BEGIN { print -2 * 10 * 9.80665 / 0.5 }')" 1e-9
says "heave 0 N/m neutral without feedback; any G > 0 holds it"
never "2Mg|always"
stability "three and three, closed loop" frame.yaml --pose surge=0 --set control.stiffness=5000 --set control.damping=50
json '.stable and .decays'

# ---- check and forces of each machine: what is said of gravity, and forces at rest in closed form ----
# M g l/(6 h) in each leg where joints are symmetric and gravity is along the axis; the energies of a program that ends where it began
# add up to nothing
length=0.3254944
at_rest() { # at_rest DESCRIPTION FORCE OPTION…: forces in the first row, FORCE in each leg ('' : no closed form), energies, words
    local wanted=$2
    what="check, $1"
    local name=$1
    shift 2
    run check "$@"
    expect_code 0 "$what"
    narrow
    never 'warning|-0[ ,]|unstable|stable'
    if [[ $* == *gravity=0' '* || $* == *gravity=0 ]]; then
        says "gravity 0, 0, 0 m/s^2"
        says "without gravity there is no unit of time and there are no groups of G and D"
        never 'sqrt|M g'
    else
        never "without gravity"
        near "$what: the unit of time" "$(sed -n 's/^  sqrt(R_b.g) *\([^ ]*\) s, the unit of time$/\1/p' out)" \
            "$(awk -v g="$("$GOUGH" check "$@" --json 2>/dev/null | jq .time_unit)" 'BEGIN { print g }')" 1e-5
    fi
    what="forces, $name"
    run forces "$@" -o rows.csv
    expect_code 0 "$what"
    narrow
    if [[ $* == *gravity=0' '* || $* == *gravity=0 ]]; then never "weight"; else says "add the forces of their own weight and inertia"; fi
    says "the whole duration"
    for v in 1 2 3 4 5 6; do
        [[ -z $wanted ]] || near "$what: leg $v at rest" "$(awk -v f="$(column rows.csv f$v | head -1)" 'BEGIN { print f + 1e-300 }')" "$wanted" 1e-5
    done
    "$GOUGH" forces "$@" --json -q >data.json 2>/dev/null
    jq -e '([.legs[].energy] | add | fabs) <= 1e-6 * ([.legs[].power[1]] | max)' data.json >/dev/null || fail "$what: energies $(jq -c '[.legs[].energy]' data.json)"
}
weight() { awk -v g="$1" -v h="$2" -v l=$length 'BEGIN { printf "%.9g\n", 6 * g * l / (6 * h) }'; }
at_rest "standing" "$(weight 9.80665 0.28)" own.yaml
at_rest "hanging" "$(weight 9.80665 -0.28)" "${hanging[@]}" --set platform.legs=
at_rest "weightless" 1e-300 "${weightless[@]}"
at_rest "gravity 1e-6" "$(weight 1e-6 0.28)" own.yaml --set gravity=1e-6
at_rest "gravity 0.1" "$(weight 0.1 0.28)" own.yaml --set gravity=0.1
at_rest "on a wall" "" own.yaml --set 'gravity=[0, -9.80665, 0]'
at_rest "very damped" "$(weight 9.80665 0.28)" own.yaml --set control.damping=20000
at_rest "three and three" "" frame.yaml --set 'motion.heave=0.01*ramp(t, 1)*(1 - ramp(t - 1, 1))'
what="forces, three and three"
for v in 1 2 3; do near "$what: upright leg $v" "$(column rows.csv f$v | head -1)" "$(awk 'BEGIN { print 10 * 9.80665 / 3 }')" 1e-5; done
for v in 4 5 6; do near "$what: level leg $v" "$(column rows.csv f$v | awk 'NR == 1 { print 1 + $1 }')" 1 1e-12; done
what="check, three and three"
run check frame.yaml
says "0 N/m: open loop"

# ---- tune: what it names does it, by a run of simulate; and it is not silent about a stiffness that its scales do not know ----
tune() { # tune DESCRIPTION STUDY OPTION…: the G named, checked by simulate
    what="tune, $1"
    shift
    run tune "$@"
    expect_code 0 "$what"
    narrow
    never "no G of the search|does not do|binds"
    G=$(sed -n 's/^  stiffness   G = \([^ ]*\) N.m in each leg$/\1/p' out)
}
reaches() { # reaches G LIMIT STUDY OPTION…
    local G=$1 limit=$2 found
    shift 2
    found=$("$GOUGH" simulate "$@" --set control.stiffness="$G" --json -q 2>/dev/null | jq '.deviation.position')
    awk -v a="$found" -v b="$limit" 'BEGIN { exit !(a != "" && a !~ /null|nan/ && a + 0 <= b * 1.001) }'
}
# weightless, without feed-forward: the springs bear M a, so G is about M a/(d · their share), 2.4e4 N/m here. The search used to be
# scaled by the weight and said that no G does it
short=(--set 'motion.moves=[{start: 0, duration: 1, heave: 0.03}]' --set simulation.duration=1.2 --set platform.legs=)
for g in 0 1e-6; do
    tune "gravity $g" own.yaml --set gravity=$g "${short[@]}" --deviation 1e-4 --feedforward none --stiffness 0:1e6
    reaches "$G" 1e-4 own.yaml --set gravity=$g "${short[@]}" --set control.feedforward=none || fail "$what: G = $G is not enough"
    reaches "$(awk -v G="$G" 'BEGIN { print 0.8 * G }')" 1e-4 own.yaml --set gravity=$g "${short[@]}" --set control.feedforward=none &&
        fail "$what: 0.8 G would do"
done
# counterbalanced: the threshold at home and the one where the program ends differ, and the sentences say which is meant
what="tune, gravity 0.1"
tune "gravity 0.1" own.yaml --set gravity=0.1 "${short[@]}" --deviation 1e-4 --feedforward none --stiffness 0:1e6
reaches "$G" 1e-4 own.yaml --set gravity=0.1 "${short[@]}" --set control.feedforward=none || fail "$what: G = $G is not enough"
reaches "$(awk -v G="$G" 'BEGIN { print 0.8 * G }')" 1e-4 own.yaml --set gravity=0.1 "${short[@]}" --set control.feedforward=none &&
    fail "$what: 0.8 G would do"
tune "gravity 0.1, with feed-forward" own.yaml --set gravity=0.1 "${short[@]}" --deviation 1e-2 --feedforward program --stiffness 0:1e6
says "the program ends at rest, so the pose there was checked"
never "at home only"
threshold() { "$GOUGH" stability own.yaml --set gravity=0.1 --pose "$1" --json | jq '[.thresholds[].stiffness] | max'; }
near "$what: at home" "$(sed -n 's/^At rest at home, .* needs G above \([^ ]*\) N.m.*/\1/p' out)" "$(threshold surge=0)" 1e-5
near "$what: where the program ends, with 2 %" "$G" "$(threshold heave=0.03 | awk '{ print $1 / 0.98 }')" 1e-4
# a fixed step that passes over a pulse: the run with small steps does not confirm what it names
cat >pulse.yaml <<'END'
units: si
platform: {base: {radius: 0.25, half_angle: 10}, top: {radius: 0.15, half_angle: 10}, height: 0.28}
load: {mass: 6, center_of_mass: [0, 0, 0.05], inertia: [0.05, 0.05, 0.08]}
disturbance: {force: ["50*(ramp(t - 1.0005, 0.005) - ramp(t - 1.0205, 0.005))", 0, 0]}
control: {stiffness: 500, damping: 15}
simulation: {duration: 1.5, output_step: 0.02}
END
tune "a pulse" pulse.yaml --deviation 1e-2 --feedforward program --stiffness 0:1e5
reaches "$G" 1e-2 pulse.yaml --set simulation.step=0.0005 || fail "$what: G = $G is not enough"
# so strongly damped that one run would take millions of steps: an end with a sentence, not none
what="tune, too strongly damped"
run tune own.yaml --set control.damping=1e8 --deviation 1e-3
expect_code 2 "$what"
says "the loop is so strongly damped that one run takes about"
# Ctrl-C: the best so far
what="tune, interrupted"
for seconds in 1 3 10 30 100; do # the longer ones for a busy machine, on which the command has hardly begun
    timeout -s INT $seconds "$GOUGH" tune own.yaml --deviation 1e-9 --feedforward none >out 2>err
    [[ -s err ]] && break
done
says "stopped before the end; nothing was written. Best so far: without feed-forward"
finish
