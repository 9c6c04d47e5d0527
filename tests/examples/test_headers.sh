#!/usr/bin/env bash
# Label: thorough.
# The commands that the first lines of each example tell its reader to run do run, and every example starts by saying what it shows.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"

mkdir bin
ln -s "$GOUGH" bin/gough
PATH=$work/bin:$PATH

awk -f ship-deck.awk >ship-deck.csv
for example in *.yaml; do
    claim "$example says what it shows" grep -q '^# [A-Z]' <(head -1 "$example")
    claim "$example gives a command" grep -q '^#     gough ' "$example"
    while IFS= read -r line; do
        bash -c "${line#\#     }" >said.txt 2>&1
        status=$?
        # a run that ends early is an answer too; what the reader was promised is said behind the command
        case $line in
        *collapses*) claim "$line" same $status 1 ;;
        *'too soft'*) claim "$line" within $status 0 1 ;;
        *) claim "$line" same $status 0 ;;
        esac
        if ((status > 1)); then cat said.txt; fi
    done < <(grep -E '^#     (gough|awk) ' "$example")
    claim "$example passes gough check" "$GOUGH" check "$example" -q
done

finish
