#!/usr/bin/env bash
# package-sizes.sh [PACKAGE…]: what the groups of install-packages.sh install, by apt's own numbers: beside the groups above them in the
# table, and by themselves on a bare Debian. With packages as arguments, what each of them adds to a bare Debian. Nothing is installed.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v apt-get >/dev/null || { echo "There is no apt here." >&2; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
nothing=(-o Dir::State::status=/dev/null -o APT::Install-Recommends=false) # as if nothing were installed

# all that apt would install of these packages, and of what they need
closure() { apt-get -s "${nothing[@]}" install "$@" 2>/dev/null | sed -n 's/^Inst \([^ :]*\).*/\1/p' | sort -u; }
sizes() { # sizes FEWER MORE: "packages MiB" of what MORE has and FEWER has not
    comm -13 "$1" "$2" >"$scratch/added"
    xargs -r apt-cache "${nothing[@]}" show --no-all-versions <"$scratch/added" | awk '
        /^Package: / { n++ }
        /^Installed-Size: / { kib += $2 }
        END { printf "%d %.0f\n", n, kib / 1024 }'
}
listed() { sed -n "/^$1() {/,/^END/p" scripts/install-packages.sh | sed -n 's/ *| /|/gp'; }

mapfile -t bare < <(apt-cache "${nothing[@]}" dumpavail |
    awk '/^Package:/ { p = $2 } /^Priority: required/ || /^Essential: yes/ { print p }' | sort -u)
bare+=(apt)
closure "${bare[@]}" >"$scratch/bare"
if (($#)); then
    for package in "$@"; do
        closure "${bare[@]}" "$package" >"$scratch/more"
        read -r count size < <(sizes "$scratch/bare" "$scratch/more")
        printf '%-28s %4d packages %6d MiB\n' "$package" "$count" "$size"
    done
    exit
fi
echo '| group | for | packages | MiB beside those above | MiB alone |'
echo '|---|---|---|---|---|'
above=()
cp "$scratch/bare" "$scratch/above"
while IFS='|' read -r group purpose; do
    mapfile -t packages < <(listed pieces | awk -F'|' -v group="$group" '$1 == group { print $2 }')
    closure "${bare[@]}" "${packages[@]}" >"$scratch/alone"
    above+=("${packages[@]}")
    closure "${bare[@]}" "${above[@]}" >"$scratch/more"
    read -r _ alone < <(sizes "$scratch/bare" "$scratch/alone")
    read -r _ beside < <(sizes "$scratch/above" "$scratch/more")
    names=${packages[*]}
    echo "| \`$group\` | $purpose | ${names// /, } | $beside | $alone |"
    mv "$scratch/more" "$scratch/above"
done < <(listed groups)
