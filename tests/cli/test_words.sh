#!/usr/bin/env bash
# --help, and the man page and the completions of three shells that the build has written, name the same verbs and options.
# Not sanitized: it runs --help alone.
source "$(dirname "$0")/support.sh"
cd "${BUILD:?}" || exit 1
! grep -n '^@.*@$' docs/man/gough.1 completions/* || fail "a part of a template was not filled"

# the man page as plain text: markup and escapes away
tr '\n' ' ' <docs/man/gough.1 | sed -e 's/\\f[A-Z]//g' -e 's/\\-/-/g' >"$scratch/man"
man_has() { grep -qE -- "(^|[^a-z-])$1([^a-z-]|$)" "$scratch/man"; }

verbs=$("$GOUGH" --help | sed -n 's/^  gough \([a-z]*\) [A-Z].*/\1/p' | sort -u)
[[ $(wc -w <<<"$verbs") -ge 5 ]] || fail "--help names too few verbs: $verbs"

# the bash completion, asked as the shell would
source completions/gough.bash
offered() { # offered WORD…: what completes the last word
    COMP_WORDS=("$GOUGH" "$@")
    COMP_CWORD=$#
    COMPREPLY=()
    _gough 2>/dev/null
    printf '%s\n' "${COMPREPLY[@]}"
}
compopt() { :; }

[[ $(offered "" | grep -v '^-' | sort) == "$verbs" ]] || fail "bash completes other verbs: $(offered "")"
for verb in $verbs; do
    grep -q "^| \`gough $verb " "$SOURCE/README.md" || fail "the table of the README lacks $verb"
    man_has "gough $verb" || fail "the man page lacks $verb"
    grep -q "^ *'$verb:" completions/_gough || fail "the zsh completion lacks $verb"
    grep -q -- "-a $verb " completions/gough.fish || fail "the fish completion lacks $verb"

    options=$("$GOUGH" "$verb" --help | grep -oE '(^|[ ,])--[a-z-]+' | tr -d ' ,' | sort -u)
    [[ $(wc -w <<<"$options") -ge 4 ]] || fail "$verb --help names too few options"
    [[ $(offered "$verb" -- | sort -u) == "$options" ]] ||
        fail "$verb: bash completes $(offered "$verb" -- | sort | tr '\n' ' '), --help says $(tr '\n' ' ' <<<"$options")"
    for option in $options; do
        man_has "$option" || fail "the man page lacks $option"
        grep -qE -- "$option([^a-z]|$)" completions/_gough || fail "the zsh completion lacks $option"
        grep -qE -- "-n \"__fish_seen_subcommand_from [a-z ]*\b$verb\b[^\"]*\" (-s . )?-l ${option#--} |^complete -c gough (-s '?.'? )?-l ${option#--} " \
            completions/gough.fish || fail "the fish completion lacks $verb $option"
    done
done

# nothing more than that: options of the man page exist
for verb in $verbs; do "$GOUGH" "$verb" --help; done >"$scratch/help"
for option in $(grep -oE -- '--[a-z-]+' "$scratch/man" | sort -u); do
    grep -q -- "$option" "$scratch/help" || fail "the man page invents $option"
done
# the examples that help texts quote exist
for quoted in $(grep -oE "'[a-z]+-[a-z.-]+'" "$scratch/help" | tr -d "'" | sort -u); do
    "$GOUGH" example "$quoted" >"$scratch/example" 2>&1 || fail "--help quotes an example that is not there: $quoted"
done
[[ $(offered example paper-he) == *paper-heave* ]] || fail "bash does not complete the examples"
[[ $(offered help pos) == pose ]] || fail "bash does not complete the verbs of help"
[[ $(offered check --set control.samp) == *control.sampling.period=* ]] || fail "bash does not complete the keys of --set"
[[ $(offered keys control.samp) == *control.sampling.period* ]] || fail "bash does not complete the keys"
[[ -n $(offered plot --figure "") ]] || fail "bash does not complete the figures"
for shell in zsh fish; do
    command -v $shell >/dev/null || continue
    file=completions/_gough
    [[ $shell == fish ]] && file=completions/gough.fish
    $shell -n "$file" || fail "$shell cannot read $file"
done
if command -v man >/dev/null; then
    complaints=$(LC_ALL=C.UTF-8 MANROFFSEQ="" MANWIDTH=100 man --warnings -E UTF-8 -l -Tutf8 -Z docs/man/gough.1 2>&1 >/dev/null)
    [[ -z $complaints ]] || fail "man: $complaints"
fi
finish
