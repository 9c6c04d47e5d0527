#!/usr/bin/env bash
# Legs with mass and friction as the user reads them: a published machine, what is left out, what is refused and where.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1

says() { grep -qF -- "$1" out || tr -s ' \n' ' ' <out | grep -qF -- "$1" || fail "$what: does not say: $1"; }
never() { ! grep -qE -- "$1" out || fail "$what: says: $(grep -E -- "$1" out | head -1)"; }
near() { awk -v a="$2" -v b="$3" -v e="$4" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= e) }' || fail "$1: $2 instead of $3"; }

# MathWorks' Stewart platform: forces at rest and modes without gravity, to all digits printed there
cat >heavy.yaml <<'END'
platform:
  base: {radius: 3, half_angle: 2.5}
  top: {radius: 1, half_angle: 10}
  height: 2
  legs:
    cylinder: {mass: 92.110671136, inertia: 43.023996787, center: 1.182675256494375}
    piston: {mass: 51.812252514, inertia: 24.168615535, center: 1.182675256494375}
load: {mass: 1216.926817904, inertia: [304.485230896, 304.485230896, 608.463408952]}
gravity: 9.81
control: {stiffness: 4e6}
simulation: {duration: 0.5, output_step: 0.1}
END
what="a published machine"
run forces heavy.yaml -o rows.csv
expect_code 0 forces
never massless
near "$what: force" "$(column rows.csv f1 | head -1)" 4078.783657 5e-7
run forces heavy.yaml --set platform.legs= -o rows.csv
says "legs        massless in this model"
near "$what: force without the legs" "$(column rows.csv f6 | head -1)" 3137.519736 5e-7
run stability heavy.yaml --set gravity=0 --json
cp out data.json
jq -r '[.eigenvalues[] | .[1] / (8 * (1 | atan)) | if . < 0 then -. else . end] | .[range(0; 12; 2)]' data.json >hertz
for right in 9.551896 9.551896 12.829893 17.578710 17.578710 18.400226; do
    read -r found
    near "$what: a frequency" "$found" "$right" 5e-7
done <hertz
run check heavy.yaml
says "mass of the legs     863.538 kg, of which the top bears 401.545 kg at home (33 % of the load)"
run check heavy.yaml --json
near "$what: check's legs" "$(jq .leg_mass out)" 863.5375419 1e-6
near "$what: check's hanging mass" "$(jq '.leg_mass_on_top' out)" "$(awk 'BEGIN { print 6 * (92.110671136 * 3 / 8 + 51.812252514 * 5 / 8) }')" 1e-3
run stability heavy.yaml
says "the trace -2(M+S)g/h = -15877.2 N/m < 0"
tr -s "\n " " " <out | grep -qF "with the load M and what of the legs' mass hangs on the top, S." || fail "$what: M and S are not named"
never "Dry friction|-2Mg"

# friction: left out of what is linearised, and said; in the motion
what="dry friction"
run stability heavy.yaml --set platform.legs.friction.coulomb=100
says "Dry friction of the legs and losses of their screws are left out"
run stability heavy.yaml --set platform.legs.friction.efficiency=0.9 --json
[[ $(jq .friction_left_out out) == true && $(jq .friction_left_out data.json) == false ]] || fail "$what: friction_left_out"
jq .eigenvalues out >rough
run stability heavy.yaml --json
jq .eigenvalues out | cmp -s - rough || fail "$what: eigenvalues change"
run forces heavy.yaml --set 'motion.heave=0.1*t' --set platform.legs.friction.coulomb=100 --set platform.legs.friction.smoothing_speed=1e-6 -o rows.csv
run forces heavy.yaml --set 'motion.heave=0.1*t' -o smooth.csv
near "$what: a rising leg needs the friction more" "$(paste -d- <(column rows.csv f2) <(column smooth.csv f2) | tail -1 | awk -F- '{ print $1 - $2 }')" 100 1e-6
# tune: the stiffness found meets the accuracy with the friction in the motion, one that is 10 % less does not
pushed=(--set platform.legs.friction.coulomb=100 --set 'disturbance.force=[0, 0, "2000*sin(3*t)"]' --set control.damping=2e4
    --set 'simulation={duration: 4, output_step: 0.1}')
