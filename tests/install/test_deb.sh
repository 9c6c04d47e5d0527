#!/usr/bin/env bash
# The Debian package can be built, holds what is used, and names what it needs.
# Label: campaign: a build of its own, which needs the packages that only `make package` does
source "$(dirname "$0")/use.sh"
for tool in dpkg-deb dpkg-shlibdeps; do
    command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
package_build=$BUILD/package
cmake -S "$SOURCE" -B "$package_build" -G Ninja -DCMAKE_INSTALL_PREFIX=/usr -DGOUGH_TESTS=OFF >/dev/null
cmake --build "$package_build" >/dev/null
(cd "$package_build" && cpack -G DEB -B "$scratch" >"$scratch/log" 2>&1) || { cat "$scratch/log"; exit 1; }
package=$(ls "$scratch"/gough_*.deb)
mkdir "$scratch/unpacked"
dpkg-deb -x "$package" "$scratch/unpacked"
needs=$(dpkg-deb -f "$package" Depends)
for library in libc6 libfyaml0 libhdf5 libjansson4 libnlopt0 libquadmath0; do
    [[ $needs == *$library* ]] || { echo "the package does not depend on $library: $needs"; exit 1; }
done
use_package "$scratch/unpacked/usr"
if command -v lintian >/dev/null; then
    complaints=$(lintian --tag-display-limit 0 --suppress-tags bogus-mail-host "$package" 2>/dev/null | grep '^E:' || true)
    [[ -z $complaints ]] || { echo "$complaints"; exit 1; }
fi
