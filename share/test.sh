#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests but the slow ones. Ends with ctest's
# own summary and exit code. Arguments are handed to ctest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

jobs=$(nproc)
share/bootstrap.sh
cmake --preset release
cmake --build --preset release --parallel "$jobs"
exec ctest --preset release --label-exclude slow --parallel "$jobs" "$@"
