#!/usr/bin/env python3
"""A Slurm cluster of a few nodes on this machine, for one command: slurm_cluster.py [--nodes N] -- COMMAND...

Starts munged, slurmctld and one slurmd per node in a temporary folder, on free ports, with a key of their own; no
system service and nothing in /etc is touched. Each node has 1 processor and 1 GPU that is only a number. When all nodes
are idle, COMMAND is run with SLURM_CONF set; its exit code is this program's. Whatever ends it, the command, an error or
a signal, no process and no file of the cluster is left. Exit code 77 where Slurm is missing or cannot run.

Root is not needed: then all daemons and jobs are the caller's.
"""
import argparse
import ctypes
import getpass
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
START_SECONDS = 60
STOP_SECONDS = 10
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "sinfo")
SET_PARENT_DEATH_SIGNAL, SET_CHILD_SUBREAPER = 1, 36

CONFIGURATION = """\
ClusterName=farm
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
MailProg=/bin/true
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
# A requeued job waits until its credential has expired, which are two minutes by default.
AuthInfo=socket={folder}/munge.socket,cred_expire=10
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
# Nothing that wants cgroups, systemd or a database.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,sched_min_interval=100000,bf_interval=1
SlurmdTimeout=30
KillWait=10
MinJobAge=3600
ReturnToService=2
# Nodes say what they are told here, not what the machine has.
SlurmdParameters=config_overrides
GresTypes=gpu
{nodes}
PartitionName=farm Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
NODE = "NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1 RealMemory=1000 Gres=gpu:1 State=UNKNOWN"


class Stopped(Exception):
    """A signal asked for the end."""


class Skipped(Exception):
    """Slurm is missing or not made for several nodes on one machine."""


def set_process_option(option, value):
    ctypes.CDLL(None, use_errno=True).prctl(option, value, 0, 0, 0)


def find_programs():
    # Daemons lie in sbin, which is not in every user's path.
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    missing = [name for name in PROGRAMS if shutil.which(name) is None]
    if missing:
        raise Skipped(f"{', '.join(missing)}: not installed (script/bootstrap installs slurm-wlm and munge)")


def free_ports(count):
    """Ports that were free a moment ago; a cluster that loses one to somebody else is started anew."""
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def end_of(path, lines=15):
    return "".join(path.read_text(errors="replace").splitlines(True)[-lines:]) if path.exists() else ""


class Cluster:
    def __init__(self, folder, node_count):
        self.folder = folder
        self.nodes = [f"node{i + 1}" for i in range(node_count)]
        self.daemons = []  # (name, process)

    def configure(self):
        host = socket.gethostname().split(".")[0]
        ports = free_ports(1 + len(self.nodes))
        nodes = [NODE.format(name=name, host=host, port=port) for name, port in zip(self.nodes, ports[1:])]
        text = CONFIGURATION.format(host=host, ports=ports, user=getpass.getuser(), folder=self.folder,
                                    nodes="\n".join(nodes))
        (self.folder / "slurm.conf").write_text(text, encoding="utf-8")
        # A GPU needs a file, of any kind as long as nothing restricts devices.
        (self.folder / "gres.conf").write_text("AutoDetect=off\nName=gpu File=/dev/null\n", encoding="utf-8")
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n", encoding="utf-8")
        for name in ["state", *self.nodes]:
            (self.folder / name).mkdir()
        os.environ["SLURM_CONF"] = str(self.folder / "slurm.conf")

    def start_daemon(self, name, command):
        with open(self.folder / f"{name}.out", "wb") as out:
            # In a session of its own, so that Ctrl-C ends the command first; it ends when its parent does.
            process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=out, stderr=out, start_new_session=True,
                preexec_fn=lambda: set_process_option(SET_PARENT_DEATH_SIGNAL, signal.SIGTERM))
        self.daemons.append((name, process))

    def start(self):
        key = self.folder / "munge"
        key.mkdir(mode=0o700)
        with open(os.open(key / "key", os.O_WRONLY | os.O_CREAT, 0o600), "wb") as file:
            file.write(secrets.token_bytes(128))
        self.start_daemon("munged", [
            "munged", "--foreground", f"--key-file={key}/key", f"--seed-file={key}/seed", f"--pid-file={key}/pid",
            f"--socket={self.folder}/munge.socket", f"--log-file={key}/log", "--num-threads=10"])
        self.wait_for("munged", lambda: (self.folder / "munge.socket").exists())
        self.start_daemon("slurmctld", ["slurmctld", "-D", "-c"])
        self.wait_for("slurmctld", lambda: self.ask("scontrol", "ping").returncode == 0)
        if "MULTIPLE_SLURMD" not in self.ask("scontrol", "show", "config").stdout:
            raise Skipped("this Slurm was built without --enable-multiple-slurmd")
        for node in self.nodes:
            self.start_daemon(node, ["slurmd", "-D", "-N", node])
        self.wait_for("idle nodes", self.is_idle)

    def ask(self, *command):
        return subprocess.run(command, capture_output=True, text=True, check=False, timeout=START_SECONDS)

    def is_idle(self):
        answer = self.ask("sinfo", "--noheader", "--Node", "--format=%T")
        return answer.returncode == 0 and answer.stdout.split() == ["idle"] * len(self.nodes)

    def wait_for(self, what, is_there):
        end = time.monotonic() + START_SECONDS
        while not is_there():
            for name, process in self.daemons:
                if process.poll() is not None:
                    raise RuntimeError(f"{name} ended with exit code {process.returncode}")
            if time.monotonic() > end:
                raise RuntimeError(f"no {what} after {START_SECONDS} s")
            time.sleep(0.1)

    def logs(self):
        return "".join(f"--- {name}\n{end_of(self.folder / f'{name}.out')}" for name, _ in self.daemons)


def children():
    """All processes below this one: orphans of daemons too, as this is their subreaper."""
    parents = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                fields = pathlib.Path("/proc", entry, "stat").read_text(errors="replace").rpartition(")")[2].split()
            except OSError:
                continue  # it ended
            parents[int(entry)] = int(fields[1])
    below, level = [], [os.getpid()]
    while level:
        level = [process for process, parent in parents.items() if parent in level]
        below += level
    return below


def end_children():
    """First politely: slurmd and munged remove what they made. Then until none is left."""
    end = time.monotonic() + STOP_SECONDS
    for process in children():
        send(process, signal.SIGTERM)
    while children():
        if time.monotonic() > end:
            for process in children():
                send(process, signal.SIGKILL)
        try:
            while os.waitpid(-1, os.WNOHANG)[0] != 0:
                pass
        except ChildProcessError:
            pass
        time.sleep(0.05)


def send(process, number):
    try:
        os.kill(process, number)
    except ProcessLookupError:
        pass


def start_cluster(folder, node_count):
    """Anew where a port was taken by somebody else in between."""
    for attempt in range(3):
        place = folder / f"{attempt}"
        place.mkdir(mode=0o755)
        cluster = Cluster(place, node_count)
        cluster.configure()
        try:
            cluster.start()
            return cluster
        except RuntimeError as error:
            print(f"slurm_cluster: {error}\n{cluster.logs()}", file=sys.stderr)
            end_children()
    raise Skipped("no cluster could be started here; the daemons' last words stand above")


def run(node_count, command):
    with tempfile.TemporaryDirectory(prefix="slurm-", dir="/tmp") as name:  # short: sockets' names are
        folder = pathlib.Path(name)
        folder.chmod(0o755)  # munged wants its socket where everybody can go
        try:
            find_programs()
            cluster = start_cluster(folder, node_count)
            os.environ["SLURM_CLUSTER_FOLDER"] = str(cluster.folder)
            code = subprocess.run(command, check=False).returncode
            if code not in (0, SKIPPED):
                print(cluster.logs(), file=sys.stderr)
            return code if code >= 0 else 128 - code
        except Skipped as reason:
            print(f"skipped: {reason}")
            return SKIPPED
        except Stopped as reason:
            return 128 + reason.args[0]
        finally:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(number, signal.SIG_IGN)
            end_children()


def stop(number, _):
    raise Stopped(number)


def keep(node_count, command):
    """The cluster's keeper: a process of its own, which tears down also when its parent was killed."""
    set_process_option(SET_CHILD_SUBREAPER, 1)
    set_process_option(SET_PARENT_DEATH_SIGNAL, signal.SIGTERM)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, stop)
    return run(node_count, command)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nodes", type=int, default=2, help="how many (default 2)")
    parser.add_argument("command", nargs="+", metavar="COMMAND", help="what to run, after --")
    arguments = parser.parse_args()
    keeper = os.fork()
    if keeper == 0:
        code = 1
        try:
            code = keep(arguments.nodes, arguments.command)
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda sent, _: send(keeper, sent))
    return os.waitstatus_to_exitcode(os.waitpid(keeper, 0)[1])


if __name__ == "__main__":
    sys.exit(main())
