#!/usr/bin/env bash
# package-sizes.sh [PACKAGE…]: what the groups of install-packages.sh add, by apt's own numbers: build to a bare Debian, each other group
# to build. With packages as arguments, what each of them adds to a bare Debian. Nothing is installed.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v apt-get >/dev/null || { echo "There is no apt here." >&2; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# all that apt would install of these packages, and of what they need, where nothing is installed
closure() {
    apt-get -s -o Dir::State::status=/dev/null -o APT::Install-Recommends=false install "$@" 2>/dev/null |
        sed -n 's/^Inst \([^ :]*\).*/\1/p' | sort -u
}
sizes() { # sizes NAME FEWER MORE: packages and size of what MORE has and FEWER has not
    comm -13 "$2" "$3" >"$scratch/added"
    xargs -r apt-cache show --no-all-versions <"$scratch/added" | awk -v name="$1" '
        /^Package: / { n++ }
        /^Installed-Size: / { kib += $2 }
        END { printf "%-28s %4d packages %6.0f MiB\n", name, n, kib / 1024 }'
}
group() { sed -n "s/^$1 *| \([a-z0-9.+-]*\) *|.*/\1/p" scripts/install-packages.sh; }

mapfile -t bare < <(apt-cache dumpavail | awk '/^Package:/ { p = $2 } /^Priority: required/ || /^Essential: yes/ { print p }' | sort -u)
bare+=(apt)
closure "${bare[@]}" >"$scratch/bare"
if (($#)); then
    for package in "$@"; do
        closure "${bare[@]}" "$package" >"$scratch/more"
        sizes "$package" "$scratch/bare" "$scratch/more"
    done
    exit
fi
mapfile -t build < <(group build)
closure "${bare[@]}" "${build[@]}" >"$scratch/build"
sizes build "$scratch/bare" "$scratch/build"
for name in $(sed -n 's/^\([a-z]*\) *| [a-z0-9.+-]* *|.*/\1/p' scripts/install-packages.sh | uniq | grep -vx build); do
    mapfile -t packages < <(group "$name")
    closure "${bare[@]}" "${build[@]}" "${packages[@]}" >"$scratch/more"
    sizes "$name" "$scratch/build" "$scratch/more"
done
