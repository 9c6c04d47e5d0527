# Sourced by the tests of the command: run it, keep what it said, count what is wrong.
set -uo pipefail
: "${GOUGH:?the command}"
scratch=$(mktemp -d)
out=$scratch/out err=$scratch/err
trap 'rm -rf "$scratch"' EXIT
failures=0

fail() {
    echo "$(basename "$0"): $*"
    failures=$((failures + 1))
}

# standard output to $scratch/out, standard error to $scratch/err, exit code to $code
run() {
    "$GOUGH" "$@" >"$out" 2>"$err" </dev/null
    code=$?
}

expect_code() {
    local expected=$1
    shift
    ((code == expected)) || fail "$*: exit code $code instead of $expected; $(head -3 "$err")"
}

# whether the command was built with the page
has_page() { ! grep -q 'without the page' <("$GOUGH" report nothing.yaml -o nothing.html 2>&1); }

# a column of a CSV file by name
column() { awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } { print $c }' "$1"; }

finish() {
    ((failures == 0)) || exit 1
    exit 0
}
