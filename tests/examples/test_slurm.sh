#!/usr/bin/env bash
# Label: campaign: waits for Slurm
# The job array of the guide under Slurm, whose controller and daemon run here for the time of the test, as the user of the test and
# with ports and folders of their own: eight shards with the bytes of one machine, also if a task is killed and started again.
# shellcheck source=tests/examples/recipes.sh
source "$(dirname "$0")/recipes.sh"
PATH=$PATH:/usr/sbin:/sbin
for tool in slurmctld slurmd sbatch scontrol; do
    command -v $tool >/dev/null || { echo "skipped: no $tool (Debian package slurm-wlm)"; exit 77; }
done
study 500

port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
host=$(hostname)
mkdir state spool
# four processors, whatever the machine has, for two tasks of two
cat >slurm.conf <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
SlurmctldPort=$(port)
SlurmdPort=$(port)
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
MailProg=/bin/true
NodeName=node NodeHostname=$host NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$PWD/slurm.conf
slurmctld -D >controller.log 2>&1 &
controller=$!
slurmd -D -N node >daemon.log 2>&1 &
daemon=$!
trap 'kill $daemon $controller 2>/dev/null; wait; rm -rf "$work"' EXIT
# up to two minutes on a quiet machine
wait_for() {
    local tries=$((1200 * ${GOUGH_TEST_SLOWNESS:-4} / 4))
    while ((tries-- > 0)); do
        "$@" && return
        sleep 0.1
    done
    echo "waited in vain for: $*"
    tail -n 20 controller.log daemon.log
    exit 1
}
idle() { [[ $(sinfo -h -o %T 2>/dev/null) == idle ]]; }
begun() { compgen -G 'part-3.shard*' >/dev/null; }
none_left() { [[ -z $(squeue -h 2>/dev/null || echo unknown) ]]; }
wait_for idle

block Slurm >sweep.sbatch
submit=$(commands Slurm 'sbatch sweep')
claim 'the guide has a command to submit' same "$submit" 'sbatch sweep.sbatch'
bash -c "$submit" >said.txt || cat said.txt controller.log
wait_for none_left
claim 'eight tasks ended' same "$(ls slurm-*_*.out | wc -l)" 8
bash -c "$(commands Slurm 'gough merge')" >/dev/null
joined 'the job array'

# a task that is killed while it writes its shard
study 100000
job=$(sbatch --parsable sweep.sbatch)
wait_for begun
scancel --signal=KILL --full "${job}_3"
wait_for none_left
claim 'the task was killed before its end' test ! -e part-3.shard
sbatch --array=3 sweep.sbatch >/dev/null
wait_for none_left
bash -c "$(commands Slurm 'gough merge')" >/dev/null
joined 'a task was killed and started again'

if [[ -x $BUILD/gough-mpi ]] && command -v mpirun >/dev/null; then
    ln -s "$BUILD/gough-mpi" gough-mpi
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
    recipe=$(commands Slurm 'sbatch -n' | sed 's/-n 64/-n 4/')
    bash -c "$recipe" >said.txt || cat said.txt
    wait_for none_left
    claim 'MPI in a job: the bytes of one machine' cmp one.h5 table.h5 || cat slurm-*.out
else
    echo "not tried: no MPI (Debian packages libopenmpi-dev, openmpi-bin)"
fi
finish
