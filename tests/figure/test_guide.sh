#!/usr/bin/env bash
# The guide to tables and figures names every column, every kind of figure and every attribute that there is.
set -euo pipefail
guide=$SOURCE/docs/guide/results.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

"$GOUGH" example paper-heave >"$scratch/study.yaml"
"$GOUGH" simulate "$scratch/study.yaml" -q --set simulation.duration=1 --reactions -o "$scratch/run.h5" 2>/dev/null
"$GOUGH" simulate "$scratch/study.yaml" -q --set simulation.duration=1 --reactions -o "$scratch/run.csv" 2>/dev/null
for column in $(head -1 "$scratch/run.csv" | tr ',' ' '); do
    # legs are named by their first and last
    [[ $column =~ ^(l|dl|f|p)[2-5]$ ]] || grep -q "\`$column\`" "$guide" || fail "no column $column in the guide"
done
kinds=$("$GOUGH" plot --help | sed -n '/^Kinds of figure/,$p' | sed -n 's/^  \([a-z]*\) — .*/\1/p')
[[ $(wc -w <<<"$kinds") -ge 11 ]] || fail "kinds are $kinds"
for kind in $kinds; do grep -q "^|.*\`$kind\`.*|" "$guide" || fail "no kind $kind in the guide"; done
if command -v h5dump >/dev/null; then
    for name in $(h5dump -n 1 "$scratch/run.h5" | sed -n 's/^ *attribute *\/\([a-z_]*\) *$/\1/p' | sort -u); do
        grep -q "\`$name\`" "$guide" || fail "no attribute $name in the guide"
    done
fi
