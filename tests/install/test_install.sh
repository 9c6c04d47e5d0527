#!/usr/bin/env bash
# What is installed can be used: by pkg-config, by CMake, as static library, as command.
source "$(dirname "$0")/use.sh"
DESTDIR="" cmake --install "$BUILD" --prefix "$scratch/prefix" >/dev/null
use_package "$scratch/prefix"
# until 1.0 a library is named after its minor version too: another one is not loaded in its place
version=$(sed -n 's/^#define GOUGH_VERSION "\([0-9]*\.[0-9]*\)\..*/\1/p' "$scratch/prefix/include/gough/version.h")
for name in gough gough-analyse gough-files; do
    library=$(find "$scratch/prefix" -name "lib$name.so")
    readelf -d "$library" | grep -q "SONAME.*\[lib$name\.so\.$version\]" || { echo "lib$name.so has another SONAME than lib$name.so.$version"; exit 1; }
done
# a package maker's way: DESTDIR before the prefix
DESTDIR=$scratch/stage cmake --install "$BUILD" --prefix /usr/local >/dev/null
[[ -x $scratch/stage/usr/local/bin/gough ]] || { echo "DESTDIR is not honoured"; exit 1; }
