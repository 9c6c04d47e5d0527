#!/usr/bin/env bash
# The machines of test_machines.sh: what check and forces say of them.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
source "$(dirname "$0")/machines.sh"

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
finish
