#!/usr/bin/env bash
# An input is never overwritten, by whatever name or link the output leads to it; pipes, devices and folders where a file is needed
# are refused at once; standard input keeps working.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml
printf 't,heave\n0,0\n0.5,0.01\n1,0.02\n1.5,0.01\n2,0\n' >deck.csv
settings=(--set 'motion={samples: deck.csv}' --set 'simulation={duration: 2, output_step: 0.1}')
swept=("${settings[@]}" --set 'sweep.keys={control.stiffness: [500, 600]}')
mkdir -p folder
ln deck.csv hard.csv
ln -s deck.csv soft.csv
ln -s ../deck.csv folder/soft.csv
cp own.yaml study.csv
cp own.yaml study.html
"$GOUGH" forces own.yaml -q -o result.csv
cp result.csv result.png
"$GOUGH" sweep own.yaml -q --set 'sweep.keys={control.stiffness: [500, 600]}' --shard 1/1 -o one.shard
cp one.shard shard.csv
cp one.shard other.shard
find . -type f -exec cksum {} + | sort >before

refused() { # refused SENTENCE ARGUMENT…
    local sentence=$1
    shift
    run "$@"
    expect_code 2 "$@"
    grep -qF -- "$sentence" err || fail "$*: does not say '$sentence' but: $(cat err)"
    [[ ! -s out ]] || fail "$*: prints $(head -2 out)"
    find . -type f ! -name out ! -name err ! -name before -exec cksum {} + | sort | cmp -s - <(grep -v ' ./before$' before) ||
        fail "$*: a file has changed: $(find . -type f -newer before | tr '\n' ' ')"
}
for name in deck.csv hard.csv soft.csv folder/soft.csv ./deck.csv "$PWD/deck.csv"; do
    refused "the output '$name' would overwrite the input" forces own.yaml "${settings[@]}" -o "$name"
done
refused "would overwrite the input" simulate own.yaml "${settings[@]}" -o other.h5 -o soft.csv
refused "would overwrite the input" sweep own.yaml "${swept[@]}" -o hard.csv
refused "would overwrite the input" forces study.csv -o study.csv
refused "would overwrite the input" simulate study.csv -o study.csv
refused "would overwrite the input" sweep study.csv --set 'sweep.keys={control.stiffness: [500, 600]}' -o study.csv
refused "would overwrite the input" tune study.csv --deviation 1e-3 -o study.csv
refused "would overwrite the input" tune own.yaml "${settings[@]}" --deviation 1e-3 -o deck.csv
refused "would overwrite the input" stability study.csv --sweep-stiffness 100:200:2 -o study.csv
refused "would overwrite the input" stability own.yaml "${settings[@]}" --sweep-stiffness 100:200:2 -o hard.csv
refused "would overwrite the input" plot result.csv result.png
refused "would overwrite the input" plot result.png
refused "would overwrite the input" plot result.csv result.png -o result.png
refused "would overwrite the input" merge shard.csv -o shard.csv
"$GOUGH" report study.html -o page.html >out 2>err
if ! grep -q 'without the page' err; then
    rm -f page.html
    refused "would overwrite the input" report study.html
    refused "would overwrite the input" report own.yaml study.html -o study.html
    refused "would overwrite the input" report own.yaml study.html -o page.html -o ./study.html
fi
"$GOUGH" forces - -o study.csv <study.csv >out 2>err
code=$?
expect_code 2 "the study at standard input as output"
cmp -s study.csv own.yaml || fail "the study at standard input was overwritten"
refused "are the same file" forces own.yaml -o new.csv -o ./new.csv
refused "are the same file" simulate own.yaml -o new.csv -o new.csv
refused "are the same file" plot result.csv -o new.png -o folder/../new.png
refused "are the same file" example own-machine -o new.yaml -o ./new.yaml

# what is no regular file; seconds after which a command that waits for one is ended
patience=$((15 * ${GOUGH_TEST_SLOWNESS:-4}))
mkfifo fifo fifo.csv
waits() { # waits CODE SENTENCE ARGUMENT…
    local wanted=$1 sentence=$2
    shift 2
    timeout -s KILL "$patience" "$GOUGH" "$@" >out 2>err </dev/null
    code=$?
    expect_code "$wanted" "$@"
    grep -qF -- "$sentence" err || fail "$*: does not say '$sentence' but: $(cat err)"
}
for verb in check forces simulate stability; do
    waits 3 "is a named pipe; a regular file is needed" $verb fifo
    waits 3 "is a folder; a regular file is needed" $verb folder
done
waits 3 "is a named pipe" sweep fifo
waits 3 "is a named pipe" tune fifo --deviation 1e-3
waits 3 "is a device" check /dev/zero
waits 3 "is a named pipe" merge fifo -o merged.csv
waits 3 "is a folder" merge folder -o merged.csv
waits 3 "is a device" merge /dev/zero -o merged.csv
waits 3 "is a named pipe" plot fifo -o a.png
waits 3 "is a device" plot /dev/zero -o a.png
waits 3 "is a folder" plot folder -o a.png
waits 3 "is a named pipe" check own.yaml --set 'motion={samples: fifo.csv}'
[[ ! -e merged.csv && ! -e a.png ]] || fail "a refused input leaves an output"
mkfifo part.csv.part
waits 3 "part.csv.part" sweep own.yaml "${swept[@]}" -o part.csv

