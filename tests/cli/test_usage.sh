#!/usr/bin/env bash
# Bad command lines end with exit code 2 and a sentence on standard error, and nothing on standard output.
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
refused "is 'simulate' meant?" simulat "$study"
refused "there is no verb 'zzz'" zzz
refused "STUDY is missing" forces
refused "too many arguments" forces "$study" "$study"
refused "unrecognized option" forces "$study" --frobnicate
refused "KEY=VALUE" forces "$study" --set control.stiffness
refused "KEY=VALUE" simulate "$study" --set =3
refused "double or quad" simulate "$study" --precision=triple
refused "both write to standard output" forces "$study" -o - --json
refused ".h5 or .csv" forces "$study" -o "$scratch/result.txt"
refused "is 'paper-heave.yaml' meant?" example paper-heav
refused "a time as in the column t" plot "$scratch/x.csv" --from=soon
refused "a time as in the column t" plot "$scratch/x.csv" --to=nan
refused "2 labels for 1 result" plot "$scratch/x.csv" --label a --label b
refused "did you mean" simulate "$study" --set control.stifness=3
[[ ! -e $scratch/result.txt ]] || fail "a refused name was written"

for arguments in "--help" "--version" "--usage" "forces --help" "plot --help" "check --version"; do
    # shellcheck disable=SC2086
    run $arguments
    expect_code 0 "$arguments"
    [[ -s $scratch/out && ! -s $scratch/err ]] || fail "$arguments: belongs on standard output"
done
finish
