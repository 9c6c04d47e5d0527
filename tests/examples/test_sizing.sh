#!/usr/bin/env bash
# The guide to sizing a leg: its commands run as they stand, and its numbers are those that they print.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"
guide=$SOURCE/docs/guide/sizing.md
try_guide "$guide" 8 12
claim 'the figure is drawn' test -s duty.png
claim 'the figure is shown' test -s "$SOURCE/docs/images/duty.png"

says() { claim "the guide says $1" grep -q -- "$1" "$guide"; } # says TEXT
gough forces legs.yaml --json -q >legs.json
of() { jq -r ".legs[4] | $1" legs.json; }
whole() { awk "BEGIN { printf \"%.0f\", $1 }"; }
claim 'leg 5 works hardest' same "$(jq -r '[.legs[].force[1]] | index(max)' legs.json)" 4
says "| peak of the drive force | $(whole "$(of '.force[1]')") N |"
says "| RMS of the drive force | $(whole "$(of .rms_force)") N |"
says "| peak speed | $(of .speed | awk '{ printf "%.3f", $1 }') m/s |"
says "| peak power | $(whole "$(of '.power[1]')") W |"
says "| peak load of the top joint | $(whole "$(of .joint_load.top)") N |"
says "| peak load of the base joint | $(whole "$(of .joint_load.base)") N |"
says "| peak side load | $(of .side_load | awk '{ printf "%.1f", $1 }') N |"
says "\*Lost by friction\*: $(whole "$(of .friction_loss)") J in 20 s"
says "between $(whole "$(of '.holding[0]')") N and $(whole "$(of '.holding[1]')") N of drive force"
says "dead band of $(whole "$(of '.holding[1] - .holding[0]')") N"
says "gives back $(whole "$(of .returned_energy)") J in 20 s"
says "braking power of $(whole "$(of .braking_power)") W"
says "and $(whole "$(of '.returned_energy / 20')") W on average"
gough forces legs.yaml --json -q --set 'platform.legs={length: [1.55, 2.95]}' >light.json
says "$(whole "$(jq '[.legs[].force[1]] | max' light.json)") N in place of $(whole "$(of '.force[1]')") N"
gough check legs.yaml --json >check.json
says "here $(whole "$(jq .leg_mass check.json)") kg, of which the top bears $(whole "$(jq .leg_mass_on_top check.json)") kg"
gough forces legs.yaml --json -q --set 'platform.legs.friction={}' >smooth.json
claim 'without friction more comes back' same "$(jq -s '([.[0].legs[].returned_energy] | add) < ([.[1].legs[].returned_energy] | add)' legs.json smooth.json)" true
claim 'no leg holds by itself' same "$(jq '[.legs[].holding[0] > 0] | all' legs.json)" true
finish
