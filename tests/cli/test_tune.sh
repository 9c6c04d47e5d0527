#!/usr/bin/env bash
# gough tune: the stiffness that it names, run by gough simulate, meets the accuracy, a fifth less does not; its answers as text, JSON,
# data and picture; and what it says where there is no answer.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1

# under sanitizers one accuracy must do
sanitized=
[[ $GOUGH == *sanitized* ]] && sanitized=yes

"$GOUGH" example paper-perturbed >perturbed.yaml
"$GOUGH" example paper-heave >heave.yaml

key() { jq -r "$1" out; }
less() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a + 0 == a && b + 0 == b && a <= b) }'; }

deviation() { # deviation STUDY FEEDFORWARD G D: of a run of gough simulate; inf where it ends early
    "$GOUGH" simulate "$1" --json -q --set control.feedforward="$2" --set control.stiffness="$3" --set control.damping="$4" \
        >run.json 2>/dev/null && jq -r .deviation.position run.json || echo 1e300
}

# ---- what is named does, a fifth less does not --------------------------------------------------------------------

check_choice() { # check_choice FEEDFORWARD DEVIATION A:B [OPTION…]
    local feed=$1 asked=$2 span=$3 G D reached
    shift 3
    run tune perturbed.yaml --deviation "$asked" --feedforward "$feed" --stiffness "$span" --json "$@"
    expect_code 0 "tune --feedforward $feed --deviation $asked"
    G=$(key '.choices[0].stiffness') D=$(key '.choices[0].damping')
    [[ $(key '.choices[0].feedforward') == "$feed" ]] || fail "asked for $feed, says $(key '.choices[0].feedforward')"
    reached=$(deviation perturbed.yaml "$feed" "$G" "$D")
    echo "feed-forward $feed, asked $asked: G = $G, D = $D reaches $reached, with 0.8 G" \
        "$(deviation perturbed.yaml "$feed" "$(awk -v g="$G" 'BEGIN { printf "%.17g", 0.8 * g }')" "$D")"
    less "$reached" "$asked" || fail "$feed, $asked: G = $G reaches only $reached"
    less "$reached" "$(key '.choices[0].deviation')" || fail "$feed: the run deviates more than tune says"
    less "$(awk -v a="$(key '.choices[0].deviation')" 'BEGIN { print a * 0.97 }')" "$reached" || fail "$feed: tune says too much"
    reached=$(deviation perturbed.yaml "$feed" "$(awk -v g="$G" 'BEGIN { printf "%.17g", 0.8 * g }')" "$D")
    less "$reached" "$asked" && fail "$feed, $asked: four fifths of G = $G reach $reached too"
    return 0
}

check_choice program 1e-5 6:40
[[ $(key '.choices[0].binding.what + " " + .choices[0].binding.mode') == "position heave" ]] ||
    fail "what binds is $(key '.choices[0].binding')"
less 0.99 "$(key '.choices[0].binding.share')" || fail "heave holds only $(key '.choices[0].binding.share')"
[[ $(key '.choices[0].periodic') == true ]] || fail "the paper's heave is periodic"
check_choice none 1e-2 15:200
less -1.05 "$(key '.choices[0].curve.slope')" && less "$(key '.choices[0].curve.slope')" -0.95 ||
    fail "without feed-forward the slope is $(key '.choices[0].curve.slope')"
if [[ -z $sanitized ]]; then
    check_choice program 2e-6 30:200
    check_choice none 2e-3 100:800
    check_choice none 1e-3 100:800 --damping-ratio 0.3
    [[ $(key '.choices[0].damping_ratio | . > 0.2999999 and . < 0.3000001') == true ]] ||
        fail "the damping ratio is $(key '.choices[0].damping_ratio')"
fi

# ---- answers -------------------------------------------------------------------------------------------------------

# rest at home: quick
still="--set motion= --set disturbance.leg_force=0.001*ramp(t,2) --set simulation.duration=4"
# shellcheck disable=SC2086
run tune heave.yaml $still --deviation 1e-3 --damping-ratio 0.5 -o curve.csv -o curve.h5 -o curve.png -o curve.svg
expect_code 0 "tune with outputs"
for words in "With feed-forward" "Without feed-forward" "G = " "limited by" "legs        force up to" "curve       the deviation varies as G^-1.0" \
    "the program ends at rest" "wrote curve.csv" "wrote curve.png"; do
    grep -qF -- "$words" out || fail "tune does not say '$words'"
done
[[ $(head -c 8 curve.png | od -An -tx1 | tr -d ' \n') == 89504e470d0a1a0a ]] || fail "curve.png is no PNG"
grep -q '<svg' curve.svg || fail "curve.svg is no SVG"
[[ $(head -1 curve.csv) == feedforward,G,D,position_deviation,* ]] || fail "columns: $(head -1 curve.csv)"
[[ $(column curve.csv named | grep -cx 1) == 2 ]] || fail "two rows are named, not $(column curve.csv named | grep -cx 1)"
# within a setting G rises
paste -d, <(column curve.csv feedforward) <(column curve.csv G) |
    awk -F, '$1 == before && $2 <= G { exit 1 } { before = $1; G = $2 }' || fail "G does not rise"
