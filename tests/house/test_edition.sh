#!/usr/bin/env bash
# The edition of the interface is another one whenever a struct, an enumeration or a function of the public headers changes, and the
# same whatever their comments say. Every exported function has its edition in its linker's name, and every struct its size by name.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v perl >/dev/null || { echo "skipped: no perl"; exit 77; }
perl -e '
    my (%now, $text, $bad, @structs, @functions);
    for my $file (sort glob "include/gough/*.h") {
        open my $in, "<", $file or die;
        local $/;
        my $one = <$in>;
        $one =~ s{/\*.*?\*/}{}gs;
        $one =~ s/^#.*?(?<!\\)\n//gms;
        $text .= $one;
    }
    sub take { my ($name, $is) = @_; $now{$name} = 1 }
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

    exit($bad // 0);'

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
edition() {
    rm -rf "$scratch/headers"
    cp -r include/gough "$scratch/headers"
    sed -i "$1" "$scratch/headers/$2"
    cmake -DFOLDER="$scratch/headers" -P cmake/edition.cmake 2>&1
}
now=$(edition '' model.h)
[[ $now -gt 1 ]] || { echo "the edition is $now"; exit 1; }
while read -r header edit; do
    [[ $(edition "$edit" "$header") != "$now" ]] || { echo "the edition stays when $header is changed by $edit"; exit 1; }
done <<'END'
model.h s/double mass;/float mass;/
simulate.h s/GOUGH_DOP853,/GOUGH_DOP853 = 3,/
dynamics.h s/const gough_machine \*machine/gough_machine *machine/
columns.def /^GOUGH_COLUMN(VX,/d
batch.h s/^} gough_outcome;/int more; } gough_outcome;/
END
for edit in 's,/\*\*,/** Another word. ,' 's/^    /        /' 's/^#endif/\n#endif/'; do
    [[ $(edition "$edit" model.h) == "$now" ]] || { echo "the edition changes with $edit"; exit 1; }
done
