#!/usr/bin/env bash
# Label: thorough.
# The README's promises: its commands run, its program compiles and prints forces that carry the load, what it links to is there.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"
readme=$SOURCE/README.md

mkdir build
ln -s "$GOUGH" build/gough
commands=0
while IFS= read -r line; do
    bash -c "$line" >said.txt 2>&1
    status=$?
    claim "$line" same $status 0
    if ((status != 0)); then cat said.txt; fi
    commands=$((commands + 1))
done < <(sed -n 's/^    \(build\/gough .*\)$/\1/p' "$readme")
claim 'there are commands to try' within "$commands" 5 50
claim 'they leave a picture' test -s my.png

# shellcheck disable=SC2016
sed -n '/^```c$/,/^```$/p' "$readme" | sed '1d;$d' >lift.c
mathematics=$(sed -n 's/^Libs.private: //p' "$BUILD/gough.pc")
# shellcheck disable=SC2086
claim 'the program compiles' "${CC:-cc}" -std=c17 -Wall -Wextra -Werror lift.c -I"$SOURCE/include" -I"$BUILD/include" \
    "$BUILD/libgough.a" $mathematics -o lift
./lift >lift.txt
claim 'it runs' same $? 0
# 1050 kg lifted at 1 m/s² by six legs of length l, each with the vertical component 2/l: 1.5, 1.1 and the angle 60° − 2·0.14 rad
expected=$(awk 'BEGIN {
    d = 1.5 * 1.5 + 1.1 * 1.1 - 2 * 1.5 * 1.1 * cos(3.14159265358979 / 3 - 0.28)
    printf "%.1f", 1050 * 10.80665 * sqrt(4 + d) / 12 }')
for leg in 1 2 3 4 5 6; do
    claim "leg $leg carries its sixth" same "$(sed -n "${leg}p" lift.txt)" "leg $leg: $expected N"
done

# the sizing table is what the command prints, the figures of speed are those of the benchmarks
"$GOUGH" forces own-machine.yaml >forces.txt
rows=0
while IFS= read -r line; do
    [[ -n $line ]] || continue
    rows=$((rows + 1))
    claim "printed: $line" grep -qxF -- "$line" forces.txt
done < <(sed -n '/^```text$/,/^```$/p' "$readme" | sed '1d;$d')
claim 'the table has both parts' same "$rows" 16
median() { awk -v row="$1" -v field="$2" '{ gsub(/ +/, " ") } index($0, row " ") == 1 { rest = substr($0, length(row) + 1); split(rest, f, " "); print f[field]; exit }' "$SOURCE/docs/guide/benchmarks.md"; }
speed=$(grep -A2 '^- \*\*Speed' "$readme")
claim 'steps of the widest lanes' grep -qF "takes $(median 'RK4, the widest lanes, million steps/s' 2) million RK4 steps a second with eight" <<<"$speed"
claim 'steps against MuJoCo' grep -qF ", $(median "RK4 steps in lanes against MuJoCo's tendons, times" 2 | cut -d. -f1) times as many as MuJoCo" <<<"$speed"
claim 'one pose' grep -qF "takes $(median 'inverse dynamics, pivoting 1' 1) ns for one pose" <<<"$speed"
claim 'eight poses' grep -qF "$(median 'inverse dynamics, pivoting 8' 1) ns for each of eight" <<<"$speed"

for document in "$SOURCE"/*.md "$SOURCE"/docs/*/*.md; do
    document=${document#"$SOURCE"/}
    while IFS= read -r target; do
        case $target in http* | '#'*) continue ;; esac
        claim "$document links to $target" test -e "$SOURCE/$(dirname "$document")/${target%%#*}"
    done < <(grep -oE '\]\([^)]+\)' "$SOURCE/$document" | sed 's/^](//; s/)$//')
done

finish
