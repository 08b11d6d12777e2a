#!/bin/sh
# A job array of Slurm over many shots: task I of N simulates every N-th scene, into out/<scene>, and a task that is
# queued again goes on where it was cut off. See docs/cluster.md.
#
#     sbatch --requeue --array=1-10 examples/slurm_array.sh shots/*.json
set -eu
task=$(((${SLURM_ARRAY_TASK_ID:-1} - ${SLURM_ARRAY_TASK_MIN:-1}) / ${SLURM_ARRAY_TASK_STEP:-1} + 1))
exec "${PLAIT_SIMULATE:-plait-simulate}" --resume --part "$task/${SLURM_ARRAY_TASK_COUNT:-1}" --scene "$@"