run plot curve.h5 -o again.svg
expect_code 0 "plot curve.h5"
grep -q 'without feed-forward' again.svg || fail "the picture of the data names no curve"

# data on standard output, talk on standard error; the same numbers
# shellcheck disable=SC2086
run tune heave.yaml $still --deviation 1e-3 --damping-ratio 0.5 -o -
expect_code 0 "tune -o -"
cmp -s out curve.csv || fail "-o - prints other data than -o curve.csv"
grep -q "With feed-forward" err || fail "with -o - the summary belongs on standard error"
if locale -a 2>/dev/null | grep -qi '^de_DE\.utf-*8$'; then
    # shellcheck disable=SC2086
    LC_ALL=de_DE.UTF-8 run tune heave.yaml $still --deviation 1e-3 --damping-ratio 0.5 -o -
    cmp -s out curve.csv || fail "another locale, other data"
fi

# the sag M g l²/(6 h² G) without feed-forward, well damped
# shellcheck disable=SC2086
run tune heave.yaml $still --set disturbance= --feedforward none --deviation 1e-4 --damping-ratio 0.9 --json
G=$(key '.choices[0].stiffness')
less 2482 "$G" && less "$G" 2486 || fail "the sag law wants 1.49/6e-4 = 2483.3, not $G"
# in other units the same
# shellcheck disable=SC2086
run tune heave.yaml $still --set disturbance= --set load.mass=3 --feedforward none --deviation 1e-4 --damping-ratio 0.9 --json --dimensionless
awk -v a="$G" -v b="$(key '.choices[0].stiffness')" 'BEGIN { exit !(a / b - 1 < 2e-4 && b / a - 1 < 2e-4) }' ||
    fail "a threefold mass needs $(key '.choices[0].stiffness') in its own units, not $G"

# a machine with units and limits: in its own units every number is that in SI over its unit, in JSON and in the table; the legs' shares
# are those of the limits, and simulate finds the same force and speed
"$GOUGH" example own-machine >own.yaml
run tune own.yaml --deviation 1e-3 --feedforward none --stiffness 200:20000 --json -o si.csv
expect_code 0 "tune own.yaml"
mv out si.json
run tune own.yaml --deviation 1e-3 --feedforward none --stiffness 200:20000 --json -o bare.csv --dimensionless
mv out bare.json
jq -rn --slurpfile si si.json --slurpfile bare bare.json '
    0.25 as $L | 6 as $M | (0.25 / 9.80665 | sqrt) as $T |
    def unit: {stiffness: ($M / $T / $T), fails: ($M / $T / $T), damping: ($M / $T), deviation: $L, deviation_time: $T, angle_time: $T,
        force: ($M * $L / $T / $T), speed: ($L / $T)}[.] // 1;
    def same($path; $a; $b): ($path | map(select(type == "string")) | last | unit) as $u |
        if ($a - $b * $u | fabs) <= 1e-9 * ($a | fabs) then empty else "\($path | tostring): \($a) and \($b) in units of \($u)" end;
    ($si[0] | del(.choices[].curve.scale)) as $all |
    ($all | [paths(type == "number")][]) as $p | same($p; $all | getpath($p); $bare[0] | getpath($p)),
    ($si[0].choices[0].legs | select((.force_share - .force / 80 | fabs) > 1e-12 or (.speed_share - .speed / 0.25 | fabs) > 1e-12) |
        "shares of the limits: \(.)"),
    # the curve is scale · G^slope in the units of each
    ($si[0].choices[0] | .curve.scale * pow(.stiffness; .curve.slope)) as $one |
    ($bare[0].choices[0] | $L * .curve.scale * pow(.stiffness; .curve.slope)) as $other |
    (select(($one / $other - 1 | fabs) <= 1e-9 | not) | "the curve: \($one) and \($other)")' >differences
[[ ! -s differences ]] || fail "tune in other units: $(cat differences)"
paste -d, si.csv bare.csv | awk -F, '
    function differs(a, b, unit) { return !(a == "nan" && b == "nan") && !((a - b * unit) ^ 2 <= 1e-18 * a * a) }
    BEGIN { L = 0.25; M = 6; T = sqrt(L / 9.80665)
            of["G"] = M / T / T; of["D"] = M / T; of["position_deviation"] = of["asked"] = L; of["force"] = M * L / T / T
            of["speed"] = L / T; of["end_time"] = T }
    NR == 1 { n = NF / 2; for (i = 1; i <= n; i++) { name[i] = $i; place[$i] = i }; next }
    { for (i = 1; i <= n; i++) if (differs($i, $(i + n), name[i] in of ? of[name[i]] : 1)) print "row " NR ", " name[i] ": " $i " and " $(i + n)
      if ($place["ended"] == 1 && $place["regular"] == 1) print "row " NR " ended, but is regular"
      if ($place["growth"] != "nan" && $place["growth"] > 1.001 && $place["stable"] == 1) print "row " NR " grows, but is stable"
      stable += $place["stable"]; regular += $place["regular"] }
    END { if (!(stable > regular && regular > 10)) print stable " rows are stable, " regular " regular" }' >differences
