#!/usr/bin/env bash
# The page's source keeps the house's form; its packages are pinned without addresses to download from; text of a study has no
# way into markup or code.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
failed=0
fail() { echo "$*"; failed=1; }

# each version stands fast, and each package by its digest
grep -nE '"[~^*><]|"latest"' web/package.json | grep -v '"node"' && fail "web/package.json: a version is not exact"
grep -n '"resolved"' web/package-lock.json && fail "web/package-lock.json names an address"
(($(grep -c '"integrity"' web/package-lock.json) > 10)) || fail "web/package-lock.json has no digests"
grep -qx 'omit-lockfile-registry-resolved=true' web/.npmrc || fail "web/.npmrc would let npm write addresses into the lock file"

for file in web/src/*.js web/vite.config.js tests/web/*.mjs; do
    head -1 "$file" | grep -q '^//' || fail "$file: its first line does not say what it does"
done
grep -nE 'innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function|createContextualFragment' web/src/*.js &&
    fail "the page makes markup or code of text"
(($(grep -c 'id="gough-data">null</script>' web/index.html) == 1)) || fail "web/index.html has not one place for the data"
exit $failed
