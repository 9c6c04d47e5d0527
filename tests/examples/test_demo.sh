#!/usr/bin/env bash
# The demonstration runs from any folder, says what the study finds, and leaves the results and pictures that it names.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"

OUT=$work/out "$SOURCE/scripts/demo.sh" >said.txt 2>complained.txt
claim 'it ends well' same $? 0
claim 'it complains of nothing' same "$(cat complained.txt)" ''
claim 'it colours nothing that is not a terminal' same "$(grep -c $'\e' said.txt)" 0

says() { grep -qE "$1" said.txt || { echo "      no line matches $1"; return 1; }; }
claim 'Figure 3: the force at t = 5' says '5\.0 +0\.25548980466[0-9]+ +0\.25548980466'
claim 'Figure 3: the range of the limit cycle' says 'between 0\.15436 and 0\.2657[56]'
claim 'Figure 4: the deviation at t = 10' says '10\.0 +8\.389190e-03'
claim 'Figure 4: passes +1' says 'passes \+1 at t = 18\.255[34], upwards'
claim 'feedback holds' says 'moves the platform by 2\.[0-9]+e-06 at most'
claim 'feedback alone collapses when soft' says 'collapses: the pose is singular at t = 17\.1[45]'
claim 'the table has seventeen gains' same "$(grep -cE '^ +[0-9.]+ .* (not )?held ' said.txt)" 17
claim 'too soft is not held' says '^ +0\.35 .* not held '
claim 'the trace theorem' says 'trace -2Mg/h = -2 < 0'
claim 'yaw grows most' says '9829\.08-fold +yaw'
claim 'the first tongue of heave' says 'G from 0\.11616 to 0\.19283'
claim 'the second' says 'G from 0\.33333 to 0\.36773'
claim 'stiff is held' says '^ +50 .* held '

named=0
while read -r file; do
    claim "$(basename "$file") is there" test -s "$file"
    case $file in
    *.png) claim 'as a PNG' same "$(head -c 4 "$file" | tail -c 3)" PNG ;;
    *.pdf) claim 'as a PDF' same "$(head -c 4 "$file")" '%PDF' ;;
    *.html) claim 'as HTML, of three studies' same "$(grep -o '"title":"[^"]*"' "$file" | sort -u | grep -ciE 'heave|oscillation')" 3 ;;
    *.h5) claim 'as HDF5' same "$(head -c 4 "$file" | tail -c 3)" HDF ;;
    esac
    named=$((named + 1))
done < <(sed -n '/^Results$/,$p' said.txt | sed -n 's/^   \([^ ]*\)$/\1/p')
claim 'they are all named' same "$named" "$(find "$work/out" -type f | wc -l)"

finish
