#!/usr/bin/env bash
# gough-mpi: a sweep on the processes of MPI has the bytes of `gough sweep`, whatever their number; killed processes lose nothing that
# was written; processes that would compute other numbers are refused.
# Label: thorough.
# Not sanitized: MPI's own memory would be reported
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
mpi=$BUILD/gough-mpi
[[ -x $mpi ]] || { echo "skipped: built without MPI"; exit 77; }
command -v mpirun >/dev/null || { echo "skipped: no mpirun (Debian package openmpi-bin)"; exit 77; }
# as root, on few processors, in containers; one line of talk less
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_orte_execute_quiet=1
on() { # on N ARGUMENT…: gough-mpi on N processes; exit code to $code
    local n=$1
    shift
    mpirun --oversubscribe -n "$n" "$mpi" "$@" >out 2>err </dev/null
    code=$?
}
same() { cmp -s "$1" "$2" || fail "$3"; }
cat >study.yaml <<'END'
title: A sweep of tests
units: dimensionless
platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 15}, height: 1}
load: {mass: 1, center_of_mass: [0, 0, 0.1], inertia: [0.08, 0.08, 0.15]}
motion: {heave: 0.1*sin(t), pitch: 3*sin(2*t)}
control: {stiffness: 20, damping: 1}
simulation: {duration: 2, output_step: 0.1, method: rk4, step: 0.02}
sweep: {seed: 3, runs: 1000, keys: {load.mass: {uniform: [0.8, 1.2]}, initial.surge: {normal: [0, 0.01]}}}
END
"$GOUGH" sweep study.yaml -q -o one.csv -o one.h5
for n in 1 4; do
    on $n sweep study.yaml -o many.csv -o many.h5
    expect_code 0 "$n processes"
    same one.csv many.csv "$n processes: other bytes as CSV"
    same one.h5 many.h5 "$n processes: other bytes as HDF5"
done
grep -q '^1000 runs' out || fail "the summary is missing: $(cat out err)"
[[ ! -e many.csv.part ]] || fail "a part is left"
on 3 sweep study.yaml -q --threads 1 --lanes 2 --shard 2/3 -o two.shard
expect_code 0 "a shard"
"$GOUGH" sweep study.yaml -q --shard 2/3 -o alone.shard
same alone.shard two.shard "a shard has other bytes"
sizing=(--forces --sizing --set sweep.runs=40 --set simulation.duration=0.5)
on 4 sweep study.yaml -q "${sizing[@]}" -o many.csv
"$GOUGH" sweep study.yaml -q "${sizing[@]}" -o sized.csv
same sized.csv many.csv "forces along the program, run by run: other bytes"
# values that make no study, among processes
on 3 sweep study.yaml --set 'sweep={keys: {load.mass: [1, -1, 2, 0]}}' -o invalid.csv
expect_code 1 "invalid runs"
grep -q '2 of 4 runs are invalid' err || fail "invalid: $(cat err)"

# a writer that cannot start the thread of its own share leaves all runs to the others
cat >no_threads.c <<'END'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*routine)(void *), void *given) {
    const char *rank = getenv("OMPI_COMM_WORLD_RANK");
    Dl_info from;
    int (*real)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    const int own = dladdr((void *)routine, &from) && strstr(from.dli_fname, "gough-mpi");
    if (own && rank && strcmp(rank, "0") == 0) return EAGAIN;
    *(void **)&real = dlsym(RTLD_NEXT, "pthread_create");
    return real(thread, how, routine, given);
}
END
"${CC:-cc}" -shared -fPIC -o no_threads.so no_threads.c -ldl || fail "no_threads.c"
LD_PRELOAD=$PWD/no_threads.so timeout $((60 * ${GOUGH_TEST_SLOWNESS:-1})) mpirun --oversubscribe -n 3 "$mpi" sweep study.yaml -o many.csv >out 2>err </dev/null
code=$?
expect_code 0 "a writer without a thread"
same one.csv many.csv "a writer without a thread: other bytes"

