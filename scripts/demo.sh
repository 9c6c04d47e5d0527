#!/usr/bin/env bash
# demo.sh: the paper's whole study with build/gough. Prints what the paper claims beside what is found; leaves results (HDF5, CSV),
# pictures (PNG, PDF) and a page (HTML) in out/ and names them. GOUGH and OUT choose another command and another folder.
# shellcheck disable=SC2016  # awk programs stand between single quotes
set -uo pipefail
export LC_ALL=C
cd "$(dirname "$0")/.." || exit 1
gough=${GOUGH:-$PWD/build/gough}
out=${OUT:-out}
mkdir -p "$out" || exit 3
scratch=$(mktemp -d) || exit 3
trap 'rm -rf "$scratch"' EXIT

bold='' plain=''
if [[ -t 1 && -z ${NO_COLOR:-} ]]; then bold=$'\e[1m' plain=$'\e[0m'; fi
say() { printf '%s\n' "$*"; }
heading() { printf '\n%s%s%s\n' "$bold" "$*" "$plain"; }
fail() {
    say "demo: $*" >&2
    exit 1
}

# compute NAME VERB STUDY [OPTION…]: out/NAME.h5 and out/NAME.csv. A run that ends early (exit status 1) is an answer; its cause
# is left in $ended, which is empty for a run that reached its end.
compute() {
    local name=$1 verb=$2 study=$3 status extension
    shift 3
    for extension in h5 csv; do
        "$gough" "$verb" "examples/$study.yaml" "$@" -q -o "$out/$name.$extension" 2>"$scratch/said"
        status=$?
        if ((status > 1)); then
            cat "$scratch/said" >&2
            fail "gough $verb examples/$study.yaml ended with exit status $status"
        fi
    done
    ended=
    if ((status == 1)); then ended=$(tail -n 1 "$scratch/said" | sed 's/^[^:]*: error: [^:]*: //'); fi
    made+=("$out/$name.h5" "$out/$name.csv")
}

# draw NAME RESULT… [OPTION…]: out/NAME.png and out/NAME.pdf
draw() {
    local name=$1 extension
    shift
    for extension in png pdf; do
        "$gough" plot "$@" -q -o "$out/$name.$extension" || fail "the picture $out/$name.$extension could not be drawn"
    done
    pictures+=("$out/$name.png" "$out/$name.pdf")
}

# finely STUDY [OPTION…]: the name of a table with close rows, for extremes and crossings
finely() {
    local study=$1
    shift
    "$gough" simulate "examples/$study.yaml" "$@" --set simulation.output_step=0.001 -q -o "$scratch/fine.csv" 2>"$scratch/said"
    (($? <= 1)) || fail "$(cat "$scratch/said")"
    echo "$scratch/fine.csv"
}

# table FILE PROGRAM: awk over a table, with column numbers by name in c[] and magnitude()
table() {
    awk -F, "function magnitude(x) { return x < 0 ? -x : x }
             NR == 1 { for (i = 1; i <= NF; i++) c[\$i] = i; next } $2" "$1"
}
# largest FILE COLUMN [FROM TO]: largest magnitude
largest() {
    table "$1" "\$1 >= ${3:-0} - 1e-9 && \$1 <= ${4:-1e300} + 1e-9 { x = magnitude(\$c[\"$2\"]); if (x > m) m = x } END { printf \"%.3g\", m }"
}
least_and_greatest() {
    table "$1" "{ x = \$c[\"$2\"] + 0; if (NR == 2 || x < a) a = x; if (NR == 2 || x > b) b = x } END { printf \"%.3g and %.3g\", a, b }"
}

made=()
pictures=()
"$gough" --version >/dev/null || fail "build/gough does not run; 'make' builds it"
say "${bold}Study of the hexapod dynamics using equations in redundant coordinates${plain}"
say "The paper's numerical study, section 3, with $("$gough" --version | head -n 1)."
say "Lengths in base radii R, masses in M, times in sqrt(R/g), forces in M g."

