#!/usr/bin/env bash
# A failed assertion stops the program, silently, or calls the program's own handler; in the shared and the static library.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
: "${BUILD:?}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compiler=${CC:-cc}
failed=0
ulimit -c 0
export LD_LIBRARY_PATH=$BUILD
for library in "-L$BUILD -lgough" "$BUILD/libgough.a $(sed -n 's/^Libs.private: *//p' "$BUILD/gough.pc")"; do
    for handler in "" -DHANDLER; do
        "$compiler" -std=c17 $handler -Iinclude -I"$BUILD/include" -o "$scratch/program" tests/install/handler.c $library -lm
        rc=0
        { said=$("$scratch/program" 2>&1); } 2>/dev/null || rc=$?
        wanted=134:aligned # SIGABRT
        [[ -z $handler ]] || wanted=$'7:aligned\nbatch.c, a line: (uintptr_t)memory % ALIGNMENT == 0'
        [[ $rc:$said == "$wanted" ]] || { echo "$library $handler: $rc:$said instead of $wanted"; failed=1; }
    done
done
exit $failed
