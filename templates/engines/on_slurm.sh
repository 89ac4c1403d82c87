#!/bin/sh
# One task of an array: of the lines of a file those whose number leaves this task's number when divided by the number of tasks.
# sbatch --array=0-9 on_slurm.sh runs.txt 10
list=$1
tasks=$2
awk -v task="$SLURM_ARRAY_TASK_ID" -v tasks="$tasks" '(NR - 1) % tasks == task' "$list" | while IFS= read -r line; do
    # A run that fails is no reason to leave out the next.
    sh -c "$line" </dev/null || true
done