# ---- Figure 3 ----
heading "1  Program forces (Figure 3)"
say "   The motion: heave 0.2 sin t (1 - exp(-t/2))^2. The force in each of the six equal legs:"
compute forces forces paper-heave
table "$out/forces.csv" '
    NR == 2 { printf "\n        t   force by the six equations   closed form M(a + g)l/(6h)\n" }
    $1 == 0 || $1 == 1 || $1 == 2 || $1 == 5 || $1 == 8 || $1 == 15 || $1 == 20 {
        h = $c["z"]; l = sqrt(h * h + 0.49); F = ($c["az"] + 1) * l / (6 * h)
        d = magnitude($c["f1"] - F); if (d > worst) worst = d
        printf "    %5.1f   %.15f            %.15f\n", $1, $c["f1"], F
    }
    END { printf "\n   They differ by at most %.1g.", worst }'
"$gough" forces examples/paper-heave.yaml -q --set simulation.duration=60 -o "$scratch/cycle.csv" 2>/dev/null
say " In the long run the force swings between $(table "$scratch/cycle.csv" '
    $1 > 40 { x = $c["f1"] + 0; if (!n || x < a) a = x; if (!n || x > b) b = x; n++ } END { printf "%.5f and %.5f", a, b }')."
draw figure-3 "$out/forces.h5" --figure forces --title "Figure 3: the force in each leg"

# ---- round trip ----
heading "2  The round trip, open loop"
say "   The paper: these forces, applied to the loaded platform, give the oscillation back."
compute round-trip simulate paper-heave
say "   Found: they do, while round-off stays small. Largest deviation up to"
table "$out/round-trip.csv" '
    { e = magnitude($c["ez"]); if (e > heave) heave = e
      s = sqrt($c["ex"] ^ 2 + $c["ey"] ^ 2); if (s > sway) sway = s
      y = magnitude($c["eyaw"]); if (y > yaw) yaw = y }
    NR == 2 { printf "\n        t       heave        sway    yaw (degrees)\n" }
    $1 == 5 || $1 == 10 || $1 == 15 || $1 == 20 { printf "    %5.1f   %9.1e   %9.1e   %9.1e\n", $1, heave, sway, yaw }'
say "
   A hexapod pushed by given forces is unstable in every mode, also in those that a program of pure heave
   does not touch: round-off in yaw grows some ten thousand times in each period."
draw round-trip "$out/round-trip.h5" --figure deviation --log --title "The open-loop round trip: round-off grows"

# ---- Figure 4 ----
heading "3  A small disturbance, open loop (Figure 4)"
say "   The paper: forces off by 0.0001 sin 2t (1 - exp(-t/2)) matter little at first; then the platform moves up fast."
compute perturbed simulate paper-perturbed
perturbed_end=$ended
compute perturbed-vertical simulate paper-perturbed-vertical
vertical_end=$ended
say "   Found, with the disturbance in each leg, and with it as the total vertical force:"
deviations() { table "$1" '$1 == 2 || $1 == 6 || $1 == 10 || $1 == 14 || $1 == 18 || $1 == 20 { printf "%g %.6e\n", $1, $c["ez"] }'; }
join <(deviations "$out/perturbed.csv") <(deviations "$out/perturbed-vertical.csv") |
    awk 'BEGIN { printf "\n        t   deviation, each leg   deviation, total\n" } { printf "    %5.1f        %13.6e      %13.6e\n", $1, $2, $3 }'
say "
   The first passes +1 at t = $(table "$(finely paper-perturbed)" '$c["ez"] > 1 && !found { found = 1; printf "%.4f", t + ($1 - t) * (1 - e) / ($c["ez"] - e) } { t = $1; e = $c["ez"] }'), upwards; the second is on the same way, a little later.${perturbed_end:+
   First run: $perturbed_end.}${vertical_end:+
   Second run: $vertical_end.}"
