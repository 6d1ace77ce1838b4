#!/bin/bash
# A look-up table on several machines with a common file system: sbatch examples/slurm-table.sh
# Every task takes radii (cells of a dynamic table) that no other one works on, as many at once as it has processors
# (--cpus-per-task); the first one writes the files in the end. A job that reaches its time limit loses nothing: submit it
# again.
#SBATCH --job-name=rheocyte-table
#SBATCH --ntasks=64
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=01:00:00

srun build/rheocyte table examples/tables/linear-solid.toml -o LE-2D-26
