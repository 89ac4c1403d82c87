#!/usr/bin/env bash
# The runs of a study on every engine, with what goes wrong in practice: a run that is killed, one that is made twice, a full disk, two who gather
# results at once. Every result is compared with that of this program's own cores, bit for bit. Installs GNU parallel, HyperQueue and Slurm where that
# takes less than two minutes, else says what it leaves out. Run it after `cargo build --release`.
set -uo pipefail
cd "$(dirname "$0")/.."
program=$PWD/target/release/barrier-check
fixtures=$PWD/tests/fixtures
work=$(mktemp -d)
failed=0
trap 'stop_slurm; rm -rf "$work"' EXIT
slurm_there=no

say() { printf '%s\n' "$*"; }
bad() { say "FAILED: $*"; failed=1; }
skip() { say "skipped: $*"; }
now() { date +%s.%N; }
since() { echo "$1 $(now)" | awk '{ printf "%.1f s", $2 - $1 }'; }

[ -x "$program" ] || { say "no program at $program: cargo build --release"; exit 1; }

# 200 runs by the equations, 20 simulations.
cp "$fixtures/tiny.yaml" "$work/"
plan() {
    printf 'kind: sweep\nname: %s\ndesigns: [tiny.yaml]\nby: %s\nvary:\n  - {key: flow.arrival.surge.velocity, from: %s m/s, to: %s m/s, step: %s m/s}\n' "$@"
}
plan loads equations 3 4.99 0.01 >"$work/loads.yaml"
plan simulations simulation 3 4.9 0.1 >"$work/simulations.yaml"
cd "$work"

for study in loads simulations; do
    began=$(now)
    "$program" study $study.yaml --out local_$study >/dev/null 2>&1 || bad "$study on this program's own cores"
    say "local, $study: $(($(wc -l <local_$study/sweep.csv) - 1)) runs in $(since "$began")"
done

# What an engine has made, and what it has not is made by giving it the study again.
same() {
    "$program" study "$2.yaml" --out "$1_$2" --collect >/dev/null 2>&1
    if cmp -s "local_$2/sweep.csv" "$1_$2/sweep.csv"; then
        say "$1, $2: the same as here, bit for bit, $3"
    else
        bad "$1, $2: the results differ from those made here"
    fi
}

# Kills one worker soon after it has started.
kill_one() {
    for _ in $(seq 200); do
        victim=$(pgrep -f -- "--out $work/[a-z_]* --only" | shuf -n 1)
        [ -n "$victim" ] && kill -9 "$victim" 2>/dev/null && return
        sleep 0.02
    done
}

with_parallel() {
    "$program" study "$1.yaml" --out "parallel_$1" --list | parallel -j "$(nproc)" >/dev/null 2>&1
}

# An engine that hangs is none that can be tried here.
with_engine() {
    timeout 300 "$program" study "$2.yaml" --out "$1_$2" --on "$1" >/dev/null 2>"$1_$2.log"
    [ $? != 124 ]
}

# Twenty runs without any trouble, against as many processes with nothing around them.
timed() {
    began=$(now)
    if [ "$1" = parallel ]; then
        "$program" study simulations.yaml --out "timed_$1" --list | parallel -j "$(nproc)" >/dev/null 2>&1
    else
        timeout 300 "$program" study simulations.yaml --out "timed_$1" --on "$1" >/dev/null 2>&1
    fi
    took=$(since "$began")
    say "$1, simulations: $took, $(echo "$took $bare" | awk '{ printf "%.2f", $1 / $3 }') times bare processes"
}

on() {
    engine=$1
    for study in loads simulations; do
        began=$(now)
        kill_one &
        if [ "$engine" = parallel ]; then
            with_parallel $study
        elif ! with_engine "$engine" $study; then
            skip "$engine has not ended within five minutes"
            return
        fi
        wait
        missing=$("$program" study $study.yaml --out "${engine}_$study" --list 2>/dev/null | wc -l)
        # A task of an engine makes up to a hundred runs by the equations.
        [ "$missing" -le 100 ] || bad "$engine, $study: $missing runs are missing after one was killed"
        if [ "$engine" = parallel ]; then with_parallel $study; else with_engine "$engine" $study; fi
        same "$engine" $study "$missing missing after one was killed; $(since "$began") in all"
    done
    timed "$engine"
}

stop_slurm() {
    [ "$slurm_there" = yes ] || return 0
    kill "$(cat "$work/slurmd.pid" 2>/dev/null)" "$(cat "$work/slurmctld.pid" 2>/dev/null)" 2>/dev/null
    pkill munged 2>/dev/null
    slurm_there=no
}

