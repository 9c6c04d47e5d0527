#!/usr/bin/env bash
# The guide to JSON and the JSON itself: every key that a verb prints is documented, every documented key is printed, and so is every
# word for the end of a run.
# Not sanitized: it looks at words, and other tests run the same verbs under sanitizers.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
: "${SOURCE:?the source folder}"
guide=$SOURCE/docs/guide/json.md
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cp "$SOURCE"/examples/*.yaml "$SOURCE"/examples/*.awk "$scratch"
cd "$scratch" || exit 1
awk -f ship-deck.awk >ship-deck.csv

# the keys of a section: the first column of its table
documented() { awk -v heading="$1" '/^#/ { inside = $0 == heading } inside' "$guide" | sed -n 's/^| `\([^`]*\)` |.*/\1/p' | sort; }
# the keys of the JSON on standard input, elements of lists as []
keys='paths | select(.[-1] | type == "string") | map(if type == "number" then "[]" else "." + . end) | join("") | ltrimstr(".")'
# sections whose objects have keys of the user's making: what they hold is not listed
open='^(ended|set|keys|bounds|objective\.(minimize|aims_before|aims_after))\..*'

# hold SECTION FILE…: the keys of all files together are those of the section
hold() {
    local section=$1
    shift
    cat "$@" | jq 'if type == "object" then del(.format) else . end' | jq -r "$keys" | sed -E "s/^(last|multiplier_modes\[\])\..*//; s/^(pose\.resolution)\.(per_length|count|length_error|joints)\./\1.*./" | grep -vE "$open|^$" | sort -u >printed
    documented "$section" | sort -u >listed
    [[ -s printed && -s listed ]] || fail "$section: no keys"
    local key
    while IFS= read -r key; do fail "$section: \`$key\` is printed but not documented"; done < <(comm -23 printed listed)
    while IFS= read -r key; do fail "$section: \`$key\` is documented but not printed"; done < <(comm -13 printed listed)
    [[ $(documented "$section" | uniq -d) == "" ]] || fail "$section: a key is documented twice"
}

json() {
    local out=$1
    shift
    "$GOUGH" "$@" --json >"$out" 2>"$out.err" </dev/null
    local code=$?
    ((code <= 1)) || fail "$*: exit code $code; $(head -3 "$out.err")"
    jq -e 'type == "array" or (keys_unsorted[0] == "format" and .format == 1)' "$out" >/dev/null || fail "$*: no JSON of format 1"
}

json example.json example
hold '## example' example.json

json keys.json keys
hold '## keys' keys.json

json check-1.json check own-machine.yaml
json check-2.json check gain-sweep.yaml
json check-3.json check flight-simulator.yaml
printf 't,yaw\n0,0\n1,0\n2,359\n3,0\n' >jump.csv
json check-4.json check own-machine.yaml --set 'motion={samples: jump.csv}' --set simulation.duration=3
json check-5.json check own-machine.yaml --pose yaw=5 --set 'external=[{force: [0, 0, 30]}]'
json check-6.json check own-machine.yaml --set 'control.sampling={period: 0.001}' --set control.damping=1000
json check-8.json check own-machine.yaml --set 'motion={moves: [{heave: 0.02, yaw: 3, speed: 0.1}]}'
json check-7.json check jump.csv
hold '## check' check-6.json check-7.json check-1.json check-2.json check-3.json check-4.json check-5.json

lengths=0.33,0.32,0.33,0.32,0.33,0.32
json pose-1.json pose own-machine.yaml --lengths "$lengths"
json pose-2.json pose own-machine.yaml --lengths "$lengths" --all
printf 't,l1,l2,l3,l4,l5,l6\n0,%s\n1,%s\n' "$lengths" 0.4,0.2,0.4,0.2,0.4,0.2 >lengths.csv
json pose-3.json pose own-machine.yaml --samples lengths.csv -o poses.csv
hold '## pose' pose-1.json pose-2.json pose-3.json

json space-1.json workspace own-machine.yaml
json space-2.json workspace own-machine.yaml --set 'workspace.box={heave: 0.01}' --set 'workspace.velocity=[0, 0, 0.1]'
hold '## workspace' space-1.json space-2.json

