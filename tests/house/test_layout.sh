#!/usr/bin/env bash
# The layout of the state (src/plant/layout.h) is the only place that knows how many numbers a state and its parts have: later
# parts add theirs there alone.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
rooms=(src/drive src/plant src/control src/integrate src/system src/run src/batch src/linear src/floquet src/map src/tune web/core)
digits='\[(12|24)\]|< *(12|24) *;|, *(12|24)\)'
failed=0
while IFS=: read -r file line text; do
    case $file in
        src/plant/layout.h) continue ;;
        src/integrate/dop853_table.h) continue ;; # stages of the method
    esac
    [[ $text != *char* ]] || continue
    echo "$file:$line: the state's layout in digits: $text"
    failed=1
done < <(grep -nE "$digits" -r "${rooms[@]}" --include='*.[ch]' | sed -E 's,/\*.*,,' | grep -E "^[^:]*:[0-9]*:.*($digits)")
exit $failed
