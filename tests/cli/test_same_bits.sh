#!/usr/bin/env bash
# The same bits from GCC and Clang, without and with optimisation, run to run, alone and in lanes, in any locale, time zone
# and folder; and no compiler has a warning.
# Label: campaign. Not sanitized: it builds commands of its own.
source "$(dirname "$0")/support.sh"

"$GOUGH" example all-six >"$scratch/six.yaml"
"$GOUGH" example paper-perturbed >"$scratch/perturbed.yaml"
"$GOUGH" example gain-sweep >"$scratch/gain.yaml"
"$GOUGH" example load-uncertainty >"$scratch/load.yaml"
"$GOUGH" example gain-sweep >"$scratch/sweep.yaml"
digest() { # digest COMMAND: of tables that between them use every stepper and both precisions
    local command=$1
    {
        "$command" forces "$scratch/six.yaml" -q --reactions -o -
        "$command" simulate "$scratch/six.yaml" -q --reactions --set control.stiffness=20 --set control.damping=1 -o -
        for method in rk4 rattle2 rattle4 rattle6 rattle8; do
            "$command" simulate "$scratch/six.yaml" -q --set control.stiffness=20 --set control.damping=1 -o - \
                --set "simulation={duration: 3, output_step: 0.05, method: $method, step: 0.025}"
        done
        "$command" simulate "$scratch/perturbed.yaml" -q -o -
        "$command" sweep "$scratch/gain.yaml" -q -o -
        "$command" sweep "$scratch/load.yaml" -q --set sweep.runs=40 --set simulation.step=0.005 -o -
        for method in rk4 dop853 rattle4; do # many runs in lanes, the widest that the processor has
            "$command" sweep "$scratch/sweep.yaml" -q -o - --set control.damping=0.1 \
                --set "simulation={duration: 3, output_step: 0.05, method: $method, step: 0.025}"
        done
        "$command" stability "$scratch/perturbed.yaml" --set control.stiffness=2 --set control.damping=0.01 --json
        "$command" stability "$scratch/perturbed.yaml" -q --sweep-stiffness 0.5:2:31 --sweep-amplitude 0:1:3 -o -
        "$command" simulate "$scratch/six.yaml" -q --precision quad --set simulation.duration=1 --set control.stiffness=20 -o -
    } 2>"$scratch/err" | sha256sum
    [[ ! -s $scratch/err ]] || head -3 "$scratch/err"
}
build() { # build NAME FLAG…: the command alone, from another compiler or at another level
    local folder=$BUILD/bits-$1
    shift
    cmake -S "$SOURCE" -B "$folder" -G Ninja -DGOUGH_TESTS=OFF -DGOUGH_PAGE=OFF -DGOUGH_WERROR=ON -DCMAKE_BUILD_TYPE=Release "$@" >"$scratch/log" 2>&1 &&
        cmake --build "$folder" --target gough_command >>"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
    other=$folder/gough
}

reference=$(digest "$GOUGH")
[[ $reference =~ ^[0-9a-f]{64}\ *-$ ]] || fail "a run fails: $reference"
[[ $(digest "$GOUGH") == "$reference" ]] || fail "a second run differs"
(cd / && [[ $(TZ=Asia/Tokyo digest "$GOUGH") == "$reference" ]]) || fail "another folder and time zone differ"

# a locale whose decimal sign is a comma
if [[ -e /usr/share/i18n/locales/de_DE ]] && command -v localedef >/dev/null; then
    in_comma_locale() { LOCPATH=$scratch/locales LC_ALL=de_DE.UTF-8 "$GOUGH" "$@"; }
    mkdir "$scratch/locales"
    localedef -i de_DE -f UTF-8 "$scratch/locales/de_DE.UTF-8" 2>/dev/null
    [[ $(digest in_comma_locale) == "$reference" ]] || fail "a comma locale differs"
else
    echo "no comma locale tried: the package locales is missing"
fi

build gcc-O0 -DCMAKE_C_COMPILER=gcc -DCMAKE_C_FLAGS_RELEASE="-O0"
[[ $(digest "$other") == "$reference" ]] || fail "GCC -O0 differs"
build gcc-O3 -DCMAKE_C_COMPILER=gcc -DCMAKE_C_FLAGS_RELEASE="-O3 -DNDEBUG"
[[ $(digest "$other") == "$reference" ]] || fail "GCC -O3 differs"
if command -v clang >/dev/null; then
    build clang-O1 -DCMAKE_C_COMPILER=clang -DCMAKE_C_FLAGS_RELEASE="-O1 -DNDEBUG"
    [[ $(digest "$other") == "$reference" ]] || fail "Clang -O1 differs"
    build clang-O2 -DCMAKE_C_COMPILER=clang
    [[ $(digest "$other") == "$reference" ]] || fail "Clang -O2 differs"
else
    echo "Clang not tried: it is missing"
fi
finish
