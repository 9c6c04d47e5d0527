#!/usr/bin/env bash
# Label: standard.
# The guide to figures: its commands run as they are printed, and leave the pictures that they name.
# shellcheck source=tests/examples/common.sh
source "$(dirname "$0")/common.sh"
try_guide "$SOURCE/docs/guide/figures.md" 7 7
for picture in column.png page.pdf legs.svg difference.png; do claim "$picture is drawn" test -s "$picture"; done
finish
