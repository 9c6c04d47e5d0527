#!/usr/bin/env bash
# gough tune --poles and --lqr: the poles printed are those asked for or those of closed forms; the matrices printed as keys are those of
# the JSON, in the study's units; options that exclude each other, and poses without gains.
# shellcheck source=tests/cli/support.sh
source "$(dirname "$0")/support.sh"
: "${SOURCE:?the source folder}"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cp "$SOURCE"/examples/*.yaml "$scratch"
cd "$scratch" || exit 1

holds() { # holds WORDS CONDITION: of the JSON in `out`
    jq -e "def near(a; b; e): (a - b | fabs) <= e * (b | fabs); $2" out >/dev/null || fail "$1: $(jq -c '.gains.poles' out)"
}
says() { tr -s '\n ' ' ' <out | grep -qF -- "$1" || fail "$what does not say '$1'"; }
refused() { # refused CODE WORDS ARGUMENT…
    local expected=$1 words=$2
    shift 2
    run tune "$@"
    expect_code "$expected" "tune $*"
    [[ ! -s out ]] || fail "tune $*: prints something"
    tr -s '\n ' ' ' <err | grep -qF -- "$words" || fail "tune $*: '$words' is missing in: $(cat err)"
}
# the matrices of a text, as JSON: [G, D]
keys() { sed -n '/^control:$/,$p' out | sed -E 's/^control:$//; s/^ *stiffness:$/[[/; s/^ *damping:$/],[/; s/^ *- (.*)$/\1,/' | tr -d '\n ' | sed 's/,\]/]/g; s/,$/]]/' | jq -c .; }
# whether two such matrices agree to 12 digits of the largest element, the second multiplied by F
agree() { # agree A B F
    jq -en --argjson a "$1" --argjson b "$2" --argjson f "$3" '[range(2) as $k | ([$a[$k][][] | fabs] | max) as $m |
        range(6) as $i | range(6) as $j | ($a[$k][$i][$j] - $f * $b[$k][$i][$j] | fabs) <= 1e-12 * $m] | length == 72 and all' >/dev/null
}

# ---- poles ---------------------------------------------------------------------------------------------------------

what="tune --poles"
run tune paper-heave.yaml --poles 2,0.7 --json
expect_code 0 "$what"
holds "growth of the poles" '.gains.poles | length == 12 and all(.[]; near(.[0]; -2.8 * 3.14159265358979323846; 1e-10))'
holds "their frequency" '.gains.poles | all(.[]; near(.[1] | fabs; 4 * 3.14159265358979323846 * (0.51 | sqrt); 1e-10))'
holds "what is asked for" '.asked.frequency == 2 and .asked.damping_ratio == 0.7 and .asked.length_weight == null'
holds "symmetry" '[.gains.stiffness, .gains.damping] | all(.[]; . as $g | all(range(6) as $i | range(6) as $j | [$g[$i][$j], $g[$j][$i]]; near(.[0]; .[1]; 1e-9)))'
json=$(jq -c '[.gains.stiffness, .gains.damping]' out)
run tune paper-heave.yaml --poles 2,0.7
expect_code 0 "$what, text"
says 'every mode at rest (home) the frequency of 2 cycles per unit of time and the damping ratio 0.7'
grep -qE '^ +-8\.79645943 +8\.974183635 +0\.7 +6 pairs$' out || fail "the text lists other poles: $(grep pair out)"
agree "$(keys)" "$json" 1 || fail "$what: the keys are not the matrices of the JSON: $(keys)"

# critical damping: a double pole, to all digits
run tune paper-heave.yaml --poles 0.5,1
grep -qE '^ +-3\.141592654 +0 +1 +12 poles$' out || fail "critical damping: $(grep pole out)"

# ---- units: the keys are in the study's, the rest in those asked for ------------------------------------------------

what="tune --poles of own-machine.yaml"
run tune own-machine.yaml --poles 2,0.7 --pose yaw=5,heave=0.01
expect_code 0 "$what"
says 'at rest (heave 0.01 m, yaw 5 deg) the frequency of 2 cycles per s'
si=$(keys)
run tune own-machine.yaml --poles 2,0.7 --pose yaw=5,heave=0.01 --dimensionless
expect_code 0 "$what, dimensionless"
[[ $(keys) == "$si" ]] || fail "$what: with --dimensionless the keys are no longer in the study's units"
says 'numbers are in the units of the study'
grep -qE ' 6 pairs$' out || fail "$what: $(grep pair out)"

# ---- least cost ----------------------------------------------------------------------------------------------------

# heave: λ² = d²/(h l²), s = 6h²/l² with h = 1, d = 0.7
what="tune --lqr"
run tune paper-heave.yaml --lqr 100,1 --json
expect_code 0 "$what"
holds "closed form of heave" '(0.49 / 1.49) as $a | (6 / 1.49) as $s | ($a + ($a * $a + 100 * $s * $s | sqrt)) as $k1 | (2 * $k1 + $s * $s | sqrt) as $k2 |
    near([.gains.stiffness[0][]] | add; $k1 / $s; 1e-9) and near([.gains.damping[0][]] | add; $k2 / $s; 1e-9)'
holds "residual" '.gains.residual <= 1e-12 and .asked.length_weight == 100 and .asked.rate_weight == 1 and .asked.frequency == null'
json=$(jq -c '[.gains.stiffness, .gains.damping]' out)
run tune paper-heave.yaml --lqr 100,1
agree "$(keys)" "$json" 1 || fail "$what: the keys are not the matrices of the JSON"
says 'weights 100 of errors of length and 1 of their rates'
grep -qE 'heave$' out || fail "$what: no mode is named"
# weights have units: the same machine in mm and s
units='units={length: mm, force: N, mass: kg, angle: deg, time: s}'
cat >metres.yaml <<'END'
units: si
platform: {base: {radius: 0.3, half_angle: 10}, top: {radius: 0.2, half_angle: 10}, height: 0.35}
load: {mass: 12, inertia: [0.1, 0.1, 0.16]}
control: {feedforward: program, stiffness: 0}
END
sed -e "s/^units: si/${units/=/: }/; s/0\.3,/300,/; s/0\.2,/200,/; s/height: 0\.35/height: 350/; s/\[0.1, 0.1, 0.16\]/[1e5, 1e5, 1.6e5]/" metres.yaml >millimetres.yaml
run tune metres.yaml --lqr 1e8,1e6 --json
expect_code 0 "$what in metres"
json=$(jq -c '[.gains.stiffness, .gains.damping]' out)
run tune millimetres.yaml --lqr 100,1
expect_code 0 "$what in millimetres"
agree "$(keys)" "$json" 1e-3 || fail "$what: other gains in millimetres: $(keys), not $json"

# ---- the keys in a study: the poles come back ------------------------------------------------------------------------

comes_back() { # comes_back OPTION…: pasted into the study, the gains give the poles again
    grep -v '^control' metres.yaml >pasted.yaml
    "$GOUGH" tune metres.yaml "$@" | sed -n '/^control:$/,$p' >>pasted.yaml
    "$GOUGH" tune metres.yaml "$@" --json | jq -c '[.gains.poles[] | [.[0], (.[1] | fabs)]] | sort' >asked.json
    what="the study with the keys of tune $*"
    run stability pasted.yaml --pose surge=0 --json --set control.feedforward=program
    expect_code 0 "$what"
    jq -e --slurpfile asked asked.json '[.eigenvalues[] | [.[0], (.[1] | fabs)]] | sort | [., $asked[0]] | transpose | length == 12 and
        all(.[]; (.[0][0] * .[0][0] + .[0][1] * .[0][1] | sqrt) as $size | (.[0][0] - .[1][0] | fabs) <= 1e-9 * $size and (.[0][1] - .[1][1] | fabs) <= 1e-9 * $size)' out >/dev/null ||
        fail "$what: the poles are $(jq -c .eigenvalues out), not $(cat asked.json)"
    run stability pasted.yaml --pose surge=0 --set control.feedforward=program
    says 'stiffness G = a matrix with'
    [[ $code == 0 ]] && grep -q 'every deviation dies out' out || fail "$what: the text of stability does not say that deviations die out: $(cat out)"
}
comes_back --poles 3,0.7
comes_back --lqr 1e8,1e6

# ---- what is not ideal is said --------------------------------------------------------------------------------------

run tune paper-heave.yaml --poles 2,0.7 --set control.feedforward=none
what="tune without feed-forward" says 'control.feedforward: none, so the platform sags'
run tune flight-simulator-legs.yaml --poles 2,0.7
what="tune with dry friction" says 'Dry friction of the legs'

run tune metres.yaml --poles 3,0.7 --set control.sampling.period=0.001
expect_code 0 "tune --poles of a sampled study"
what="tune --poles of a sampled study" says 'continuous controller without integral'
says "With the study's own controller, sampled every 0.001 s, deviations at rest become smaller, the slowest of them by a factor of 0.9"
run tune metres.yaml --poles 3,0.7 --set control.sampling.period=0.2 --json
jq -e '.gains.sampled | .stable == false and .radius > 1 and .growth_rate > 0' out >/dev/null || fail "$what: $(jq -c .gains.sampled out)"

# ---- refusals ------------------------------------------------------------------------------------------------------

refused 2 "takes a frequency greater than 0, in cycles per unit of time, and a damping ratio from 0 to 1" paper-heave.yaml --poles 0,0.7
for pair in -1,0.5 2 2,0.7,1 '2,' ',1' 2,1.01 2,-0.1 nan,0.5 2,nan '2 ,0.5'; do refused 2 "--poles takes" paper-heave.yaml "--poles=$pair"; done
for pair in -1,1 1,-1 1 1,1,1 1,inf 1,x; do refused 2 "--lqr takes two weights" paper-heave.yaml "--lqr=$pair"; done
refused 2 "give only one of them" paper-heave.yaml --poles 2,0.7 --lqr 1,1
refused 2 "give one of these too" paper-heave.yaml --pose yaw=5
for option in --deviation=1 --angle-deviation=1 --damping-ratio=0.1 --feedforward=none --margin=0.1 --stiffness=1:2; do
    refused 2 "cannot be combined" paper-heave.yaml --poles 2,0.7 "$option"
done
refused 2 "-o is for the curve" paper-heave.yaml --lqr 1,1 -o a.csv
refused 2 "or give --poles or --lqr" paper-heave.yaml
refused 1 "(yaw 90°) is singular" paper-heave.yaml --poles 2,0.7 --pose yaw=90
refused 1 "neither grows nor decays" paper-heave.yaml --lqr 0,0 --set gravity=0
refused 1 "the weights (0 N/mm)^2 of errors of length and (0 N s/mm)^2 of their rates:" millimetres.yaml --lqr 0,0 --set gravity=0
run tune paper-heave.yaml --poles 2,0.7 -q
[[ $code == 0 && ! -s out && ! -s err ]] || fail "-q prints: $(cat out err)"
finish
