#!/usr/bin/env bash
# Label: thorough.
# The guide "What can my machine reach?": its commands run as they stand, and its numbers are theirs.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"
guide=$SOURCE/docs/guide/workspace.md
try_guide "$guide" 5 10

# each line of the guide's excerpts is one that the command prints
lines=0
while IFS= read -r line; do
    claim "the command prints: $line" grep -qF -- "$line" said-1.txt
    lines=$((lines + 1))
done < <(sed -n '/^```text$/,/^```$/ { /^```/! { /./p } }' "$guide")
claim 'there are lines to compare' within "$lines" 15 60

# what the text says of them: no bound lies farther than 2 % from the value found, and the travels are not free together
gough workspace motion-base.yaml --json >all.json
far=$(jq -r '[.envelope.gap | to_entries[] | select(.value != null and .value > 0.02) | .key] | join(" ")' all.json)
claim 'no value stays apart' same "$far" ''
share=$(jq '.box.greatest[0] / .travel.surge.greatest.end' all.json)
claim 'the part of the surge that is free with all else' within "$share" 0.175 0.179
claim 'bounds of the volume, with limits of force' within "$(jq '.volume.bounds[0] / .volume.bounds[1]' all.json)" 0.8 1
claim 'rows of a surface' same "$(wc -l <surface.csv)" 2523
claim 'rows of an outline' same "$(wc -l <outline.csv)" 361
finish
