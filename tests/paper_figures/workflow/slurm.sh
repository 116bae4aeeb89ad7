#!/usr/bin/env bash
# The workflow on a real Slurm: installs slurm-wlm, starts munged, slurmctld and slurmd for this machine alone, in a
# folder of their own, sends a sweep of 60 points through them, kills one job while it runs, and checks that it was sent
# again and that all points are there. Ends its daemons in any case. Not part of tests/run. Usage: slurm.sh (as root:
# slurmd starts jobs for others)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
# shellcheck source=experiments/dependencies.sh
source "$root/experiments/dependencies.sh"
[ "$(id -u)" -eq 0 ] || { say "slurm.sh: slurmd needs root; run it as root or in a container"; exit 77; }
install_packages "${packages[@]}" slurm-wlm munge procps

# Jobs look for their configuration where a cluster has it: the workflow passes no SLURM_ variable on to them.
configuration=/etc/slurm/slurm.conf
if [ -e "$configuration" ]; then
  say "slurm.sh: $configuration exists: this machine belongs to a cluster, which is left alone"
  exit 77
fi
folder=$(mktemp -d) node=$(hostname -s) runs=$root/runs
mkdir -p "$folder"/{state,spool,log}
daemons=()
stop() {
  local id
  for id in "${daemons[@]}"; do kill "$id" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$folder" "$configuration"
}
trap stop EXIT

mkdir -p /etc/slurm
cat > "$configuration" <<CONF
ClusterName=paper
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=17817
SlurmdPort=17818
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_min_interval=100000,batch_sched_delay=0
MinJobAge=3600
ReturnToService=2
MpiDefault=none
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(free -m | awk '/^Mem/ {print $2}') State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
CONF
head -c 1024 /dev/urandom > "$folder/munge.key"
chmod 711 "$folder" && chmod 600 "$folder/munge.key"
munged --force --foreground --socket="$folder/munge.socket" --key-file="$folder/munge.key" \
  --pid-file="$folder/munge.pid" --log-file="$folder/log/munged" --seed-file="$folder/munge.seed" \
  --num-threads=2 & daemons+=($!)
for _ in $(seq 50); do [ -S "$folder/munge.socket" ] && break; sleep 0.1; done
slurmctld -D -L "$folder/log/slurmctld" > /dev/null 2>&1 & daemons+=($!)
slurmd -D -N "$node" -L "$folder/log/slurmd" > /dev/null 2>&1 & daemons+=($!)
for _ in $(seq 100); do sinfo -h -o %T 2>/dev/null | grep -q '^idle' && break; sleep 0.3; done
if ! sinfo -h -o %T | grep -q '^idle'; then
  say "slurm.sh: the cluster did not come up"
  tail -n 20 "$folder"/log/* >&2
  exit 1
fi
say "Slurm $(sinfo --version | cut -d' ' -f2) is up: $(sinfo -h -o '%D node, %c cores')"

rm -rf "$runs/sweep-smoke-cpu"
"$root/experiments/reproduce" sweep --scale smoke --slurm --jobs 8 -- --slurm-status-command squeue \
  --slurm-no-account --seconds-between-status-checks 5 \
  > "$folder/log/workflow" 2>&1 & workflow=$!
daemons+=("$workflow")
# One job is killed while it runs, and not the first: its point must be there at the end all the same.
killed=
while kill -0 "$workflow" 2>/dev/null && [ -z "$killed" ]; do
  sleep 0.5
  [ "$(squeue -h -t completed -o %i | wc -l)" -ge 3 ] || continue
  killed=$(squeue -h -t running -o %i | tail -1)
  if [ -n "$killed" ]; then scancel --signal=KILL --full "$killed"; say "Killed job $killed"; fi
done
status=0
wait "$workflow" || status=$?
if [ "$status" -ne 0 ]; then
  say "slurm.sh: the workflow ended with exit status $status"
  tail -n 60 "$folder/log/workflow" >&2
  tail -n 20 "$folder/log/slurmctld" >&2
  exit 1
fi
[ -n "$killed" ] || { say "slurm.sh: no job could be killed while it ran"; exit 1; }

points=$(find "$runs/sweep-smoke-cpu" -mindepth 3 -maxdepth 3 -name run.json | wc -l)
rows=$(($(wc -l < "$runs/sweep-smoke-cpu/sweep.csv") - 1))
sent=$(squeue -h -t all -o %i | wc -l)
again=$(grep -c 'Trying to restart job' "$folder/log/workflow" || true)
[ "$points" -eq 60 ] && [ "$rows" -eq 60 ] || { say "slurm.sh: $points runs and $rows rows, not 60"; exit 1; }
if [ "$again" -lt 1 ] || [ "$sent" -lt 62 ]; then
  say "slurm.sh: the killed job was not sent again ($sent jobs, $again restarts)"
  exit 1
fi
say "60 points in $sent jobs; job $killed was killed, and its point computed by another"
