#!/usr/bin/env bash
# Label: thorough.
# What the verbs print on standard output, and their help, fits 100 columns: every example through check, forces, simulate and
# stability, a run that exceeds its limits, a map, a sweep and a choice of the feedback.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
: "${SOURCE:?the source folder}"
cp "$SOURCE"/examples/*.yaml "$SOURCE"/examples/*.awk "$scratch"
cd "$scratch" || exit 1
awk -f ship-deck.awk >ship-deck.csv
lines=0

fits() { # fits ARGUMENT…: the verb's output has no line beyond 100 characters
    "$GOUGH" "$@" >out 2>err </dev/null
    local code=$?
    ((code <= 1 || code == 2 && refusal)) || fail "$*: exit code $code: $(head -3 err)"
    [[ -s out ]] || ((refusal)) || fail "$*: prints nothing"
    lines=$((lines + $(wc -l <out)))
    LC_ALL=C awk '{ line = $0; gsub(/[\200-\277]/, "", line) } length(line) > 100 { print length(line) ": " $0; bad = 1 } END { exit bad }' out >long ||
        fail "$*: $(head -2 long)"
}

refusal=0
for verb in '' example check pose forces simulate sweep merge stability tune plot report; do
    # shellcheck disable=SC2086
    fits $verb --help
done
for study in *.yaml; do
    for verb in check forces simulate; do fits $verb "$study"; done
    # a recorded motion has no period: its stability along the program is refused
    refusal=1
    fits stability "$study"
    refusal=0
    fits stability "$study" --pose surge=0
done
fits example
fits forces own-machine.yaml --set platform.legs.max_speed=0.03 --set platform.legs.max_force=14
fits simulate own-machine.yaml --set platform.legs.max_speed=0.03
fits check own-machine.yaml --set platform.legs.length='[0.25, 0.3]'
fits stability own-machine.yaml --set gravity=0 --set control.stiffness=0
fits stability paper-heave.yaml --sweep-stiffness 0.1:2:20 --sweep-amplitude 0:1:3
fits sweep gain-sweep.yaml --set 'sweep.keys.control.stiffness=[0.5, 1, 2]'
fits check load-uncertainty.yaml
fits tune own-machine.yaml --deviation 1e-4 --feedforward none
((lines > 500)) || fail "only $lines lines"
finish
