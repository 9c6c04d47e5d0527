#!/usr/bin/env bash
# A file of another kind than a verb reads: the message tells what it is and what would be right, and nothing is written.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
"$GOUGH" example own-machine >study.yaml
"$GOUGH" simulate study.yaml -q -o run.h5 -o run.csv
"$GOUGH" sweep study.yaml -q --set simulation.duration=1 --set 'sweep={keys: {load.mass: [5, 6]}}' -o sweep.csv
"$GOUGH" sweep study.yaml -q --set simulation.duration=1 --set 'sweep={keys: {load.mass: [5, 6]}}' --shard 1/2 -o a.shard
"$GOUGH" simulate study.yaml --json >run.json
printf '<!doctype html>\n<html></html>\n' >page.html
printf '\211PNG\r\n\032\n and so on' >picture.png
hdf5='a table of results in HDF5, which `gough plot` draws' csv='a table in CSV, which `gough plot` draws'
shard='a shard of a sweep, which `gough merge` joins with the others' study='a study, from which `gough simulate` computes results'
page='a page, which a web browser shows' picture='a picture' json='JSON that gough has printed'

wrong() { # wrong FILE KIND RIGHT VERB ARGUMENT…
    local file=$1 kind=$2 right=$3
    shift 3
    run "$@"
    expect_code 2 "$@"
    grep -qF "$file" err || fail "$*: the message does not name $file: $(cat err)"
    grep -qF "is $kind; $right" err || fail "$*: does not say that it is $kind; $right, but: $(head -3 err)"
    [[ $(wc -l <err) -le 4 ]] || fail "$*: $(wc -l <err) lines of messages"
    [[ ! -e new.h5 && ! -e new.html && ! -e new.png ]] || fail "$*: an output is left"
}
needs_study='a study is YAML text, such as `gough example` prints'
declare -A kinds=([run.h5]=$hdf5 [run.csv]=$csv [sweep.csv]=$csv [a.shard]=$shard [run.json]=$json [page.html]=$page [picture.png]=$picture)
for file in "${!kinds[@]}"; do
    # check describes a file whose name ends in .csv as a record of motion
    [[ $file == *.csv ]] && verb=forces || verb=check
    wrong $file "${kinds[$file]}" "$needs_study" $verb $file
done
for verb in forces simulate sweep; do wrong run.h5 "$hdf5" "$needs_study" $verb run.h5 -o new.h5; done
wrong run.csv "$csv" "$needs_study" stability run.csv
wrong run.csv "$csv" "$needs_study" tune run.csv --deviation 1e-3
wrong run.h5 "$hdf5" "$needs_study" pose run.h5 --lengths 1,1,1,1,1,1
has_page && wrong run.h5 "$hdf5" "$needs_study" report study.yaml run.h5 -o new.html
needs_table='a table of results is needed, as -o of `gough simulate` and other verbs writes'
for file in study.yaml:"$study" a.shard:"$shard" run.json:"$json" page.html:"$page" picture.png:"$picture"; do
    wrong "${file%%:*}" "${file#*:}" "$needs_table" plot "${file%%:*}" -o new.png
done
wrong study.yaml "$study" "$needs_table" plot run.h5 study.yaml -o new.png
needs_shard='a shard is needed, as `gough sweep --shard` writes'
for file in study.yaml:"$study" run.h5:"$hdf5" sweep.csv:"$csv"; do wrong "${file%%:*}" "${file#*:}" "$needs_shard" merge "${file%%:*}" -o new.h5; done
needs_record='recorded motion is a table in CSV with a column `t`'
wrong run.h5 "$hdf5" "$needs_record" check study.yaml --set 'motion={samples: run.h5}'
wrong study.yaml "$study" "$needs_record" check study.yaml --set 'motion={samples: study.yaml}'
# a study that begins with many remarks, and one with its first key late, are studies
{ for i in {1..40}; do echo "# remark number $i of this study"; done; cat study.yaml; } >late.yaml
run check late.yaml -q
expect_code 0 "a study with remarks before it"
run check - -q <run.h5
expect_code 2 "HDF5 at standard input"
finish
