#!/usr/bin/env bash
# Each panel of each kind of figure names the unit of its numbers, in SI, dimensionless, and where tables of both are compared. The
# units are written out here.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
cd "$scratch"

"$GOUGH" example own-machine >study.yaml
set=(--set control.feedforward=none --set simulation.duration=6 --set simulation.output_step=0.05)
"$GOUGH" simulate study.yaml -q "${set[@]}" -o si.h5
"$GOUGH" simulate study.yaml -q "${set[@]}" --dimensionless -o bare.h5
"$GOUGH" sweep study.yaml -q "${set[@]}" --set 'sweep.keys={control.stiffness: {from: 3000, to: 9000, steps: 3}}' -o sweep-si.h5
"$GOUGH" sweep study.yaml -q "${set[@]}" --set 'sweep.keys={control.stiffness: {from: 3000, to: 9000, steps: 3}}' --dimensionless \
    -o sweep-bare.h5

# headings FIGURE: texts of the picture that name a panel or an axis, one a line
headings() { grep -o '<text>[^<]*</text>' "$1" | sed 's/<[^>]*>//g' | grep -v '^ *$'; }

# The panel that begins with HEADING has UNIT, with any prefix or power of ten; "-": none.
expect() { # expect FIGURE HEADING UNIT
    local line
    line=$(headings "$1" | grep "^$2" | head -1) || fail "$1 has no panel '$2'"
    if [[ $3 == - ]]; then
        [[ $line == "$2" || $line =~ ^"$2"\ \(10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+\)$ ]] || fail "$1: '$line' has a unit"
    else
        [[ $line =~ ^"$2"\ \((10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+\ )?[nµmkMG]?"$3"\)$ ]] || fail "$1: '$line' is not in $3"
    fi
}

units() { # units LABEL m N W s ° m/s TABLE...
    local label=$1 m=$2 N=$3 W=$4 s=$5 rate=$6
    shift 6
    for kind in motion forces lengths rates power deviation drift condition; do
        "$GOUGH" plot "$@" -q --figure $kind -o "$label-$kind.svg"
        if [[ $s == - ]]; then expect "$label-$kind.svg" time -; else expect "$label-$kind.svg" time "$s"; fi
    done
    expect "$label-motion.svg" 'Position x' "$m"
    expect "$label-motion.svg" 'Height z' "$m"
    expect "$label-motion.svg" Pitch °
    expect "$label-forces.svg" 'Leg force' "$N"
    expect "$label-lengths.svg" 'Leg length' "$m"
    expect "$label-rates.svg" 'Leg rate' "$rate"
    expect "$label-power.svg" 'Leg power' "$W"
    expect "$label-deviation.svg" 'Deviation of position from the program' "$m"
    expect "$label-deviation.svg" 'Deviation of angles from the program' °
    expect "$label-drift.svg" 'Constraint drift in a step' -
    expect "$label-condition.svg" 'Condition of the leg Jacobian' -
}
units si m N W s m/s si.h5
units bare - - - - - bare.h5
units mixed - - - - - si.h5 bare.h5
headings mixed-forces.svg | grep -q 'own units' || fail "a figure in mixed units does not say so"
headings si-forces.svg | grep -q 'own units' && fail "a figure in one unit says that there are more"

columns=position_deviation,angle_deviation,force,speed,power,energy
sweep() { # sweep LABEL m N m/s W J N/m TABLE...
    local label=$1 m=$2 N=$3 rate=$4 W=$5 J=$6 G=$7
    shift 7
    "$GOUGH" plot "$@" -q --columns $columns -o "$label-sweep.svg"
    expect "$label-sweep.svg" 'Largest deviation of position from the program' "$m"
    expect "$label-sweep.svg" 'Largest deviation of angle from the program' °
    expect "$label-sweep.svg" 'Largest leg force' "$N"
    expect "$label-sweep.svg" 'Largest leg speed' "$rate"
    expect "$label-sweep.svg" 'Largest leg power' "$W"
    expect "$label-sweep.svg" 'Net work of the legs' "$J"
    expect "$label-sweep.svg" control.stiffness "$G"
}
sweep si m N m/s W J N/m sweep-si.h5
sweep bare - - - - - N/m sweep-bare.h5 # keys are in the units of the study
sweep mixed - - - - - N/m sweep-si.h5 sweep-bare.h5
