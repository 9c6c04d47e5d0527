#!/usr/bin/env bash
# Each equation label that the sources cite, such as (legs-3) or (legs-2…5), stands in the theory.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
failed=0 count=0
shopt -s nullglob
theory=(docs/theory/*.md)
((${#theory[@]})) || { echo "docs/theory has no chapter"; exit 1; }
while IFS=: read -r file line label; do
    count=$((count + 1))
    grep -qF -- "$label" "${theory[@]}" || { echo "$file:$line: $label is in no chapter of docs/theory"; failed=1; }
done < <(grep -noE '\([a-z]+-[0-9]+\)' -r src include --include='*.[ch]')
((count > 0)) || { echo "no label is cited at all"; failed=1; }
exit $failed
