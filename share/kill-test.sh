#!/bin/sh
# Kills a run at random times, resumes it each time, and compares the end with a run that was never
# stopped: the same bits, no half file under a final name, a checkpoint that always loads.
#
#     share/kill-test.sh PROGRAM [KILLS [SEED]]     200 kills take some minutes
set -eu

program=$1
kills=${2:-200}
seed=${3:-1}
scene=$(dirname "$0")/../presets/scenes/calibration.json
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

go() {
    ${3:-} "$program" run "$scene" -o "$folder/$1" --quiet --threads 2 --set /realisations/count=2 \
        --set /stages/0/duration=0.5 --set /output/checkpoint_interval=0.002 \
        --set /output/frame_interval=0.02 --set /output/history_interval=0.002 $2
}

hashes() {
    grep '"state_hash"' "$folder/$1/manifest.json"
}

go straight ""
done_kills=0
resumes=0
restarts=0
while [ "$done_kills" -lt "$kills" ]; do
    rm -rf "$folder/broken"
    restarts=$((restarts + 1))
    resume=""
    while [ "$done_kills" -lt "$kills" ]; do
        go broken "$resume" exec 2> "$folder/said" &
        child=$!
        seed=$(( (seed * 1103515245 + 12345) % 2147483648 ))
        sleep "0.$(printf %03d $(( seed / 65536 % 400 )))"
        if kill -9 "$child" 2> /dev/null; then
            done_kills=$((done_kills + 1))
        fi
        code=0
        wait "$child" 2> /dev/null || code=$?
        if [ "$code" -eq 0 ]; then
            break
        elif [ "$code" -ne 137 ]; then
            echo "after $done_kills kills a resumed run ended with exit code $code:"
            cat "$folder/said"
            exit 1
        fi
        resume="--resume"
        resumes=$((resumes + 1))
    done
    go broken --resume 2> "$folder/said" || { cat "$folder/said"; exit 1; }
    if grep -q "warning: .*checkpoint" "$folder/said"; then
        echo "the newest checkpoint was damaged:" && cat "$folder/said" && exit 1
    fi
    [ "$(hashes straight)" = "$(hashes broken)" ] || { echo "other bits than the straight run"; exit 1; }
    cmp "$folder/straight/history.h5" "$folder/broken/history.h5"
done
find "$folder" -name '*.tmp' | grep . && { echo "temporary files are left"; exit 1; }
echo "$done_kills kills in $restarts runs, $resumes resumed: the same bits as the straight run"