# processes killed, the writer among them, and mpirun: the next command resumes
# so many steps that each look at the growing file comes long before the end, on a fast machine too
long=(--set sweep.runs=10000 --set simulation.duration=4 --set simulation.step=0.002)
"$GOUGH" sweep study.yaml -q "${long[@]}" -o whole.csv
rank_of() { tr '\0' '\n' <"/proc/$1/environ" 2>/dev/null | sed -n 's/^OMPI_COMM_WORLD_RANK=//p'; }
kept=0
for victim in 2 0 mpirun; do
    mpirun --oversubscribe -n 4 "$mpi" sweep study.yaml -q --threads 1 "${long[@]}" -o killed.csv >out 2>err </dev/null &
    pid=$!
    for _ in $(seq $((200 * ${GOUGH_TEST_SLOWNESS:-4}))); do
        sleep 0.02
        [[ -e killed.csv.part && $(stat -c %s killed.csv.part) -gt $((kept + 20000)) ]] && break
        [[ -e killed.csv ]] && break
    done
    if [[ $victim == mpirun ]]; then
        kill -TERM $pid
    else
        for child in $(pgrep -P $pid); do
            [[ $(rank_of "$child") == "$victim" ]] && kill -9 "$child"
        done
    fi
    wait $pid
    code=$?
    ((code != 0)) || fail "with $victim killed the sweep succeeds"
    [[ ! -e killed.csv ]] || fail "with $victim killed there is a result"
    size=$(stat -c %s killed.csv.part 2>/dev/null || echo 0)
    ((size > kept)) || fail "with $victim killed, $size bytes are kept, of $kept before"
    kept=$size
done
on 3 sweep study.yaml "${long[@]}" -o killed.csv
expect_code 0 "the sweep that was killed"
grep -q 'of them finished earlier' out || fail "it does not say that it resumed: $(cat out err)"
same whole.csv killed.csv "killed and resumed: other bytes"

# recorded motion is read by each process: another file there is other numbers
mkdir here there
printf 't,heave\n0,0\n1,0.01\n2,0\n' >here/motion.csv
printf 't,heave\n0,0\n1,0.02\n2,0\n' >there/motion.csv
sed 's/^motion:.*/motion: {samples: motion.csv}/' study.yaml >here/recorded.yaml
mpirun --oversubscribe -n 1 -wdir "$PWD/here" "$mpi" sweep recorded.yaml -q -o recorded.csv : -n 1 -wdir "$PWD/there" "$mpi" sweep >out 2>err </dev/null
code=$?
expect_code 2 "other recorded motion in another process"
grep -q 'process 1 on .*: this study has other numbers here' err || fail "other motion: $(cat err)"
[[ ! -e here/recorded.csv ]] || fail "a refused sweep leaves a result"
cp here/motion.csv there
mpirun --oversubscribe -n 1 -wdir "$PWD/here" "$mpi" sweep recorded.yaml -q -o recorded.csv : -n 1 -wdir "$PWD/there" "$mpi" sweep >out 2>err </dev/null
code=$?
expect_code 0 "the same recorded motion"
rm there/motion.csv
mpirun --oversubscribe -n 1 -wdir "$PWD/here" "$mpi" sweep recorded.yaml -q -o again.csv : -n 1 -wdir "$PWD/there" "$mpi" sweep >out 2>err </dev/null
code=$?
((code != 0)) && grep -q 'process 1 on .*motion.csv' err || fail "missing motion: code $code, $(cat err)"

# what does not fit
on 2 check study.yaml
expect_code 2 "another verb"
grep -q "gough-mpi has the verb 'sweep' only; use 'gough check'" err || fail "another verb: $(cat err)"
on 2 sweep nothing.yaml -o a.csv
expect_code 3 "a study that is not there"
on 2 sweep study.yaml --lanes 3 -o lanes.csv
expect_code 2 "three lanes"
"$mpi" --help >out 2>err || fail "--help: $(cat err)"
grep -q 'mpirun -n 64 gough-mpi sweep STUDY' out || fail "--help: $(cat out)"
finish
