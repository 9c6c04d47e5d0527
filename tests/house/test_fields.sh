#!/usr/bin/env bash
# Each member of the structs of a model and its options has a line in src/model/fields.def, or is listed here as no input. What has
# no line is neither read from study files nor in the flat model of the page.
set -euo pipefail
cd "${SOURCE:-$(dirname "$0")/../..}"
command -v perl >/dev/null || { echo "skipped: no perl"; exit 77; }
perl -0777 -e '
    my @structs = (    # struct, place in the table, members that are no input: other structs, memory of the caller, derived numbers, sizes
        ["gough_model", "", "machine motion control disturbance initial workspace"],
        ["gough_machine", "MACHINE(", "platform load base_radius gravity_magnitude principal_axes second_moments home_length home_condition breakaway smoothing_speed external externals"],
        ["gough_platform", "MACHINE(platform.", "cylinder piston friction actuators legs limits tolerances"],
        ["gough_leg_part", "MACHINE(platform.cylinder.", ""],
        ["gough_leg_part", "MACHINE(platform.piston.", ""],
        ["gough_friction", "MACHINE(platform.friction.", ""],
        ["gough_actuators", "MACHINE(platform.actuators.", ""],
        ["gough_leg_limits", "MACHINE(platform.legs.", ""],
        ["gough_platform_limits", "MACHINE(platform.limits.", ""],
        ["gough_tolerances", "MACHINE(platform.tolerances.", ""],
        ["gough_load", "MACHINE(load.", ""],
        ["gough_motion", "MOTION(", "move moves samples"],
        ["gough_samples", "MOTION(samples.", "count time value curvature"],
        ["gough_move", "MOVE(", ""],
        ["gough_external", "EXTERNAL(", ""],
        ["gough_control", "CONTROL(", "sampling"],
        ["gough_sampling", "CONTROL(sampling.", ""],
        ["gough_disturbance", "DISTURBANCE(", "noise"],
        ["gough_noise", "DISTURBANCE(noise.", ""],
        ["gough_initial", "INITIAL(", ""],
        ["gough_workspace", "WORKSPACE(", ""],
        ["gough_simulation", "SIMULATION(", "size law law_context summary statistics"]);
    my ($headers, $table) = ("", "");
    for my $file ("include/gough/model.h", "include/gough/demands.h", "include/gough/simulate.h") { open F, "<", $file or die; $headers .= <F> }
    open F, "<", "src/model/fields.def" or die;
    $table = <F>;
    s{/\*.*?\*/}{}gs for $headers, $table;
    $table =~ s/"[^"]*"//g;
    my ($bad, $members) = (0, 0);
    for (@structs) {
        my ($struct, $place, $others) = @$_;
        my ($body) = $headers =~ /typedef struct $struct \{(.*?)\}\s*$struct;/s or die "there is no $struct\n";
        my %other = map { $_ => 1 } split / /, $others;
        for my $declaration (grep { /\S/ } split /;/, $body) {
            for my $declarator (split /,/, $declaration) {
                my ($member) = $declarator =~ /(\w+)\s*(?:\[[^\]]*\]\s*)*$/ or die "$struct: $declarator\n";
                $members++;
                next if delete $other{$member};
                next if $place ne "" && $table =~ /\b\Q$place$member\E[)\[]/;
                print "$struct.$member has no line in src/model/fields.def\n";
                $bad = 1;
            }
        }
        if (%other) { print "$struct has no member @{[sort keys %other]}\n"; $bad = 1 }
    }
    if ($members < 50) { print "found only $members members\n"; $bad = 1 }
    exit $bad;'
