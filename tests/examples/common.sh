# shellcheck shell=bash
# What the tests of the examples share. Each runs in a folder of its own with a copy of the examples; a failed claim is said
# and counted, and `finish` makes it the exit status.
#
#   claim 'sentence' COMMAND…      the command must succeed
#   value FILE NAME T              the column NAME of a table in the row nearest to t = T
#   near A B TOLERANCE             |A − B| <= TOLERANCE; what is not a number fails
#   within A LEAST GREATEST        LEAST <= A <= GREATEST; likewise
#   extreme FILE NAME max|min|abs [T]   over the rows up to t = T
#   ended FILE.json                how a run ended, a word such as done or singular
#   try_guide FILE.md LEAST MOST   the guide has so many commands, and each succeeds; what it says goes to said-0.txt, said-1.txt, …

set -uo pipefail
export LC_ALL=C
: "${GOUGH:?the command to test}" "${SOURCE:?the source folder}" "${BUILD:?the build folder}"

work=$(mktemp -d "$BUILD/examples.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
cp "$SOURCE"/examples/*.yaml "$SOURCE"/examples/*.awk "$work"
cd "$work" || exit 1

failures=0
claims=0
claim() {
    local sentence=$1
    shift
    claims=$((claims + 1))
    if "$@"; then
        echo "ok    $sentence"
    else
        failures=$((failures + 1))
        echo "FAIL  $sentence"
        echo "      in: $*"
    fi
}
finish() {
    ((claims > 0 && failures == 0)) || {
        echo "$failures of $claims claims failed"
        exit 1
    }
}

number='^[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?$'
near() {
    awk -v a="$1" -v b="$2" -v tolerance="$3" -v number="$number" 'BEGIN {
        ok = a ~ number && b ~ number && tolerance ~ number && a - b <= tolerance + 0 && b - a <= tolerance + 0
        if (!ok) printf "      %s and %s differ by more than %s\n", a, b, tolerance
        exit !ok
    }'
}
within() {
    awk -v a="$1" -v least="$2" -v greatest="$3" -v number="$number" 'BEGIN {
        ok = a ~ number && least ~ number && greatest ~ number && a + 0 >= least + 0 && a + 0 <= greatest + 0
        if (!ok) printf "      %s is not within %s … %s\n", a, least, greatest
        exit !ok
    }'
}
same() {
    [[ $1 == "$2" ]] || {
        echo "      '$1' is not '$2'"
        return 1
    }
}

value() {
    awk -F, -v name="$2" -v t="$3" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next }
        c { d = $1 - t; if (d < 0) d = -d; if (NR == 2 || d < best) { best = d; found = $c } }
        END { print ((c && NR > 1 && best < 1e-6) ? found : "no such row or column") }' "$1"
}
extreme() {
    awk -F, -v name="$2" -v kind="$3" -v until="${4:-1e300}" -v number="$number" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next }
        !c { exit }
        $1 > until + 1e-9 { next }
        $c !~ number { bad = 1; exit }
        { x = (kind == "abs" && $c < 0) ? -$c : $c + 0 }
        !rows || (kind == "min" ? x < best : x > best) { best = x }
        { rows++ }
        END { if (bad || !rows) print "no such number"; else printf "%.17g\n", best }' "$1"
}
ended() { awk -F'"' '/"status"/ { print $4; exit }' "$1"; }
end_time() { awk -F'[:,]' '/"time"/ { gsub(/ /, "", $2); print $2; exit }' "$1"; }

# gough VERB STUDY OUT [MORE…]: OUT.csv, OUT.json and the exit status in $status
run() {
    local verb=$1 study=$2 out=$3
    shift 3
    rm -f "$out.csv"
    "$GOUGH" "$verb" "$study" -o "$out.csv" --json "$@" >"$out.json" 2>"$out.err"
    status=$?
    if ((status > 1)); then cat "$out.err"; fi
}

try_guide() {
    local line status commands=0
    mkdir bin
    ln -s "$GOUGH" bin/gough
    PATH=$PWD/bin:$PATH
    while IFS= read -r line; do
        [[ $line == *report* ]] && grep -q 'without the page' <(gough report own-machine.yaml -o none.html 2>&1) && continue
        bash -c "$line" >"said-$commands.txt" 2>&1
        status=$?
        claim "$line" same $status 0
        if ((status != 0)); then cat "said-$commands.txt"; fi
        commands=$((commands + 1))
    done < <(sed -n 's/^    \(gough .*\)$/\1/p' "$1")
    claim 'there are commands to try' within "$commands" "$2" "$3"
}
