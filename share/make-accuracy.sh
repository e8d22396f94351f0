#!/bin/sh
# Makes the tables and plots of share/doc/accuracy.md anew: about three quarters of an hour on two cores, most of it
# for the 40 s problem. Runs are kept in out/accuracy/runs and used again by the same program.
set -eu
cd "$(dirname "$0")/.."
program=${GRAINBENCH:-build/release/cli/grainbench}
shown="stiffness softest timestep detection-calibration detection detection-convective ensemble facets upscaling"
for study in $shown timestep-energy; do
    "$program" study "presets/studies/$study.json" -o "out/accuracy/$study" --cache out/accuracy/runs
done
"$program" study --single-contact -o out/accuracy/single-contact

to=share/doc/accuracy
mkdir -p "$to"
for study in $shown; do
    for chart in overlay cost; do
        cp "out/accuracy/$study/$chart.svg" "$to/$study-$chart.svg"
    done
    sed -e '/growth\.svg/d' -e "s|](\([a-z]*\)\.svg)|]($study-\1.svg)|" \
        "out/accuracy/$study/study.md" > "$to/$study.md"
done
cp out/accuracy/ensemble/growth.svg "$to/ensemble-growth.svg"
for chart in step outcomes; do
    cp "out/accuracy/single-contact/$chart.svg" "$to/$chart.svg"
done
