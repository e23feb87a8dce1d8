#!/usr/bin/env bash
# Passes every check of the project, from a bare Debian 12 with rustup's toolchain.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
# shellcheck disable=SC2086
require_packages gcc libc6-dev python3-venv glslang-tools xvfb openbox imagemagick mesa-vulkan-drivers $WINDOW_PACKAGES

# Headless: the window's tests draw with the software Vulkan driver and open no display but their own.
XDG_RUNTIME_DIR=$(mktemp -d)
# A fixed seed: the same commit passes or fails every time. Run “cargo test” by hand for new random cases.
export XDG_RUNTIME_DIR CARGO_INCREMENTAL=0 LANG=C.UTF-8 PROPTEST_RNG_SEED=8178
unset DISPLAY WAYLAND_DISPLAY

step() { printf '\n== %s\n' "$*"; }

step "the assets are what their scripts make of the published data"
python3 -m venv target/venv
target/venv/bin/pip install --quiet --disable-pip-version-check --requirement scripts/requirements.txt
target/venv/bin/python scripts/make_metals.py --check
target/venv/bin/python scripts/make_cie.py --check

step "format, lints, and the library without window or command line"
cargo fmt --check
cargo clippy --quiet --lib --bins -- -D warnings
cargo check --quiet --no-default-features

step "tests"
cargo test --quiet

step "the files are loaded into the programs they are for"
tests/clients/run.sh target/debug/edgewise
