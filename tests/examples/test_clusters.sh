#!/usr/bin/env bash
# Label: thorough.
# The guide to sweeps on many machines: each recipe runs as it is printed and leaves the bytes of one machine. The job array is that of
# Slurm without Slurm: its script, once for each number of the array; examples/slurm has it with Slurm.
# shellcheck source=tests/examples/recipes.sh
source "$(dirname "$0")/recipes.sh"
study 60

block Slurm >sweep.sbatch
array=$(sed -n 's/^#SBATCH --array=//p' sweep.sbatch)
claim 'the array is 1-8' same "$array" 1-8
for i in $(seq "${array%-*}" "${array#*-}"); do SLURM_ARRAY_TASK_ID=$i sh sweep.sbatch >task.txt 2>&1 || cat task.txt; done
bash -c "$(commands Slurm 'gough merge')" >/dev/null
joined 'the job array, without Slurm'

if command -v parallel >/dev/null; then
    block 'GNU parallel' >recipe.sh
    HOME=$PWD bash recipe.sh >said.txt 2>&1 || cat said.txt
    joined 'GNU parallel'
else
    echo "not tried: no GNU parallel (Debian package parallel)"
fi
if /usr/bin/python3 -c 'import distributed' 2>/dev/null; then
    block Dask >recipe.py
    HOME=$PWD /usr/bin/python3 recipe.py >said.txt 2>&1 || cat said.txt
    joined Dask
else
    echo "not tried: no Dask (Debian package python3-distributed)"
fi
if [[ -x $BUILD/gough-mpi ]] && command -v mpirun >/dev/null; then
    ln -s "$BUILD/gough-mpi" gough-mpi
    recipe=$(commands MPI mpirun | sed 's/-n 64/--oversubscribe -n 4/')
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none bash -c "$recipe" >said.txt 2>&1 || cat said.txt
    claim 'MPI: the bytes of one machine' cmp one.h5 table.h5
else
    echo "not tried: no MPI (Debian packages libopenmpi-dev, openmpi-bin)"
fi
claim 'a recipe was tried' within $tried 1 3
finish
