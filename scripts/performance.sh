#!/usr/bin/env bash
# Writes docs/performance.md: measures the kernels, the same binary built for this machine's processor, the instructions
# of the kernels in a simulator, and the table of errors in Python. Takes minutes; leave the machine alone meanwhile.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=target/performance
mkdir -p "$folder"

[ -x target/venv/bin/python ] || python3 -m venv target/venv
target/venv/bin/pip install --quiet --disable-pip-version-check --requirement scripts/requirements.txt

scripts/compare_builds.sh "$folder/builds.csv"
edgewise=${STOCK:-target/release/edgewise}
STOCK=$edgewise scripts/count_instructions.sh "$folder/instructions.csv"
"$edgewise" study speed --error-table >"$folder/table.json"
target/venv/bin/python scripts/compare_accuracy.py "$folder/table.json" >"$folder/python.json"
"$edgewise" study speed --evidence --python "$folder/python.json" --builds "$folder/builds.csv" \
    --instructions "$folder/instructions.csv" >"$folder/performance.md"
mv "$folder/performance.md" docs/performance.md
