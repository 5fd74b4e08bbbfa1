#!/bin/sh
# A table as a Slurm array, a shard for each task. The arguments are those of `hts table build` but --shard and --output:
#   sbatch --array=1-64 tables/sharing/slurm.sh --material aluminium.json --wavelengths 0.38:0.78:31 --tolerance 1e-4
#   hts table merge part.* --output aluminium.htst
# A task that is stopped goes on where it ended when it is submitted again; merge names the parts that lack.
#SBATCH --job-name=hts-table
#SBATCH --cpus-per-task=4
#SBATCH --time=1:00:00
export OMP_NUM_THREADS="${SLURM_CPUS_PER_TASK:-1}"
exec hts table build "$@" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --output "part.$SLURM_ARRAY_TASK_ID"
