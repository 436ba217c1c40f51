#!/usr/bin/env bash
# The script of scarp tile plan --slurm on a cluster of three nodes, one of which is lost.
source "$(dirname "$0")/../program/lib.sh"
PATH=$PATH:/usr/sbin:/sbin
need slurmctld slurmd sbatch gdal_translate python3
[ "$(id -u)" = 0 ] || skip "SLURM's daemons need root here"

host=$(uname -n)
host=${host%%.*}
mkdir -p slurm/state slurm/log slurm/run
export SLURM_CONF=$PWD/slurm/slurm.conf

# A cluster on loopback. It also starts on machines without control groups or with systemd's: the requested plugin uses
# none before it is needed.
configure() {
  read -r -a ports <<< "$(python3 - <<'PYTHON'
# Four free ports below the system's ephemeral range.
import random, socket
free = []
while len(free) < 4:
    port = random.randrange(12000, 32000)
    with socket.socket() as one:
        try:
            one.bind(("127.0.0.1", port))
        except OSError:
            continue
    if port not in free:
        free.append(port)
print(*free)
PYTHON
)"
  echo "CgroupPlugin=cgroup/v1" > slurm/cgroup.conf
  { cat <<C
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
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
SlurmdParameters=config_overrides
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
    echo "NodeName=n$node NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[node]} CPUs=1 RealMemory=4000"
  done
  echo "PartitionName=main Nodes=n[1-3] Default=YES MaxTime=60 State=UP"; } > slurm/slurm.conf
}

daemons=()
stop() {
  scontrol shutdown > /dev/null 2>&1 || true
  kill "${daemons[@]}" 2> /dev/null || true
  wait "${daemons[@]}" 2> /dev/null || true
  daemons=()
}
# lib.sh removes the folder when the test ends.
ends=$(trap -p EXIT | sed "s/^trap -- '//; s/' EXIT$//")
trap 'stop; eval "$ends"' EXIT

all_idle() { sinfo -h -o '%t %D' 2> /dev/null | grep -q "^idle 3"; }
# Another program may open a port before its daemon: three attempts.
for _ in 1 2 3; do
  configure
  slurmctld -D > slurm/log/ctld.out 2>&1 & daemons+=($!)
  for node in 1 2 3; do slurmd -D -N "n$node" > "slurm/log/n$node.out" 2>&1 & daemons+=($!); done
  for ((k = 0; k < 150; ++k)); do
    if all_idle; then break 2; fi
    sleep 0.1
  done
  sinfo -h -o 'SLURM: node %n is %T' || true
  grep -h -E 'error|fatal' slurm/log/*.out | grep -v "state file\|state save file" | tail -12 || true
  stop
  rm -r slurm/state
  mkdir slurm/state
done
all_idle || skip "SLURM's daemons do not start here; what they say stands above"

succeeds gdal_translate -q -r bilinear -outsize 300% 300% -a_srs EPSG:4979 -a_ullr 10.9 45.9 11.9 44.9 "$dem" placed.tif
succeeds "$scarp" tile placed.tif whole --cells 16 --effort fast -q
succeeds "$scarp" tile plan placed.tif plan.json --cells 16 --effort fast --slurm run.sh --shards 3 -q

# The program; for the first share on the second node it stops once it has made a block.
cat > wrapped <<W
#!/bin/bash
if [ "\$SLURMD_NODENAME" = n2 ] && mkdir "$PWD/once" 2> /dev/null; then
  "$scarp" "\$@" &
  until [ -n "\$(find "$PWD/plan.parts" -name "*\$SLURM_ARRAY_TASK_ID-of-*.part" -size +1k 2> /dev/null)" ]; do sleep 0.01; done
  kill -STOP \$! 2> /dev/null
  echo \$SLURM_ARRAY_TASK_ID > "$PWD/caught"
  sleep 1000
fi
exec "$scarp" "\$@"
W
chmod +x wrapped
SCARP=$PWD/wrapped succeeds bash run.sh globe
read -r shares finish < "$logs/out"
for ((k = 0; k < 600; ++k)); do
  [ ! -s caught ] || break
  sleep 0.1
done
[ -s caught ] || fail "no share came to the second node: $(squeue 2>&1) $(sinfo -N 2>&1)"
share=$(cat caught)

# The node dies with everything on it: its daemon, the job's processes, and the step that watches them.
lost=("${daemons[2]}")
for process in /proc/[0-9]*; do
  if grep -qsz '^SLURMD_NODENAME=n2$' "$process/environ" && grep -qsz "^SLURM_CONF=$SLURM_CONF$" "$process/environ"; then
    parent=$(sed -n 's/^PPid:\t//p' "$process/status" 2> /dev/null)
    lost+=("${process#/proc/}")
    if grep -qs slurmstepd "/proc/$parent/comm"; then lost+=("$parent"); fi
  fi
done
[ "${#lost[@]}" -gt 1 ] || fail "nothing of the share is found on the node"
kill -KILL "${lost[@]}" 2> /dev/null || true
wait "${daemons[2]}" 2> /dev/null || true

# SLURM notices the lost node after some 20 seconds.
for ((k = 0; k < 900; ++k)); do
  if [ -e globe/layer.json ]; then break; fi
  [ -n "$(squeue -h -j "$shares,$finish" -o '%i' 2> /dev/null)" ] || break
  # A requeued share would wait two minutes.
  for id in $(squeue -h -t PENDING -j "$shares" -o '%F_%K' 2> /dev/null); do
    scontrol update JobId="$id" StartTime=now > /dev/null 2>&1 || true
  done
  sleep 0.2
done
[ -e globe/layer.json ] || fail "no set: $(cat plan.json.finish.log plan.json.*.log 2> /dev/null | tail -5; squeue 2>&1)"
diff -r whole globe || fail "a cluster makes other tiles"
[ "$(find plan.parts -name "*$share-of-*.part" | wc -l)" = 2 ] || fail "the share was not run again"
