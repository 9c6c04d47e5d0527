#!/usr/bin/env bash
# A record of two million rows of seven numbers is opened and run in memory of at most three times these numbers, beside what a
# short record takes.
# Label: campaign
# Not sanitized: sanitizers have memory of their own
source "$(dirname "$0")/support.sh"
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml
record() { # record ROWS: the first seconds of the same motion
    awk -v rows="$1" 'BEGIN { print "t,surge,sway,heave,roll,pitch,yaw"
        for (i = 0; i < rows; i++) { s = sin(i * 0.0005); printf "%.3f,%.5f,%.5f,%.5f,%.3f,%.3f,%.3f\n", i * 0.001, 0.02 * s, 0.01 * s, 0.02 * (1 - cos(i * 0.001)), s, 2 * s, 3 * s } }'
}
record 3000 >short.csv
record 2000000 >long.csv
# the greatest memory of a run, in bytes
memory() {
    python3 -c 'import resource, subprocess, sys
code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024 if code == 0 else -1)' \
        "$GOUGH" forces own.yaml --set simulation.duration=2 --set platform.legs= --set "motion={samples: $1}"
}
for how in '' 'smooth: rounding' 'cutoff: 5'; do
    short=$(memory "{file: short.csv, columns: {surge: 2, sway: 3, heave: 4, roll: 5, pitch: 6, yaw: 7}${how:+, $how}}")
    long=$(memory "{file: long.csv, columns: {surge: 2, sway: 3, heave: 4, roll: 5, pitch: 6, yaw: 7}${how:+, $how}}")
    ((short > 0 && long > 0 && long - short <= 3 * 2000000 * 7 * 8)) || fail "${how:-as recorded}: $long bytes, $short with a short record"
done
finish
