#!/usr/bin/env bash
# No source of 600 lines, no line beyond 132 columns; the first line of each source says what it does.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
failed=0
while read -r file; do
    lines=$(wc -l <"$file")
    ((lines < 600)) || { echo "$file: $lines lines"; failed=1; }
    # code keeps to 100 by its formatter; comments may take 132, counted in characters
    LC_ALL=C awk -v file="$file" '{ gsub(/[\200-\277]/, "") } length($0) > 132 { print file ":" NR ": " length($0) " columns"; bad = 1 }
        END { exit bad }' "$file" || failed=1
    head -1 "$file" | grep -qE '^(/\*|//)' || { echo "$file: its first line does not say what it does"; failed=1; }
done < <(find src include tests bench web/core -name '*.[ch]' 2>/dev/null)
exit $failed
