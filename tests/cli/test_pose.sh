#!/usr/bin/env bash
# gough pose: the camera hexapod's lengths and pose, both ways; all poses; records past a singular pose; what is refused.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
: "${SOURCE:?the source folder}"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
"$GOUGH" example camera >camera.yaml
"$GOUGH" example own-machine >own.yaml
lengths=501.830027,496.746817,493.032981,501.929940,493.128320,491.341155
pose=surge=2,sway=-3,heave=4,roll=0.1,pitch=0.12,yaw=0.05

# near NAME A B TOLERANCE
near() { awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; exit !(d <= t && d >= -t) }' || fail "$1: $2 is not $3 within $4"; }

# the lengths of the pose are those of another computation, to half of its last digit
run check camera.yaml --pose "$pose" --json
for v in 0 1 2 3 4 5; do
    near "length $((v + 1))" "$(jq ".pose.length[$v]" out)" "$(cut -d, -f$((v + 1)) <<<$lengths)" 6e-7
done
# and back: digits that were cut off move the pose by as much
run pose camera.yaml --lengths $lengths --json
expect_code 0 pose
for part in ${pose//,/ }; do
    near "${part%=*}" "$(jq ".poses[0].${part%=*}" out)" "${part#*=}" 5e-7
done
jq -e '.poses | length == 1 and .[0].joined_to_home and .[0].within_limits and .[0].error.position < 1e-8' out >/dev/null ||
    fail "the certificate of one pose: $(jq -c .poses out)"
jq -e '.units.length == "mm" and .reached == 1 and .margin > 0.5 and .complete == null' out >/dev/null || fail "keys of one pose"
run pose camera.yaml --lengths $lengths
grep -q '^  surge  *2.00000018 mm$' out || fail "no surge: $(cat out)"
grep -q '1 certified step$' out || fail "no way: $(cat out)"

# full digits come back to rounding
full=$("$GOUGH" check camera.yaml --pose "$pose" --json | jq -r '.pose.length | map(tostring) | join(",")')
run pose camera.yaml --lengths "$full" --near surge=1 --json
for part in ${pose//,/ }; do near "${part%=*}" "$(jq ".poses[0].${part%=*}" out)" "${part#*=}" 1e-10; done
jq -e '.poses[0].joined_to_home == null' out >/dev/null || fail "a pose followed from elsewhere is not known to be joined to home"

# all: mirror images in pairs, one of them joined to home, all with these lengths
run pose camera.yaml --lengths "$full" --all --json
expect_code 0 --all
jq -e '.real == 8 and .nonreal == 24 and .infinite == 8 and .complete == "counted"' out >/dev/null || fail "counts: $(jq -c 'del(.poses)' out)"
jq -e '[.poses[] | select(.joined_to_home)] | length == 1' out >/dev/null || fail "not one pose is joined to home"
jq -e '[.poses[].determinant | if . > 0 then 1 else -1 end] | add == 0' out >/dev/null || fail "signs of determinants"
for i in 0 1 2 3 4 5 6 7; do
    at=$(jq -r ".poses[$i] | \"surge=\(.surge),sway=\(.sway),heave=\(.heave),roll=\(.roll),pitch=\(.pitch),yaw=\(.yaw)\"" out)
    "$GOUGH" check camera.yaml --pose "$at" --json >back
    for v in 0 1 2 3 4 5; do near "length of pose $i" "$(jq ".pose.length[$v]" back)" "$(cut -d, -f$((v + 1)) <<<"$full")" 1e-8; done
done
run pose camera.yaml --lengths $lengths --all
grep -q '^8 real poses, 24 complex, 8 paths at infinity, 0 in doubt$' out || fail "counts in words: $(head -4 out)"
[[ $(grep -c 'joined$' out) == 1 ]] || fail "one pose is joined: $(cat out)"

# a record: the lengths of a run give back its motion
"$GOUGH" forces camera.yaml -o legs.csv -q
run pose camera.yaml --samples legs.csv -o poses.csv
expect_code 0 --samples
grep -q 'certain rows  *551 of 551' out || fail "rows: $(cat out)"
[[ $(head -1 poses.csv) == t,surge,sway,heave,roll,pitch,yaw,error,margin,condition ]] || fail "columns: $(head -1 poses.csv)"
paste -d, <(column legs.csv roll) <(column poses.csv roll) <(column legs.csv yaw) <(column poses.csv yaw) <(column legs.csv condition) <(column poses.csv condition) |
    awk -F, '($1 - $2)^2 > 1e-18 || ($3 - $4)^2 > 1e-18 { bad = 1 } END { exit bad || NR != 551 }' || fail "angles of the record"
near "surge at t = 6" "$(awk -F, '$1 == 6 { print $2 }' poses.csv)" 2 1e-9
run pose camera.yaml --samples legs.csv --length-error 0.001 -o noisy.csv --json
jq -e '(.record.length_error | unique) == [0.001] and .record.certain == 551 and .record.lost == null' out >/dev/null || fail "length error: $(jq -c .record out)"
cmp -s <(column poses.csv surge) <(column noisy.csv surge) || fail "an error of the lengths moves the pose"
awk -F, 'NR == FNR { m[FNR] = $9; next } FNR > 1 && !($9 < m[FNR]) { exit 1 }' poses.csv noisy.csv || fail "an error of the lengths leaves the margin"

# level rings are singular at yaw 90°: a record to 85° is followed, those beyond are lost before it
turn() { # turn END: lengths of own.yaml turned from 0 to END degrees in 2 s, 100 rows a second
    awk -v end="$1" 'BEGIN { degree = atan2(0, -1) / 180; print "t,l1,l2,l3,l4,l5,l6"
        for (i = 0; i <= 200; i++) {
            printf "%.9g", i / 100
            for (v = 0; v < 6; v++) {
                b = (120 * int((v + 1) / 2) + (v % 2 ? -10 : 10)) * degree
                a = (60 + 120 * int(v / 2) + (v % 2 ? 10 : -10) + end * i / 200) * degree
                printf ",%.17g", sqrt((0.25 * cos(b) - 0.15 * cos(a))^2 + (0.25 * sin(b) - 0.15 * sin(a))^2 + 0.28^2)
            }
            print "" } }'
}
turn 85 >turn.csv
run pose own.yaml --samples turn.csv -o turned.csv
expect_code 0 "a record to 85°"
near "the last yaw" "$(column turned.csv yaw | tail -1)" 85 1e-9
for end in 91 95 100; do
    turn $end >turn.csv
    run pose own.yaml --samples turn.csv -o turned.csv --json
    expect_code 1 "a record to $end°"
    last=$(column turned.csv yaw | tail -1)
    awk -v y="$last" 'BEGIN { exit !(y > 87 && y < 90) }' || fail "a record to $end° is lost at $last°"
    [[ $(column turned.csv t | wc -l) == "$(jq .record.certain out)" ]] || fail "rows of the table and of the summary"
    jq -e '.record.lost.least_singular_value < 0.05 and .record.lost.pose[5] < 90' out >/dev/null || fail "where: $(jq -c .record.lost out)"
    grep -q 'the pose is lost before t = ' err || fail "$(cat err)"
    # the row that is offered has poses, of which none is chosen
    again=$(sed -n 's/.*--lengths \([^ ]*\) --all.*/\1/p' err)
    "$GOUGH" pose own.yaml --lengths "$again" --all --json >all.json || fail "--lengths $again --all"
    jq -e '.real >= 4' all.json >/dev/null || fail "poses of the row: $(jq -c .real all.json)"
done
# a bound of the study takes the place of the record's own
run pose own.yaml --set platform.legs.max_acceleration=50 --samples turn.csv -o turned.csv --json
jq -e '.record.acceleration_given and .record.acceleration[0] == 50 and .record.certain < 180' out >/dev/null || fail "acceleration: $(jq -c .record out)"

# behind a singular pose
behind=$(awk -F, 'NR == 202' OFS=, turn.csv | cut -d, -f2-)
run pose own.yaml --lengths "$behind" --json
jq -e '(.poses | length == 1) or .reached < 1' out >/dev/null || fail "a pose behind: $(cat out)"

# the commands of the guide do what it says
mkdir guide bin && ln -s "$GOUGH" bin/gough
while IFS= read -r command; do
    (cd guide && PATH=$scratch/bin:$PATH bash -c "$command") >out 2>err || fail "docs/guide/pose.md: $command: $(cat err)"
    [[ $command != *--all ]] || [[ $(grep -c '  -  ' out) == 4 ]] || fail "docs/guide/pose.md: not four poses with one sign"
done < <(sed -n 's/^    \(gough .*\)/\1/p' "$SOURCE/docs/guide/pose.md")

refused() { # refused SENTENCE ARGUMENT…
    local sentence=$1
    shift
    run "$@"
    expect_code 2 "$@"
    [[ ! -s out ]] || fail "$*: standard output is not empty"
    grep -qF -- "$sentence" err || fail "$*: does not say '$sentence' but: $(cat err)"
}
refused "give either --lengths" pose own.yaml
refused "give either --lengths" pose own.yaml --lengths 1,1,1,1,1,1 --samples legs.csv -o a.csv
refused "six lengths" pose own.yaml --lengths 1,1,1,1,1
refused "six lengths" pose own.yaml --lengths 1,1,1,1,1,1,1
refused "six lengths above 0" pose own.yaml --lengths 1,1,1,1,1,0
refused "six lengths above 0" pose own.yaml --lengths 1,1,nan,1,1,1
refused "--near has no component 'yow'; did you mean 'yaw'?" pose own.yaml --lengths 1,1,1,1,1,1 --near yow=1
refused "--near says where" pose own.yaml --lengths 1,1,1,1,1,1 --near yaw=1 --all
refused "--all lists the poses of --lengths" pose own.yaml --samples legs.csv --all -o a.csv
refused "give -o FILE" pose own.yaml --samples legs.csv
refused "-o writes the poses of --samples" pose own.yaml --lengths 1,1,1,1,1,1 -o a.csv
refused "a length of 0 or more" pose own.yaml --samples legs.csv -o a.csv --length-error -1
refused "would overwrite the input" pose own.yaml --samples legs.csv -o legs.csv
printf 't,l1,l2,l3,l4,l5\n0,1,1,1,1,1\n' >five.csv
refused "the column l6, the length of leg 6, is missing" pose own.yaml --samples five.csv -o a.csv
printf 't,l1,l2,l3,l4,l5,l6\n0,1,1,1,1,1,1\n0,1,1,1,1,1,1\n' >twice.csv
refused "row 2: the time" pose own.yaml --samples twice.csv -o a.csv
printf 't,l1,l2,l3,l4,l5,l6\n0,1,1,-1,1,1,1\n' >negative.csv
refused "row 1: the length l3 = -1 m must be above 0" pose own.yaml --samples negative.csv -o a.csv
[[ ! -e a.csv ]] || fail "a refused record has an output"
run pose own.yaml --lengths 1,1,1,1,1,9 --all --json
expect_code 1 "lengths that no pose has"
jq -e '.real == 0 and .poses == [] and (.message | test("no pose of this machine"))' out >/dev/null || fail "no pose: $(cat out)"
finish
