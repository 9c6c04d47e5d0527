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
refused "unrecognized option" forces "$study" --frobnicate
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
refused "did you mean 'paper-heave.yaml'?" example paper-heav
refused "a time as in column t" plot "$scratch/x.csv" --from=soon
refused "a time as in column t" plot "$scratch/x.csv" --to=nan
refused "2 labels are given for 1 result" plot "$scratch/x.csv" --label a --label b
refused "did you mean" simulate "$study" --set control.stifness=3
[[ ! -e $scratch/result.txt ]] || fail "a refused name was written"

for arguments in "--help" "--version" "--usage" "forces --help" "plot --help" "check --version"; do
    # shellcheck disable=SC2086
    run $arguments
    expect_code 0 "$arguments"
    [[ -s $scratch/out && ! -s $scratch/err ]] || fail "$arguments: belongs on standard output"
done
finish
