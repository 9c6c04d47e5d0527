#!/usr/bin/env bash
# A program linked to libgough.a has only the functions that it calls, and may give its own functions any name that does not begin with
# gough_.
set -euo pipefail
: "${BUILD:?}" "${SOURCE:?}"
archive=$BUILD/libgough.a
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compiler=${CC:-cc}
headers=(-I"$SOURCE/include" -I"$BUILD/include")
if nm -u "$archive" 2>/dev/null | grep -q __asan; then echo "skipped: built with sanitizers"; exit 77; fi

"$compiler" -std=c17 -O2 "${headers[@]}" -o "$scratch/program" "$SOURCE/tests/install/program.c" "$archive" -Wl,--gc-sections -lquadmath -lm -pthread
[[ $("$scratch/program") == 1.000000000000 ]] || { echo "the program prints $("$scratch/program")"; exit 1; }
text=$(size "$scratch/program" | awk 'NR == 2 { print $1 }')
echo "a program that calls gough_inverse_dynamics(): $text bytes of text"
((text <= 150000)) || { echo "more than 150 kB"; exit 1; }
told=$(tr '\n' ' ' <"$SOURCE/README.md" | sed -n 's/.*--gc-sections` has \([0-9]*\) kB of *text.*/\1/p')
((text >= told * 900 && text <= told * 1100)) || { echo "the README says ${told:-nothing} kB"; exit 1; }

# an object for each source, none of whose inner names is left
(($(ar t "$archive" | wc -l) > 50)) || { echo "the archive has $(ar t "$archive" | wc -l) objects"; exit 1; }
names=$(cut -d' ' -f1 "$archive.names")
(($(wc -w <<<"$names") > 50)) || { echo "too few inner names: $names"; exit 1; }
for name in $names; do echo "int $name(void); int $name(void) { return 1; }"; done >"$scratch/own.c"
"$compiler" -std=c17 -O2 -fno-builtin "${headers[@]}" -o "$scratch/both" "$SOURCE/tests/install/program.c" "$scratch/own.c" \
    -Wl,--whole-archive "$archive" -Wl,--no-whole-archive -lquadmath -lm -pthread 2>"$scratch/err" || { head -5 "$scratch/err"; exit 1; }
[[ $("$scratch/both") == 1.000000000000 ]] || { echo "beside names of its own the program prints $("$scratch/both")"; exit 1; }
