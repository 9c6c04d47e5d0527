# bash completion for gough
_gough() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]-}
    local verbs="example check forces simulate sweep merge stability tune plot report" always="--quiet --help --usage --version"
    local options=""
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W "$verbs --help --usage --version" -- "$current")
        return
    fi
    case $verb in
        example) options="--output --json" ;;
        check) options="--json --set" ;;
        forces) options="--output --json --set --precision --reactions --dimensionless --all" ;;
        simulate) options="--output --json --set --precision --reactions --dimensionless" ;;
        sweep) options="--output --json --set --threads --lanes --shard --run --dimensionless" ;;
        merge) options="--output --json" ;;
        stability) options="--output --json --set --pose --matrix --at --sweep-stiffness --sweep-amplitude --sweep-frequency --sweep-damping --threads --lanes --title --dimensionless" ;;
        tune) options="--output --json --set --deviation --angle-deviation --damping-ratio --feedforward --margin --stiffness --threads --title --dimensionless" ;;
        plot) options="--output --figure --columns --from --to --log --label --title" ;;
        report) options="--output --set" ;;
    esac
    # bash splits --precision=quad at the sign
    [[ $current == = ]] && current=""
    [[ $previous == = ]] && previous=${COMP_WORDS[COMP_CWORD - 2]}
    case $previous in
        --precision) mapfile -t COMPREPLY < <(compgen -W "double quad" -- "$current"); return ;;
        --feedforward) mapfile -t COMPREPLY < <(compgen -W "program none both" -- "$current"); return ;;
        --figure)
            mapfile -t COMPREPLY < <(compgen -W "$("${COMP_WORDS[0]}" plot --help 2>/dev/null |
                sed -n '/^Kinds of figure/,/^$/s/^  \([a-z-]*\).*/\1/p')" -- "$current")
            return ;;
        --set | --columns | --from | --to | --label | --title | --threads | --lanes | --shard | --run | --pose | --at | --sweep-* | --deviation | --angle-deviation | --damping-ratio | --margin | --stiffness) return ;;
        -o | --output) mapfile -t COMPREPLY < <(compgen -f -- "$current"); compopt -o filenames 2>/dev/null; return ;;
    esac
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options $always" -- "$current")
    elif [[ $verb == example ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("${COMP_WORDS[0]}" example 2>/dev/null | sed -n 's/^  \([^ ]*\).*/\1/p')" -- "$current")
    else
        local endings='@(yaml|yml)'
        [[ $verb == plot ]] && endings='@(h5|csv)'
        [[ $verb == merge ]] && endings=shard
        shopt -s extglob
        mapfile -t COMPREPLY < <(compgen -f -X "!*.$endings" -- "$current"; compgen -d -- "$current")
        compopt -o filenames 2>/dev/null
    fi
}
complete -F _gough gough
