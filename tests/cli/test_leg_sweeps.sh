#!/usr/bin/env bash
# Label: thorough.
# Legs and external loads in sweeps: each run of a sweep over their numbers is the single run with that number, bit for bit; six equal
# numbers are one; legs of mass 0 move as legs without mass, whose equations are others.
# Not sanitized: it looks at digits, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
cat >study.yaml <<'END'
platform:
  base: {radius: 0.25, half_angle: 10}
  top: {radius: 0.15, half_angle: 10}
  height: 0.28
  legs:
    cylinder: {mass: 0.5, center: 0.08, inertia: [0.002, 0.002, 0.002, 0.002, 0.002, 0.002]}
    piston: {mass: 0.3, center: 0.09, inertia: 0.001}
    reflected_mass: 2
    friction: {viscous: 20, coulomb: 3, breakaway: 4, stribeck_speed: 0.02, smoothing_speed: 0.005, efficiency: 0.9}
load: {mass: 6, center_of_mass: [0.01, 0, 0.05], inertia: [0.05, 0.06, 0.08]}
external:
  - {force: [0, 0, 30], moment: [0, 0.5*sin(3*t), 0], at: [0.02, 0, 0.1]}
  - {force: [2*cos(t), 0, 0], axes: top}
motion: {heave: 0.02*sin(5*t), roll: 3*sin(4*t), yaw: 2*sin(3*t)}
control: {stiffness: 2e4, damping: 300}
simulation: {duration: 0.5, output_step: 0.05, method: rk4, step: 0.0025}
END

# ---- each run alone ----
alike() { # KEY VALUE…, in the order of the list
    local key=$1 i=0 value column names
    shift
    run sweep study.yaml -q --set "sweep={keys: {$key: [$(IFS=,; echo "$*")]}}" -o sweep.csv
    expect_code 0 "sweep of $key"
    [[ $(sed 1d sweep.csv | cut -d, -f3-14 | sort -u | wc -l) == "$#" ]] || fail "sweep of $key: the runs do not differ"
    for value in "$@"; do
        i=$((i + 1))
        run simulate study.yaml -q --set "$key=$value" -o alone.csv
        expect_code 0 "$key=$value"
        names=
        for column in x y z roll pitch yaw vx vy vz wx wy wz; do
            [[ $(column sweep.csv $column | sed -n "${i}p") == "$(column alone.csv $column | tail -1)" ]] || names+=" $column"
        done
        [[ -z $names ]] || fail "$key=$value: the sweep has other bits of$names"
    done
}
alike platform.legs.piston.mass 0 0.1 0.2 0.3 0.5 0.7 0.9 1.1 1.3
alike platform.legs.cylinder.inertia.2 0.001 0.002 0.004
alike platform.legs.friction.efficiency 0.7 0.8 1
alike external.1.force.3 -10 0 20 30 35
alike external.1.at.1 0 0.02 0.05
alike external.2.force.2 0 1 2
alike external.1.moment.3 0 1 2

# ---- six equal numbers ----
"$GOUGH" simulate study.yaml -q --joints -o one.csv
six=()
for number in cylinder.mass=0.5 cylinder.center=0.08 cylinder.inertia=0.002 piston.mass=0.3 piston.center=0.09 piston.inertia=0.001 \
    reflected_mass=2 friction.viscous=20 friction.coulomb=3 friction.breakaway=4 friction.stribeck_speed=0.02 \
    friction.smoothing_speed=0.005 friction.efficiency=0.9; do
    value=${number#*=}
    six+=(--set "platform.legs.${number%=*}=[$value, $value, $value, $value, $value, $value]")
done
"$GOUGH" simulate study.yaml -q --joints "${six[@]}" -o six.csv
cmp -s one.csv six.csv || fail "six equal numbers are not one"

# ---- mass 0 ----
for legs in platform.legs= 'platform.legs={cylinder: {mass: 0, center: 0.1, inertia: 0}, reflected_mass: 0}'; do
    "$GOUGH" forces study.yaml -q --set "$legs" -o - 2>err
done | awk 'NR == 1 { head = $0; rows = 0 } $0 == head { half++ } { row[half, half == 2 ? ++two : ++one] = $0 }
    END { if (one < 5 || one != two) exit 1; for (i = 1; i <= one; i++) if (row[1, i] != row[2, i]) exit 1 }' || fail "legs of mass 0 take other forces"
# The stages of a step leave the constraints, off which both formulations differ, by a share of what the step gets wrong; here that is
# below rounding (docs/theory/accuracy.md).
fine=(--set simulation.step=0.000625)
"$GOUGH" simulate study.yaml -q "${fine[@]}" --set platform.legs= -o bare.csv
"$GOUGH" simulate study.yaml -q "${fine[@]}" --set 'platform.legs={cylinder: {mass: 0, center: 0.1, inertia: 0}, reflected_mass: 0}' -o zero.csv
cmp -s bare.csv zero.csv && fail "legs of mass 0 take the equations of those without: nothing is compared"
apart() { # FIRST-COLUMN LAST-COLUMN: greatest difference
    awk -F, -v from="$1" -v to="$2" 'FNR == 1 { next } NR == FNR { for (i = from; i <= to; i++) a[FNR, i] = $i; next }
        { for (i = from; i <= to; i++) { d = $i - a[FNR, i]; if (d < 0) d = -d; if (!(d <= worst)) worst = d } } END { printf "%.3g", worst }' bare.csv zero.csv
}
awk -v w="$(apart 2 4)" 'BEGIN { exit !(w <= 1e-14) }' || fail "legs of mass 0: positions differ by $(apart 2 4) m"
awk -v w="$(apart 5 7)" 'BEGIN { exit !(w <= 1e-13) }' || fail "legs of mass 0: angles differ by $(apart 5 7) degrees"
awk -v w="$(apart 8 10)" 'BEGIN { exit !(w <= 1e-13) }' || fail "legs of mass 0: velocities differ by $(apart 8 10) m/s"
finish
