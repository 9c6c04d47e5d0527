#!/usr/bin/env bash
# Several outputs: each is written, with the bytes that it has alone, and all are checked before anything is run; a full disk or a
# closed standard output spoils none of the others and is not hidden by them.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml
keys=(--set 'sweep.keys={control.stiffness: [500, 600, 700]}')
same() { cmp -s "$1" "$2" || fail "$3"; }

for verb in forces simulate sweep; do
    arguments=(own.yaml)
    [[ $verb == sweep ]] && arguments+=("${keys[@]}")
    "$GOUGH" $verb "${arguments[@]}" -q -o alone.csv || fail "$verb alone: CSV"
    "$GOUGH" $verb "${arguments[@]}" -q -o alone.h5 || fail "$verb alone: HDF5"
    run $verb "${arguments[@]}" -o a.csv -o b.h5 -o c.csv
    expect_code 0 "$verb with three outputs"
    same a.csv alone.csv "$verb: the first output differs"
    same b.h5 alone.h5 "$verb: the second output differs"
    same c.csv alone.csv "$verb: the third output differs"
    for name in a.csv b.h5 c.csv; do grep -q "$name" out || fail "$verb does not say that it wrote $name: $(cat out)"; done
    "$GOUGH" $verb "${arguments[@]}" -q -o - -o d.h5 >standard.csv || fail "$verb with standard output and a file"
    same standard.csv alone.csv "$verb: standard output beside a file differs"
    same d.h5 alone.h5 "$verb: a file beside standard output differs"
    [[ -z $(find . -name '*.part') ]] || fail "$verb leaves $(find . -name '*.part')"

    rm -f good.csv
    run $verb "${arguments[@]}" -o good.csv -o wrong.txt
    expect_code 2 "$verb with a wrong ending"
    [[ ! -e good.csv ]] || fail "$verb runs before it has checked all outputs"
    run $verb "${arguments[@]}" -o good.csv -o nowhere/a.csv
    expect_code 3 "$verb with a folder that is not there"
    [[ ! -e good.csv ]] || fail "$verb runs before it has checked all folders"
    run $verb "${arguments[@]}" -o good.csv -o - --json
    expect_code 2 "$verb with -o - and --json"

    ln -sf /dev/full full.csv
    if [[ -w /dev/full ]]; then
        run $verb "${arguments[@]}" -o full.csv -o good.csv -q
        expect_code 3 "$verb with a full disk first"
        rm -f good.csv
        run $verb "${arguments[@]}" -o good.csv -o full.csv -q
        expect_code 3 "$verb with a full disk last"
        same good.csv alone.csv "$verb: a full disk spoils the output before"
        rm -f good.csv*
        "$GOUGH" $verb "${arguments[@]}" -q -o good.csv -o - >/dev/full 2>err
        code=$?
        expect_code 3 "$verb with a full standard output"
        [[ ! -e good.csv ]] || same good.csv alone.csv "$verb: a full standard output spoils the file"
    fi
    rm -f good.csv*
    "$GOUGH" $verb "${arguments[@]}" -q -o good.csv -o - >&- 2>err
    code=$?
    expect_code 3 "$verb with a closed standard output"
    [[ ! -e good.csv ]] || same good.csv alone.csv "$verb: a closed standard output spoils the file"
    rm -f ./*.part full.csv good.csv
done

"$GOUGH" sweep own.yaml "${keys[@]}" -q --shard 1/2 -o 1.shard
"$GOUGH" sweep own.yaml "${keys[@]}" -q --shard 2/2 -o 2.shard
run merge 2.shard 1.shard -o m.csv -o m.h5
expect_code 0 "merge into two"
same m.csv alone.csv "merge: CSV differs"
same m.h5 alone.h5 "merge: HDF5 differs"
run sweep own.yaml "${keys[@]}" --shard 1/2 -o 1.shard -o 3.shard
expect_code 2 "a shard into two files"
run plot a.csv -o p.png -o p.svg -o p.pdf
expect_code 0 "plot into three"
[[ $(head -c 4 p.png | tail -c 3) == PNG && $(head -c 4 p.pdf) == %PDF ]] || fail "plot: not all formats"
grep -q '</svg>' p.svg || fail "plot: no SVG"
"$GOUGH" example own-machine -o e.yaml -o f.yaml -q
same e.yaml own.yaml "example: the first of two differs"
same f.yaml own.yaml "example: the second of two differs"
finish
