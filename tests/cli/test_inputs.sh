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

# what is no regular file
mkfifo fifo fifo.csv
waits() { # waits CODE SENTENCE ARGUMENT…
    local wanted=$1 sentence=$2
    shift 2
    timeout -s KILL 60 "$GOUGH" "$@" >out 2>err </dev/null
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
"$GOUGH" check <(cat own.yaml) >out 2>err || fail "check of a substituted process: $(cat err)"
finish
