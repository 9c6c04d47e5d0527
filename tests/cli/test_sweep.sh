#!/usr/bin/env bash
# gough sweep and gough merge: the same bytes whatever the threads, lanes and shards, and however often a sweep was killed; a run
# alone is that run of the sweep; what does not fit is refused.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
cat >study.yaml <<'END'
title: A sweep of tests
units: dimensionless
platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 15}, height: 1}
load: {mass: 1, center_of_mass: [0, 0, 0.1], inertia: [0.08, 0.08, 0.15]}
motion: {heave: 0.1*sin(t), pitch: 3*sin(2*t)}
control: {stiffness: 20, damping: 1}
simulation: {duration: 2, output_step: 0.1, method: rk4, step: 0.02}
sweep:
  seed: 7
  keys:
    control.stiffness: {from: 0.1, to: 1000, steps: 9, scale: log}
    load.mass: [0.8, 1, 1.2]
    load.center_of_mass.1: {uniform: [-0.05, 0.05]}
    initial.yaw: {normal: [0, 2]}
END
refused() { # refused SENTENCE ARGUMENT…
    local sentence=$1
    shift
    run "$@"
    expect_code 2 "$@"
    grep -qF -- "$sentence" err || fail "$*: does not say '$sentence' but: $(cat err)"
}
same() { cmp -s "$1" "$2" || fail "$3"; }

# rows in the order of runs, first and last values exactly
run sweep study.yaml -o whole.csv
expect_code 0 sweep
[[ $(wc -l <whole.csv) == 28 ]] || fail "$(wc -l <whole.csv) lines"
[[ ! -e whole.csv.part ]] || fail "a part is left"
[[ $(column whole.csv run | paste -sd' ') == "$(seq -s' ' 27)" ]] || fail "runs: $(column whole.csv run | paste -sd' ')"
[[ $(column whole.csv load.mass | sort -u | paste -sd' ') == "0.80000000000000004 1 1.2" ]] || fail "masses"
[[ $(column whole.csv control.stiffness | sed -n '1p;7p;13p;19p;27p' | paste -sd' ') == "0.10000000000000001 1 10 100 1000" ]] ||
    fail "decades: $(column whole.csv control.stiffness | sort -u | paste -sd' ')"

# the same bytes for any threads and lanes; -o - and HDF5 hold the same
for threads in 1 2 3; do
    for lanes in 1 2 4 8; do
        "$GOUGH" sweep study.yaml -q --threads $threads --lanes $lanes -o other.csv 2>err || { grep -q "this processor runs" err && continue; }
        same whole.csv other.csv "threads $threads, lanes $lanes: other bytes"
    done
done
"$GOUGH" sweep study.yaml -q -o - | cmp -s - whole.csv || fail "-o - differs"
"$GOUGH" sweep - -q -o - <study.yaml | cmp -s - whole.csv || fail "standard input differs"
"$GOUGH" sweep study.yaml -q --threads 1 -o whole.h5
"$GOUGH" sweep study.yaml -q --threads 3 -o other.h5
same whole.h5 other.h5 "threads change the bytes of HDF5"
if command -v h5dump >/dev/null; then
    for name in control.stiffness pitch energy; do
        h5dump -y -w 0 -m %.17g -d "/$name" whole.h5 | grep -E '^ *-?[0-9n]' | tr -d ' ' | tr ',' '\n' | sed '/^$/d' >h5
        column whole.csv $name | cmp -s - h5 || fail "$name differs between CSV and HDF5"
    done
    h5dump -w 0 -a /end_cause/flag_meanings whole.h5 | grep -q 'done leg_short' || fail "end_cause has no words in HDF5"
fi

# a run alone is that run of the sweep, to the bit
state='x y z roll pitch yaw vx vy vz wx wy wz'
for n in 1 14 27; do
    # shellcheck disable=SC2046
    "$GOUGH" simulate study.yaml -q $("$GOUGH" sweep study.yaml --run $n) -o alone.csv 2>/dev/null
    for name in $state; do
        [[ $(column alone.csv "$name" | tail -1) == "$(column whole.csv "$name" | sed -n "${n}p")" ]] || fail "run $n: $name"
    done
done
[[ $("$GOUGH" sweep study.yaml --run 14) == "--set control.stiffness=10 --set load.mass=1 --set load.center_of_mass.1="* ]] ||
    fail "run 14: $("$GOUGH" sweep study.yaml --run 14)"
# a draw depends on seed, run and key only
a=$("$GOUGH" sweep study.yaml --run 5 | sed 's/.*yaw=//')
[[ $a == "$("$GOUGH" sweep study.yaml --set 'sweep.keys={load.mass: [1, 1, 1, 1, 1], load.center_of_mass.1: {uniform: [0, 1]}, initial.yaw: {normal: [0, 2]}}' --run 5 | sed 's/.*yaw=//')" ]] ||
    fail "draws depend on the other keys"
[[ $a != "$("$GOUGH" sweep study.yaml --set sweep.seed=8 --run 5 | sed 's/.*yaw=//')" ]] || fail "the seed changes nothing"

