#!/usr/bin/env bash
# Where results go: files complete or absent, standard output checked, talk on standard error, quiet when asked.
source "$(dirname "$0")/support.sh"
study=$scratch/heave.yaml
"$GOUGH" example paper-heave >"$study"

# a table beside a summary
run forces "$study" -o "$scratch/a.csv"
expect_code 0 forces -o
[[ $(wc -l <"$scratch/a.csv") == 402 ]] || fail "forces -o: $(wc -l <"$scratch/a.csv") lines"
grep -q "massless" "$scratch/out" || fail "the summary does not say that the legs are massless"
[[ ! -s $scratch/err ]] || fail "forces has something to say: $(cat "$scratch/err")"

# the same table on standard output, the summary then being talk
run forces "$study" -o -
expect_code 0 forces -o -
cmp -s "$scratch/out" "$scratch/a.csv" || fail "-o - differs from -o FILE"
grep -q "massless" "$scratch/err" || fail "-o - hides the summary"
run forces "$study" -o - -q
[[ ! -s $scratch/err ]] || fail "-q talks: $(cat "$scratch/err")"
run simulate "$study" -q
expect_code 0 simulate -q
[[ ! -s $scratch/err && ! -s $scratch/out ]] || fail "simulate -q talks"

# standard input as the study
"$GOUGH" forces - -o - -q <"$study" | cmp -s - "$scratch/a.csv" || fail "a study from standard input differs"

# HDF5 and CSV hold the same numbers
run forces "$study" -o "$scratch/a.h5" -q
expect_code 0 forces -o a.h5
if command -v h5dump >/dev/null; then
    h5dump -y -w 0 -m %.17g -d f3 "$scratch/a.h5" | grep -E '^ *-?[0-9]' | tr -d ' ' | tr ',' '\n' | sed '/^$/d' >"$scratch/h5"
    column "$scratch/a.csv" f3 | cmp -s - "$scratch/h5" || fail "f3 differs between CSV and HDF5"
fi

# places that cannot be written
run forces "$study" -o "$scratch/nowhere/a.csv"
expect_code 3 "a folder that does not exist"
run example paper-heave -o "$scratch/nowhere/a.yaml"
expect_code 3 "an example into a folder that does not exist"
run forces "$scratch/none.yaml"
expect_code 3 "a study that does not exist"
run plot "$scratch/none.h5"
expect_code 3 "a result that does not exist"
if [[ -w /dev/full ]]; then
    for arguments in "forces $study" "forces $study --json" "forces $study -o -" "example paper-heave" "check $study" "--help" "--version"; do
        # shellcheck disable=SC2086
        "$GOUGH" $arguments >/dev/full 2>"$scratch/err"
        code=$?
        expect_code 3 "$arguments >/dev/full"
        [[ -s $scratch/err ]] || fail "$arguments >/dev/full says nothing"
    done
fi
"$GOUGH" forces "$study" -o "$scratch/closed.csv" >&- 2>/dev/null
code=$?
expect_code 3 "standard output closed"
[[ ! -e $scratch/closed.csv ]] || cmp -s "$scratch/closed.csv" "$scratch/a.csv" || fail "a closed standard output spoils the file"
(ulimit -f 8; "$GOUGH" forces "$study" -o "$scratch/large.csv" >/dev/null 2>"$scratch/err")
code=$?
expect_code 3 "a file larger than allowed"
[[ -z $(ls "$scratch"/large* 2>/dev/null) ]] || fail "half a file is left: $(ls "$scratch"/large*)"

# figures: beside the result unless told otherwise
run plot "$scratch/a.csv"
expect_code 0 plot
[[ $(head -c 4 "$scratch/a.png" | tail -c 3) == PNG ]] || fail "plot leaves no picture beside the result"
run plot "$scratch/a.csv" "$scratch/a.h5" -o "$scratch/both.svg" --label one --label two -q
expect_code 0 "plot of two"
[[ ! -s $scratch/err ]] || fail "plot -q talks"
grep -q '<svg' "$scratch/both.svg" || fail "plot -o leaves no SVG"
run plot "$scratch/a.csv" -o "$scratch/a.gif"
expect_code 2 "a picture of unknown kind"

# colours and bars are for terminals only
run simulate "$study" --json
! grep -q $'\033' "$scratch/out" "$scratch/err" || fail "escape sequences in a file"
if script -qec true /dev/null </dev/null >/dev/null 2>&1; then # some containers have no pseudo-terminals
    on_terminal() { # on_terminal ASSIGNMENT…: a run of minutes, stopped when its bar is there or the limit is over
        env TERM=xterm "$@" script -qec "'$GOUGH' simulate '$study' -o '$scratch/long.csv' --precision quad \
            --set simulation.duration=2000 --set control.stiffness=5" /dev/null </dev/null >"$scratch/out" 2>/dev/null &
        local pid=$!
        for _ in $(seq $((40 * ${GOUGH_TEST_SLOWNESS:-4}))); do
            sleep 0.25
            grep -q '\[#*-*\]' "$scratch/out" && break
        done
        kill $pid 2>/dev/null
        wait $pid 2>/dev/null
    }
    on_terminal NO_COLOR=
    grep -q '\[#*-*\]' "$scratch/out" || fail "no bar on a terminal: $(head -c 300 "$scratch/out")"
    grep -q $'\033\[36m' "$scratch/out" || fail "no colour on a terminal"
    on_terminal NO_COLOR=1
    grep -q '\[#*-*\]' "$scratch/out" || fail "NO_COLOR takes the bar away"
    ! grep -q $'\033\[[0-9;]*m' "$scratch/out" || fail "NO_COLOR is not honoured"
    [[ ! -e $scratch/long.csv ]] || fail "a killed run leaves a file"
fi
finish
