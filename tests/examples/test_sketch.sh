#!/usr/bin/env bash
# The sketch of the machine in the guide to the study file: seen from above, each leg runs between the joints that `gough check` prints.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"
sketch=$SOURCE/docs/images/machine.svg
# the sketch's scale: 600 units a metre about (215, 250), y upwards
"$GOUGH" check own-machine.yaml >check.txt
claim 'the study is valid' same $? 0
for leg in 1 2 3 4 5 6; do
    drawn=$(sed -n "s/.*id=\"leg-$leg\" x1=\"\([0-9.]*\)\" y1=\"\([0-9.]*\)\" x2=\"\([0-9.]*\)\" y2=\"\([0-9.]*\)\".*/\1 \2 \3 \4/p" "$sketch" |
        awk '{ print ($1 - 215) / 600, (250 - $2) / 600, ($3 - 215) / 600, (250 - $4) / 600 }')
    joints=$(awk -v leg="$leg" '$1 == leg && NF == 8 { print $3, $4, $6, $7 }' check.txt)
    claim "leg $leg is drawn" test -n "$drawn"
    claim "leg $leg is printed" test -n "$joints"
    for n in 1 2 3 4; do
        claim "leg $leg, coordinate $n" near "$(cut -d' ' -f$n <<<"$drawn")" "$(cut -d' ' -f$n <<<"$joints")" 1e-4
    done
    claim "leg $leg has its number" grep -q ">$leg</text>" "$sketch"
done
claim 'the half angle is that of the study' grep -q '^  base: {radius: 0.25, half_angle: 10}' own-machine.yaml
claim 'the half angle is drawn' grep -q '>10°</text>' "$sketch"
claim 'the length is that from joint to joint' grep -q '>joint to joint</text>' "$sketch"
claim 'the guide shows the sketch' grep -q '](../images/machine.svg)' "$SOURCE/docs/guide/study-file.md"
finish
