#!/usr/bin/env bash
# Label: thorough.
# No text of the user drives the terminal: control bytes, marks of direction and bytes that are not UTF-8, in every kind of place
# and every verb, come out escaped in messages and summaries; JSON keeps the text.
# Sanitized: campaign: other tests of the command run each verb under sanitizers, and base/text escapes.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1

# ESC, BEL, DEL, C1, right-to-left override, isolate, zero width, line separator; and bytes that are not UTF-8
hostile=$'\e]0;owned\a\e[31m\x7f\u009b31m\u202e\u2066\u200b\u2028'
broken=$'x\x9b31m\xff\xc3'
forbidden='[\x00-\x09\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\x8b-\x8f\xa8-\xae]|\xe2\x81[\xa6-\xa9]|\xef\xbb\xbf'

# Each run keeps its output in files of its own, which are searched together at the end: a search per run would start more processes
# than the runs themselves.
mkdir said
runs=0
declare -A called=()
run() {
    runs=$((runs + 1))
    out=$scratch/said/$runs.out err=$scratch/said/$runs.err
    "$GOUGH" "$@" >"$out" 2>"$err" </dev/null
    code=$?
}
clean() { called[$runs]=$1; } # clean WHAT: what the last run printed is to be searched
search() { # search FAULT OPTION...: a failure for each file that grep lists
    local fault=$1 file number
    shift
    while read -r file; do
        number=${file#said/}
        number=${number%.*}
        [[ -n ${called[$number]:-} ]] || continue
        fail "${called[$number]}: $fault: $(LC_ALL=C grep -am1 . "$file" | cat -v)"
    done < <(find said -type f | sort -V | xargs grep -l -a "$@")
}
shows() { # shows WHAT: and the hostile text is there, escaped
    clean "$1"
    grep -qF '\x1b' "$out" "$err" || fail "$1: the text is not shown: $(head -3 "$err")"
}

"$GOUGH" example own-machine >good.yaml
verbs=$("$GOUGH" --help | sed -n 's/^  gough \([a-z]*\) [A-Z].*/\1/p' | sort -u)
[[ $(wc -w <<<"$verbs") -ge 10 ]] || fail "too few verbs: $verbs"

run "$hostile"
shows "a verb"
run "--$hostile" check
shows "an option before the verb"
runs=$((runs + 1))
bash -c 'exec -a "$1" "$2" zzz' bash "$hostile" "$GOUGH" >said/$runs.out 2>said/$runs.err
clean "the name of the command"

text=$hostile$broken
for verb in $verbs; do
    run "$verb" "--$text"
    expect_code 2 "$verb with an unknown option"
    clean "$verb, an unknown long option"
    run "$verb" "-$text" good.yaml
    clean "$verb, an unknown short option"
    run "$verb" "-q$text" good.yaml
    clean "$verb, an unknown short option behind another"
    run "$verb" "$text"
    clean "$verb, a file that is not there"
    run "$verb" "no/$text/x.yaml"
    clean "$verb, a folder that is not there"
    for option in $("$GOUGH" "$verb" --help | grep -oE -- '--[a-z-]+=' | sort -u); do
        for value in "$text" "$text=1" "1:$text" "x/$text.csv"; do
            run "$verb" good.yaml --set simulation.duration=0.1 "$option$value"
            clean "$verb $option"
            [[ ! -e good.html ]] || rm good.html
        done
    done
done
run forces good.yaml --set "$hostile=1"
shows "a key of --set"
run forces good.yaml --set "control.stiffness=$hostile"
shows "a value of --set"
run tune good.yaml --deviation "$hostile"
shows "a number of an option"
run stability good.yaml --pose "heave=$hostile"
shows "a number of --pose"

# ---- in the study ---------------------------------------------------------------------------------------------------

study() { # study WHAT LINE: a study with a line of its own
    { cat good.yaml; printf '%s\n' "$2"; } >study.yaml
    run check study.yaml
    expect_code 2 "$1"
    clean "$1"
}
study "a raw control byte" "# $hostile"
study "a byte that is not UTF-8" "# $broken"
study "an unknown key" "\"\\e[31m$(printf '\u202e')\": 1"
study "a key given twice" "\"load\": {\"\\e[31m\": 1, \"\\e[31m\": 2}"
study "a mark of direction in a key" "$(printf '\u202e\u2066'): 1"
for place in 'motion.heave="X"' 'control.feedforward="X"' 'control.stiffness="X"' 'motion.samples="X"' 'title="X"' 'units="X"' \
    'platform.base.joints=["X"]' 'sweep={keys: {"X": [1]}}' 'sweep.keys={control.stiffness: ["X"]}' 'motion={moves: [{"X": 1}]}' \
    'simulation.constraints={"X": 1}' 'disturbance.force=["X",0,0]'; do
    for text in '\e[31m' '\u202e' '\x9b' '\x7f'; do
        run check good.yaml --set "${place//X/$text}"
        [[ $place == title* ]] || expect_code 2 "$place with $text"
        clean "$place with $text"
    done
done

# ---- in what succeeds -----------------------------------------------------------------------------------------------

title=$'marks \u202e and \u2066 of direction'
name=$'good \e[31m\u202e'
mkdir -p "$name"
cp good.yaml "$name/$name.yaml"
short=(--set simulation.duration=0.2 --set "title=$title")
sweep=(--set 'sweep={keys: {control.stiffness: [5e4, 6e4]}}')
for verb in check forces simulate; do
    run $verb "$name/$name.yaml" "${short[@]}"
    expect_code 0 "$verb of a study with marks"
    clean "the summary of $verb"
    grep -qF 'marks \u202e and \u2066 of' "$out" || fail "$verb: the title is not shown: $(head -2 "$out")"
done
run stability "$name/$name.yaml" "${short[@]}"
clean "the summary of stability"
run stability "$name/$name.yaml" "${short[@]}" --sweep-stiffness 1e4:1e5:3 -o "$name/map.csv"
expect_code 0 "a map"
shows "the summary of a map"
run tune "$name/$name.yaml" "${short[@]}" --deviation 1e-2 -o "$name/tune.csv"
shows "the summary of tune"
for verb in forces simulate; do
    run $verb "$name/$name.yaml" "${short[@]}" -o "$name/$verb.csv"
    expect_code 0 "$verb with a table"
    shows "the table of $verb"
done
run sweep "$name/$name.yaml" "${short[@]}" "${sweep[@]}" -o "$name/sweep.csv"
expect_code 0 "a sweep"
shows "the summary of a sweep"
if has_page; then
    run report "$name/$name.yaml" "${short[@]}"
    shows "the page of report"
fi
run plot "$name/simulate.csv"
expect_code 0 plot
shows "the picture of plot"
run example own-machine -o "$name/again.yaml"
shows "a file of example"

# JSON is data: the text as it is, in what parses
command -v jq >/dev/null && for verb in check forces simulate stability sweep tune; do
    run $verb "$name/$name.yaml" "${short[@]}" "${sweep[@]}" --json -q -o "$name/json.csv" --deviation 1e-2
    [[ $verb == tune ]] || run $verb "$name/$name.yaml" "${short[@]}" "${sweep[@]}" --json -q -o "$name/json.csv"
    [[ $verb == check || $verb == stability ]] && run $verb "$name/$name.yaml" "${short[@]}" "${sweep[@]}" --json
    [[ $(jq -r .title "$out") == "$title" ]] || fail "$verb --json: the title is $(jq -c .title "$out" | cat -v)"
done

# ---- in tables ------------------------------------------------------------------------------------------------------

printf 't,"heave\e[31m"\n0,0\n1,1\n' >control.csv
printf 't,heave\u202e\n0,0\n1,1\n' >marks.csv
printf 't,heave\n0,\e[31m\n1,\u202e\n' >cells.csv
for file in control marks cells; do
    run check good.yaml --set "motion={samples: $file.csv}"
    expect_code 2 "samples in $file.csv"
    clean "samples in $file.csv"
    run plot $file.csv --columns "heave$hostile"
    clean "a plot of $file.csv"
    run merge $file.csv -o merged.csv
    clean "a merge of $file.csv"
done
LC_ALL=C search "a character that drives a terminal" -P "$forbidden"
LC_ALL=C.UTF-8 search "not UTF-8" -xv '.*'
((${#called[@]} > 300)) || fail "only ${#called[@]} places were tried"
finish
