#!/usr/bin/env bash
# A program compiled with the headers of another edition fails to link or to load; it never runs on wrong memory. Other languages
# find functions by name and edition, and sizes of structs by name.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
: "${BUILD:?}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compiler=${CC:-cc}
failed=0
fail() { echo "$*"; failed=1; }
edition=$(sed -n 's/^#define GOUGH_EDITION //p' "$BUILD/include/gough/version.h")
[[ $edition -ge 2 ]] || fail "no edition in version.h"

# no function is found under the name that earlier editions gave it
for library in "$BUILD"/libgough.so "$BUILD"/libgough-analyse.so "$BUILD"/libgough-files.so "$BUILD"/libgough.a; do
    dynamic=-D; [[ $library != *.a ]] || dynamic=
    names=$(nm $dynamic -g --defined-only "$library" | awk 'NF == 3 { print $3 }')
    [[ -n $names ]] || fail "$library has no functions"
    others=$(grep -vxE "gough_[a-z0-9_]+_e$edition|gough_version|gough_edition|gough_struct_size" <<<"$names" || true)
    [[ -z $others ]] || fail "$(basename "$library") has names without edition $edition:" $others
done

# a program of the edition before the names had one: it runs with its own library, and links and loads with no other
here=tests/install/earlier
mkdir "$scratch/own" "$scratch/renamed"
"$compiler" -std=c17 -shared -fPIC -Wl,-soname,libgough.so.0 -o "$scratch/own/libgough.so.0" "$here/library.c"
ln -s libgough.so.0 "$scratch/own/libgough.so"
ln -s "$(realpath "$BUILD/libgough.so")" "$scratch/renamed/libgough.so.0"
"$compiler" -std=c17 -c -o "$scratch/earlier.o" "$here/program.c"
for how in lazy now; do
    "$compiler" -Wl,-z,$how -o "$scratch/earlier-$how" "$scratch/earlier.o" -L"$scratch/own" -lgough
    for function in 0 1 2; do
        said=$(LD_LIBRARY_PATH=$scratch/own "$scratch/earlier-$how" $function) || fail "the earlier program does not run with its own library"
        [[ $said == ran ]] || fail "the earlier program with its own library: $said"
        for folder in "$BUILD" "$scratch/renamed"; do
            said=$(LD_LIBRARY_PATH=$folder "$scratch/earlier-$how" $function 2>&1) && fail "$how: an earlier program runs with this library: $said"
            [[ $said == *libgough.so.0*"cannot open"* || $said == *"undefined symbol: gough_"* ]] || fail "$how, $folder: $said"
        done
    done
done
for library in "-L$BUILD -lgough" "$BUILD/libgough.a"; do
    said=$("$compiler" -o "$scratch/linked" "$scratch/earlier.o" $library 2>&1) && fail "an earlier program links with $library"
    [[ $said == *"undefined reference to"*gough_simulation_default* ]] || fail "$library: $said"
done

# a program of the next edition
mkdir "$scratch/next"
cp -r include/gough "$scratch/next"
cp "$BUILD/include/gough/version.h" "$scratch/next/gough"
"$compiler" -std=c17 -I"$scratch/next" -o "$scratch/same" tests/install/program.c -L"$BUILD" -lgough -lm || fail "a program of this edition does not link"
sed -i "s/^#define GOUGH_EDITION .*/#define GOUGH_EDITION $((edition + 1))/" "$scratch/next/gough/version.h"
said=$("$compiler" -std=c17 -I"$scratch/next" -o "$scratch/linked" tests/install/program.c -L"$BUILD" -lgough -lm 2>&1) && fail "a program of another edition links"
[[ $said == *"gough_machine_init_e$((edition + 1))"* ]] || fail "$said"

# Python declares gough_simulation too short: no byte after it is written, and it cannot be used
if command -v python3 >/dev/null; then
    python3 - "$BUILD/libgough.so" <<'END' || fail "from Python"
import ctypes, sys
library = ctypes.CDLL(sys.argv[1])
library.gough_version.restype = ctypes.c_char_p
library.gough_struct_size.restype = ctypes.c_size_t
library.gough_struct_size.argtypes = [ctypes.c_char_p]
def function(name): return library[f"{name}_e{library.gough_edition()}"]
assert library.gough_version().decode().count(".") == 2
size = library.gough_struct_size(b"gough_simulation")
assert size > 100 and library.gough_struct_size(b"no such struct") == 0
room = ctypes.create_string_buffer(bytes([7]) * (size + 8), size + 8)
assert function("gough_simulation_init")(room, ctypes.c_size_t(size)) == 0
assert ctypes.c_size_t.from_buffer(room).value == size and ctypes.c_double.from_buffer(room, 8).value == 20
assert room.raw[size:] == bytes([7]) * 8
assert function("gough_simulation_init")(room, ctypes.c_size_t(size - 16)) == 2
assert room.raw[size - 16:size - 8] != bytes([255]) * 8 and room.raw[size:] == bytes([7]) * 8
END
fi
exit $failed
