#!/usr/bin/env bash
# The sweeps among the examples: feedback beyond G = 0.5 holds the platform, and the disturbance's effect falls with G; the load
# that is not quite known keeps near its program. The guide's lines run.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"

cell() { awk -F, -v name="$2" -v run="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } $1 == run { print $c }' "$1"; }

"$GOUGH" sweep gain-sweep.yaml -q -o gain.csv
claim 'gains: the sweep is done' same $? 0
claim 'gains: a row for each' same "$(wc -l <gain.csv)" 34
claim 'gains: the first is too soft' same "$(cell gain.csv end_cause 1)" singular
claim 'gains: so is G = 0.316' same "$(cell gain.csv end_cause 5)" singular
for n in 9 17 25 33; do claim "gains: run $n holds" same "$(cell gain.csv end_cause $n)" 'done'; done
claim 'gains: G = 1000 is run 33' same "$(cell gain.csv control.stiffness 33)" 1000
# far above what the program asks for, deviation times G is constant: ten times the gain, a tenth of the deviation
claim 'gains: the deviation falls as 1/G' near "$(awk -v a="$(cell gain.csv position_deviation 17)" -v b="$(cell gain.csv position_deviation 25)" 'BEGIN { print a / b }')" 10 1.5
claim 'gains: the deviation of angle is that of the start' near "$(cell gain.csv angle_deviation 30)" 0.000173205 5e-6

"$GOUGH" sweep load-uncertainty.yaml -q -o load.csv
claim 'loads: the sweep is done' same $? 0
claim 'loads: 1000 runs' same "$(wc -l <load.csv)" 1001
claim 'loads: nearly all keep the limits' within "$(grep -c ',done,' load.csv)" 980 1000
claim 'loads: the mean mass is 6 kg' near "$(awk -F, 'NR > 1 { s += $2 } END { print s / (NR - 1) }' load.csv)" 6 0.04
claim 'loads: 5 mm is not exceeded by those' within "$(awk -F, '/,done,/ && $23 > m { m = $23 } END { printf "%.17g", m }' load.csv)" 1e-3 5e-3

# the guide: its study, and the command that runs one of its runs alone
{ grep -v '^sweep:' gain-sweep.yaml | sed '/^  keys:/,$d'; awk '/^```yaml/ { on = 1; next } /^```/ { on = 0 } on' "$SOURCE/docs/guide/sweep.md"; } >guide.yaml
claim 'guide: its sweep is one' "$GOUGH" check guide.yaml -q
claim 'guide: it has 93 runs' same "$("$GOUGH" check guide.yaml | sed -n 's/^  runs *//p')" 93
claim 'guide: run 5' same "$("$GOUGH" sweep guide.yaml --run 5)" '--set control.stiffness=1.2589254117941673 --set load.mass=1'
header=$(head -1 gain.csv)
for name in ${header//,/ }; do
    [[ $name == *.* || $name =~ ^(y|z|roll|pitch|yaw|v.|w[xy])$ ]] || claim "guide: it has the column $name" grep -q "\`$name\`" "$SOURCE/docs/guide/sweep.md"
done
finish
