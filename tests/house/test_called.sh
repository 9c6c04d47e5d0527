#!/usr/bin/env bash
# Each exported function is called by a test written in C or, for functions that other languages look up, in another language.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
failed=0
functions=$(cat include/gough/*.h | tr '\n' ' ' | sed 's/;/;\n/g' | grep -oE 'GOUGH_API [^;(]*\bgough_[a-z0-9_]+\(' | grep -oE 'gough_[a-z0-9_]+\($' | tr -d '(' | sort -u)
inline=$(cat include/gough/*.h | grep -oE '^static inline [^(]*\bgough_[a-z0-9_]+\(' | grep -oE 'gough_[a-z0-9_]+\($' | tr -d '(' | sort -u)
[[ $(wc -w <<<"$functions") -gt 120 && $(wc -w <<<"$inline") -gt 8 ]] || { echo "found too few functions"; failed=1; }
called=$(cat tests/*/*.[ch] | grep -oE '\bgough_[a-z0-9_]+\(' | tr -d '(' | sort -u)
missing=$(comm -23 <(sort -u <<<"$functions"$'\n'"$inline") <(echo "$called"))
[[ -z $missing ]] || { echo "no test calls" $missing; failed=1; }
exit $failed
