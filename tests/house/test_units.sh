#!/usr/bin/env bash
# The command scales units in one place, src/cli/common/scale.c: nothing else in it computes with what a unit of the output is.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
failed=0
while IFS=: read -r file line text; do
    case $file in
        src/cli/common/scale.c) continue ;;
        src/cli/common/leg_table.c) [[ $text == *"units->length == 1"* ]] && continue ;; # whether the units are the study's own
    esac
    echo "$file:$line: a unit scaled by hand: $text"
    failed=1
done < <(grep -nE '\b(u|units|l->units|report->units)(->|\.)(length|mass|time)\b' -r src/cli --include='*.[ch]')
exit $failed
