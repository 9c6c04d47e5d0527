# Sourced by the tests test_machines*.sh: machines that nobody thought of, and what is asked of each sentence about them.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example own-machine >own.yaml
cat >frame.yaml <<'END'
units: si
platform:
  base:
    joints: [[0.5, 0, 0], [-0.25, 0.433, 0], [-0.25, -0.433, 0], [1, 0, 0.5], [-0.5, 0.866, 0.5], [-0.5, -0.866, 0.5]]
  top:
    joints: [[0.5, 0, 0], [-0.25, 0.433, 0], [-0.25, -0.433, 0], [0.25, 0.433, 0], [-0.5, 0, 0], [0.25, -0.433, 0]]
  height: 0.5
load: {mass: 10, center_of_mass: [0, 0, 0], inertia: [1, 1, 1]}
motion: {heave: 0.01*sin(6*t)}
control: {stiffness: 0}
simulation: {duration: 2, output_step: 0.02}
END

says() { # says TEXT: on standard output or standard error, line breaks aside
    tr -s ' \n' ' ' <out >flat
    tr -s ' \n' ' ' <err >>flat
    grep -qF -- "$1" flat || fail "$what: does not say '$1' but: $(cat out err)"
}
never() { # never PATTERN
    tr -s ' \n' ' ' <out >flat
    tr -s ' \n' ' ' <err >>flat
    grep -qE -- "$1" flat && fail "$what: says '$(grep -oE -- ".{0,60}$1.{0,40}" flat | head -1)'"
    return 0
}
narrow() { # lines of at most 100 columns, each number finite
    LC_ALL=C sed 's/[\x80-\xbf]//g' out | awk -v what="$what" 'length($0) > 100 { print what ": " length($0) " columns: " $0; bad = 1 } END { exit bad }' ||
        fail "$what: lines too long"
    never '(^|[^a-z])(inf|nan)([^a-z]|$)'
}
near() { # near WHAT VALUE EXPECTED RELATIVE
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; m = b < 0 ? -b : b
        exit !(a != "" && a !~ /nan|null|inf/ && d <= t * m && -d <= t * m) }' || fail "$1: $2 instead of $3 within a part of $4"
}
stability() { # stability DESCRIPTION OPTION…
    what="stability, $1"
    shift
    "$GOUGH" stability "$@" --json >data.json || fail "$what: JSON"
    run stability "$@"
    expect_code 0 "$what"
    narrow
}
json() { jq -e "$1" data.json >/dev/null || fail "$what: not $1: $(jq -c '{stable, drifts, decays, growth_rate}' data.json)"; }
simulate() { # simulate DESCRIPTION OPTION…
    what="simulate, $1"
    shift
    run simulate "$@"
    narrow
}

weightless=(own.yaml --set gravity=0)
hanging=(own.yaml --set platform.height=-0.28 --set 'load.center_of_mass=[0, 0, -0.05]')
