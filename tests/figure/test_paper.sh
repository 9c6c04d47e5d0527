#!/usr/bin/env bash
# Figures for print: sizes on paper, text of at least 7 points at 85 mm measured on pixels, six legs told apart without colours, names at
# the ends of lines, a panel for each leg with one scale, limits, bands, lines that cover others, words for readers who do not see.
# Label: standard
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
cd "$scratch"

texts() { grep -o '<text>[^<]*</text>' "$1" | sed 's/<[^>]*>//g' | grep -v '^ *$'; }
says() { grep -qF -- "$2" <(texts "$1" | tr '\n' ' ') || fail "$1 does not say '$2'"; }
refused() { # refused SENTENCE ARGUMENT...
    local sentence=$1 rc=0
    shift
    "$GOUGH" plot "$@" -q -o refused.svg 2>err || rc=$?
    [[ $rc == 2 && ! -e refused.svg ]] || fail "plot $*: exit $rc"
    grep -qF -- "$sentence" err || fail "plot $*: $(cat err)"
}

# six legs at six levels, and text: CSV of forces 1 … 6
awk 'BEGIN { print "t,f1,f2,f3,f4,f5,f6"; for (i = 0; i <= 400; i++) { printf "%.2f", i / 100; for (k = 1; k <= 6; k++) printf ",%d", k; print "" } }' >levels.csv
print=(--figure forces --style print --width 85mm)
"$GOUGH" plot levels.csv -q "${print[@]}" --dpi 300 -o levels.png -o levels.svg -o levels.pdf
"$GOUGH" plot levels.csv -q "${print[@]}" --width 3.5in --font 9 -o wide.svg
"$GOUGH" plot levels.csv -q --figure forces --width 174 -o double.svg
grep -q ' width="85.0[0-9]mm"' levels.svg || fail "levels.svg is not 85 mm wide: $(head -c 300 levels.svg)"
grep -q ' width="88.[89][0-9]mm"' wide.svg || fail "wide.svg is not 3.5 in wide: $(head -c 300 wide.svg)"
grep -q ' width="17[34].[09][0-9]mm"' double.svg || fail "double.svg is not 174 mm wide: $(head -c 300 double.svg)"
grep -aq '/MediaBox \[ *0 0 24[01]\(\.[0-9]*\)\? ' levels.pdf || fail "levels.pdf is not 85 mm wide"

gnuplot -e "set table 'pixels'; plot 'levels.png' binary filetype=png with rgbimage" 2>/dev/null
python3 - levels.svg wide.svg <<'CHECK'
import re, sys
# all text of a picture in points: 7 at least with the default size, 11/12 of what --font asks for
for picture, least in ((sys.argv[1], 7.0), (sys.argv[2], 9 * 11 / 12 - 0.01)):
    svg = open(picture).read()
    mm, box = float(re.search(r' width="([\d.]+)mm"', svg)[1]), float(re.search(r'viewBox="0 0 ([\d.]+) ', svg)[1])
    sizes = [float(size) * mm / box / 25.4 * 72 for size in re.findall(r'font-size="([\d.]+)"', svg)]
    if not sizes or min(sizes) < least: sys.exit(f"{picture} has text of {min(sizes):.2f} points")
# the pixels, as grey
width = height = 0
grey = {}
for row in open("pixels"):
    part = row.split()
    if row.startswith("#") or len(part) < 5: continue
    x, y = int(float(part[0])), int(float(part[1]))
    grey[x, y] = 0.299 * float(part[2]) + 0.587 * float(part[3]) + 0.114 * float(part[4])
    width, height = max(width, x + 1), max(height, y + 1)
if abs(width - 85 / 25.4 * 300) > 3: sys.exit(f"85 mm at 300 dots per inch are {width} pixels")
ink = lambda x, y: grey[x, y] < 200
# the axis of ordinates is the longest upright stroke; its numbers stand at its left
upright = max(range(width), key=lambda x: sum(ink(x, y) for y in range(height)))
rows = [any(ink(x, y) for x in range(upright - 20)) for y in range(height)]
heights, y = [], 0
while y < height:
    begin = y
    while y < height and rows[y]: y += 1
    if y - begin > 6: heights.append(y - begin)
    y += 1
