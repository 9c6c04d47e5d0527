# shellcheck shell=bash
# Sourced: try_many_runs RUNS sweeps so many runs of one step and merges them, and looks at memory and processor time. Sweeps of a tenth
# of the runs are the measure of how both grow. The pictures are of shares of the runs and, with a key, of a line.
source "$(dirname "${BASH_SOURCE[0]}")/support.sh"
cd "$scratch" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3, which measures memory"; exit 77; }
cat >study.yaml <<'END2'
title: Many runs of one step
units: dimensionless
platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 15}, height: 1}
load: {mass: 1, center_of_mass: [0, 0, 0.1], inertia: [0.08, 0.08, 0.15]}
control: {stiffness: 20, damping: 1}
simulation: {duration: 0.02, output_step: 0.02, method: rk4, step: 0.02}
sweep: {seed: 3, runs: 10, keys: {load.mass: {uniform: [0.8, 1.2]}, initial.surge: {normal: [0, 0.01]}}}
END2
# measured NAME ARGUMENT…: runs the command; peak of its memory in MB and its processor time in ms go to $memory and $time
measured() {
    local name=$1
    shift
    read -r code memory time < <(python3 - "$GOUGH" "$@" <<'END2'
import resource, subprocess, sys
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(done.returncode, used.ru_maxrss // 1000, round(1000 * (used.ru_utime + used.ru_stime)))
END2
    )
    expect_code 0 "$name"
    echo "$name: $memory MB, $time ms of processor time"
}
try_many_runs() {
    local runs=$1 tenth=$(($1 / 10)) before first
    declare -A first
    for n in $tenth $runs; do
        measured "sweep of $n runs" sweep study.yaml -q --set sweep.runs="$n" --shard 1/1 -o all.shard
        check_growth sweep "$n"
        measured "merge of $n runs into HDF5" merge -q -o all.h5 all.shard
        check_growth hdf5 "$n"
        measured "picture of $n runs in HDF5" plot -q -o picture.svg all.h5
        check_growth picture "$n"
        measured "merge of $n runs into CSV" merge -q -o all.csv all.shard
        check_growth csv "$n"
        measured "picture of $n runs in CSV" plot -q -o csv.svg all.csv
        check_growth csv_picture "$n"
    done
    [[ $(wc -l <all.csv) == $((runs + 1)) ]] || fail "the table has $(wc -l <all.csv) lines"
}
# 200 MB whatever the runs, and no more memory for ten times the runs (2 MB are allowed for chance); processor time in proportion, with
# as much again for what other work does to caches; time in proportion to the square would be ten times that in proportion
check_growth() {
    ((memory <= 200)) || fail "$1 of $2 runs takes $memory MB"
    if [[ -v first[$1] ]]; then
        before=${first[$1]}
        ((memory <= ${before% *} + 2)) || fail "$1: $memory MB for $2 runs, ${before% *} MB for a tenth of them"
        ((time <= 20 * ${before#* } + 1000)) || fail "$1: $time ms for $2 runs, ${before#* } ms for a tenth of them"
    else
        first[$1]="$memory $time"
    fi
}
