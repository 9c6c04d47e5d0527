#!/usr/bin/env bash
# Bad command lines end with exit code 2 and a sentence on standard error, and nothing on standard output.
# Sanitized: campaign: cli/inputs runs the options of each verb under sanitizers, and so does the corpus of fuzz_options.
source "$(dirname "$0")/support.sh"

refused() { # refused SENTENCE ARGUMENT…
    local sentence=$1
    shift
    run "$@"
    expect_code 2 "$@"
    [[ ! -s $scratch/out ]] || fail "$*: standard output is not empty"
    grep -qF -- "$sentence" "$scratch/err" || fail "$*: does not say '$sentence' but: $(cat "$scratch/err")"
}

study=$scratch/heave.yaml
"$GOUGH" example paper-heave >"$study"

refused "Usage: gough"
refused "did you mean 'simulate'?" simulat "$study"
refused "there is no verb 'zzz'" zzz
refused "STUDY is missing" forces
refused "too many arguments" forces "$study" "$study"
refused "there is no option '--frobnicate'" forces "$study" --frobnicate
refused "did you mean '--json'?" forces "$study" --jsn
refused "there is no option '-z'" forces -qz "$study"
refused "there is no option '-nope'" forces -nope "$study"
refused "'--l' can be any of --lanes, --lengths" sweep --l 3 "$study"
refused "--set takes a value: --set KEY=VALUE" forces "$study" --set
refused "-o takes a value: -o FILE" forces "$study" -o
refused "--json takes no value; got '3'" forces "$study" --json=3
refused "gough forces: error: STUDY is missing" forces
refused "'gough forces --help' says what it takes" forces
refused "there is no option '--lanes'" --lanes 3 forces "$study"
refused "there is no option '--set'" --set load.mass=3 example
refused "did you mean 'check'?" help chec
refused "KEY=VALUE" forces "$study" --set control.stiffness
refused "KEY=VALUE" simulate "$study" --set =3
refused "double or quad" simulate "$study" --precision=triple
refused "--threads takes a whole number of 1 or more; got 'x'" sweep "$study" --threads x
refused "--threads takes a whole number of 1 or more; got '0'" sweep "$study" --threads 0
refused "--threads takes a whole number of 1 or more; got '123456789012'" sweep "$study" --threads 123456789012
printf 't,x\n0,1\n' >"$scratch/table.csv" # beside a file, standard input is another one
refused "standard input:1:1: the file is empty" plot "$scratch/table.csv" - -o "$scratch/a.svg"
for number in 0x10 -0X1P4 nan inf Infinity 1e999 1e 0b1 1_000 + . 1.5.2 ١; do
    refused "--pose: heave must be a number; got '$number" stability "$study" --pose "heave=$number"
    refused "three decimal numbers" stability "$study" --sweep-stiffness "$number:2:3"
    refused "three decimal numbers" stability "$study" --sweep-stiffness "1:2:$number"
    refused "--at takes a number" stability "$study" --at "$number"
    refused "--deviation takes a number" tune "$study" --deviation "$number"
    refused "--stiffness takes two numbers" tune "$study" --deviation 1 --stiffness "1:$number"
    refused "--from takes a number" plot x.csv --from "$number"
    refused "--threads takes a whole number" sweep "$study" --threads "$number"
    refused "" check "$study" --set "control.stiffness=$number"
done
for number in 1,5 ' 1' '1 ' ''; do # YAML takes the blanks away
    refused "--pose" stability "$study" --pose "heave=$number"
    refused "--at takes a number" stability "$study" --at "$number"
    refused "--threads takes a whole number" sweep "$study" --threads "$number"
done
for number in +1 -1 1. .5 1e0 -1.5E-3 00001; do
    run stability "$study" --pose "yaw=$number" --json
    expect_code 0 "--pose yaw=$number"
    run check "$study" --set "initial.yaw=$number"
    expect_code 0 "initial.yaw=$number"
done
refused "both write to standard output" forces "$study" -o - --json
refused ".h5 or .csv" forces "$study" -o "$scratch/result.txt"
refused "did you mean 'paper-heave'?" example paper-heav
refused "did you mean 'paper-heave.yaml'?" example paper-haeve
refused "'flight-simulator'" example flight
refused "did you mean 'control.sampling'?" keys contrl.sampling
refused "did you mean 'simulate'?" sim
refused "a time as in column t" plot "$scratch/x.csv" --from=soon
refused "a time as in column t" plot "$scratch/x.csv" --to=nan
refused "2 labels are given for 1 result" plot "$scratch/x.csv" --label a --label b
refused "did you mean" simulate "$study" --set control.stifness=3
[[ ! -e $scratch/result.txt ]] || fail "a refused name was written"