draw figure-4 "$out/round-trip.h5" "$out/perturbed.h5" "$out/perturbed-vertical.h5" --columns z,ez \
    --title "Figure 4: a small disturbance of the forces" --label 'program forces' --label 'each leg disturbed' \
    --label 'total disturbed'

# ---- feedback ----
heading "4  Feedback"
say "   The paper: forces F = F^p + G (l^p - l) make the oscillation stable."
compute feedback simulate paper-feedback
say "   Found: the same disturbance with G = 50 M g/R moves the platform by $(largest "$(finely paper-feedback)" ez) at most, against"
say "   $(largest "$out/perturbed.csv" ez) in open loop."
draw feedback "$out/perturbed.h5" "$out/feedback.h5" --columns z --title 'The same disturbance with and without feedback' \
    --label 'open loop' --label 'feedback, G = 50'

# ---- feedback alone ----
heading "5  Feedback alone, F^p = 0"
say "   The paper: with G large enough the program is followed even without program forces."
compute stiff simulate paper-no-feedforward
compute soft simulate paper-no-feedforward --set control.stiffness=5
compute slack simulate paper-no-feedforward --set control.stiffness=2
slack_end=${ended%%:*}
say "   Found: with G = 100 the deviation keeps between $(least_and_greatest "$(finely paper-no-feedforward)" ez),"
say "   with G = 5 between $(least_and_greatest "$(finely paper-no-feedforward --set control.stiffness=5)" ez): the legs must be too short to carry the weight."
say "   With G = 2 the platform collapses: ${slack_end:-not this time}."
draw feedback-alone "$out/stiff.h5" "$out/soft.h5" "$out/slack.h5" --figure motion --title 'Feedback alone, no program forces' \
    --label 'G = 100' --label 'G = 5' --label 'G = 2'

# ---- deviation against G ----
heading "6  Deviation against G"
say "   The paper: some G always keeps the deviation as small as wanted. Largest deviation of position (in R) and of angle (in"
say "   degrees):"
gains=(0.05 0.1 0.15 0.2 0.35 0.5 0.8 1 2 5 10 20 50 100 200 500 1000)
names='G,position_deviation,angle_deviation,position_deviation_20,angle_deviation_20,ended,end_time'
with=$out/deviation-with-program-forces.csv
alone=$out/deviation-by-feedback-alone.csv
echo "$names" >"$with"
echo "$names" >"$alone"

