#!/usr/bin/env bash
# Plain English: what users read has none of the phrases listed here, which a native writer would not write. Read are the messages
# in src (string literals), the public headers, README, guides, theory, man page, completions, examples and the texts of the page.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v perl >/dev/null || { echo "skipped: no perl"; exit 77; }

# one regular expression a line; letters match in either case, a space matches any white space
phrases=$(mktemp)
trap 'rm -f "$phrases"' EXIT
cat >"$phrases" <<'END'
\bmemory is out\b
(?<!there\x20)\b(is|are) none\b
\blimits (are|is) none\b
\bgoes on being\b
\b(go|goes|gone|going) on\b
\bdoes not do\b
\bfound not to do\b
\bnobody (asked|looked)\b
\blimits? (is |are |that is )?left\b
\blimits? (that )?(it|they) leaves?\b
\bheld against\b
\bindependent road\b
\bstands? in the way of\b
\bstands? (in|beside|there|apart|behind) (the |docs/|FILE)
\bwhat is (left|missing|wrong) (is|with)\b
\bwhat would be right\b
\bsays? what would\b
\bwho (wants to|reads|changes)\b
\bsay nothing but\b
\bchecked and told\b
\bis told by\b
\ball of it as\b
\bwith other numbers\b
\bas (it|they) stands?\b
\bleft aside\b
\b(looked|looks|look) at (either|too|over|once|closely)\b
\bwhatever the (grid|number)\b
\b(can|cannot|may) be had\b
\bis had\b
\bnumerical end\b
\bruns done\b
\bno possible study\b
\bwhat sizes a leg\b
\bvouch(es)?\b
\b(is|are) said\b
\bsaid too\b
\bof other hands\b
\ba fifth less\b
\banother is asked\b
\bwhat (was|is) asked\b(?! for)
\bthat much is\b
\bhow near that\b
\btells that\b
\bnot to be used\b
\btaken in turn\b
\bof its own making\b
\bthe same in short\b
\bhanded (to|out)\b
\bmakes? ready\b
\bof no known kind\b
\bcounts as one that\b
\blooked at at\b
\bno (more|less) than that is\b
\bare none to be had\b
\bwhere (it|they) (is|are) none\b
\bwhen memory is\b
\bwanted motion\b
\bgoes nowhere\b
\bis there twice\b
\bcomes? on top\b
\bfeels? \S+ least\b
\ba row each\b
\bless draws it\b
\bstays? for ever\b
\bmakes? no valid\b
\bends only itself\b
\bwhat binds\b
\bis differenced\b
\bthe move before it\b
\bseen from the (base|top)\b
\bleft out here\b
\bceases to be\b
\bsome ten\b
\bwould do\b
\btake a longer one\b
\bas (its keys|the study) (say|gives? it)\b
\bdo not tell\b
\bis what holds\b
\bdeviations? goe?s? as\b
\bthe most possible\b
\bthe words (used here|mean)\b
\bwhat (it|they) contains?\b
\bnot quite known\b
END
banned() { # banned NAME: the lines on standard input, as `line:text`, that contain a phrase
    NAME=$1 PHRASES=$phrases perl -Mopen=:std,:utf8 -ne '
        BEGIN { open F, "<", $ENV{PHRASES} or die; while (<F>) { chomp; s/ /\\s+/g; push @p, qr/$_/i } }
        for my $p (@p) { if (/$p/) { my $found = $&; print "$ENV{NAME}: \"$found\" in ", substr($_, 0, 160) =~ s/\s*$//r, "\n"; $bad = 1; last } }
        END { exit($bad ? 1 : 0) }'
}
literals() { # the string literals of a C source, adjacent ones joined, each after its line number
    perl -0777 -Mopen=:std,:utf8 -ne '
        s{/\*.*?\*/}{my $c = $&; $c =~ s/[^\n]//g; $c}gse;      # comments, without their lines
        s{//[^\n]*}{}g;
        while (/"((?:[^"\\\n]|\\.)*)"(?:\s*(?:PRI\w+\s*)?"((?:[^"\\\n]|\\.)*)")*/g) {
            my ($start, $text) = (substr($_, 0, $-[0]) =~ tr/\n// + 1, $&);
            $text =~ s/"\s*\n?\s*"//g;
            $text =~ s/\s*\n\s*/ /g;
            print "$start: $text\n";
        }' "$1"
}
strings() { # the strings of a JavaScript source, or the text of an HTML file, after their line numbers
    perl -0777 -Mopen=:std,:utf8 -ne '
        s{/\*.*?\*/|<!--.*?-->}{my $c = $&; $c =~ s/[^\n]//g; $c}gse;
        s{(^|[^:])//[^\n]*}{$1}g;
        my $n = 0;
        for my $line (split /\n/) {
            $n++;
            if ($ARGV =~ /\.html$/) { print "$n: $line\n"; next }
            print "$n: $&\n" while $line =~ /"(?:[^"\\]|\\.)*"|`(?:[^`\\]|\\.)*`/g;
        }' "$1"
}
comments() { # the comments of a C header, each after its line number
    perl -0777 -Mopen=:std,:utf8 -ne '
        while (m{/\*.*?\*/}gs) {
            my ($start, $text) = (substr($_, 0, $-[0]) =~ tr/\n// + 1, $&);
            $text =~ s/\s*\n\s*\*?\s*/ /g;
            print "$start: $text\n";
        }' "$1"
}
# paragraphs of other files: lines joined up to an empty one, a table's row or a list's item
prose() {
    perl -0777 -Mopen=:std,:utf8 -ne '
        my ($n, $start, $text, $fenced) = (0, 0, "", 0);
        for (my @lines = (split(/\n/), "")) {
            $n++;
            $fenced = !$fenced if /^```/;
            next if $fenced;
            my $break = /^\s*(#|\/\/)?\s*$/ || /^\s*[|*.-]/ || /^\s{4}/ || /^\w+:/;
            if ($break) { print "$start: $text\n" if $text ne ""; $text = ""; $start = $n }
            s/^\s*(#|\/\/) ?//;
            $text .= ($text eq "" ? "" : " ") . $_;
        }
        print "$start: $text\n" if $text ne "";' "$1"
}

failed=0
while IFS= read -r file; do
    case $file in
        src/*.h | src/*.c | src/*.def) literals "$file" | banned "$file" || failed=1 ;;
        web/src/*) strings "$file" | banned "$file" || failed=1 ;;
        include/*) comments "$file" | banned "$file" || failed=1 ;;
        *) prose "$file" | banned "$file" || failed=1 ;;
    esac
done < <(git ls-files README.md CONTRIBUTING.md include/gough docs/guide docs/theory docs/man completions examples \
    'web/src/*.js' 'web/src/*.html' "$@")
exit $failed
