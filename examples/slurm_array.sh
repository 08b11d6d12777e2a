#!/bin/sh
# A job array of Slurm over many shots: task i of n simulates every n-th scene, into out/<scene>. See docs/cluster.md.
#
#     sbatch --array=0-9 examples/slurm_array.sh shots/*.json
set -eu
part=$((${SLURM_ARRAY_TASK_ID:-0} - ${SLURM_ARRAY_TASK_MIN:-0})) parts=${SLURM_ARRAY_TASK_COUNT:-1}
number=0
for scene in "$@"; do
    if [ $((number % parts)) -eq "$part" ]; then
        "${PLAIT_SIMULATE:-plait-simulate}" --scene "$scene" --out "out/$(basename "$scene" .json)"
    fi
    number=$((number + 1))
done
