#!/usr/bin/env bash
# A study through a real Slurm on this machine: munged, slurmctld and slurmd in a scratch folder,
# 40 cases as a job array, the node's daemon killed once in the middle. The table must be that of
# the local run, bit for bit.
# Usage: slurm_test.sh BALLBOT SOURCE_DIR
set -euo pipefail
ballbot=$1 source=$2
for tool in munged slurmctld slurmd sbatch; do
  PATH=$PATH:/usr/sbin command -v $tool >/dev/null || {
    echo "SKIPPED: $tool is not installed. ./bootstrap packages installs Slurm (slurm-wlm, munge)."
    exit 77
  }
done
if [ "$(id -u)" -ne 0 ]; then
  echo "SKIPPED: slurmd and slurmctld of this test need root to start jobs as their user."
  exit 77
fi
PATH=$PATH:/usr/sbin

scratch=$(mktemp -d /tmp/ballbot_slurm.XXXXXX)
chmod 755 "$scratch"
host=$(hostname -s)
port=$((20000 + $$ % 10000 * 2))

munged_pid='' slurmctld_pid='' slurmd_pid=''
cleanup() {
  local status=$?
  trap - EXIT
  for pid in $slurmd_pid $slurmctld_pid $munged_pid; do kill "$pid" 2>/dev/null || true; done
  for pid in $slurmd_pid $slurmctld_pid $munged_pid; do wait "$pid" 2>/dev/null || true; done
  [ $status -eq 0 ] || tail -n 20 "$scratch"/*.log || true
  rm -rf "$scratch"
  exit $status
}
trap cleanup EXIT

# munge: its own key and socket; it refuses folders that others may write to.
mkdir -m 700 "$scratch/munge"
dd if=/dev/urandom bs=1 count=1024 of="$scratch/munge/key" status=none
chmod 600 "$scratch/munge/key"
mkdir -m 755 "$scratch/munge_socket"
munged --foreground --force --key-file="$scratch/munge/key" --socket="$scratch/munge_socket/socket" \
  --pid-file="$scratch/munge/pid" --log-file="$scratch/munge/log" --seed-file="$scratch/munge/seed" \
  >"$scratch/munged.log" 2>&1 &
munged_pid=$!

mkdir "$scratch/spool" "$scratch/state"
export SLURM_CONF=$scratch/slurm.conf
cat >"$SLURM_CONF" <<CONF
ClusterName=loopback
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$scratch/munge_socket/socket,cred_expire=15
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
JobRequeue=1
MinJobAge=300
SchedulerParameters=sched_interval=2,batch_sched_delay=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
# Without this slurmd looks for a cgroup file system, which containers may lack; nothing here uses it.
echo 'CgroupPlugin=cgroup/v1' >"$scratch/cgroup.conf"
slurmctld -D >"$scratch/slurmctld.log" 2>&1 &
slurmctld_pid=$!
start_slurmd() {
  slurmd -D >>"$scratch/slurmd.log" 2>&1 &
  slurmd_pid=$!
}
start_slurmd
for _ in $(seq 240); do
  sinfo --noheader --format=%t 2>/dev/null | grep -q '^idle' && break
  kill -0 "$slurmd_pid" && kill -0 "$slurmctld_pid" && kill -0 "$munged_pid" || break
  sleep 0.5
done
sinfo --noheader --format=%t | grep -q '^idle' || { echo "the node did not become idle"; exit 1; }

study=$source/configs/studies/smoke.yaml
forty=(--set duration_s=0.8 --quiet --json)
sed "s|\.\./scenarios|$source/configs/scenarios|; s|^seeds: 2|seeds: 10|" "$study" >"$scratch/forty.yaml"
digest() {
  local summary
  summary=$(cat)
  grep -q '"cases": 40,' <<<"$summary" && grep -q '"failed": 0,' <<<"$summary" || { echo "not 40 cases without failure: $summary" >&2; return 1; }
  sed -n 's/.*"table_digest": "\([0-9a-f]*\)".*/\1/p' <<<"$summary"
}

local_digest=$("$ballbot" study "$scratch/forty.yaml" "${forty[@]}" --out "$scratch/local" | digest)

"$ballbot" study "$scratch/forty.yaml" "${forty[@]}" --launcher slurm --cases-per-task 4 --out "$scratch/slurm" \
  >"$scratch/slurm.json" 2>"$scratch/study.log" &
study_pid=$!
# In the middle: some cases are done, some are running. The node goes: its daemon, and the steps
# that it was running.
our_steps() {  # those that were started with this test's configuration
  local pid
  for pid in $(pgrep -x slurmstepd || true); do
    tr '\0' '\n' <"/proc/$pid/environ" 2>/dev/null | grep -qx "SLURM_CONF=$SLURM_CONF" && echo "$pid" || true
  done
}
steps=''
for _ in $(seq 600); do
  done_cases=$({ cat "$scratch"/slurm/results/*.jsonl 2>/dev/null || true; } | wc -l)
  if [ "$done_cases" -ge 6 ]; then
    for pid in $(our_steps); do kill -STOP "$pid" 2>/dev/null && steps+=" $pid"; done
    [ -z "$steps" ] || break
  fi
  sleep 0.1
done
[ -n "$steps" ] && [ "$done_cases" -lt 40 ] || { echo "the study was over before the node could be killed"; exit 1; }
kill -9 "$slurmd_pid"
wait "$slurmd_pid" 2>/dev/null || true
kill -9 $steps
# Back only when Slurm has noticed: it then puts what the node had into the queue again.
for _ in $(seq 240); do
  sinfo --noheader --format=%t 2>/dev/null | grep -q '^down' && break
  sleep 0.5
done
start_slurmd
wait "$study_pid" || { echo "the study through Slurm failed"; cat "$scratch/study.log"; exit 1; }
slurm_digest=$(digest <"$scratch/slurm.json")
cat "$scratch/study.log"
echo "local $local_digest"
echo "slurm $slurm_digest"
[ "$local_digest" = "$slurm_digest" ]
cmp "$scratch/local/table.csv" "$scratch/slurm/table.csv"
