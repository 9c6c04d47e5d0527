#!/usr/bin/env bash
# The source tarball has the same bytes whenever it is made, and it builds without npm, a compiler for WebAssembly, git and a network:
# the command, its page, a few tests. It says how the network was kept away.
# Label: campaign: compiles the library once more
set -euo pipefail
: "${BUILD:?}" "${SOURCE:?}"
[[ -e $BUILD/web/report.html ]] || { echo "skipped: the page was not bundled in this build"; exit 77; }
command -v git >/dev/null && git -C "$SOURCE" rev-parse HEAD >/dev/null 2>&1 || { echo "skipped: the sources are not in a git repository"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

first=$("$SOURCE/scripts/dist.sh" "$BUILD")
cp "$first" "$scratch/first.tar.gz"
sleep 1.1 # a time stamp in whole seconds would be another one
second=$(umask 077; "$SOURCE/scripts/dist.sh" "$BUILD")
[[ $first == "$second" ]] || { echo "the second tarball is called $second, the first $first"; exit 1; }
cmp "$scratch/first.tar.gz" "$second"
name=$(basename "$first" .tar.gz)
bytes=$(stat -c %s "$first")
told=$(sed -n 's/^The source tarball has \([0-9.]*\) MB.*/\1/p' "$SOURCE/README.md")
awk -v bytes="$bytes" -v told="$told" 'BEGIN { exit !(bytes >= told * 0.9e6 && bytes <= told * 1.1e6) }' ||
    { echo "the tarball has $bytes bytes; the README says ${told:-nothing} MB"; exit 1; }
echo "$name.tar.gz: $bytes bytes, $(tar -tzf "$first" | wc -l) files and folders, twice the same"

# without what the tarball makes unnecessary
mkdir "$scratch/bin"
find /usr/bin /bin /usr/local/bin -maxdepth 1 \( -type f -o -type l \) -exec ln -sf -t "$scratch/bin" {} + 2>/dev/null || true
for tool in node nodejs npm npx git clang wasm-ld; do rm -f "$scratch/bin/$tool" "$scratch/bin/$tool"-[0-9]*; done
export PATH=$scratch/bin
if unshare -rn true 2>/dev/null; then
    away=(unshare -rn)
    echo "no network: in a namespace of its own"
else
    away=(env http_proxy=http://127.0.0.1:9 https_proxy=http://127.0.0.1:9 no_proxy=)
    echo "no network: proxies that do not answer, for this system allows no namespaces"
fi
tar -xzf "$first" -C "$scratch"
cd "$scratch/$name"
"${away[@]}" cmake -S . -B build -G Ninja >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
grep -q "building without tests" "$scratch/log" && tests=() || tests=(test_kernel_body test_study_keys test_sweep_part)
"${away[@]}" cmake --build build --target gough_command gough_archive "${tests[@]}" >"$scratch/log" 2>&1 || { tail -30 "$scratch/log"; exit 1; }
said=$(build/gough --version)
version=$(sed -n 's/^project(gough VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
expected="gough $version"
[[ ${name#gough-} == "$version" ]] || expected+=" (${name#gough-})"
[[ $said == "$expected" ]] || { echo "the command built says '$said' instead of '$expected'"; exit 1; }
build/gough report examples/own-machine.yaml -q -o page.html
"$BUILD/gough" report examples/own-machine.yaml -q -o "$scratch/page.html"
cmp page.html "$scratch/page.html"
if ((${#tests[@]})); then
    "${away[@]}" ctest --test-dir build -R '^(kernel/body|study/keys|sweep/part)$' --output-on-failure
    "${away[@]}" ctest --test-dir build -R '^cli/(summary|sweep)$' --output-on-failure
fi
