#!/usr/bin/env bash
# Accuracy, overlap of arguments and threads are stated for every public function: the comment at the top of its header has a rule for
# each, which the function's own comment may replace. Each function has a comment of its own directly before it, and one that
# computes numbers says in it how accurate they are.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v perl >/dev/null || { echo "skipped: no perl"; exit 77; }
perl -e '
    my ($bad, $count, $numeric) = (0, 0, 0);
    for my $file (glob "include/gough/*.h") {
        open my $in, "<", $file or die;
        my $text = do { local $/; <$in> };
        my @found;
        while ($text =~ m#(?:/\*\*((?:(?!\*/).)*)\*/\n)?^((?:GOUGH_API|static inline) ([^;{(]*?)\b(gough_\w+)\(([^;{]*)\))#gms) {
            push @found, [$1, $2, $3, $4, $5];
        }
        next unless @found;
        my ($top) = $text =~ m#^/\*\* \@file(.*?)\*/#s;
        for my $word ("Accuracy", "Overlap", "Threads") {
            next if ($top // "") =~ /^ \*  $word: [A-Z]?\w/m;
            print "$file: the first comment has no rule \"$word: …\"\n"; $bad = 1;
        }
        for (@found) {
            my ($comment, $all, $type, $name, $arguments) = @$_;
            $count++;
            if (!defined $comment) { print "$file: $name has no comment before it\n"; $bad = 1; next }
            next if $all =~ /^static/;
            $arguments =~ s/const \w+ \*?\w+(\[\w*\])*//g;
            my $numbers = $type =~ /double/ || $arguments =~ /\bdouble (\*\w+|\w+\[)/
                || $arguments =~ /\bgough_(machine|state|acceleration|rest|period|floquet|outcome|tuning|map|summary|unwrapping) \*|\bgough_sink\b/;
            next unless $numbers;
            $numeric++;
            next if $comment =~ /\b(exact|exactly|accurate|accuracy|rounding|error below|roundings|bits|digits)\b/i;
            print "$file: $name does not say how accurate its numbers are\n"; $bad = 1;
        }
    }
    if ($count < 120 || $numeric < 25) { print "found only $count functions, $numeric of numbers\n"; $bad = 1 }
    exit $bad;'
