#!/bin/sh
# Steps short scenes with several builds of the program, with 1, 2, 4 and 8 threads each, and compares
# the last bit of their state: all contact laws of the presets, moving walls, sinks, sources, driven
# groups, periodic directions, slots sorted anew.
#
#     share/same-bits.sh PROGRAM...      seconds; some minutes for a debug build
#
# Exit code 0 if all states are the same, 1 if not, 2 if a run failed.
set -eu

presets=$(dirname "$0")/../presets/scenes
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Prints the hashes of the realisations of a scene: state PROGRAM THREADS SCENE STAGES SECONDS
state() {
    stages=""
    stage=0
    while [ "$stage" -lt "$4" ]; do
        stages="$stages --set /stages/$stage/duration=$5"
        stage=$((stage + 1))
    done
    rm -rf "$folder/run"
    # shellcheck disable=SC2086
    if ! "$1" run "$presets/$3.json" -o "$folder/run" --quiet --threads "$2" $stages \
        2> "$folder/said"; then
        cat "$folder/said" >&2
        exit 2
    fi
    grep '"state_hash"' "$folder/run/manifest.json"
}

differ=0
while read -r scene stages seconds; do
    expected=""
    for program in "$@"; do
        for threads in 1 2 4 8; do
            hashes=$(state "$program" "$threads" "$scene" "$stages" "$seconds")
            if [ -z "$expected" ]; then
                expected=$hashes
                echo "$scene:" $hashes
            elif [ "$hashes" != "$expected" ]; then
                echo "  $program with $threads threads differs:" $hashes
                differ=1
            fi
        done
    done
done << 'SCENES'
calibration 1 0.1
bne 2 0.05
ball-impact 2 0.01
hopper 2 0.02
sheared-box 3 0.02
rotating-drum 2 0.01
conveyor-layer 2 0.02
poured-heap 2 0.05
yielding-drop 1 0.05
adhesive-drop 1 0.02
newtons-cradle 1 0.02
SCENES

[ "$differ" -eq 0 ] && echo "all states are the same to the bit: $# builds, 1, 2, 4 and 8 threads"
exit "$differ"
