#!/usr/bin/env bash
# dist.sh BUILD: a tarball of the sources in BUILD, with the bundled page and the revision, so that building it needs no npm, no compiler
# for WebAssembly, no git and no network. It has the tracked files as they are; the same commit, bundled by the same
# versions of clang, Vite and gzip, gives the same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
command -v git >/dev/null || { echo "dist.sh: git is missing, which lists the sources" >&2; exit 1; }
[[ -z $(git rev-parse --show-prefix) ]] || { echo "dist.sh: these sources are no git repository of their own" >&2; exit 1; }

version=$(sed -n 's/^project(gough VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
tagged=$(git tag --points-at HEAD | sed -n 's/^v\([0-9].*\)/\1/p')
[[ -z $tagged ]] || grep -qxF "$version" <<<"$tagged" ||
    { echo "dist.sh: the commit has the tag v$tagged, but CMakeLists.txt says VERSION $version; make them equal" >&2; exit 1; }
revision=$(cmake "-DSOURCE=$PWD" "-DVERSION=$version" -P cmake/revision.cmake 2>&1)
name=gough-$revision
cmake --build "$build" --target page_template >/dev/null

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
commit=$(git stash create) # tracked files that differ from the commit; empty if none does
git archive --prefix="$name/" "${commit:-HEAD}" | tar -x -C "$stage"
echo "$revision" >"$stage/$name/REVISION"
cp "$build/web/report.html" "$stage/$name/web/report.html"
tar -c -C "$stage" --sort=name --format=gnu --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX \
    --mtime="@$(git log -1 --format=%ct HEAD)" "$name" | gzip -9n >"$stage/$name.tar.gz"
mv "$stage/$name.tar.gz" "$build/$name.tar.gz"
echo "$build/$name.tar.gz"
