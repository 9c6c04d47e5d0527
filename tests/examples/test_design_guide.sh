#!/usr/bin/env bash
# Label: thorough.
# The guide to designs: its commands run as they stand, and its numbers come out; the design holds its box by another verb.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"
guide=$SOURCE/docs/guide/design.md
rm -f flight-design.yaml
try_guide "$guide" 4 4

read -r before after < <(awk '/greatest force of a leg/ { print $(NF - 3), $(NF - 2); exit }' said-1.txt)
claim 'the first guess' within "$before" 13850 13950
claim 'the design' within "$after" 11250 11350
claim 'the telescope binds' grep -q '^  design.telescope: ' said-1.txt
claim 'the box is certified' grep -q 'every pose of workspace.box keeps every limit' said-1.txt
# the other verb has the box too: the scale that it finds is 1 or more
claim 'the box by the other verb' within "$(awk '/^  size/ { print $2 }' said-2.txt)" 1 100
another=$(awk '/greatest force of a leg/ { print $(NF - 2); exit }' said-3.txt)
claim 'another seed finds nothing much better' within "$another" "$(awk "BEGIN { print 0.99 * $after }")" "$(awk "BEGIN { print 1.01 * $after }")"
finish
