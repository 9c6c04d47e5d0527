#!/usr/bin/env bash
# What is installed can be used: by pkg-config, by CMake, as static library, as command.
source "$(dirname "$0")/use.sh"
DESTDIR="" cmake --install "$BUILD" --prefix "$scratch/prefix" >/dev/null
use_package "$scratch/prefix"
# a package maker's way: DESTDIR before the prefix
DESTDIR=$scratch/stage cmake --install "$BUILD" --prefix /usr/local >/dev/null
[[ -x $scratch/stage/usr/local/bin/gough ]] || { echo "DESTDIR is not honoured"; exit 1; }