# one_gain FILE G STUDY DURATION: a line of the table
one_gain() {
    "$gough" simulate "examples/$3.yaml" -q --set control.stiffness="$2" --set simulation.duration="$4" \
        --set simulation.tolerance=1e-10 -o "$scratch/gain.csv" 2>"$scratch/said"
    local status=$?
    ((status <= 1)) || fail "$(cat "$scratch/said")"
    table "$scratch/gain.csv" "
        { p = sqrt(\$c[\"ex\"] ^ 2 + \$c[\"ey\"] ^ 2 + \$c[\"ez\"] ^ 2)
          a = magnitude(\$c[\"eroll\"]); b = magnitude(\$c[\"epitch\"]); if (b > a) a = b
          b = magnitude(\$c[\"eyaw\"]); if (b > a) a = b
          if (p > P) P = p; if (a > A) A = a; last = \$1 }
        \$1 <= 20.000001 { P20 = P; A20 = A }
        END { printf \"%s,%.6g,%.6g,%.6g,%.6g,%d,%.9g\\n\", \"$2\", P, A, P20, A20, $status, last }" >>"$1"
}
for G in "${gains[@]}"; do
    one_gain "$with" "$G" paper-feedback 200
    one_gain "$alone" "$G" paper-no-feedforward 20
done
made+=("$with" "$alone")
join -t, <(sort "$with") <(sort "$alone") | sort -t, -k1,1g | awk -F, '
    BEGIN {
        print "\n                     disturbed, with F^p                             undisturbed, F^p = 0"
        print "        G        to t = 20               to t = 200                    to t = 20"
        print "             position    angle       position    angle                  position"
    }
    $1 == "G" { next }
    {
        early = $7 < 19.9 ? sprintf("ends at t = %.1f", $7) : sprintf("%8.1e  %8.1e", $4, $5)
        late = $6 ? sprintf("ends at t = %.1f", $7) : sprintf("%8.1e  %8.1e", $2, $3)
        held = $6 || $3 > 1 || $2 > 0.05 ? "not held" : "held"
        alone = $12 ? sprintf("collapses at t = %.1f", $13) : sprintf("%8.1e", $8)
        printf "  %7g    %-20s    %-20s  %-8s    %s\n", $1, early, late, held, alone
    }'
draw deviation "$with" "$alone" --title 'Deviation against stiffness' \
    --label 'disturbed, up to t = 200' --label 'feedback alone, up to t = 20'
say "
   Held from where G passes the threshold of every mode: 0.082 in heave, 0.466 in yaw and 0.894 in sway with tilt.
   Below, modes that the disturbance does not touch grow from round-off; near 0.15 and 0.35 heave itself is pumped by
   the program (parametric resonance). Without a rate term nothing dies out: what is held is bounded.
   docs/theory/stability.md derives all of it."

# ---- stability ----
heading "7  Stability without simulating"
say "   The paper infers the necessity of feedback from runs. It follows from the equations: the loop linearised, at rest and over"
say "   one period of the motion."
"$gough" stability examples/paper-heave.yaml >"$scratch/loop.txt" 2>"$scratch/said" || fail "$(cat "$scratch/said")"
sed -n '/^  Without feedback/,/^  Checked/ { /^  Checked/d; s/^  \(Without\)/\n  \1/; s/^/ /p; }' "$scratch/loop.txt"
say "
   Along the oscillation, without feedback, deviations grow in each period of 2 pi:"
sed -n '/^Along the program/,/^  Checked/s/^    \([a-z].*\)/    \1/p' "$scratch/loop.txt" |
    awk '$1 != "mode" { name = $1 ($2 ~ /^×/ ? " " $2 : ""); factor = $2 ~ /^×/ ? $3 : $2; if (factor > 1) printf "    %10.6g-fold   %s\n", factor, name }'
map=$out/stability-map
"$gough" stability examples/paper-heave.yaml --sweep-stiffness 0:1.4:141 --sweep-amplitude 0:1.5:31 -q \
    --title 'Where feedback holds, and its resonance tongues' -o "$map.csv" -o "$map.png" -o "$map.pdf" 2>"$scratch/said" ||
    fail "$(cat "$scratch/said")"
made+=("$map.csv" "$map-tongues.csv")
pictures+=("$map.png" "$map.pdf")
say "
   With feedback: above the thresholds of 6, but for these resonance tongues of heave, where a stiffer loop fails again:"
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
    $c["amplitude"] == 1 && $c["mode"] == "heave" && $c["kind"] ~ /resonance/ {
        printf "    G from %.5f to %.5f: grows up to %.4g-fold in each period\n", $c["from"], $c["to"], $c["growth_per_period"] }' "$map-tongues.csv"
say "   $map.png has all of them over G and the amplitude of the motion."

heading "Results"
printf '   %s\n' "${made[@]}"
heading "Pictures"
printf '   %s\n' "${pictures[@]}"

# ---- the page ----
heading "The page"
"$gough" report examples/paper-heave.yaml examples/paper-perturbed.yaml examples/paper-feedback.yaml -q -o "$out/paper.html" 2>"$scratch/said"
(($? <= 1)) || fail "$(cat "$scratch/said")"
say "   $out/paper.html"
say "   Open it in a browser: the paper's three runs side by side, in 3D, with curves, numbers, and a live simulation."
