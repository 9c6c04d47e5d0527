#!/usr/bin/env bash
# The guide to the library: its program in Python computes what the C program of the README does, its handler compiles, its controller
# moves the machine as a run of the same study does, it names the libraries' files and every header.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
: "${BUILD:?}"
guide=docs/guide/library.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
fail() { echo "$*"; failed=1; }
block() { # block LANGUAGE FILE [NUMBER]
    awk -v opening="\`\`\`$1" -v wanted="${3:-1}" '$0 == opening { n++; on = n == wanted; next } /^```/ { on = 0 } on' "$2"
}

block c README.md >"$scratch/lift.c"
block c "$guide" >"$scratch/handler.c"
flags=(-std=c17 -Wall -Wextra -Iinclude -I"$BUILD/include")
"${CC:-cc}" "${flags[@]}" "$scratch/lift.c" "$scratch/handler.c" -o "$scratch/lift" -L"$BUILD" -lgough -lm || fail "the programs do not compile"
forces=$(LD_LIBRARY_PATH=$BUILD "$scratch/lift" | sed -n 's/^leg [1-6]: \(.*\) N$/\1/p' | tr '\n' ' ')
[[ $(wc -w <<<"$forces") -eq 6 ]] || fail "the README's program prints $forces"
if command -v python3 >/dev/null; then
    block python "$guide" >"$scratch/lift.py"
    said=$(python3 "$scratch/lift.py" "$BUILD/libgough.so") || fail "the program in Python does not run"
    [[ "$said " == "$forces" ]] || fail "Python computes $said, C $forces"
fi

block c "$guide" 2 >"$scratch/loop.c"
"${CC:-cc}" "${flags[@]}" "$scratch/loop.c" -o "$scratch/loop" -L"$BUILD" -lgough -lm || fail "the controller does not compile"
cat >"$scratch/loop.yaml" <<'STUDY'
units: {length: mm, force: N, mass: kg, angle: rad, time: s}
gravity: 9806.65
platform:
  base: {radius: 1500, half_angle: 0.14}
  top: {radius: 1100, half_angle: 0.14}
  height: 2000
load: {mass: 1050, inertia: [410e6, 520e6, 460e6]}
control: {stiffness: 400, damping: 15, sampling: {period: 0.001, velocity: difference}}
initial: {heave: 10}
simulation: {duration: 0.05, output_step: 0.05, method: rk4, step: 0.001}
STUDY
"${GOUGH:-$BUILD/gough}" simulate "$scratch/loop.yaml" -q -o "$scratch/loop.csv" || fail "the study of the controller does not run"
above=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "ez") c = i } END { printf "%.4f", $c }' "$scratch/loop.csv")
[[ $(LD_LIBRARY_PATH=$BUILD "$scratch/loop") == "$above mm above home after 0.05 s" ]] ||
    fail "the controller: $(LD_LIBRARY_PATH=$BUILD "$scratch/loop"); the study: $above mm"

# a law of one's own is that of the study, whose disturbance is the pull
block c "$guide" 3 >"$scratch/law.c"
"${CC:-cc}" "${flags[@]}" "$scratch/law.c" -o "$scratch/law" -L"$BUILD" -lgough -lm || fail "the law does not compile"
sed -e '/^initial/d; s/velocity: difference/velocity: exact/; s/^simulation.*/simulation: {duration: 0.5, output_step: 0.25}/' "$scratch/loop.yaml" >"$scratch/law.yaml"
echo 'disturbance: {leg_force: ["300", 0, 0, 0, 0, 0]}' >>"$scratch/law.yaml"
"${GOUGH:-$BUILD/gough}" simulate "$scratch/law.yaml" -q -o "$scratch/law.csv" || fail "the study of the law does not run"
above=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "ez") c = i } NR > 1 { printf "t = %.2f s: %.4f mm above home\n", $1, $c }' "$scratch/law.csv")
[[ $(LD_LIBRARY_PATH=$BUILD "$scratch/law") == "$above" && $(wc -l <<<"$above") == 3 ]] ||
    fail "the law: $(LD_LIBRARY_PATH=$BUILD "$scratch/law"); the study: $above"

# the matrix of the guide is that of the same study
block c "$guide" 4 >"$scratch/matrix.c"
"${CC:-cc}" "${flags[@]}" "$scratch/matrix.c" -o "$scratch/matrix" -L"$BUILD" -lgough-analyse -lgough -lm || fail "the matrix does not compile"
LD_LIBRARY_PATH=$BUILD "$scratch/matrix" >"$scratch/matrix.txt" || fail "the program of the matrix does not run"
cat >"$scratch/matrix.yaml" <<'STUDY'
units: {length: m, force: N, mass: kg, angle: rad, time: s}
platform: {base: {radius: 1.5, half_angle: 0.14}, top: {radius: 1.1, half_angle: 0.14}, height: 2}
load: {mass: 1050, inertia: [410, 520, 460]}
control: {stiffness: 4e5, damping: 1.5e4}
STUDY
"${GOUGH:-$BUILD/gough}" stability "$scratch/matrix.yaml" --matrix -q >"$scratch/matrix.csv" || fail "the study of the matrix does not run"
# four digits of each element; what rounding leaves of zeros is below 1e-9
digits() { awk '{ for (i = 1; i <= NF; i++) printf("%.4g ", $i > -1e-9 && $i < 1e-9 ? 0 : $i); print "" }'; }
[[ $(sed 's/.*= //' "$scratch/matrix.txt" | digits) == "$(sed '1d; s/,/ /g' "$scratch/matrix.csv" | digits)" ]] ||
    fail "the matrix: $(cat "$scratch/matrix.txt"); that of the study: $(cat "$scratch/matrix.csv")"
[[ $(sed 's/^d\(.*\)\/dt .*/\1/' "$scratch/matrix.txt" | paste -sd,) == "$(head -1 "$scratch/matrix.csv")" ]] ||
    fail "the rows of the matrix have other names than the columns of the study's: $(head -1 "$scratch/matrix.csv")"

# motion cueing prints what the guide says
block c "$guide" 5 >"$scratch/cues.c"
"${CC:-cc}" "${flags[@]}" "$scratch/cues.c" -o "$scratch/cues" -L"$BUILD" -lgough -lm || fail "the program of cues does not compile"
[[ $(LD_LIBRARY_PATH=$BUILD "$scratch/cues") == "$(grep '^after .* s: surge' "$guide")" ]] ||
    fail "the program of cues prints $(LD_LIBRARY_PATH=$BUILD "$scratch/cues")"

soname=$(readelf -d "$BUILD/libgough.so" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')
[[ $(grep -o 'libgough\.so\.[0-9.]*[0-9]' "$guide" | sort -u) == "$soname" ]] || fail "the guide names another library than $soname"
for header in include/gough/*.h; do
    name=$(basename "$header")
    [[ $name == gough.h || $name == analyse.h ]] || grep -q "include/gough/$name)" "$guide" || fail "the guide does not name $name"
done
exit $failed
