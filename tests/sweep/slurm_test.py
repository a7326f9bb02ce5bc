#!/usr/bin/env python3
"""A sweep through a real Slurm of one node gives the rows of a run on this machine, though its elements are stopped.

    slurm_test.py PROGRAM SCRIPTS

Starts munged, slurmctld and slurmd on this machine's loopback, each with files and a key of its own in a temporary
folder (nothing of the system's is touched; needs no root), submits a small sweep by SCRIPTS/submit.sh as three shards,
tells one element to stop as Slurm does before the time limit (USR1), requeues another one in flight as after a node's
failure, and waits for the job that merges. Both come back and go on where they were or begin anew. Fails, and says what
is missing, where Slurm is not installed."""

import contextlib
import getpass
import os
import pathlib
import re
import shutil
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time

from same_bits import rows

SWEEP = """
sweep: on_slurm
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: [2.6, 3.2], seeds: 2}
trials: 6
planners: [straight_line, reactive]
sensor: {width_px: 160, height_px: 120}
mission: {time_limit_s: 20}
"""
DAEMONS = ["munged", "slurmctld", "slurmd"]
COMMANDS = ["sbatch", "scancel", "scontrol", "squeue"]
WAIT_S = 300

# One node, no cgroups (they need root), no accounting; a requeued job may start again after seconds.
CONFIGURATION = """
ClusterName=avoidbench
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=3
SlurmctldPort={controller_port}
SlurmdPort={node_port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=2
KillWait=2
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=3 RealMemory=1000
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


def wait_for(what, is_there, seconds=WAIT_S):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = is_there()
        if found:
            return found
        time.sleep(0.2)
    raise TimeoutError(f"waited {seconds} s for {what}")


class Cluster:
    """Slurm of one node in a folder; its daemons end with the block."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = []
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
        for variable in [name for name in self.environment if name.startswith(("SLURM_JOB", "SLURM_ARRAY", "SBATCH_"))]:
            del self.environment[variable]

    def __enter__(self):
        controller_port, node_port = free_ports(2)
        for name in ("munge", "state", "spool"):
            (self.folder / name).mkdir(mode=0o755)
        key = self.folder / "munge/key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        host = socket.gethostname().split(".")[0]
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(
                folder=self.folder,
                host=host,
                user=getpass.getuser(),
                controller_port=controller_port,
                node_port=node_port,
            )
        )
        munge = self.folder / "munge"
        self.start(
            "munged",
            "--foreground",
            "--force",
            f"--key-file={key}",
            f"--socket={munge}/socket",
            f"--pid-file={munge}/pid",
            f"--seed-file={munge}/seed",
            f"--log-file={munge}/log",
        )
        wait_for("munged", (munge / "socket").exists, 20)
        self.start("slurmctld", "-D")
        wait_for("slurmctld", lambda: "UP" in self.tell("scontrol", "ping", check=False), 30)
        self.start("slurmd", "-D", "-N", host)
        wait_for("the node", lambda: "IDLE" in self.tell("scontrol", "show", "node", check=False), 30)
        return self

    def __exit__(self, *error):
        if error[0] is not None:
            self.show_logs()
        with contextlib.suppress(subprocess.CalledProcessError):
            self.tell("scancel", "--full", "--signal=KILL", f"--user={getpass.getuser()}", check=False)
        for process in reversed(self.processes):
            process.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(10)
            process.kill()
            process.wait()

    def start(self, name, *options):
        program = shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")
        with open(self.folder / f"{name}.out", "wb") as out:
            self.processes.append(subprocess.Popen([program, *options], env=self.environment, stdout=out, stderr=out))

    def tell(self, *command, check=True):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        if check and done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def show_logs(self):
        for log in sorted(self.folder.rglob("*.log")) + sorted(self.folder.glob("*.out")):
            print(f"--- {log}", *log.read_text(errors="replace").splitlines()[-40:], sep="\n")


def trial_count(file):
    """Committed trials of a database that somebody else writes; 0 where there is none yet."""
    with contextlib.suppress(sqlite3.OperationalError):
        with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True, timeout=5)) as database:
            return database.execute("SELECT count(*) FROM trials").fetchone()[0]
    return 0


def main():
    program, scripts = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    missing = [name for name in DAEMONS + COMMANDS if shutil.which(name, path=path) is None]
    if missing:
        sys.exit(f"this test needs Slurm and MUNGE; missing: {', '.join(missing)} (scripts/install_packages.sh slow)")
    with tempfile.TemporaryDirectory(prefix="avoidbench_slurm_") as name:
        folder = pathlib.Path(name)
        folder.chmod(0o755)  # MUNGE wants a socket that all can reach
        sweep = folder / "sweep.yaml"
        sweep.write_text(SWEEP)
        alone = folder / "alone.db"
        subprocess.run(
            [program, "run", sweep, "--quiet", "--jobs", "1", "--db", alone], check=True, stderr=subprocess.DEVNULL
        )
        with Cluster(folder) as cluster:
            fly(cluster, program, scripts, sweep, folder)
        expected, found = rows(alone), rows(folder / "merged.db")
        different = [kind for kind in expected if found[kind] != expected[kind]]
        if different:
            sys.exit(f"rows differ from those of one machine: {', '.join(different)}")
        print(f"{len(found['trial'])} trials, the same rows as on one machine")


def fly(cluster, program, scripts, sweep, folder):
    merged, local = folder / "merged.db", folder / "local"
    local.mkdir()
    cluster.environment["AVOIDBENCH_LOCAL"] = str(local)
    said = cluster.tell(scripts / "submit.sh", sweep, "3", "--program", program, "--out", merged, "--time", "10")
    print(said)
    array = re.search(r"^array (\d+)", said, re.M).group(1)

    def in_flight(element):
        file = local / f"avoidbench_{array}_{element}" / f"shard{element:03d}of003.db"
        return wait_for(f"the first trials of element {element}", lambda: 0 < trial_count(file))

    in_flight(1)
    cluster.tell("scancel", "--batch", "--signal=USR1", f"{array}_1")
    in_flight(2)
    cluster.tell("scontrol", "requeue", f"{array}_2")
    wait_for(
        "the merged database",
        lambda: merged.exists() or "avoidbench" not in cluster.tell("squeue", "--format=%j", "--noheader"),
    )
    log = (folder / f"merged.shards/logs/avoidbench-{array}_1.log").read_text()
    if "stopped; run the same command again" not in log or "queues again" not in log:
        raise RuntimeError(f"element 1 was not stopped and queued again:\n{log}")
    if "trials are already in the database" not in log:
        raise RuntimeError(f"element 1 began anew:\n{log}")
    restarts = cluster.tell("scontrol", "show", "job", f"{array}_2")
    if "Restarts=1" not in restarts:
        raise RuntimeError(f"element 2 was not queued again:\n{restarts}")


if __name__ == "__main__":
    main()
