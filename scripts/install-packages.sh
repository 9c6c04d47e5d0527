#!/usr/bin/env bash
# install-packages.sh GROUP…: makes sure that the packages of these groups are there. Missing ones are installed by apt, as root or with
# sudo. Without apt they are named, and the script stops. scripts/package-sizes.sh prints the size of each group. With GOUGH_PAGE=OFF in the
# environment the groups that only the page needs are passed over.
set -euo pipefail

# group | what it is for. Each group stands on those above it that a step of the Makefile asks for with it.
groups() {
    cat <<'END'
compiler    | compiling C
tools       | configuring and building
libraries   | headers and libraries that the library and the command are linked with
figures     | `gough plot` at run time
bundler     | bundling the page: Node.js and npm, which fetches Vite and the page's packages
webassembly | compiling the page's core
python      | building the package for Python, and its wheel
test        | tests of the library and the command
pytest      | tests of the package for Python
format      | the test of the formatting, and `make lint`
docs        | the API reference, and the test that it is complete
browser     | tests of the page
package     | making the Debian packages, and the test of them
lintian     | checking the Debian packages
dist        | making the source tarball
fuzz        | fuzzing with libFuzzer
lint        | static analysis
counts      | benchmarks: counting operations
peers       | benchmarks: timings beside MuJoCo and GSL
mpi         | building gough-mpi, and running it
engines     | the tests of the recipes for GNU parallel, Dask and Slurm
sundials    | benchmarks: timings beside SUNDIALS
musl        | building the core with the C library musl
END
}

# group | Debian package | what tells that it is there
pieces() {
    cat <<'END'
compiler  | gcc              | echo | ${CC:-cc} -E -
compiler  | binutils         | command -v nm
tools     | cmake            | command -v cmake
tools     | ninja-build      | command -v ninja
tools     | pkg-config       | command -v pkg-config
libraries | libc6-dev        | echo '#include <stdio.h>' | ${CC:-cc} -E -
libraries | libfyaml-dev     | pkg-config --exists libfyaml
libraries | libhdf5-dev      | pkg-config --exists hdf5-serial
libraries | libjansson-dev   | pkg-config --exists jansson
libraries | liblapacke-dev   | pkg-config --exists lapacke
libraries | libnlopt-dev     | pkg-config --exists nlopt
libraries | zlib1g-dev       | pkg-config --exists zlib
figures   | gnuplot-nox      | command -v gnuplot
bundler   | nodejs           | command -v node
bundler   | npm              | command -v npm
webassembly | clang          | command -v clang
webassembly | lld            | command -v wasm-ld
webassembly | wasi-libc      | test -e /usr/lib/wasm32-wasi/libc.a
webassembly | libclang-rt-14-dev-wasm32 | ls "$(clang -print-resource-dir)"/lib/wasi/libclang_rt.builtins-wasm32.a
python    | python3-dev      | test -e "$(/usr/bin/python3 -c 'import sysconfig; print(sysconfig.get_path("include"))')/Python.h"
python    | python3-numpy    | /usr/bin/python3 -c 'import numpy'
python    | python3-setuptools | /usr/bin/python3 -c 'import setuptools'
python    | python3-wheel    | /usr/bin/python3 -c 'import wheel'
test      | check            | pkg-config --exists check
test      | hdf5-tools       | command -v h5dump
test      | jq               | command -v jq
test      | libmpfi-dev      | test -e /usr/include/mpfi.h
test      | locales          | test -e /usr/share/i18n/locales/de_DE
test      | man-db           | command -v man
test      | netcdf-bin       | command -v ncdump
test      | python3          | command -v python3
pytest    | python3-pytest   | /usr/bin/python3 -c 'import pytest'
pytest    | python3-xarray   | /usr/bin/python3 -c 'import xarray, pandas'
format    | clang-format     | command -v clang-format
docs      | doxygen          | command -v doxygen
browser   | chromium         | command -v chromium
browser   | poppler-utils    | command -v pdftotext
package   | dpkg-dev         | command -v dpkg-shlibdeps
package   | file             | command -v file
lintian   | lintian          | command -v lintian
dist      | git              | command -v git
fuzz      | libclang-rt-dev  | ls "$(clang -print-resource-dir)"/lib/*/libclang_rt.fuzzer*
lint      | clang-tidy       | command -v clang-tidy
lint      | cppcheck         | command -v cppcheck
lint      | shellcheck       | command -v shellcheck
counts    | g++              | command -v g++
peers     | libgsl-dev       | pkg-config --exists gsl
peers     | libmujoco-dev    | test -e /usr/include/mujoco/mujoco.h
mpi       | libopenmpi-dev   | command -v mpicc
mpi       | openmpi-bin      | command -v mpirun
engines   | parallel         | command -v parallel
engines   | python3-distributed | /usr/bin/python3 -c 'import distributed'
engines   | slurm-wlm        | PATH=$PATH:/usr/sbin command -v slurmctld
sundials  | libsundials-dev  | test -e /usr/include/cvode/cvode.h
musl      | musl-tools       | command -v musl-gcc
END
}

for wanted in "$@"; do
    groups | grep -q "^$wanted *|" || {
        echo "install-packages.sh: there is no group '$wanted'; the groups are $(groups | awk '{ printf "%s%s", (NR > 1 ? ", " : ""), $1 }')" >&2
        exit 2
    }
done

# groups that only the page of `gough report` needs
of_page=(bundler webassembly browser)
wanted_groups=()
for wanted in "$@"; do
    [[ ${GOUGH_PAGE:-ON} == OFF && " ${of_page[*]} " == *" $wanted "* ]] || wanted_groups+=("$wanted")
done

present() { (eval "$1") >/dev/null 2>&1; }

missing=() page_only=()
while IFS='|' read -r group package probe; do
    group=${group// /} package=${package// /}
    for wanted in "${wanted_groups[@]}"; do
        if [[ $group == "$wanted" ]] && ! present "$probe" && [[ " ${missing[*]:-} " != *" $package "* ]]; then
            missing+=("$package")
            [[ " ${of_page[*]} " != *" $group "* ]] || page_only+=("$package")
        fi
    done
done < <(pieces)
((${#missing[@]})) || exit 0

# what the user can do without
without_page() {
    ((${#page_only[@]} == 0)) ||
        echo "Only the page of \`gough report\` needs ${page_only[*]}: 'make PAGE=OFF' (for CMake -DGOUGH_PAGE=OFF) builds everything else."
}

if ! command -v apt-get >/dev/null; then
    {
        echo "Missing: ${missing[*]}"
        echo "These are the names of Debian packages. This system has no apt: install what they hold with its own package manager, then run make again."
        without_page
    } >&2
    exit 1
fi
as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        {
            echo "Missing: ${missing[*]}"
            echo "Installing them needs root: run 'apt-get install ${missing[*]}' as root, then make again."
            without_page
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
        without_page >&2
        exit 1
    fi
fi
