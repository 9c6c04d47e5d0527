#!/usr/bin/env bash
# The machines of test_machines.sh: what tune names for them does it.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/machines.sh"

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
