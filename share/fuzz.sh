#!/bin/sh
# Builds the fuzz targets with clang and libFuzzer (packages clang-14, libclang-rt-14-dev) and runs
# them one after the other, each for so many seconds, from the corpus in tests/fuzz and the presets.
#
#     share/fuzz.sh [SECONDS [TARGET...]]      600 seconds each for all targets
#
# What is found lies in build/fuzz/found: copy it into tests/fuzz/corpus, where an ordinary test tries
# it for ever after. Exit code 0 if nothing was found.
set -eu
cd "$(dirname "$0")/.."

seconds=${1:-600}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- scene csv stl vtp checkpoint

cmake --preset fuzz > /dev/null
cmake --build --preset fuzz
if [ -d /dev/shm ]; then  # each run writes a file: better into memory
    export TMPDIR=/dev/shm
fi
status=0
for target in "$@"; do
    mkdir -p "build/fuzz/grown/$target" build/fuzz/found
    seeds="tests/fuzz/corpus/$target"
    [ "$target" = scene ] && seeds="$seeds presets/scenes"
    # HDF5 and VTK are not instrumented: what they do is seen only where it crashes or leaks.
    build/fuzz/tests/fuzz/fuzz_"$target" "build/fuzz/grown/$target" $seeds \
        -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -malloc_limit_mb=2048 \
        -max_len=4096 -print_final_stats=1 -verbosity=0 \
        -artifact_prefix="build/fuzz/found/$target-" > "build/fuzz/$target.log" 2>&1 || status=1
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$target.log")
    echo "$target: ${runs:-?} runs in $seconds s, $(ls build/fuzz/found | grep -c "^$target-" || true) found"
done
exit $status
