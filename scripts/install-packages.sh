#!/usr/bin/env bash
# install-packages.sh GROUP…: makes sure that what the groups need is there (build, test, demo, docs, lint, bench, package).
# Missing pieces are installed by apt, as root or with sudo. Without apt they are named, and the script stops.
set -euo pipefail

# group | Debian package | what tells that it is there
pieces() {
    cat <<'END'
build   | gcc              | command -v ${CC:-cc} && echo '#include <stdio.h>' | ${CC:-cc} -E -
build   | libc6-dev        | echo '#include <stdio.h>' | ${CC:-cc} -E -
build   | cmake            | command -v cmake
build   | ninja-build      | command -v ninja
build   | pkg-config       | command -v pkg-config
build   | libfyaml-dev     | pkg-config --exists libfyaml
build   | libhdf5-dev      | pkg-config --exists hdf5-serial
build   | libjansson-dev   | pkg-config --exists jansson
build   | liblapacke-dev   | pkg-config --exists lapacke
build   | gnuplot-nox      | command -v gnuplot
build   | clang            | command -v clang
build   | lld              | command -v wasm-ld
build   | wasi-libc        | test -e /usr/lib/wasm32-wasi/libc.a
build   | libclang-rt-14-dev-wasm32 | ls "$(clang -print-resource-dir)"/lib/wasi/libclang_rt.builtins-wasm32.a
build   | nodejs           | command -v node
build   | npm              | command -v npm
test    | check            | pkg-config --exists check
test    | chromium         | command -v chromium
test    | libclang-rt-dev  | ls "$(clang -print-resource-dir)"/lib/*/libclang_rt.fuzzer*
test    | binutils         | command -v nm
test    | dpkg-dev         | command -v dpkg-shlibdeps || ! command -v dpkg
test    | file             | command -v file
test    | locales          | test -e /usr/share/i18n/locales/de_DE
test    | hdf5-tools       | command -v h5dump
test    | netcdf-bin       | command -v ncdump
test    | clang-format     | command -v clang-format
test    | man-db           | command -v man
test    | jq               | command -v jq
test    | python3          | command -v python3
test    | doxygen          | command -v doxygen
docs    | doxygen          | command -v doxygen
lint    | clang-format     | command -v clang-format
lint    | clang-tidy       | command -v clang-tidy
lint    | cppcheck         | command -v cppcheck
lint    | shellcheck       | command -v shellcheck
bench   | g++              | command -v g++
bench   | libmujoco-dev    | test -e /usr/include/mujoco/mujoco.h
bench   | libsundials-dev  | test -e /usr/include/cvode/cvode.h
bench   | libgsl-dev       | pkg-config --exists gsl
package | dpkg-dev         | command -v dpkg-shlibdeps
package | file             | command -v file
package | lintian          | command -v lintian
END
}

present() { (eval "$1") >/dev/null 2>&1; }

missing=()
while IFS='|' read -r group package probe; do
    group=${group// /} package=${package// /}
    for wanted in "$@"; do
        if [[ $group == "$wanted" ]] && ! present "$probe" && [[ " ${missing[*]:-} " != *" $package "* ]]; then
            missing+=("$package")
        fi
    done
done < <(pieces)
((${#missing[@]})) || exit 0

if ! command -v apt-get >/dev/null; then
    {
        echo "Missing: ${missing[*]}"
        echo "These are the names of Debian packages. This system has no apt: install what they hold with its own package manager, then run make again."
    } >&2
    exit 1
fi
as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        {
            echo "Missing: ${missing[*]}"
            echo "Installing them needs root: run 'apt-get install ${missing[*]}' as root, then make again."
        } >&2
        exit 1
    fi
    as_root=(sudo)
fi

echo "Installing what is missing: ${missing[*]}" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
install() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}" </dev/null; }
if ! install >"$log" 2>&1; then
    # the lists of packages may be old, or not there yet
    if ! { "${as_root[@]}" apt-get update -q </dev/null && install; } >"$log" 2>&1; then
        cat "$log" >&2
        echo "The packages could not be installed; the lines above say why." >&2
        exit 1
    fi
fi
