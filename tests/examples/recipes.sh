# shellcheck shell=bash
# Sourced by the tests of the guide to sweeps on many machines: `gough` on the path, its study made short, the table one.h5 that one
# machine writes, and the blocks of code of the guide.
# shellcheck source=tests/examples/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
guide=$SOURCE/docs/guide/clusters.md

# block HEADING: the first block of code below a heading
block() { awk -v heading="## $1" '$0 == heading { on = 1; next } /^## / { on = 0 } on && /^```/ { if (inside) exit; inside = 1; next } on && inside' "$guide"; }
# commands HEADING WORDS: the commands below a heading that begin with these words
commands() { awk -v heading="## $1" '$0 == heading { on = 1; next } /^## / { on = 0 } on' "$guide" | sed -n "s/^    \($2.*\)/\1/p"; }
ln -s "$GOUGH" gough
export PATH=$PWD:$PATH
# study RUNS: the study of the guide, made short, and what one machine makes of it
study() {
    gough example load-uncertainty | sed "s/^  runs: 1000/  runs: $1/; s/duration: 10,/duration: 0.2,/" >study.yaml
    claim 'the study is short' same "$(gough check study.yaml | awk '$1 == "runs" { print $2 }')" "$1"
    gough sweep study.yaml -q -o one.h5
}
tried=0
# joined WHAT: the table that a recipe leaves has the bytes of one machine
joined() {
    claim "$1: the bytes of one machine" cmp one.h5 table.h5
    claim "$1: eight shards" same "$(ls part-*.shard | wc -l)" 8
    rm -f table.h5 part-*.shard
    tried=$((tried + 1))
}
