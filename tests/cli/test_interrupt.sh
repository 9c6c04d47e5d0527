#!/usr/bin/env bash
# Ctrl-C, SIGTERM and SIGHUP: each long verb says what is kept, ends by the signal and leaves nothing behind, neither beside its
# outputs nor in the folder for temporary files; SIGKILL leaves nothing either.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
set -m # else a shell starts its background jobs with SIGINT ignored
mkdir temporary out
export TMPDIR=$scratch/temporary
"$GOUGH" example own-machine >own.yaml
long=(--set simulation.duration=100000 --set simulation.output_step=0.05 --set control.stiffness=5000)

# Whether the command has its handlers for the three signals: sanitizers catch others before.
is_watching() {
    local mask
    [[ $(readlink "/proc/$1/exe") == *gough* ]] || return 1
    mask=$(sed -n 's/^SigCgt:\t//p' "/proc/$1/status" 2>/dev/null)
    (((0x${mask:-0} & 0x4003) == 0x4003))
}

# interrupted SIGNAL SENTENCE FILE ARGUMENT…: the signal comes when the file named is there ('' for at once)
interrupted() {
    local signal=$1 sentence=$2 sign=$3
    shift 3
    "$GOUGH" "$@" >said 2>err </dev/null &
    local pid=$!
    for _ in $(seq 600); do
        # shellcheck disable=SC2086
        if [[ -z $sign ]]; then
            is_watching "$pid" && break
        else
            compgen -G "$sign" >/dev/null && break
        fi
        kill -0 $pid 2>/dev/null || break
        sleep 0.05
    done
    sleep 0.1
    kill -"$signal" $pid 2>/dev/null || fail "$*: ended before the signal: $(cat err)"
    wait $pid
    code=$?
    expect_code $((128 + $(kill -l "$signal"))) "$* interrupted by $signal"
    [[ $signal == KILL ]] || grep -qF -- "$sentence" err || fail "$* interrupted by $signal does not say '$sentence' but: $(cat err)"
    [[ $(wc -l <err) -le 1 ]] || fail "$* says more than one line: $(cat err)"
    for _ in $(seq 100); do # what removes the folder is not waited for
        [[ -z $(ls -A temporary) ]] && break
        sleep 0.1
    done
    [[ -z $(ls -A temporary) ]] || fail "$* interrupted by $signal leaves $(ls -A temporary)"
    [[ -z $(ls -A out) ]] || fail "$* interrupted by $signal leaves $(ls -A out)"
}
for signal in INT TERM HUP; do
    interrupted $signal "gough simulate: stopped before the end; nothing was written" '' simulate own.yaml "${long[@]}" -o out/a.csv -o out/b.h5
    interrupted $signal "gough forces: stopped before the end; nothing was written" '' forces own.yaml "${long[@]}" -o out/a.csv
    interrupted $signal "gough stability: stopped before the end; nothing was written" '' stability own.yaml --set 'motion={heave: 0.02*sin(9*t)}' \
        --sweep-stiffness 100:50000:2001 --sweep-frequency 0.5:2:801 -o out/map.csv -o out/map.svg
    has_page && interrupted $signal "gough report: stopped before the end; nothing was written" '' report own.yaml "${long[@]}" -o out/a.html
done

# gnuplot that takes its time: the first of its name in PATH
mkdir bin
printf '#!/bin/sh\ntouch figure\nexec sleep 100\n' >bin/gnuplot
chmod +x bin/gnuplot
PATH=$scratch/bin:$PATH
"$GOUGH" forces own.yaml -q -o result.csv
for signal in INT TERM HUP KILL; do
    interrupted $signal "gough plot: stopped before the end; nothing was written" 'temporary/gough-figure-*/figure' plot result.csv -o out/a.svg
done

# Ctrl-C as a terminal sends it, where there is one
if command -v script >/dev/null && script -qec true /dev/null </dev/null >/dev/null 2>&1; then
    # the terminal stays open until the command has ended
    (sleep 3; printf '\003'; for _ in $(seq 200); do [[ -e ended ]] && break; sleep 0.1; done) |
        { TERM=dumb timeout 60 script -qec "'$GOUGH' simulate own.yaml ${long[*]} -o out/a.csv" /dev/null >said 2>&1; touch ended; }
    grep -q "gough simulate: stopped before the end; nothing was written" said || fail "Ctrl-C is answered by $(cat said)"
    [[ -z $(ls -A out) ]] || fail "Ctrl-C leaves $(ls -A out)"
fi

# writing a large table: its file has no name until it is complete
"$GOUGH" forces own.yaml -q --set simulation.duration=1000 --set simulation.output_step=0.01 -o whole.csv
for delay in 0.1 0.2 0.4 0.8; do
    "$GOUGH" forces own.yaml -q --set simulation.duration=1000 --set simulation.output_step=0.01 -o out/a.csv 2>err &
    pid=$!
    sleep $delay
    kill -KILL $pid 2>/dev/null
    wait $pid 2>/dev/null
    left=$(ls -A out)
    [[ -z $left || $left == a.csv ]] || fail "a kill after $delay s leaves $left"
    [[ -z $left ]] || cmp -s out/a.csv whole.csv || fail "a kill after $delay s leaves a part of the table"
    rm -f out/*
done
finish
