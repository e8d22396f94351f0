#!/usr/bin/env bash
# From a fresh checkout to a first run folder: installs what is missing, builds, runs a small bed.
# Arguments are handed to `grainbench run`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

share/bootstrap.sh
cmake --preset release
cmake --build --preset release --target grainbench --parallel "$(nproc)"
exec build/release/cli/grainbench run presets/scenes/bne-quick.json -o out/bne-quick "$@"
