#!/usr/bin/env bash
# The Debian packages can be built, each holds what its name says and names what it needs, together they can be used, and lintian has
# nothing against them but the address of the maintainer.
# Label: campaign: a build of its own, which needs the packages that only `make package` does
source "$(dirname "$0")/use.sh"
for tool in dpkg-deb dpkg-shlibdeps; do
    command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
package_build=$BUILD/package
cmake -S "$SOURCE" -B "$package_build" -G Ninja -DCMAKE_INSTALL_PREFIX=/usr -DGOUGH_TESTS=OFF >/dev/null
cmake --build "$package_build" >/dev/null
(cd "$package_build" && cpack -G DEB -B "$scratch" >"$scratch/log" 2>&1) || { cat "$scratch/log"; exit 1; }

# holds NAME FILE…: the package has these files
holds() {
    local name=$1 list file
    shift
    list=$(dpkg-deb -c "$scratch/${name}"_*.deb | awk '{ print $6 }')
    for file in "$@"; do
        grep -qE "^\./usr/$file\$" <<<"$list" || { echo "$name has no $file: $list"; exit 1; }
    done
    # the table of the README has its size, in MB
    local bytes told
    bytes=$(stat -c %s "$scratch/${name}"_*.deb)
    told=$(sed -n "s/^| \`$name\` |.*| \([0-9.]*\) |\$/\1/p" "$SOURCE/README.md")
    awk -v bytes="$bytes" -v told="$told" 'BEGIN { exit !(bytes >= told * 0.9e6 && bytes <= told * 1.1e6) }' ||
        { echo "$name has $bytes bytes; the README says ${told:-nothing} MB"; exit 1; }
    echo "ok: $name, $bytes bytes"
}
# needs NAME PACKAGE…
needs() {
    local name=$1 depends package
    shift
    depends=$(dpkg-deb -f "$scratch/${name}"_*.deb Depends)
    for package in "$@"; do
        [[ $depends == *$package* ]] || { echo "$name does not depend on $package: $depends"; exit 1; }
    done
}
library=libgough$(sed -n 's/^project(gough VERSION \([0-9]*\.[0-9]*\).*/\1/p' "$SOURCE/CMakeLists.txt")
holds gough bin/gough share/man/man1/gough.1.gz
holds "$library" 'lib/.*/libgough\.so\.[0-9.]*' 'lib/.*/libgough-analyse\.so\.[0-9.]*' 'lib/.*/libgough-files\.so\.[0-9.]*'
holds libgough-dev include/gough/gough.h 'lib/.*/libgough.so' 'lib/.*/libgough.a' 'lib/.*/libgough-files.a' 'lib/.*/pkgconfig/gough.pc' 'lib/.*/cmake/gough/gough-config.cmake'
holds gough-doc share/doc/gough/README.md share/doc/gough/guide/sweep.md share/doc/gough/images/page.png share/doc/gough/examples/own-machine.yaml
needs gough libc6 libfyaml0 libhdf5 libjansson4 libnlopt0 libquadmath0 zlib1g
needs "$library" libc6 libfyaml0 libhdf5 libnlopt0 libquadmath0
needs libgough-dev "$library"
if ls "$scratch"/python3-gough_*.deb >/dev/null 2>&1; then
    holds python3-gough lib/python3/dist-packages/gough/__init__.py 'lib/python3/dist-packages/gough/_gough.*\.so'
    needs python3-gough python3-numpy 'gough (='
fi
if ls "$scratch"/gough-mpi_*.deb >/dev/null 2>&1; then
    holds gough-mpi bin/gough-mpi share/man/man1/gough-mpi.1.gz
    needs gough-mpi openmpi-bin libopenmpi
fi
# no file is in two packages
twice=$(for package in "$scratch"/*.deb; do dpkg-deb -c "$package" | awk '$6 !~ /\/$/ { print $6 }'; done | sort | uniq -d)
[[ -z $twice ]] || { echo "in two packages: $twice"; exit 1; }

mkdir "$scratch/unpacked"
for package in "$scratch"/*.deb; do dpkg-deb -x "$package" "$scratch/unpacked"; done
use_package "$scratch/unpacked/usr"
if [[ -e $scratch/unpacked/usr/lib/python3/dist-packages/gough/__init__.py ]]; then
    mass=$(PATH=$scratch/unpacked/usr/bin:$PATH PYTHONPATH=$scratch/unpacked/usr/lib/python3/dist-packages /usr/bin/python3 -c \
        "import gough, sys; print(len(gough.forces(sys.argv[1])['f1']))" "$SOURCE/examples/own-machine.yaml")
    ((mass > 10)) || { echo "python3-gough computes $mass rows"; exit 1; }
    echo "ok: python3-gough"
fi
if ! command -v lintian >/dev/null; then
    echo "lintian was not asked: it is not installed (Debian package lintian)"
    exit 0
fi
for package in "$scratch"/*.deb; do
    complaints=$(lintian --tag-display-limit 0 --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$package" 2>/dev/null | grep '^[EW]:' || true)
    [[ -z $complaints ]] || { echo "$complaints"; exit 1; }
done
echo "ok: lintian"