start_slurm() {
    mkdir -p /run/munge "$work/slurm"
    [ -e /etc/munge/munge.key ] || { dd if=/dev/urandom bs=1 count=1024 2>/dev/null >/etc/munge/munge.key; }
    chown -R munge: /etc/munge /run/munge /var/lib/munge /var/log/munge 2>/dev/null
    chmod 400 /etc/munge/munge.key
    pgrep munged >/dev/null || su -s /bin/sh munge -c "$(command -v munged)" >/dev/null 2>&1 || return 1
    slurm_there=yes
    host=$(hostname -s)
    cat >"$work/slurm.conf" <<CONFIGURATION
ClusterName=here
SlurmctldHost=$host
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
StateSaveLocation=$work/slurm
SlurmdSpoolDir=$work/slurm
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
ReturnToService=2
JobAcctGatherType=jobacct_gather/none
NodeName=$host CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONFIGURATION
    export SLURM_CONF=$work/slurm.conf
    slurmctld && slurmd || return 1
    for _ in $(seq 40); do
        sinfo -h -o %t 2>/dev/null | grep -q idle && return 0
        sleep 0.5
    done
    return 1
}

began=$(now)
"$program" study simulations.yaml --out bare --list | xargs -P "$(nproc)" -I LINE sh -c LINE >/dev/null 2>&1
bare=$(since "$began")
say "bare processes, simulations: $bare"

# GNU parallel and Slurm are Debian's, HyperQueue is from PyPI.
if ! command -v parallel >/dev/null || ! command -v slurmctld >/dev/null; then
    timeout 120 sh -c 'apt-get update -q && apt-get install -y -q --no-install-recommends parallel slurm-wlm munge' >/dev/null 2>&1
fi
python3 -m venv "$work/python" >/dev/null 2>&1 && timeout 120 "$work/python/bin/pip" install -q hyperqueue==0.27.0 >/dev/null 2>&1
if command -v parallel >/dev/null; then on parallel; else skip "GNU parallel could not be installed within two minutes"; fi
if "$work/python/bin/python3" -c 'import hyperqueue' 2>/dev/null; then
    PATH=$work/python/bin:$PATH on hyperqueue
else
    skip "HyperQueue could not be installed within two minutes"
fi
if ! command -v slurmctld >/dev/null; then
    skip "Slurm could not be installed within two minutes"
elif start_slurm; then
    on slurm
else
    skip "Slurm could not be started here"
fi

# A run that two make at once.
first=$("$program" study simulations.yaml --out twice_simulations --list | head -n 1)
sh -c "$first" & sh -c "$first" &
wait
[ "$(find twice_simulations/kept -name '*.bin' | wc -l)" = 1 ] || bad "a run that was made twice at once is not kept once"
[ -z "$(find twice_simulations/kept -name '*.tmp')" ] || bad "a run that was made twice at once leaves half a result"
"$program" study simulations.yaml --out twice_simulations >/dev/null 2>&1
same twice simulations "one of them made twice at once"

# Two who gather at once: one may be told to wait, and neither breaks what is there.
"$program" study loads.yaml --out local_loads --collect >/dev/null 2>&1 & one=$!
"$program" study loads.yaml --out local_loads --collect >/dev/null 2>&1 & other=$!
wait $one; first=$?
wait $other; second=$?
case "$first$second" in
    00 | 02 | 20) say "two who gathered at once ended with $first and $second" ;;
    *) bad "two who gathered at once ended with $first and $second" ;;
esac
cp local_loads/sweep.csv before.csv
"$program" study loads.yaml --out local_loads --collect >/dev/null 2>&1
cmp -s before.csv local_loads/sweep.csv || bad "gathering at once changed the results"

# A full disk.
mkdir full
if mount -t tmpfs -o size=16k none full 2>/dev/null; then
    mkdir -p full/out && head -c 100000 /dev/zero >full/filler 2>/dev/null
    line=$("$program" study simulations.yaml --out full/out --list 2>/dev/null | head -n 1)
    sh -c "$line" 2>full.log && bad "a run whose result could not be kept ended well"
    grep -q "could not be kept\|No space left" full.log || bad "a full disk is not told: $(cat full.log)"
    rm -f full/filler
    mount -o remount,size=16m full
    "$program" study simulations.yaml --out full/out >/dev/null 2>&1
    cmp -s local_simulations/sweep.csv full/out/sweep.csv && say "a full disk is told, and the study goes on once there is room" || bad "after a full disk the results differ"
    umount full
else
    skip "a full disk: no file system can be mounted here"
fi

# Many runs are planned and gathered soon.
printf 'kind: sweep\nname: many\ndesigns: [tiny.yaml]\nby: equations\nvary:\n  - {key: flow.arrival.surge.velocity, from: 3 m/s, to: 4.99 m/s, step: 0.01 m/s}\n  - {key: channel.base_friction, from: 10 deg, to: 34.5 deg, step: 0.5 deg}\n' >many.yaml
began=$(now)
count=$("$program" study many.yaml --out many --list | wc -l)
say "planning $count runs took $(since "$began")"
"$program" study many.yaml --out many >/dev/null 2>&1
began=$(now)
"$program" study many.yaml --out many --collect >/dev/null 2>&1 || bad "gathering $count runs"
say "gathering $count runs took $(since "$began")"

[ $failed = 0 ] && say "all engines gave the same results"
exit $failed
