#!/usr/bin/env bash
# No source of 600 lines, no function of 60, no line beyond 132 columns, in C and in JavaScript; the first line of each source says
# what it does.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
# code keeps to 100 by its formatter; comments may take 132, counted in characters
find src include tests bench python web/core web/src web/vite.config.js \( -name '*.[ch]' -o -name '*.js' -o -name '*.mjs' \) -print0 \
    2>/dev/null | LC_ALL=C xargs -0 awk '
    function long(from) { if (from && FNR - from + 1 >= 60) { print FILENAME ":" from ": a function of " FNR - from + 1 " lines"; bad = 1 } }
    FNR == 1 {
        start = 0
        delete opened
        if ($0 !~ /^(\/\*|\/\/)/) { print FILENAME ": its first line does not say what it does"; bad = 1 }
    }
    FNR == 600 { print FILENAME ": 600 lines or more"; bad = 1 }
    # a function of C begins at the left margin and ends with a brace there; one of JavaScript ends at its own indentation
    FILENAME ~ /\.[ch]$/ && !start && (/^[a-z].*\) \{$/ || /^    [^ ].*\) \{$/) { start = FNR }
    FILENAME ~ /\.[ch]$/ && /^\}/ { long(start); start = 0 }
    FILENAME ~ /js$/ && FILENAME !~ /tests/ && /\{$/ && !/^ *(if|for|while|switch|\} else|\} catch)/ &&
        (/function/ || /=> \{$/ || /^ +((async|static|get|set) )*[A-Za-z_]+\(.*\) \{$/) { match($0, /^ */); opened[RLENGTH] = FNR }
    FILENAME ~ /js$/ && /^ *\}/ { match($0, /^ */); long(opened[RLENGTH]); opened[RLENGTH] = 0 }
    { gsub(/[\200-\277]/, "") }
    length($0) > 132 { print FILENAME ":" FNR ": " length($0) " columns"; bad = 1 }
    END { exit bad }'