[[ ! -s differences ]] || fail "the table of tune: $(head -5 differences)"
run simulate own.yaml --json -q --set control.feedforward=none --set control.stiffness="$(jq '.choices[0].stiffness' si.json)"
jq -e --slurpfile si si.json '$si[0].choices[0].legs as $named |
    ([.legs[].force[] | fabs] | max / $named.force - 1 | fabs) < 1e-3 and ([.legs[].speed] | max / $named.speed - 1 | fabs) < 1e-3' out >/dev/null ||
    fail "simulate finds another force or speed than $(jq -c '.choices[0].legs' si.json)"

# ---- none ----------------------------------------------------------------------------------------------------------

none() { # none SENTENCE OPTION…
    local sentence=$1
    shift
    # shellcheck disable=SC2086
    run tune heave.yaml $still "$@"
    expect_code 1 "tune $*"
    grep -qF -- "$sentence" err || fail "tune $*: does not say '$sentence' but: $(cat err)"
}
none "starts 0.002 off the program" --deviation 1e-3 --set initial.heave=0.002 --stiffness 0:50 --feedforward program
none "without damping that offset never dies out" --deviation 1e-4 --set initial.pitch=1 --feedforward program --set disturbance=
none "its first swing is as large with any G" --deviation 1e-4 --set initial.pitch=1 --feedforward program --set disturbance= \
    --damping-ratio 0.2
none "a leg's force exceeds its limit" --deviation 1e-2 --set platform.legs.max_force=0.15 --stiffness 0:50
run tune heave.yaml --deviation 1e-2 --set platform.legs.max_speed=0.05 --stiffness 1:50
expect_code 1 "tune with a slow leg"
grep -qF "a leg moves too fast" err || fail "tune with a slow leg says: $(cat err)"
run tune heave.yaml --json --deviation 1e-3 --set motion= --set simulation.duration=2 --set platform.legs.max_force=0.15 --stiffness 0:50
expect_code 1 "tune --json without a choice"
[[ $(key '.choices | map(.found) | any') == false && $(key '.choices[0].stiffness') == null ]] || fail "a choice that is none"
[[ $(key '.choices[0].curve.exceptions[-1].cause') == leg_force ]] || fail "the exceptions lack the cause"
[[ $(key '.choices[0].reason') == *"force exceeds its limit"* ]] || fail "JSON lacks the reason"

# ---- damping that asks for short steps ------------------------------------------------------------------------------

# fixed steps follow the program to round-off; adaptive ones, as short and one by one, would leave their tolerance of 1e-10
run tune own.yaml --deviation 1e-4 --feedforward program --stiffness 300:400 --set control.damping=20000 --json
expect_code 0 "tune with a strong damping"
less "$(key '.choices[0].deviation')" 1e-12 ||
    fail "a strongly damped loop deviates by $(key '.choices[0].deviation'): its steps are not the small ones"

# ---- refused -------------------------------------------------------------------------------------------------------

refused() { # refused SENTENCE ARGUMENT…
    local sentence=$1
    shift
    run tune "$@"
    expect_code 2 "$@"
    [[ ! -s out ]] || fail "$*: standard output is not empty"
    grep -qF -- "$sentence" err || fail "$*: does not say '$sentence' but: $(cat err)"
}
refused "--deviation is missing" heave.yaml
refused "--deviation takes a number greater than 0" heave.yaml --deviation 0
refused "--deviation takes a number greater than 0" heave.yaml --deviation 1e-3x
refused "from 0 to less than 1" heave.yaml --deviation 1e-3 --damping-ratio 1
refused "from 0 to 0.5" heave.yaml --deviation 1e-3 --margin nan
refused "program, none or both" heave.yaml --deviation 1e-3 --feedforward yes
refused "two numbers a:b with 0 <= a <= b" heave.yaml --deviation 1e-3 --stiffness 3
refused "two numbers a:b with 0 <= a <= b" heave.yaml --deviation 1e-3 --stiffness 5:3
refused "the machine is unstable at home without feedback: sway–tilt grows unless G exceeds 0.894107" heave.yaml --deviation 1e-3 --stiffness 0:0
refused "the search ends at 0.5" heave.yaml --deviation 1e-3 --stiffness 0.1:0.5
refused "STUDY is missing" --deviation 1e-3
refused "both write to standard output" heave.yaml --deviation 1e-3 --json -o -
refused "-o takes a name that ends in" heave.yaml --deviation 1e-3 -o curve.txt
refused "period" heave.yaml --deviation 1e-3 --set motion.period=5
run tune heave.yaml --deviation 1e-3 -o nowhere/curve.csv
expect_code 3 "-o into a folder that is not there"
finish
