#!/usr/bin/env bash
# Builds Edgewise and does its main job on a photograph that ships with it: r and h of a gold ball.
# With a display the window opens on it; without one the numbers, curve, swatches and preset come out here.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
require_packages gcc libc6-dev

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    # shellcheck disable=SC2086
    require_packages $WINDOW_PACKAGES
    exec cargo run -- --sample gold_tent
fi
echo "There is no display (DISPLAY and WAYLAND_DISPLAY are unset), so the command line does the job and no window opens." >&2
exec cargo run --no-default-features --features cli -- samples --match gold_tent -o out --force
