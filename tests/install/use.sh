# Sourced: link_programs FOLDER compiles the users' programs against what is installed under FOLDER, by pkg-config, by
# find_package(gough) and against the static library, and runs them; use_package FOLDER does so and tries the command and the texts.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compiler=${CC:-cc}

expect() { # expect WHAT WANTED PROGRAM…
    local what=$1 wanted=$2 got
    shift 2
    got=$("$@") || { echo "$what: does not run"; exit 1; }
    [[ $got == "$wanted" ]] || { echo "$what: prints '$got' instead of '$wanted'"; exit 1; }
    echo "ok: $what"
}

# without the revision of the sources, which follows in brackets
version_of() { "$1" --version | cut -d' ' -f1-2; }

# links_of FOLDER: each link of the texts in the folder leads to a file
links_of() {
    local text link target count=0
    while IFS=: read -r text link; do
        target=${link%%#*}
        [[ -z $target || $target == http*://* || $target == mailto:* ]] && continue
        [[ -e $(dirname "$text")/$target ]] || { echo "$text links to $target, which is not installed"; exit 1; }
        count=$((count + 1))
    done < <(find "$1" -name '*.md' -exec grep -HoE '\]\([^)]+\)' {} + | sed -E 's/\]\(([^)]*)\)$/\1/')
    ((count > 100)) || { echo "the installed texts have only $count links"; exit 1; }
    echo "ok: $count links of the installed texts"
}

link_programs() {
    local prefix=$1 config libraries title
    config=$(dirname "$(find "$prefix" -name gough.pc)")
    libraries=$(dirname "$config")
    export PKG_CONFIG_PATH=$config LD_LIBRARY_PATH=$libraries
    # at rest each of six equal legs pushes with M g l / (6 h)
    "$compiler" -std=c17 -o "$scratch/by-pkg-config" "$here/program.c" $(pkg-config --cflags --libs gough) -lm
    expect "pkg-config gough" 1.000000000000 "$scratch/by-pkg-config"
    "$compiler" -std=c17 -o "$scratch/files" "$here/files.c" $(pkg-config --cflags --libs gough-files)
    title=$(sed -n 's/^title: *//p' "$SOURCE/examples/paper-heave.yaml")
    expect "pkg-config gough-files" "$title" "$scratch/files" "$SOURCE/examples/paper-heave.yaml"
    "$compiler" -std=c17 -o "$scratch/static" "$here/program.c" $(pkg-config --cflags gough) "$libraries/libgough.a" \
        $(pkg-config --libs-only-l --static gough | sed 's/-lgough\b//')
    (unset LD_LIBRARY_PATH; expect "libgough.a" 1.000000000000 "$scratch/static")

    # the archives of all three, as pkg-config lists them
    "$compiler" -std=c17 -o "$scratch/files-static" "$here/files.c" $(pkg-config --cflags gough) \
        "$libraries/libgough-files.a" "$libraries/libgough-analyse.a" "$libraries/libgough.a" \
        $(pkg-config --static --libs gough-files | sed -E 's/-lgough(-analyse|-files)?( |$)/ /g')
    (unset LD_LIBRARY_PATH; expect "libgough-files.a" "$title" "$scratch/files-static" "$SOURCE/examples/paper-heave.yaml")

    mkdir -p "$scratch/user"
    cp "$here/program.c" "$here/files.c" "$scratch/user"
    cat >"$scratch/user/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.16)
project(user C)
find_package(gough 0.1 REQUIRED)
add_executable(program program.c)
target_link_libraries(program gough::gough m)
add_executable(static program.c)
target_link_libraries(static gough::static)
add_executable(files files.c)
target_link_libraries(files gough::files)
add_executable(files-static files.c)
target_link_libraries(files-static gough::files-static)
END
    cmake -S "$scratch/user" -B "$scratch/user/build" -DCMAKE_PREFIX_PATH="$prefix" >"$scratch/log" 2>&1 &&
        cmake --build "$scratch/user/build" >>"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
    expect "find_package, gough::gough" 1.000000000000 "$scratch/user/build/program"
    (unset LD_LIBRARY_PATH; expect "find_package, gough::static" 1.000000000000 "$scratch/user/build/static")
    expect "find_package, gough::files" "$title" "$scratch/user/build/files" "$SOURCE/examples/paper-heave.yaml"
    (unset LD_LIBRARY_PATH; expect "find_package, gough::files-static" "$title" "$scratch/user/build/files-static" "$SOURCE/examples/paper-heave.yaml")
}

use_package() {
    local prefix=$1 config
    link_programs "$prefix"
    links_of "$prefix/share/doc/gough"
    config=$(dirname "$(find "$prefix" -name gough.pc)")
    expect "the command" "gough $(sed -n 's/^Version: //p' "$config/gough.pc")" version_of "$prefix/bin/gough"
    local file
    for file in share/man/man1/gough.1 share/bash-completion/completions/gough share/fish/vendor_completions.d/gough.fish \
        share/doc/gough/images/machine.svg share/doc/gough/examples/paper-heave.yaml share/doc/gough/copyright include/gough/version.h; do
        [[ -e $prefix/$file || -e $prefix/$file.gz ]] || { echo "$file is not installed"; exit 1; }
    done
    find "$prefix/share/zsh" -name _gough | grep -q . || { echo "the zsh completion is not installed"; exit 1; }
}
