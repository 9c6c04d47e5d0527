#!/usr/bin/env bash
# docs.sh BUILD: the API reference into BUILD/docs/html; a warning of Doxygen is an error.
set -euo pipefail
build=${1:-build}
mkdir -p "$build/docs"
{
    cat Doxyfile
    echo "OUTPUT_DIRECTORY = $build/docs"
    echo "PROJECT_NUMBER = $(sed -n 's/^project(gough VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
} | doxygen -
echo "$build/docs/html/index.html"
