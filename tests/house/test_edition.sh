#!/usr/bin/env bash
# The edition of the interface (include/gough/names.h) is raised when a struct, an enumeration or the arguments of a function
# change: tests/house/edition.txt lists them with a digest each. Every exported function has its edition in its linker's name, and
# every struct its size by name.
#
#     tests/house/test_edition.sh --write     writes edition.txt anew; refuses while a change needs another edition
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v perl >/dev/null || { echo "skipped: no perl"; exit 77; }
perl -MDigest::MD5=md5_hex -e '
    my $list = "tests/house/edition.txt";
    my (%now, %then, $text, $bad, @structs, @functions);
    for my $file (sort glob "include/gough/*.h") {
        open my $in, "<", $file or die;
        local $/;
        my $one = <$in>;
        $one =~ s{/\*.*?\*/}{}gs;
        $one =~ s/^#.*?(?<!\\)\n//gms;
        $text .= $one;
    }
    sub take { my ($name, $is) = @_; $is =~ s/\s+/ /g; $now{$name} = substr md5_hex($is), 0, 12 }
    while ($text =~ /typedef (struct|enum) (gough_\w+) \{(.*?)\n?\} (gough_\w+);/gs) {
        take($2, $3);
        push @structs, $2 if $1 eq "struct";
    }
    while ($text =~ /^enum (?:(gough_\w+) )?\{(.*?)\}/gms) { my ($name, $is) = ($1, $2); take($name // ($is =~ /(\w+)/)[0], $is) }
    while ($text =~ /^typedef ([^{};]*\(\*(gough_\w+)\)[^;]*);/gm) { take($2, $1) }
    while ($text =~ /^GOUGH_API ([^;]*?\b(gough_\w+)\([^;]*);/gm) {
        push @functions, $2;
        my ($name, $is) = ($2, $1);
        $is =~ s/__attribute__.*//s;
        take("$name()", $is);
    }
    die "found only @{[scalar keys %now]} declarations\n" unless @structs > 60 && @functions > 120 && keys %now > 210;

    sub all_of { my $file = shift; open my $in, "<", $file or die; local $/; <$in> }
    my $names = all_of("include/gough/names.h");
    my $sizes = all_of("src/base/sizes.c");
    my ($edition) = $names =~ /^#define GOUGH_EDITION (\d+)$/m or die "names.h has no edition\n";
    my %plain = map { $_ => 1 } qw(gough_version gough_edition gough_struct_size);
    for (@functions) {
        next if $plain{$_} || $names =~ /^GOUGH_NAME_\($_\)$/m;
        print "include/gough/names.h: a line for $_ is missing\n"; $bad = 1;
    }
    for ($names =~ /^GOUGH_NAME_\((\w+)\)$/gm) {
        next if $now{"$_()"};
        print "include/gough/names.h: there is no function $_\n"; $bad = 1;
    }
    for (@structs) {
        next if $sizes =~ /SIZE_OF\($_\)/;
        print "src/base/sizes.c: the size of $_ is missing\n"; $bad = 1;
    }

    my $old = 0;
    if (open my $in, "<", $list) {
        while (<$in>) { if (/^edition (\d+)$/) { $old = $1 } elsif (/^(\S+) (\w+)$/) { $then{$1} = $2 } }
    }
    my @changed = grep { !$now{$_} || $now{$_} ne $then{$_} } sort keys %then;
    my @added = grep { !$then{$_} } sort keys %now;
    if (@changed && $edition <= $old) {
        print "the interface has changed (@changed): raise GOUGH_EDITION in include/gough/names.h, then run tests/house/test_edition.sh --write\n";
        $bad = 1;
    } elsif (@ARGV && $ARGV[0] eq "--write") {
        open my $out, ">", $list or die;
        print $out "edition $edition\n", map { "$_ $now{$_}\n" } sort keys %now;
    } elsif (@changed || @added || $edition != $old) {
        print "the interface has grown or has another edition: run tests/house/test_edition.sh --write\n";
        $bad = 1;
    }
    exit($bad // 0);' -- "$@"
