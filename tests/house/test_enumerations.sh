#!/usr/bin/env bash
# Each public function that is given an enumeration, by itself, in a struct that it reads, or as an int named after one, is called in
# tests/base/test_enumerations.c. A study and what belongs to it is made by the library and is not looked through.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v perl >/dev/null || { echo "skipped: no perl"; exit 77; }
perl -0777 -e '
    my $text = "";
    for my $file (glob "include/gough/*.h") { open my $in, "<", $file or die; $text .= <$in> }
    $text =~ s{/\*.*?\*/}{}gs;
    $text =~ s/^#.*?(?<!\\)\n//gms;
    my %enum = map { $_ => 1 } $text =~ /typedef enum (gough_\w+)/g;
    my (%body, %has);
    $body{$1} = $2 while $text =~ /typedef struct (gough_\w+) \{(.*?)\n\} gough_\w+;/gs;
    my $grown = 1;
    while ($grown) {
        $grown = 0;
        for my $struct (grep { !$has{$_} && !/^gough_(study|error)$/ } keys %body) {
            for my $type ($body{$struct} =~ /\b(gough_\w+) /g) {
                next unless $enum{$type} || $has{$type};
                $has{$struct} = $grown = 1;
            }
        }
    }
    # what the library makes and functions only show: rows, statuses, fields
    # and machines, which gough_machine_init() has filled, and refuses
    delete @has{qw(gough_field gough_place gough_machine)};
    open my $in, "<", "tests/base/test_enumerations.c" or die;
    my $test = <$in>;
    my ($bad, $count) = (0, 0);
    while ($text =~ /^GOUGH_API [^;]*?\b(gough_\w+)\(([^;]*)\)/gm) {
        my ($function, $arguments) = ($1, $2);
        # the law of one instant reads gains alone, as the question for its program does, and one sample has no status
        next if $function =~ /^gough_(fail|fail_key|place_reset|control_law|control_sample|keeps_program)$/;
        my $takes = grep { $enum{$_} } $arguments =~ /(?:^|, |\s)(gough_\w+) \w+/g;
        $takes ||= grep { $has{$_} } $arguments =~ /const (gough_\w+) \*/g;
        $takes ||= $arguments =~ /\bint (component|column|method)\b/;
        next unless $takes;
        $count++;
        next if $test =~ /\b$function\(/;
        print "tests/base/test_enumerations.c does not call $function()\n";
        $bad = 1;
    }
    if ($count < 25) { print "found only $count functions that take an enumeration\n"; $bad = 1 }
    exit $bad;'