run tune heavy.yaml --deviation 1e-3 "${pushed[@]}" --json
expect_code 0 tune with dry friction
[[ $(jq .friction_left_out out) == true ]] || fail "$what: friction_left_out of tune"
found=$(jq '.choices[0].stiffness' out)
run tune heavy.yaml --deviation 1e-3 "${pushed[@]}"
tr -s "\n " " " <out | grep -q 'runs with the dry friction of the legs' || fail "$what: tune does not say what it leaves out"
for part in 1 0.9; do
    run simulate heavy.yaml "${pushed[@]}" --set "control.stiffness=$(awk -v g="$found" -v k=$part 'BEGIN { print g * k }')" --json
    jq .deviation.position out
done >deviations
paste -sd' ' deviations | awk '{ exit !($1 > 5e-4 && $1 <= 1.0001e-3 && $2 > 1e-3) }' ||
    fail "$what: G = $found N/m and 0.9 of it leave $(paste -sd' ' deviations) m"

run check heavy.yaml --set platform.legs.friction='{coulomb: 100, breakaway: 150, stribeck_speed: 0.02}'
says "dry friction         breakaway 150 N, of which the smooth law reaches about 95.9 %;"
says "a leg that should rest under half of it creeps at about 0.00057735 m/s"

# viscous friction damps: nothing is said to go on for ever
what="viscous friction"
run stability heavy.yaml --set platform.legs.friction.viscous=1e4
says "Stable: every deviation dies out"
never "D = 0\\) nothing dies out"

# a screw that locks itself: forces along a motion, but no motion under forces
what="a screw that locks itself"
run forces heavy.yaml --set platform.legs.friction.efficiency=0.4
expect_code 0 "$what: forces"
for verb in simulate stability; do
    run $verb heavy.yaml --set platform.legs.friction.efficiency=0.4
    expect_code 2 "$what: $verb"
    grep -q "with an efficiency of 0.4 in leg 1 the screw locks itself: such a leg is driven by position, not by force" err || fail "$what: $verb: $(cat err)"
done

# a controller that thinks its legs massless lets the machine sag
what="a controller that ignores the legs"
run stability heavy.yaml --set control.model.legs=false
says "With feed-forward that ignores the legs' mass, the loop rests where springs and load balance"
says "the program's forces fed forward except for the legs' mass"
run stability heavy.yaml --set control.model.legs=false --set 'motion.heave=0.01*sin(12*t)'
expect_code 0 "$what: multipliers"
says "With feed-forward that ignores the legs' mass, the loop has a periodic motion of its own"
run stability heavy.yaml --set control.model.friction=false --set platform.legs.friction.viscous=100 --set 'motion.heave=0.01*sin(12*t)'
expect_code 0 "$what: multipliers without friction"
says "With feed-forward that ignores the viscous friction of the legs, the loop has a periodic motion of its own"
never "ignores the viscous friction of the legs, the loop rests"
run tune heavy.yaml --set control.model.legs=false --deviation 1e-3 --damping-ratio 0.5 --feedforward program
expect_code 0 "$what: tune"
says "With feed-forward that ignores the legs' mass"
run simulate heavy.yaml --set control.model.legs=false --set simulation.duration=2 --set control.damping=2e4 -o rows.csv
expect_code 0 simulate
near "$what: it sags by less force than stiffness" "$(column rows.csv ez | tail -1 | awk '{ print ($1 < -1e-4 && $1 > -1e-3) }')" 1 0
run check heavy.yaml --set 'control.model={legs: false, friction: false}' --set 'platform.legs.friction={viscous: 10, coulomb: 5}'
says "feedforward the program's forces without the legs' mass and the viscous friction of the legs without the dry friction of the legs and losses of their screws"
finish
