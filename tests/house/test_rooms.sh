#!/usr/bin/env bash
# Each room of src/ includes only itself and rooms above it; study, table, sweep, figure, page and cli see the others only through
# the public headers, but that a sweep has the crew of threads and writes its table by the table's own means; public headers include only public headers.
# CONTRIBUTING.md draws the house as it is. No two files of the sources share a name, but for a source and its own header.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
rooms=(base kernel drive program plant control model pose workspace cueing integrate system run batch linear floquet map tune design study table sweep figure page cli)
declare -A rank
for i in "${!rooms[@]}"; do rank[${rooms[i]}]=$i; done
public_only=" study table sweep figure page cli "
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
    elif [[ $room/$other == sweep/table || $room/$header == sweep/base/crew.h ]]; then :
    elif [[ $public_only == *" $room "* ]]; then fail "$file:$line: $room sees other rooms only through gough/*.h, not $header"
    elif ((${rank[$other]} > ${rank[$room]})); then fail "$file:$line: $room stands above $other and may not include $header"
    fi
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' -r src --include='*.[ch]')
while IFS=: read -r file line text; do
    [[ $text == *'"gough/'* ]] || fail "$file:$line: a public header includes only public headers"
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' -r include --include='*.h')

# the drawing: one row a room, in the order of the rooms, with its public headers, its tests and its chapters
drawn=()
while IFS='|' read -r _ room _ headers tests chapters _; do
    room=${room//[ \`]/}
    drawn+=("$room")
    for name in ${headers//[\`,]/}; do [[ -e include/gough/$name ]] || fail "CONTRIBUTING.md: $room has no include/gough/$name"; done
    for name in ${tests//[\`,]/}; do [[ -d tests/$name ]] || fail "CONTRIBUTING.md: $room has no tests/$name"; done
    for name in ${chapters//[\`,]/}; do [[ -e docs/theory/$name ]] || fail "CONTRIBUTING.md: $room has no docs/theory/$name"; done
done < <(sed -n '/^| room |/,/^$/p' CONTRIBUTING.md | tail -n +3 | grep '^|')
[[ ${drawn[*]} == "${rooms[*]}" ]] || fail "CONTRIBUTING.md draws ${drawn[*]}; the rooms are ${rooms[*]}"
named=$(sed -n '/^| room |/,/^$/p' CONTRIBUTING.md)
for header in include/gough/*.h; do
    ! grep -q '^GOUGH_API\|^static inline\|^typedef' "$header" || # gathers others
        [[ $named == *"\`${header##*/}\`"* ]] || fail "CONTRIBUTING.md gives ${header##*/} to no room"
done
for folder in tests/*/; do
    folder=$(basename "$folder")
    [[ " support data house digest examples faults fuzz independent install bench web python " == *" $folder "* ]] ||
        [[ $named == *"\`$folder\`"* ]] || fail "CONTRIBUTING.md gives tests/$folder to no room"
done

# no name twice: a source and its header stand in one folder
while read -r name; do fail "two files are called $name: $(find src -name "$name.*" | sort | xargs)"; done < <(
    find src -name '*.[ch]' -printf '%f %h\n' | sed 's/\.[ch] / /' | sort -u | awk '{ print $1 }' | uniq -d)
exit $failed
