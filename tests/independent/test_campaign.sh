#!/usr/bin/env bash
# Label: thorough.
# Twenty random studies of the campaign: each number that check, forces and simulate print, as text, JSON and CSV, in SI and
# dimensionless, is that of the independent computation beside this file. `make campaign` runs a thousand.
set -euo pipefail
: "${GOUGH:?the command to test}" "${SOURCE:?the source folder}"
command -v python3 >/dev/null || { echo "no python3 (Debian package python3)"; exit 1; }
PYTHONDONTWRITEBYTECODE=1 exec python3 "$SOURCE/tests/independent/campaign/campaign.py" --gough "$GOUGH" --studies "${CAMPAIGN_STUDIES:-20}"
