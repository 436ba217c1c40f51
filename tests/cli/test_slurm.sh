#!/usr/bin/env bash
# The script of scarp tile plan --slurm on a cluster of three nodes, one of which is lost.
source "$(dirname "$0")/lib.sh"
need slurmctld slurmd sbatch gdal_translate
[ "$(id -u)" = 0 ] || skip "SLURM's daemons need root here"

host=$(hostname -s)
mkdir -p slurm/state slurm/log slurm/run
{ cat <<C
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$((20000 + $$ % 10000))
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
StateSaveLocation=$PWD/slurm/state
SlurmdSpoolDir=$PWD/slurm/%n
SlurmctldPidFile=$PWD/slurm/run/ctld.pid
SlurmdPidFile=$PWD/slurm/run/%n.pid
SlurmctldLogFile=$PWD/slurm/log/ctld.log
SlurmdLogFile=$PWD/slurm/log/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=defer,sched_interval=1,bf_interval=1
MpiDefault=none
ReturnToService=2
KillWait=2
SlurmdTimeout=6
C
for node in 1 2 3; do
  echo "NodeName=n$node NodeHostname=$host NodeAddr=127.0.0.1 Port=$((30000 + $$ % 10000 + 10000 * node / 4)) CPUs=1 RealMemory=4000"
done
echo "PartitionName=main Nodes=n[1-3] Default=YES MaxTime=60 State=UP"; } > slurm/slurm.conf
export SLURM_CONF=$PWD/slurm/slurm.conf
daemons=()
# lib.sh takes the folder away when the test ends.
ends=$(trap -p EXIT | sed "s/^trap -- '//; s/' EXIT$//")
stop() {
  scontrol shutdown > /dev/null 2>&1 || true
  kill "${daemons[@]}" 2> /dev/null || true
  wait 2> /dev/null || true
  eval "$ends"
}
trap stop EXIT
slurmctld -D > slurm/log/ctld.out 2>&1 & daemons+=($!)
for node in 1 2 3; do slurmd -D -N "n$node" > "slurm/log/n$node.out" 2>&1 & daemons+=($!); done
for ((k = 0; k < 200; ++k)); do sinfo -h -o '%t %D' 2> /dev/null | grep -q "^idle 3" && break; sleep 0.1; done
sinfo -h -o '%t %D' 2> /dev/null | grep -q "^idle 3" || skip "SLURM does not start here"

succeeds gdal_translate -q -r bilinear -outsize 500% 500% -a_srs EPSG:4979 -a_ullr 10.9 45.9 11.9 44.9 "$dem" placed.tif
succeeds "$scarp" tile placed.tif whole -q
succeeds "$scarp" tile plan placed.tif plan.json --slurm run.sh --shards 4 -q
SCARP=$scarp succeeds bash run.sh globe
read -r shares finish < "$logs/out"

# A node dies with all that runs on it: its daemon, the job's processes, and the step that watches them.
for ((k = 0; k < 100; ++k)); do
  squeue -h -t RUNNING -w n2 -o %i 2> /dev/null | grep -q . && break
  sleep 0.1
done
lost=("${daemons[2]}")
for process in /proc/[0-9]*; do
  if grep -qsz '^SLURMD_NODENAME=n2$' "$process/environ"; then
    parent=$(sed -n 's/^PPid:\t//p' "$process/status" 2> /dev/null)
    lost+=("${process#/proc/}")
    if grep -qs slurmstepd "/proc/$parent/comm"; then lost+=("$parent"); fi
  fi
done
[ "${#lost[@]}" -gt 1 ] || fail "no share runs on the node"
kill -KILL "${lost[@]}" 2> /dev/null || true

for ((k = 0; k < 1200; ++k)); do
  left=$(squeue -h -j "$shares,$finish" -o '%i' 2> /dev/null || true)
  [ -n "$left" ] || break
  if [ -e globe/layer.json ]; then break; fi
  # A share that is run again would wait two minutes.
  for id in $(squeue -h -t PENDING -j "$shares" -o '%F_%K' 2> /dev/null); do
    scontrol update JobId="$id" StartTime=now > /dev/null 2>&1 || true
  done
  sleep 0.2
done
[ -e globe/layer.json ] || fail "no set: $(cat plan.json.finish.log plan.json.*.log 2> /dev/null | tail -5)"
diff -r whole globe || fail "a cluster makes other tiles"
