#!/usr/bin/env bash
# Label: thorough.
# The guide to choosing the feedback: its commands run as they stand, and what it says of the G named comes out.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"
guide=$SOURCE/docs/guide/choosing-the-feedback.md
try_guide "$guide" 10 20
for picture in figure-4 line map damping tune; do claim "the picture $picture" test -s "$picture.png"; done

# the table of section 6: the G named, and a fifth less
deviation() { gough simulate heave.yaml --json -q "$@" | jq .deviation.position; }
gough tune heave.yaml --deviation 1e-3 --json >tune.json 2>/dev/null
for feedforward in program none; do
    G=$(jq -r ".choices[] | select(.feedforward == \"$feedforward\") | .stiffness" tune.json)
    said=1.349
    [[ $feedforward == none ]] && said=612
    claim "G with feed-forward $feedforward" within "$G" "$(awk "BEGIN { print $said * 0.999 }")" "$(awk "BEGIN { print $said * 1.001 }")"
    claim "it keeps within the deviation, feed-forward $feedforward" within \
        "$(deviation --set control.stiffness="$G" --set control.feedforward=$feedforward)" 0 1e-3
    claim "a fifth less does not, feed-forward $feedforward" within \
        "$(deviation --set control.stiffness="$(awk "BEGIN { print 0.8 * $G }")" --set control.feedforward=$feedforward)" 1.0001e-3 0.1
done
claim 'tuned, nothing lasts' within "$(gough stability heave.yaml --set control.stiffness=14.13 --set control.damping=0.746 --json | jq .growth_per_period)" 0 0.5
finish
