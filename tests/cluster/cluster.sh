#!/bin/bash
# Slurm with two nodes on this machine, in name spaces of its own (mounts, network, processes): nothing outside is touched.
#   unshare -mnpf --uts bash cluster.sh FOLDER COMMAND...    runs COMMAND as a user of the cluster would; SLURM_CONF is set
# Works without systemd: proctrack/linuxproc, task/none, cgroup/v1 and DefMemPerCPU are needed for that.
set -u
folder=$(realpath "$1"); shift
mount --make-rprivate / && mount -t proc proc /proc
for place in /run /var/lib/slurm /var/log/slurm /var/lib/munge /var/log/munge /etc/munge; do mkdir -p $place && mount -t tmpfs t $place; done
mkdir -p /run/munge /var/lib/slurm/slurmctld /var/lib/slurm/slurmd.n1 /var/lib/slurm/slurmd.n2
hostname head; ip link set lo up; ip addr add 10.77.0.1/32 dev lo
/usr/sbin/mungekey --create && chown -R munge: /etc/munge /run/munge /var/lib/munge /var/log/munge && chmod 755 /run/munge
setpriv --reuid=munge --regid=munge --clear-groups /usr/sbin/munged --syslog 2>/dev/null
chown -R slurm: /var/lib/slurm /var/log/slurm
mkdir -p /run/slurm.conf
cat > /run/slurm.conf/cgroup.conf <<'C'
CgroupPlugin=cgroup/v1
C
cat > /run/slurm.conf/slurm.conf <<'C'
ClusterName=pano
SlurmctldHost=head(10.77.0.1)
SlurmUser=slurm
AuthType=auth/munge
CredType=cred/munge
AuthInfo=cred_expire=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
DefMemPerCPU=200
MaxArraySize=10001
ReturnToService=2
StateSaveLocation=/var/lib/slurm/slurmctld
SlurmdSpoolDir=/var/lib/slurm/slurmd.%n
SlurmctldPidFile=/run/slurmctld.pid
SlurmdPidFile=/run/slurmd.%n.pid
SlurmdLogFile=/var/log/slurm/slurmd.%n.log
SlurmctldLogFile=/var/log/slurm/slurmctld.log
JobRequeue=1
SlurmdParameters=config_overrides
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
NodeName=n[1-2] NodeHostname=head NodeAddr=10.77.0.1 Port=[17001-17002] CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
C
export SLURM_CONF=/run/slurm.conf/slurm.conf
slurmctld; slurmd -N n1; slurmd -N n2
for _ in $(seq 100); do [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ] && break; sleep 0.2; done
if [ "$(sinfo -h -t idle -o %D 2>/dev/null)" != 2 ]; then echo "cluster.sh: the nodes did not come up" >&2; for log in /var/log/slurm/*.log; do tail -20 "$log"; done >&2; exit 9; fi
"$@"
status=$?
[ $status -eq 0 ] || tail -30 /var/log/slurm/slurmctld.log >&2
scontrol shutdown 2>/dev/null
exit $status
