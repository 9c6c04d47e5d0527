#!/usr/bin/env bash
# scripts/install-packages.sh: silent when all is there; without apt, and without root or sudo, it names what is missing
# and stops. Tried with folders of links in place of /usr/bin. Each package stands in one group, the Makefile asks only for groups that
# there are and for each of them somewhere, and CONTRIBUTING lists the groups with their packages.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bash=$(command -v bash)
build=(compiler tools libraries figures)

# path_without NAME…: a folder with every program of the system but these
path_without() {
    local folder=$scratch/$1
    mkdir "$folder"
    find /usr/bin /bin /usr/local/bin -maxdepth 1 \( -type f -o -type l \) -exec ln -sf -t "$folder" {} + 2>/dev/null || true
    for name in "$@"; do rm -f "$folder/$name"; done
    echo "$folder"
}
refused() { # refused PATH WORD…: exit 1, the words on standard error
    local path=$1 said word
    shift
    if said=$(PATH=$path "$bash" scripts/install-packages.sh "${build[@]}" 2>&1 </dev/null); then
        echo "with $(basename "$path") missing it goes on"
        exit 1
    fi
    for word in "$@"; do
        [[ $said == *"$word"* ]] || { echo "it does not say '$word' but: $said"; exit 1; }
    done
}

said=$("$bash" scripts/install-packages.sh "${build[@]}" 2>&1)
[[ -z $said ]] || { echo "with all there it says: $said"; exit 1; }
refused "$(path_without ninja apt-get apt)" "Missing: ninja-build" "no apt"
if ((EUID != 0)); then
    refused "$(path_without cmake sudo)" "Missing: cmake" "apt-get install cmake"
elif command -v setpriv >/dev/null; then
    folder=$(path_without cmake sudo)
    chmod 755 "$scratch"
    cp scripts/install-packages.sh "$scratch/script"
    said=$(PATH=$folder setpriv --reuid 65534 --clear-groups "$bash" "$scratch/script" "${build[@]}" 2>&1 </dev/null) && { echo "without root it goes on"; exit 1; }
    [[ $said == *"Missing: cmake"*"apt-get install cmake"* ]] || { echo "without root it says: $said"; exit 1; }
fi
# what only the page needs is not asked for without it, and is named as such where it is missing
bare=$(path_without node npm clang wasm-ld apt-get apt)
said=$(PATH=$bare "$bash" scripts/install-packages.sh "${build[@]}" bundler 2>&1 </dev/null) && { echo "without npm it goes on"; exit 1; }
[[ $said == *"Only the page"*"nodejs npm"*"make PAGE=OFF"*"-DGOUGH_PAGE=OFF"* ]] || { echo "without npm it says: $said"; exit 1; }
said=$(PATH=$bare GOUGH_PAGE=OFF "$bash" scripts/install-packages.sh "${build[@]}" bundler webassembly browser 2>&1 </dev/null) ||
    { echo "with GOUGH_PAGE=OFF it says: $said"; exit 1; }
# each package of the list is one of this system's
if command -v apt-cache >/dev/null && [[ -n $(apt-cache search --names-only '^cmake$') ]]; then
    mapfile -t packages < <(sed -n 's/^[a-z]* *| \([a-z0-9.+-]*\) *|.*/\1/p' scripts/install-packages.sh | sort -u)
    known=$(apt-cache show "${packages[@]}" 2>/dev/null | sed -n 's/^Package: //p')
    for package in "${packages[@]}"; do
        grep -qxF -- "$package" <<<"$known" || { echo "there is no package $package"; exit 1; }
    done
fi

# listed NAME: the lines of a list in the script, without blanks around the bars
listed() { sed -n "/^$1() {/,/^END/p" scripts/install-packages.sh | sed -n 's/ *| */|/gp'; }
groups=$(listed groups | cut -d'|' -f1)
twice=$(listed pieces | cut -d'|' -f2 | sort | uniq -d)
[[ -z $twice ]] || { echo "in more than one group: $twice"; exit 1; }
[[ $(listed pieces | cut -d'|' -f1 | uniq) == "$groups" ]] || { echo "the groups of the packages are not the groups of the list, in its order"; exit 1; }
if said=$("$bash" scripts/install-packages.sh tools nonsense 2>&1); then echo "a group 'nonsense' is accepted"; exit 1; fi
[[ $said == *"no group 'nonsense'"*compiler*sundials* ]] || { echo "for an unknown group it says: $said"; exit 1; }

# what the steps ask for, whatever the make that runs this test was told
plan() { env -u MAKEFLAGS -u MAKEOVERRIDES -u PAGE -u PYTHON make -n --no-print-directory "$@"; }
steps=$(plan all test quick test-thorough test-more coverage demo python mpi package dist fuzz campaign bench lint docs |
    sed -n 's/.*install-packages\.sh //p' | tr ' ' '\n' | sed '/^$/d' | sort -u)
[[ $steps == "$(sort <<<"$groups")" ]] || { echo "the Makefile asks for other groups:"; diff <(echo "$steps") <(sort <<<"$groups"); exit 1; }
without=$(plan PAGE=OFF PYTHON=OFF test | sed -n 's/.*install-packages\.sh //p' | xargs)
[[ $without == "compiler tools libraries figures test" ]] || { echo "without the page and Python the tests ask for: $without"; exit 1; }

# the table of CONTRIBUTING: group, purpose, packages, sizes
told=$(sed -n '/^| group | for | packages/,/^$/p' CONTRIBUTING.md | sed -n 's/^| `\([a-z]*\)` | \([^|]*\) | \([^|]*\) | [0-9]* | [0-9]* |$/\1|\2|\3/p')
true=$(while IFS='|' read -r group purpose; do
    those=$(listed pieces | awk -F'|' -v group="$group" '$1 == group { print $2 }' | paste -sd,)
    echo "$group|$purpose|${those//,/, }"
done < <(listed groups))
[[ $told == "$true" ]] || { echo "CONTRIBUTING lists other groups:"; diff <(echo "$told") <(echo "$true"); exit 1; }
