#!/usr/bin/env bash
# gough report: the page holds what the other verbs say, to the bit; its default names; what is wrong and what ends early.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1

run report "$SOURCE/examples/paper-heave.yaml" -o any.html
if ((code == 2)) && grep -q 'without the page' err; then
    echo "built without the page: skipped"
    exit 77
fi
expect_code 0 report
grep -q 'wrote any.html' err || fail "it does not say what it wrote"

data() { sed -n 's/.*<script type="application\/json" id="gough-data">\(.*\)/\1/p' "$1" | sed 's/<\/script>.*//'; }
# numbers of a packed column, each extrapolated from those before it, as src/cli/report/packed.c describes
cat >unpack.py <<'PYTHON'
import base64, json, math, struct, sys, zlib
column = json.load(sys.stdin)
rows, order = column["rows"], column["order"]
planes = zlib.decompress(base64.b64decode(column["packed"]))
assert len(planes) == 8 * rows
values = []
for row in range(rows):
    guess, known = 0.0, min(row, order)
    for j in range(1, known + 1):
        guess += (-1) ** (j + 1) * math.comb(known, j) * values[row - j]
    code = sum(planes[k * rows + row] << 8 * k for k in range(8))
    apart = -(code + 1) // 2 if code % 2 else code // 2
    bits = struct.unpack("<Q", struct.pack("<d", guess if math.isfinite(guess) else 0.0))[0]
    values.append(struct.unpack("<d", struct.pack("<Q", (bits + apart) % 2**64))[0])
    print(repr(values[row]))
PYTHON
numbers() { python3 unpack.py; }
same_numbers() { # same_numbers FILE FILE: as doubles, to the bit
    paste -d' ' "$1" "$2" | awk '$1 != $2 && sprintf("%.17g", $1) != sprintf("%.17g", $2) { bad = 1 } END { exit bad || NR == 0 }'
}

# numbers of the tables, to the bit
run example own-machine
cp out own.yaml
run report own.yaml
expect_code 0 report own.yaml
[[ -s own.html ]] || fail "the default name is not own.html"
data own.html >own.json
jq -e . own.json >/dev/null || fail "the data are no JSON"
run simulate own.yaml -q -o own.csv
run forces own.yaml -q -o program.csv
for name in $(head -n 1 own.csv | tr ',' ' '); do
    jq -r ".studies[0].columns[] | select(.name == \"$name\")" own.json | numbers >page.txt
    column own.csv "$name" >table.txt
    same_numbers page.txt table.txt || fail "the column $name differs from the table"
done
for name in t z yaw l3 f6; do
    jq -r ".studies[0].program[] | select(.name == \"$name\")" own.json | numbers >page.txt
    column program.csv "$name" >table.txt
    same_numbers page.txt table.txt || fail "the program's column $name differs from the table"
done
for verb in simulate forces stability; do
    "$GOUGH" $verb own.yaml --json 2>/dev/null | jq -S 'del(.format)' >said.json
    jq -S ".studies[0].$verb" own.json >page.json
    cmp -s said.json page.json || fail "the page has another summary of $verb"
done
[[ $(jq -r '.studies[0].text' own.json) == "$(cat own.yaml)" ]] || fail "the study's text differs"
[[ $(jq -r '.studies[0].machine.limits.length | join(" ")' own.json) == '0.25 0.4' ]] || fail "limits are not there"
[[ $(jq -r '.studies[0].machine.limits.force' own.json) == 80 ]] || fail "the limit of force is not there"
[[ $(jq -r .version own.json) == "$("$GOUGH" --version | awk '{ print $2 }')" ]] || fail "another version"
[[ $(jq -r '.studies[0].live | length' own.json) -gt 100 ]] || fail "nothing to run live"

# a title that would end the element, and everything else that is not ASCII
# shellcheck disable=SC1112
title='</script><script>alert(1)</script> "quoted" ‘größer’ & 6 µm'
run report own.yaml --set "title=$(jq -nr --arg t "$title" '$t | @json')" -o hostile.html
expect_code 0 report hostile.html
[[ $(data hostile.html | jq -r '.studies[0].title') == "$title" ]] || fail "the title did not come through"
[[ $(grep -o '<script' hostile.html | wc -l) == $(grep -o '<script' own.html | wc -l) ]] || fail "the title made an element"

# names of studies, which are text too; more names than studies are refused
run report own.yaml own.yaml --label "$title" --label '' -q -o named.html
expect_code 0 report labels
[[ $(data named.html | jq -r '.studies[0].label') == "$title" ]] || fail "the label did not come through"
[[ $(grep -o '<script' named.html | wc -l) == $(grep -o '<script' own.html | wc -l) ]] || fail "the label made an element"
run report own.yaml --label a --label b -o named2.html
expect_code 2 "more labels than studies"
grep -q '2 labels are given for 1 study' err || fail "it does not say that there are too many labels"
[[ ! -e named2.html ]] || fail "a page was written in spite of that"

# a run that ends early: the page is written and says so, exit code 1
run report own.yaml --set platform.legs.max_force=15 -o early.html
expect_code 1 report early
[[ $(data early.html | jq -r '.studies[0].end.status') == leg_force ]] || fail "the page does not say how the run ended"
data early.html | jq -e '.studies[0].end | .time > 0 and .leg > 0 and (.message | length) > 10' >/dev/null || fail "not where and why"

# no period: rest alone, and why
run report own.yaml --set 'motion={heave: 0.01*sin(t^2)}' -o aperiodic.html
data aperiodic.html | jq -e '.studies[0] | .stability.period == null and (.stability_message | length) > 10 and (.stability.thresholds | length) == 6' \
    >/dev/null || fail "a program without a period is not told"

# several, one page; the same bytes each time; standard output
run report own.yaml "$SOURCE/examples/paper-feedback.yaml" -q -o two.html
expect_code 0 report two
[[ -s err ]] && fail "-q says $(cat err)"
[[ $(data two.html | jq '.studies | length') == 2 ]] || fail "not two studies"
"$GOUGH" report own.yaml "$SOURCE/examples/paper-feedback.yaml" -q -o - >again.html
cmp -s two.html again.html || fail "the same studies give other bytes"

# wrong
run report own.yaml -o page.htm
expect_code 2 "an ending"
run report own.yaml -o nowhere/page.html
expect_code 3 "a folder that is not there"
run report nothing.yaml
expect_code 3 "a study that is not there"
run report
expect_code 2 "no study"
run report own.yaml --set load.mass=-1 -o wrong.html
expect_code 2 "a wrong study"
[[ -e wrong.html ]] && fail "a page of a wrong study"

# the machine in the page is the study's, number by number: all of them differ
"$GOUGH" example own-machine >"$scratch/each.yaml"
"$GOUGH" report "$scratch/each.yaml" -q -o "$scratch/each.html" || fail "report of own-machine"
for number in '"gravity":\[0.0,0.0,-9.80664' '"center_of_mass":\[0.0,0.0,0.05' '"speed":0.25,' '"force":80.0' '"stiffness":\[5000.0,' '"damping":\[150.0,' \
    '"home_length":\[0.3254' '"base":\[\[0.2462'; do
    grep -q -- "$number" "$scratch/each.html" || fail "the page does not have $number"
done
finish
