# For tests of the page in Debian's chromium, which source it: skips where the page was not bundled or there is no browser; a folder
# SCRATCH that is removed at the end, and a folder PICTURES that stays.
: "${GOUGH:?}" "${BUILD:?}" "${SOURCE:?}"
[[ -e $BUILD/web/report.html ]] || { echo "skipped: the page was not bundled in this build"; exit 77; }
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || { echo "skipped: no chromium"; exit 77; }
SCRATCH=$(mktemp -d)
trap 'rm -rf "$SCRATCH"' EXIT
export CHROMIUM SCRATCH PICTURES=$BUILD/web/pictures