# shards
for i in 1 2 3 4; do "$GOUGH" sweep study.yaml -q --shard $i/4 -o s$i.shard; done
for ending in csv h5; do
    run merge -o merged.$ending s3.shard s1.shard s4.shard s2.shard
    expect_code 0 merge
    same whole.$ending merged.$ending "merged shards differ in $ending"
done
refused "shard 2 of 4 is missing" merge -o m.csv s1.shard s3.shard s4.shard
refused "are the same shard, 2 of 4" merge -o m.csv s1.shard s2.shard s3.shard s4.shard s2.shard
"$GOUGH" sweep study.yaml -q --set sweep.seed=8 --shard 2/4 -o foreign.shard
refused "are not from the same sweep" merge -o m.csv s1.shard foreign.shard s3.shard s4.shard
head -c 2000 s2.shard >torn.shard
refused "torn.shard" merge -o m.csv s1.shard torn.shard s3.shard s4.shard
refused "is a table in CSV, which \`gough plot\` draws; a shard is needed" merge -o m.csv whole.csv
echo nothing >nothing.shard
refused "is not a finished shard" merge -o m.csv nothing.shard
refused "o FILE is missing" merge s1.shard
[[ ! -e m.csv ]] || fail "a refused merge leaves a file"
"$GOUGH" sweep study.yaml -q --set sweep.keys='{load.mass: [1, 2]}' --shard 1/3 -o e1.shard
"$GOUGH" sweep study.yaml -q --set sweep.keys='{load.mass: [1, 2]}' --shard 2/3 -o e2.shard
"$GOUGH" sweep study.yaml -q --set sweep.keys='{load.mass: [1, 2]}' --shard 3/3 -o e3.shard
"$GOUGH" merge -q -o e.csv e?.shard && [[ $(wc -l <e.csv) == 3 ]] || fail "shards without runs"

# killed at any time, again and again, and gone on
long=(--set 'sweep={seed: 3, runs: 600, keys: {load.mass: {uniform: [0.8, 1.2]}, initial.surge: {normal: [0, 0.01]}}}' --set simulation.duration=10 --set simulation.step=0.01)
"$GOUGH" sweep study.yaml -q "${long[@]}" -o long.csv
[[ $(wc -l <long.csv) == 601 ]] || fail "the long sweep has $(wc -l <long.csv) lines"
mkdir again
for round in 1 2 3 4 5 6 7 8; do
    "$GOUGH" sweep study.yaml -q --threads 2 --lanes $((round % 2 + 1)) "${long[@]}" -o again/long.csv 2>/dev/null &
    pid=$!
    sleep "0.0$((round * 7 % 10))$((round * 3 % 10))"
    kill -9 $pid 2>/dev/null
    wait $pid 2>/dev/null
    [[ -e again/long.csv.part ]] || break
    # a record torn in the middle is dropped
    size=$(stat -c %s again/long.csv.part)
    ((round % 3 == 0 && size > 4000)) && truncate -s $((size - 100)) again/long.csv.part
done
run sweep study.yaml "${long[@]}" -o again/long.csv
expect_code 0 "going on"
same long.csv again/long.csv "killed and gone on: other bytes"
[[ $(ls -A again) == long.csv ]] || fail "left behind: $(ls -A again)"

# stopped by a signal: what is done is kept, and it says how to go on
slow=("${long[@]}" --set sweep.runs=200000 --threads 1)
"$GOUGH" sweep study.yaml -q "${slow[@]}" -o slow.csv 2>err &
pid=$!
for _ in $(seq $((100 * ${GOUGH_TEST_SLOWNESS:-4}))); do
    sleep 0.05
    [[ -e slow.csv.part && $(stat -c %s slow.csv.part) -gt 4000 ]] && break
done
kill -TERM $pid
wait $pid
code=$?
expect_code 143 "a terminated sweep"
grep -q "kept in slow.csv.part; the same command resumes" err || fail "stopped: $(cat err)"
[[ -e slow.csv.part && ! -e slow.csv ]] || fail "a stopped sweep leaves $(ls slow.csv*)"
refused "belongs to a different sweep" sweep study.yaml "${long[@]}" -o slow.csv
exec 9<>slow.csv.part
if command -v flock >/dev/null; then
    flock -n 9
    refused "is in use" sweep study.yaml "${slow[@]}" -o slow.csv
fi
exec 9>&-
echo "something else" >wrong.csv.part
refused "belongs to a different sweep" sweep study.yaml -o wrong.csv

# no room: the part stays for later
(ulimit -f 8; "$GOUGH" sweep study.yaml -q "${long[@]}" -o full.csv 2>err)
code=$?
expect_code 3 "a part larger than allowed"
[[ -e full.csv.part && ! -e full.csv ]] || fail "no room leaves $(ls full.csv*)"
"$GOUGH" sweep study.yaml -q "${long[@]}" -o full.csv
same long.csv full.csv "after no room: other bytes"
run sweep study.yaml -o nowhere/a.csv
expect_code 3 "a folder that does not exist"
if [[ -w /dev/full ]]; then
    "$GOUGH" sweep study.yaml -q -o - >/dev/full 2>err
    code=$?
    expect_code 3 "-o - on a full disk"
