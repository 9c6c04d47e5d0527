#!/usr/bin/env bash
# Units are scaled in one place, src/table/units.c: nothing in the command computes with what a unit of the output is, or has names of
# units of its own.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
failed=0
while IFS=: read -r file line text; do
    echo "$file:$line: a unit scaled by hand: $text"
    failed=1
done < <(grep -nE '\b(u|units|l->units|report->units)(->|\.)(length|mass|time)\b' -r src/cli --include='*.[ch]')
while IFS=: read -r file line text; do
    echo "$file:$line: a name of a unit: $text"
    failed=1
done < <(grep -nE '"(N/m|N s/m|N m|m/s2?|1/s|kg m2)"|" (m|kg|N|W|J|N/m|N s/m|m/s|m/s\^2|1/s|kg m\^2)"' -r src/cli --include='*.[ch]' | grep -v '/\*.*\*/')
exit $failed
