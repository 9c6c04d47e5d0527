#!/usr/bin/env bash
# Each room of src/ includes only itself and rooms above it; study, result, report and cli see the others only through the
# public headers; public headers include only public headers.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
rooms=(base kernel model dynamics integrate system simulate batch analyse study result report cli)
declare -A rank
for i in "${!rooms[@]}"; do rank[${rooms[i]}]=$i; done
public_only=" study result report cli "
failed=0
fail() { echo "$*"; failed=1; }

for room in src/*/; do
    room=$(basename "$room")
    [[ -v rank[$room] ]] || fail "src/$room is no room of the house"
done
while IFS=: read -r file line text; do
    room=${file#src/} room=${room%%/*}
    header=${text#*\"} header=${header%%\"*}
    other=${header%%/*}
    case $header in
        gough/*) [[ -e include/$header || $header == gough/version.h ]] || fail "$file:$line: no public header $header"; continue ;;
        */*) ;;
        *) [[ -e ${file%/*}/$header ]] || fail "$file:$line: $header is not in its folder"; continue ;;
    esac
    if [[ ! -v rank[$other] ]]; then fail "$file:$line: $header is of no room"
    elif [[ $other == "$room" ]]; then :
    elif [[ $public_only == *" $room "* ]]; then fail "$file:$line: $room sees other rooms only through gough/*.h, not $header"
    elif ((${rank[$other]} > ${rank[$room]})); then fail "$file:$line: $room stands above $other and may not include $header"
    fi
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' -r src --include='*.[ch]')
while IFS=: read -r file line text; do
    [[ $text == *'"gough/'* ]] || fail "$file:$line: a public header includes only public headers"
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' -r include --include='*.h')
exit $failed
