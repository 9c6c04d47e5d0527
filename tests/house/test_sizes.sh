#!/usr/bin/env bash
# No source of 600 lines, no line beyond 132 columns; the first line of each source says what it does.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
# code keeps to 100 by its formatter; comments may take 132, counted in characters
find src include tests bench web/core -name '*.[ch]' -print0 2>/dev/null | LC_ALL=C xargs -0 awk '
    FNR == 1 {
        if ($0 !~ /^(\/\*|\/\/)/) { print FILENAME ": its first line does not say what it does"; bad = 1 }
    }
    FNR == 600 { print FILENAME ": 600 lines or more"; bad = 1 }
    { gsub(/[\200-\277]/, "") }
    length($0) > 132 { print FILENAME ":" FNR ": " length($0) " columns"; bad = 1 }
    END { exit bad }'