few=(--set 'workspace={box: {heave: 0.01}}' --set 'design={vary: {platform.height: [0.25, 0.3]}, minimize: stroke, evaluations: 20}')
json design-1.json design own-machine.yaml "${few[@]}"
json design-2.json design own-machine.yaml "${few[@]}" --set workspace.box.heave=0.5
hold '## design' design-1.json design-2.json

json run-1.json forces own-machine.yaml
json run-2.json forces own-machine.yaml --set platform.legs.max_speed=0.05
json run-3.json simulate own-machine.yaml --set platform.legs.max_speed=0.05
json run-4.json simulate paper-feedback.yaml --dimensionless
json run-5.json simulate own-machine.yaml --set control.damping=20000 --set simulation.duration=1
hold '## forces and simulate' run-*.json

json sweep-1.json sweep gain-sweep.yaml --set 'sweep.keys.control.stiffness=[1, 2]'
"$GOUGH" sweep gain-sweep.yaml --set 'sweep.keys.control.stiffness=[1, 2]' --shard 1/1 -o a.shard -q
json sweep-2.json merge a.shard -o a.csv
json sweep-3.json sweep gain-sweep.yaml --forces --sizing --set 'sweep.keys.control.stiffness=[1, 2]'
hold '## sweep and merge' sweep-1.json sweep-2.json sweep-3.json
json one.json sweep load-uncertainty.yaml --run 7
hold '### One run' one.json
jq -e '.set | has("load.mass")' one.json >/dev/null || fail "a run sets its keys"

json loop-1.json stability own-machine.yaml
json loop-2.json stability paper-heave.yaml --matrix
json loop-3.json stability own-machine.yaml --set 'motion={moves: [{start: 1, duration: 2, heave: 0.02}]}'
json loop-4.json stability own-machine.yaml --set 'control.sampling={period: 0.001}' --set control.damping=1000
hold '## stability' loop-*.json
# the pose at the end of a program has the keys from `pose` to `decays`, and `stable`
jq -r '.last | keys[]' loop-3.json | sort >last
documented '## stability' | grep -v '[.]' | awk 'BEGIN { split("pose eigenvalues modes thresholds growth_rate trace trace_theorem asymmetry drifts decays stable", a, " "); for (i in a) of[a[i]] = 1 } of[$0]' | sort >listed
cmp -s last listed || fail "keys of \`last\`: $(diff last listed | tr '\n' ' ')"

json map.json stability paper-heave.yaml --sweep-stiffness 0.1:2:5 --sweep-amplitude 0:1:3
hold '### A map' map.json

json tune-1.json tune paper-perturbed.yaml --deviation 1e-3 --feedforward program
json tune-2.json tune own-machine.yaml --deviation 1e-4 --feedforward none --set 'platform.legs.length=[0.1, 0.6]'
json tune-3.json tune paper-perturbed.yaml --deviation 1e-3 --damping-ratio 0.2 --stiffness 1:10 --feedforward program --set control.sampling.period=0.05 --set simulation.duration=3
hold '## tune' tune-1.json tune-2.json tune-3.json
json gains-1.json tune own-machine.yaml --poles 2,0.7 --pose yaw=5
json gains-2.json tune paper-heave.yaml --lqr 1,1 --set control.sampling.period=0.05
hold '### Gains' gains-1.json gains-2.json

# the words for the end of a run are those of the library
sed -n '/gough_cause_name/,/^}/s/.*return "\([a-z_]*\)";.*/\1/p' "$SOURCE/src/base/status.c" | grep -v unknown | sort >causes
awk '/^\| word/ { inside = 1; next } /^## / { inside = 0 } inside' "$guide" | sed -n 's/^| \(`[^|]*\) |.*/\1/p' | grep -o '`[a-z_]*`' | tr -d '`' | sort >listed
[[ $(wc -l <causes) -ge 11 ]] || fail "causes: $(tr '\n' ' ' <causes)"
cmp -s causes listed || fail "words for the end of a run: $(diff causes listed | tr '\n' ' ')"
finish
