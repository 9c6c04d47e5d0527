#!/usr/bin/env bash
# Pictures have something in them: the pixels of each kind of figure, read back, hold ink of more than one colour.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

cd "$scratch"
"$GOUGH" example all-six >study.yaml
"$GOUGH" simulate study.yaml -q --set control.stiffness=50 --set simulation.duration=5 -o run.h5
"$GOUGH" forces study.yaml -q --set simulation.duration=5 -o forces.csv
printf 'G,position_deviation,ended\n0.1,0.5,1\n1,0.01,0\n10,0.001,0\n' >gain.csv

# share of pixels that are not white, in thousandths, and how many colours there are far from grey
ink() {
    gnuplot -e "set table 'pixels'; plot '$1' binary filetype=png every 4:4 with rgbimage" 2>/dev/null
    awk '!/^#/ && NF >= 5 {
            all++
            if ($3 < 250 || $4 < 250 || $5 < 250) dark++
            high = $3 > $4 ? $3 : $4; high = high > $5 ? high : $5
            low = $3 < $4 ? $3 : $4; low = low < $5 ? low : $5
            if (high - low > 80) colour[int($3 / 64) "," int($4 / 64) "," int($5 / 64)]++
        }
        END { for (c in colour) if (colour[c] > 8) colours++; print int(1000 * dark / all), colours + 0 }' pixels
}
expect_ink() { # expect_ink FIGURE LEAST_COLOURS
    local share colours
    read -r share colours < <(ink "$1")
    ((share >= 5 && share <= 400)) || fail "$1: $share thousandths of its pixels are not white"
    ((colours >= $2)) || fail "$1: $colours colours"
}

for kind in overview motion forces lengths rates power deviation drift condition; do
    "$GOUGH" plot -q run.h5 --figure=$kind -o $kind.png || fail "$kind is not drawn"
done
for kind in overview forces lengths rates power; do expect_ink $kind.png 4; done
for kind in motion deviation drift condition; do expect_ink $kind.png 1; done
"$GOUGH" plot -q forces.csv -o forces.png && expect_ink forces.png 4
"$GOUGH" plot -q run.h5 --columns=x,y,z -o columns.png && expect_ink columns.png 3
"$GOUGH" plot -q gain.csv -o gain.png && expect_ink gain.png 1

# an empty sheet would not pass
printf 'G,position_deviation\n-1,-1\n' >nothing.csv
"$GOUGH" plot -q nothing.csv -o nothing.png
read -r _ colours < <(ink nothing.png)
((colours == 0)) || fail "a figure without a line has $colours colours"