# a digit of DejaVu Sans is 0.73 as high as its text
digit = sorted(heights)[len(heights) // 2] / 0.73 / 300 * 72
if digit < 7: sys.exit(f"digits at the axis belong to text of {digit:.2f} points")
# lines: rows with much ink right of the axis, told apart by how much of them is ink, how many pieces they have
# and how long the longest is
left, right = upright + 30, int(0.8 * width)
share = [sum(ink(x, y) for x in range(left, right)) / (right - left) for y in range(height)]
patterns, y = [], 0
top = next(y for y in range(height // 3, height) if not ink(upright, y))  # of the panel; its key stands above
while y < top:
    if share[y] < 0.3: y += 1; continue
    begin = y
    while y < top and share[y] >= 0.3: y += 1
    middle = (begin + y) // 2
    row = "".join("#" if ink(x, middle) else " " for x in range(left, right)).split()
    patterns.append((share[middle], len(row) / (right - left) * 300 / 25.4, max(map(len, row)) / 300 * 25.4))
patterns = patterns[1:]  # but for the axis of abscissas, the lowest
if len(patterns) != 6: sys.exit(f"{len(patterns)} lines are seen: {patterns}")
for i, (a, p, m) in enumerate(patterns):
    for b, q, n in patterns[:i]:
        if abs(a - b) < 0.1 and abs(p - q) < 0.2 * max(p, q) and abs(m - n) < 0.4 * max(m, n): sys.exit(f"two lines have one pattern: {patterns}")
CHECK
# names where lines end: text right of the panel, in the order of the levels
grep -o 'translate([0-9.,]*)"[^>]*text-anchor="start">' levels.svg >places || true
python3 - <<'CHECK'
import re, sys
svg = open("levels.svg").read()
found = [(float(x), float(y), text) for x, y, text in
         re.findall(r'translate\(([\d.]+),([\d.]+)\)"[^>]*>\s*<text><tspan[^>]*>([1-6])</tspan></text>', svg) +
         re.findall(r'translate\(([\d.]+),([\d.]+)\)"[^>]*>\s*<text>([1-6])</text>', svg)]
edge = max(x for x, y, text in found)
names = [text for x, y, text in sorted(found, key=lambda f: f[1]) if abs(x - edge) < 1]
if names != list("654321"): sys.exit(f"names at the ends of the lines: {names}, of {found}")
CHECK

# words for readers who do not see
grep -q '<title>[^<]' levels.svg || fail 'an SVG without a title'
grep -q '<desc>One panel over time.*Leg force.*lines: 1, 2, 3, 4, 5, 6' levels.svg || fail "description: $(grep '<desc>' levels.svg)"
grep -q 'Produced by GNUPLOT' levels.svg && fail "gnuplot's own description is left"

# a line that another covers is named; legs that are equal are one line
awk 'BEGIN { print "t,f1,f2,f3,f4,f5,f6"; for (i = 0; i <= 100; i++) { s = sin(i / 10); printf "%.2f,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f\n", i / 100, s, s * 1.001, -s, s / 2, s / 3, -s / 2 } }' >near.csv
"$GOUGH" plot near.csv -q --figure forces -o near.svg
says near.svg 'line “2” covers line “1”'
"$GOUGH" plot levels.csv -q --figure forces -o apart.svg
grep -q covers <(texts apart.svg) && fail 'lines apart are called covered'

# of compared results, the pair is named once for all panels
"$GOUGH" example all-six >all-six.yaml
"$GOUGH" forces all-six.yaml -q --set simulation.duration=5 -o same.h5
"$GOUGH" plot same.h5 same.h5 -q --figure motion --width 85mm --label one --label two -o same.svg
says same.svg 'line “two” covers line “one” in all panels'

# lines of a result have the dashes of the result, not of the leg
"$GOUGH" plot same.h5 same.h5 -q --figure forces --style print --label one --label two -o same.svg
python3 - <<'CHECK'
import re, sys
found = {}
for colour, dashes in re.findall(r"<path stroke='(rgb\([^)]*\))' ?(?:stroke-dasharray='([^']*)')? ", open("same.svg").read()):
    if colour in ("rgb(  0, 114, 178)", "rgb(213,  94,   0)"): found.setdefault(colour, set()).add(dashes)
if sorted(map(len, found.values())) != [1, 1] or len({*map(tuple, found.values())}) != 2: sys.exit(f"dashes of two results: {found}")
CHECK

# more than two periods in a pixel: a band between the extremes
awk 'BEGIN { print "t,f1,f2,f3,f4,f5,f6"; for (i = 0; i <= 20000; i++) { s = i % 2 ? 1 : -1; printf "%.4f,%.4f,2,2,2,2,2\n", i / 1000, s * (1 + i / 20000) } }' >fast.csv
"$GOUGH" plot fast.csv -q --figure forces -o fast.svg
says fast.svg 'bands: least to greatest'
grep -q 'fill-opacity *= *.0\?\.50' fast.svg || fail 'no band is drawn'
grep -q 'bands' <(texts near.svg) && fail 'a slow line is called a band'

# a panel for each leg with one scale: each panel has the numbers of the others at its axis
"$GOUGH" plot levels.csv -q --figure forces --split -o split.svg
for leg in 1 2 3 4 5 6; do says split.svg "Leg force, leg $leg"; done
python3 - <<'CHECK'
import re, sys
from collections import Counter
numbers = Counter(re.findall(r'text-anchor="end">\s*<text>(?:<tspan[^>]*>)? *([−\d.]+)', open("split.svg").read()))
if len(numbers) < 2 or set(numbers.values()) != {6}: sys.exit(f"numbers at the six axes: {numbers}")
CHECK
refused 'the figure motion has no panel for each leg; forces, lengths, rates and power have one' near.csv --figure motion --split

# limits near the lines are drawn, those far away are named
"$GOUGH" example own-machine >study.yaml
short=(-q --set simulation.duration=6 --set simulation.output_step=0.05)
most=$("$GOUGH" forces study.yaml "${short[@]}" --json | jq '[.legs[].force[]] | max')
"$GOUGH" forces study.yaml "${short[@]}" --set "platform.legs.max_force=$(jq -n "1.2 * $most")" -o near.h5
"$GOUGH" forces study.yaml "${short[@]}" --set "platform.legs.max_force=800" -o far.h5
for name in near far; do "$GOUGH" plot $name.h5 -q --figure forces -o $name.svg; done
grep -qx ' *limit *' <(texts near.svg) || fail 'no limit is drawn'
grep -q 'limit' <(texts apart.svg) && fail 'a limit that the study does not have'
says far.svg 'the limit, ±800 N, lies outside the picture'

# units of tables without dimensions
"$GOUGH" forces study.yaml "${short[@]}" --dimensionless -o bare.h5
for kind in forces:'Leg force (M g)' lengths:'Leg length (R_b)' rates:'Leg rate (√(R_b g))' power:'M g √(R_b g))'; do
    "$GOUGH" plot bare.h5 -q --figure "${kind%%:*}" -o bare.svg
    says bare.svg "${kind#*:}"
    says bare.svg 'time (√(R_b/g))'
done

# differences: lines are those of a table made by hand
set=(-q --set simulation.duration=3 --set simulation.output_step=0.05)
"$GOUGH" simulate study.yaml "${set[@]}" -o a.csv
"$GOUGH" simulate study.yaml "${set[@]}" --set load.mass=6.5 -o b.csv
paste -d, a.csv b.csv | awk -F, 'NR == 1 { n = NF / 2; for (i = 1; i <= n; i++) printf "%s%s", $i, i < n ? "," : "\n"; next }
    { printf "%s", $1; for (i = 2; i <= n; i++) printf ",%.17g", $(i + n) - $i; print "" }' >hand.csv
paths() { grep -o "<path stroke='rgb([^>]*" "$1"; }
for kind in forces power; do
    "$GOUGH" plot a.csv b.csv -q --figure $kind --split --difference --label light --label heavy -o difference.svg
    "$GOUGH" plot hand.csv -q --figure $kind --split --title 'heavy − light' -o hand.svg
    cmp -s <(paths difference.svg) <(paths hand.svg) || fail "the difference of $kind is another line than that of the tables"
    says difference.svg 'heavy − light'
    says difference.svg "Difference of leg ${kind%s}, leg 1"
done
"$GOUGH" plot a.csv a.csv b.csv -q --figure lengths --difference -o three.svg
says three.svg 'Differences from'
"$GOUGH" simulate study.yaml "${set[@]}" --set simulation.output_step=0.04 -o c.csv
refused 'give both runs the same simulation.output_step' a.csv c.csv --difference
refused 'a difference needs two results or more; there is one' a.csv --difference
refused 'the figure duty does not draw a difference' a.csv b.csv --figure duty --difference

refused 'the style of a figure is screen or print' levels.csv --figure forces --style grey
refused 'a figure with text of 8 points is at least' levels.csv --figure forces --width 45mm
refused 'the width of a figure is 40 mm to 1000 mm' levels.csv --figure forces --width 10mm
refused 'the resolution of a figure is 30 dots per inch to 2400 dots per inch' levels.csv --figure forces --dpi 5
refused '--width takes a length above 0' levels.csv --figure forces --width wide
