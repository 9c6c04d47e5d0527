# fish completion for gough
set -l verbs example check forces simulate sweep merge plot report
complete -c gough -f
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a example -d "print a ready study file to start from"
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a check -d "validate a study and print its machine"
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a forces -d "the leg forces that the program of motion needs"
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a simulate -d "the motion under control and disturbance"
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a sweep -d "many runs of a study with other numbers"
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a merge -d "one table of the shards of a sweep"
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a plot -d "figures as PNG, SVG or PDF"
complete -c gough -n "not __fish_seen_subcommand_from $verbs" -a report -d "all of it as one HTML page"

complete -c gough -s q -l quiet -d "say nothing but what is wrong"
complete -c gough -s '?' -l help -d "what the verb does"
complete -c gough -l usage -d "the same in short"
complete -c gough -s V -l version -d "the version"

complete -c gough -n "__fish_seen_subcommand_from example check forces simulate sweep merge" -l json -d "print as JSON"
complete -c gough -n "__fish_seen_subcommand_from example forces simulate sweep merge plot report" -s o -l output -r -F -d "where the result goes"
complete -c gough -n "__fish_seen_subcommand_from check forces simulate sweep report" -l set -x -d "override a key of the study"
complete -c gough -n "__fish_seen_subcommand_from forces simulate" -l precision -x -a "double quad" -d digits
complete -c gough -n "__fish_seen_subcommand_from forces simulate" -l reactions -d "add the constraint reactions to the table"
complete -c gough -n "__fish_seen_subcommand_from forces simulate sweep" -l dimensionless -d "in units of R_b, M and sqrt(R_b/g)"
complete -c gough -n "__fish_seen_subcommand_from sweep" -l threads -x -d "how many threads"
complete -c gough -n "__fish_seen_subcommand_from sweep" -l lanes -x -a "1 2 4 8" -d "runs side by side in a processor"
complete -c gough -n "__fish_seen_subcommand_from sweep" -l shard -x -d "run the i-th of n parts: i/n"
complete -c gough -n "__fish_seen_subcommand_from sweep" -l run -x -d "print what this run sets"
complete -c gough -n "__fish_seen_subcommand_from plot" -l figure -x -d "which figure"
complete -c gough -n "__fish_seen_subcommand_from plot" -l columns -x -d "draw these columns"
complete -c gough -n "__fish_seen_subcommand_from plot" -l from -x -d "from this time"
complete -c gough -n "__fish_seen_subcommand_from plot" -l to -x -d "up to this time"
complete -c gough -n "__fish_seen_subcommand_from plot" -l log -d "magnitudes on a logarithmic axis"
complete -c gough -n "__fish_seen_subcommand_from plot" -l label -x -d "what a result is called in the key"
complete -c gough -n "__fish_seen_subcommand_from plot" -l title -x -d "heading of the figure"

complete -c gough -n "__fish_seen_subcommand_from example" -a "(gough example 2>/dev/null | string match -rg '^  (\S+)')"
complete -c gough -n "__fish_seen_subcommand_from check forces simulate sweep report" -a "(__fish_complete_suffix .yaml)"
complete -c gough -n "__fish_seen_subcommand_from plot" -a "(__fish_complete_suffix .h5)"
complete -c gough -n "__fish_seen_subcommand_from merge" -a "(__fish_complete_suffix .shard)"