fi

# values that make no study are rows too
run sweep study.yaml --set 'sweep.keys={load.mass: [1, -1, 2, 0]}' -o invalid.csv
expect_code 1 "invalid runs"
grep -q '2 of 4 runs are invalid; the first is run 2 (load.mass=-1): `load.mass` must be greater than 0, found -1' err || fail "invalid: $(cat err)"
[[ $(column invalid.csv end_cause | paste -sd' ') == "done invalid done invalid" ]] || fail "causes $(column invalid.csv end_cause | paste -sd' ')"
"$GOUGH" sweep study.yaml -q --set 'sweep.keys={load.mass: [1, 2]}' -o valid.csv
[[ $(sed -n 4p invalid.csv | cut -d, -f2-) == "$(sed -n 3p valid.csv | cut -d, -f2-)" ]] || fail "an invalid run changes the next"
# the program, its home and the options may vary too
run sweep study.yaml --set 'sweep.keys={platform.height: [0.9, 1, 1.1], motion.about.3: [0, 0.2], simulation.step: [0.02, 0.05]}' --set 'motion.about=[0, 0, 0]' -o kinds.csv
expect_code 0 "a sweep of programs"
for n in 1 6 12; do
    # shellcheck disable=SC2046
    "$GOUGH" simulate study.yaml -q --set 'motion.about=[0, 0, 0]' --set "platform.height=$(column kinds.csv platform.height | sed -n ${n}p)" \
        --set "motion.about.3=$(column kinds.csv motion.about.3 | sed -n ${n}p)" --set "simulation.step=$(column kinds.csv simulation.step | sed -n ${n}p)" -o alone.csv
    [[ $(column alone.csv pitch | tail -1) == "$(column kinds.csv pitch | sed -n ${n}p)" ]] || fail "run $n of programs"
done
# adaptive steps, and limits that end a run
run sweep study.yaml --set 'simulation={duration: 2}' --set 'sweep.keys={platform.legs.max_force: [0.1, 10]}' --json -o ends.csv
expect_code 0 "adaptive runs"
[[ $(column ends.csv end_cause | paste -sd' ') == "leg_force done" ]] || fail "ends $(column ends.csv end_cause | paste -sd' ')"
if command -v jq >/dev/null; then
    jq -e '.verb == "sweep" and .runs == 2 and .done == 1 and .ended == {"leg_force": 1} and .position_deviation.least.run == 2 and .rate > 0' out >/dev/null ||
        fail "JSON: $(cat out)"
fi
# dimensionless: in units of the study as it stands
si=(--set units=si --set platform.base.radius=2 --set load.mass=3 --set 'sweep.keys={control.stiffness: [20, 30]}')
"$GOUGH" sweep study.yaml -q "${si[@]}" --dimensionless -o d.csv
"$GOUGH" simulate study.yaml -q "${si[@]}" --dimensionless --set control.stiffness=30 -o alone.csv
for name in $state; do
    [[ $(column alone.csv "$name" | tail -1) == "$(column d.csv "$name" | tail -1)" ]] || fail "dimensionless $name"
done

# figures of one key, of two over a grid, and of any
for keys in 'control.stiffness: [0.1, 1, 10]' 'control.stiffness: [0.1, 1, 10], load.mass: {from: 1, to: 2, steps: 3}' 'load.mass: [1, 2], gravity: [1, 2], control.damping: [1, 2]'; do
    "$GOUGH" sweep study.yaml -q --set "sweep.keys={$keys}" -o figure.csv
    "$GOUGH" sweep study.yaml -q --set "sweep.keys={$keys}" -o figure.h5
    for ending in csv h5; do
        run plot figure.$ending -o figure.svg
        expect_code 0 "plot of $keys in $ending"
        grep -q '<svg' figure.svg || fail "no figure of $keys"
        run plot figure.$ending --columns force -o figure.pdf
        expect_code 0 "plot of forces"
    done
done
refused "did you mean" plot figure.csv --figure swep
refused "has no column nonsense" plot figure.csv --columns nonsense

# the other verbs pass over the section, check says what it asks for
run simulate study.yaml -q
expect_code 0 "simulate of a study with a sweep"
run check study.yaml
grep -q '^  runs  *27$' out || fail "check does not count the runs: $(cat out)"
refused "did you mean" simulate study.yaml --set 'sweep.keys={control.stifness: [1]}'
refused "no section \`sweep\`" sweep study.yaml --set sweep=
refused "there is no run 28" sweep study.yaml --run 28
refused "a shard needs an output" sweep study.yaml --shard 1/2 -o a.csv
refused "--shard takes i/n" sweep study.yaml --shard 2 -o a.shard
refused "takes an i from 1 to n" sweep study.yaml --shard 3/2 -o a.shard
refused "whole number of 1 or more" sweep study.yaml --threads zero
refused "lanes" sweep study.yaml --lanes 3 -o lanes.csv
[[ ! -e lanes.csv.part ]] || fail "a refused sweep leaves a part"
finish