# standard input in all its names, also from a pipe
for name in - /dev/stdin /dev/fd/0; do
    "$GOUGH" check $name <own.yaml >out 2>err || fail "check $name from a file: $(cat err)"
    # shellcheck disable=SC2002
    cat own.yaml | "$GOUGH" check $name >out 2>err || fail "check $name from a pipe: $(cat err)"
    # shellcheck disable=SC2002
    cat result.csv | "$GOUGH" plot $name -o piped.svg >out 2>err || fail "plot $name from a pipe: $(cat err)"
done

# each verb that reads a study reads it from a pipe too, under each of its names; nothing waits for more than there is
sweep=(--set 'sweep={keys: {load.mass: [1, 2]}}' -o piped.csv)
each() { # each ARGUMENT… with STUDY for the study
    local as arguments
    for as in - /dev/stdin /dev/fd/0; do
        arguments=("${@/STUDY/$as}")
        # shellcheck disable=SC2002
        cat own.yaml | timeout -s KILL "$patience" "$GOUGH" "${arguments[@]}" >out 2>err || fail "${arguments[*]}, from a pipe: $(cat err)"
    done
    timeout -s KILL "$patience" "$GOUGH" "${@/STUDY//dev/fd/9}" >out 2>err </dev/null 9< <(cat own.yaml) || fail "$*, of a substituted process: $(cat err)"
    timeout -s KILL "$patience" "$GOUGH" "${@/STUDY/-}" >out 2>err </dev/null
    code=$?
    expect_code 2 "$*, of nothing"
    grep -q 'standard input:1:1: error: the study is empty' err || fail "$*, of nothing: $(cat err)"
}
each check STUDY
each pose STUDY --lengths "$("$GOUGH" check own.yaml --json | tr -d ' \n' | sed 's/.*"home_length":\[\([^]]*\)\].*/\1/')"
each forces STUDY -o piped.csv
each simulate STUDY -o piped.csv
each stability STUDY --pose surge=0
each sweep STUDY "${sweep[@]}"
each tune STUDY --deviation 0.1 --feedforward program -q
if "$GOUGH" report own.yaml -o page.html 2>err; then
    each report STUDY -o piped.html
    "$GOUGH" report own.yaml - -o piped.html <own.yaml 2>err || fail "report of a file and standard input: $(cat err)"
    # without -o, a page of what has no name is report.html, here
    rm -f report.html
    "$GOUGH" report <(cat own.yaml) >out 2>err && [[ -s report.html ]] || fail "report of a substituted process: $(cat err)"
fi
# standard input twice: the second would find it empty
for twice in "- -" "- /dev/stdin" "/dev/fd/0 -" "/proc/self/fd/0 -"; do
    # shellcheck disable=SC2086
    waits 2 "standard input can be read only once; it is given as" report $twice -o piped.html
    # shellcheck disable=SC2086
    waits 2 "standard input can be read only once; it is given as" plot $twice -o piped.svg
done
# a recording beside a study without a folder is looked for in the working directory
printf 't,heave\n0,0\n1,0.013\n2,0\n3,0.0171\n' >record.csv
for as in - /dev/stdin; do
    "$GOUGH" check $as --set 'motion={samples: record.csv}' --set simulation.duration=1 >out 2>err <own.yaml || fail "check $as with a recording: $(cat err)"
done
"$GOUGH" check <(cat own.yaml) --set 'motion={samples: record.csv}' --set simulation.duration=1 >out 2>err || fail "a substituted process with a recording: $(cat err)"
# shellcheck disable=SC2002
cat record.csv | "$GOUGH" check own.yaml --set 'motion={samples: /dev/stdin}' >out 2>err
grep -qF '`/dev/stdin` is not a regular file; recorded motion is read from regular files only' err || fail "a recording from a pipe: $(cat err)"
# HDF5 and shards need the file itself; as standard input that is a file they have it
"$GOUGH" simulate own.yaml -q -o result.h5 && "$GOUGH" sweep own.yaml "${sweep[@]::2}" --shard 1/1 -o part.shard -q || fail "tables for pipes"
for name in - /dev/stdin; do
    "$GOUGH" plot $name -o piped.svg <result.h5 2>err || fail "plot $name, HDF5: $(cat err)"
    "$GOUGH" merge $name -o merged.csv <part.shard >out 2>err || fail "merge $name: $(cat err)"
done
# shellcheck disable=SC2002
cat result.h5 | "$GOUGH" plot - -o piped.svg 2>err && fail "HDF5 through a pipe"
grep -q 'standard input: is HDF5 through a pipe, which cannot be read; give the file itself' err || fail "HDF5 through a pipe: $(cat err)"
# shellcheck disable=SC2002
cat part.shard | "$GOUGH" merge - -o merged.csv 2>err && fail "a shard through a pipe"
grep -q 'is a pipe; a regular file is needed' err || fail "a shard through a pipe: $(cat err)"
finish