for arguments in "--help" "-h" "--version" "--usage" "forces --help" "forces -h" "plot --help" "check --version" "help" "help forces"; do
    # shellcheck disable=SC2086
    run $arguments
    expect_code 0 "$arguments"
    [[ -s $scratch/out && ! -s $scratch/err ]] || fail "$arguments: belongs on standard output"
done
same() { # same A B: two command lines, their words separated by blanks, print the same
    # shellcheck disable=SC2086
    [[ "$("$GOUGH" $1 2>&1)" == "$("$GOUGH" $2 2>&1)" ]] || fail "'$1' and '$2' differ"
}
same "help" "--help"
same "help tune" "tune --help"
same "check -h" "check --help"

# options before the verb are those behind it
same "--json --set load.mass=2 check $study" "check $study --json --set load.mass=2"
same "-q check $study" "check $study -q"
same "--dimensionless forces $study -o -" "forces $study -o - --dimensionless"

# the keys: none twice, and these among them
"$GOUGH" keys --names >"$scratch/keys"
[[ $(wc -l <"$scratch/keys") -gt 150 && -z $(sort "$scratch/keys" | uniq -d) ]] || fail "too few keys, or one twice"
refused "" check "$study" --set control.stiffnes=3
for key in control.stiffness load.mass simulation.duration; do grep -qx "$key" "$scratch/keys" || fail "keys lacks $key"; done
[[ $("$GOUGH" keys --names load.m) == load.mass ]] || fail "keys load.m"
"$GOUGH" keys load.mass | tr -s '\n ' ' ' | grep -q "^load.mass: number, mass, > 0; required mass of the load" || fail "keys load.mass: $("$GOUGH" keys load.mass)"

# several studies: all are checked, the greatest status counts
sed 's/mass: 1/mass: -1/' "$study" >"$scratch/bad.yaml"
cmp -s "$study" "$scratch/bad.yaml" && fail "no bad study"
run check "$study" "$scratch/bad.yaml" "$study"
expect_code 2 "check of three studies"
[[ $(grep -c "is a valid study" "$scratch/out") == 2 ]] || fail "two of three studies are right"
grep -q "^$scratch/bad.yaml:[0-9]*:[0-9]*: error: " "$scratch/err" || fail "the wrong study is not named"
run check "$study" "$scratch/bad.yaml" none.yaml --json
expect_code 3 "check of three files, one of which is not there"
if command -v jq >/dev/null; then
    [[ $(jq -c '[.studies[] | [.valid, .title != null]]' "$scratch/out") == '[[true,true],[false,false],[false,false]]' ]] || fail "JSON of three studies"
    "$GOUGH" check "$study" --json | jq 'del(.format)' >"$scratch/one"
    jq '.studies[0] | del(.file, .valid)' "$scratch/out" | cmp -s - "$scratch/one" || fail "the JSON of one of several differs from its own"

    # errors as JSON: a line each, with the place
    said() { "$GOUGH" "$@" 2>&1 >/dev/null | jq -c .; }
    [[ $(said check "$scratch/bad.yaml" --json | jq -r '.error | "\(.file):\(.line):\(.column): error: \(.message)"') == "$("$GOUGH" check "$scratch/bad.yaml" 2>&1 | head -1)" ]] ||
        fail "JSON of an error: $(said check "$scratch/bad.yaml" --json)"
    [[ $(said --json check "$study" --set load.mass=-1 | jq -r .error.setting) == load.mass ]] || fail "JSON of a setting"
    [[ $(said check --bad --json "$study" | jq -r .error.message) == "there is no option '--bad'" ]] || fail "JSON of a wrong option"
    [[ $(said --json zzz | jq -r .error.message) == "there is no verb 'zzz'" ]] || fail "JSON of a wrong verb"
    "$GOUGH" example own-machine >"$scratch/own.yaml"
    [[ $(said check "$scratch/own.yaml" --set gravity=9810 --json | jq -rs 'map(keys[0]) | unique[]') == warning ]] || fail "JSON of warnings"
    cp "$scratch/bad.yaml" "$scratch/"$'\xff.yaml'
    [[ $(said check "$scratch/"$'\xff.yaml' --json | jq -r .error.file) == *'\xff.yaml' ]] || fail "JSON of a name that is not UTF-8"
    printf 'a: [1\n# : error: nothing\n' >"$scratch/two.yaml"
    [[ $(said check "$scratch/two.yaml" --json | jq -s length) == 1 ]] || fail "a line of the study is taken for an error"
fi
finish
