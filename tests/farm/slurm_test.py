#!/usr/bin/env python3
"""A library analysed by a Slurm array while things go wrong: slurm_cluster.py -- slurm_test.py PROGRAM

docker/slurm/analyze-library.sbatch over two nodes: one task's program is killed, one task is requeued, one is told that
its time is up, one node is drained, and the program fails on a node. What `merge` then writes has to be, byte for byte,
what it writes after a run on one machine.
"""
import contextlib
import os
import pathlib
import shlex
import signal
import subprocess
import sys
import tempfile
import time

from library import BROKEN, write_library

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "docker/slurm/analyze-library.sbatch"
METRICS = ("relative_density,polygons_per_planar_group,planar_group_variation,cooccurrence_contrast,fourier_transform,"
           "distance")  # all that are the same in every run
TASKS = 6
PATIENCE = 150
NODES = ("node1", "node2")
# The cluster's nodes are small.
SMALL = ["--cpus-per-task=1", "--mem=100M"]
INPUT_FAILED, UNUSABLE = 3, 2


def require(condition, message):
    if not condition:
        raise AssertionError(message)


def ask(*command):
    run = subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE)
    require(run.returncode == 0, f"{shlex.join(command)}: exit code {run.returncode}\n{run.stderr}")
    return run.stdout.strip()


def wait_for(what, is_so):
    end = time.monotonic() + PATIENCE
    while not is_so():
        require(time.monotonic() < end, f"waited {PATIENCE} s for this: {what}\n{ask('squeue', '--array')}")
        time.sleep(0.01)


def describe(job):
    """What Slurm knows of a job or task: {"JobState": "RUNNING", "Restarts": "0", ...}"""
    words = ask("scontrol", "--oneliner", "show", "job", job).split()
    return dict(word.split("=", 1) for word in words if "=" in word)


def node_state(node):
    return ask("sinfo", "--noheader", "--nodes", node, "--format=%T")


def files_below(folder):
    return {path for path in folder.rglob("*") if path.is_file()} if folder.exists() else set()


def words_of(process):
    """Its command line and its parent; empty where it has ended."""
    try:
        words = pathlib.Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").split("\0")
        stat = pathlib.Path(f"/proc/{process}/stat").read_text(errors="replace").rpartition(")")[2].split()
        return words, stat[1] if stat[0] != "Z" else None
    except OSError:
        return [], None


def program_of(array, task):
    """The process that is analysing the task's shard, the one that the batch script started."""
    # Other clusters on this machine have the same numbers.
    wanted = {f"SLURM_CONF={os.environ['SLURM_CONF']}", f"SLURM_ARRAY_JOB_ID={array}", f"SLURM_ARRAY_TASK_ID={task}"}
    for process in filter(str.isdigit, os.listdir("/proc")):
        words, parent = words_of(process)
        if "--out" not in words or __file__ in words or parent is None or "slurm_script" not in str(words_of(parent)[0]):
            continue
        try:
            if wanted <= set(pathlib.Path(f"/proc/{process}/environ").read_text(errors="replace").split("\0")):
                return int(process)
        except OSError:
            continue  # it ended
    return None


class Farm:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.library, self.logs = folder / "library", folder / "logs"
        self.array = None
        self.interrupted = {}  # task: how
        for each in (self.logs, folder / "gates"):
            each.mkdir()

    def submit(self, out, analyzer, *options, variables=()):
        environment = {**os.environ, "LIBRARY": str(self.library), "OUT": str(out), "ANALYZER": analyzer,
                       "ANALYZER_OPTIONS": f"--jobs 1 --metrics {METRICS}", **dict(variables)}
        command = ["sbatch", "--parsable", f"--output={self.logs}/%A_%a.log", *SMALL, *options, str(SCRIPT)]
        run = subprocess.run(command, env=environment, cwd=self.folder, capture_output=True, text=True, check=False)
        require(run.returncode == 0, f"sbatch: {run.stderr}")
        return run.stdout.strip()

    def wrapped(self, *words):
        """The program behind this file: see `stand_in`."""
        return shlex.join([sys.executable, __file__, *map(str, words), self.program])

    def gate(self, task):
        return self.folder / "gates" / str(task)

    def name(self, task):
        return f"{self.array}_{task}"

    def is_running(self, task):
        return describe(self.name(task))["JobState"] == "RUNNING"

    def running(self):
        return [task for task in range(TASKS) if self.is_running(task)]

    def interrupt(self, task, how, action):
        """Lets the task begin and stops it while it is at work.

        Assets of a small shard are measured together and written at the end, so there is no waiting for half of them.
        """
        out = self.folder / "farm"
        before = files_below(out)
        wait_for(f"task {task} runs", lambda: self.is_running(task))
        self.gate(task).touch()
        wait_for(f"task {task} is at work", lambda: program_of(self.array, task) is not None)
        process = program_of(self.array, task)
        require(process is not None, f"task {task} was over before it could be stopped: it needs larger assets")
        wait_for(f"task {task} has its journal", lambda: files_below(out) - before)
        os.kill(process, signal.SIGSTOP)  # in the middle, however long the rest of this takes
        action(process)
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGCONT)
        wait_for(f"task {task} is back in the queue after: {how}", lambda: describe(self.name(task))["Restarts"] == "1")
        self.interrupted[task] = how
        print(f"task {task}: {how}, restarts", flush=True)


def analyse_on_one_machine(farm, out):
    run = subprocess.run([farm.program, "batch", str(farm.library), "--out", str(out), "--metrics", METRICS],
                         capture_output=True, text=True, check=False, timeout=PATIENCE)
    require(run.returncode == INPUT_FAILED, f"batch: exit code {run.returncode}, not {INPUT_FAILED}\n{run.stderr}")
    require(BROKEN.rpartition("/")[2] in run.stderr + run.stdout, f"the broken asset is not named:\n{run.stderr}")
    return subprocess.run([farm.program, "merge", str(out), "--json", f"{out}.json", "--csv", f"{out}.csv"],
                          capture_output=True, text=True, check=False, timeout=PATIENCE).returncode


def drain(farm, node, tasks):
    """The node's task ends there; all others run on the other node."""
    on_node = [task for task in tasks if describe(farm.name(task))["NodeList"] == node]
    require(len(on_node) == 1, f"{node} should have one task: {on_node}")
    ask("scontrol", "update", f"NodeName={node}", "State=DRAIN", "Reason=test")
    require(node_state(node) == "draining", f"{node} is {node_state(node)}")
    waiting = [task for task in range(TASKS) if describe(farm.name(task))["JobState"] == "PENDING"]
    require(waiting, "no task is left that the drained node could have got")
    for task in range(TASKS - 1):
        farm.gate(task).touch()
    wait_for(f"{node} is drained", lambda: node_state(node) == "drained")
    require(describe(farm.name(on_node[0]))["JobState"] == "COMPLETED", "the drained node's task did not complete")
    print(f"{node} drained when its task {on_node[0]} was done; waiting: {waiting}", flush=True)
    return waiting


def check_tasks(farm, waiting, drained):
    for task in range(TASKS):
        found = describe(farm.name(task))
        require(found["JobState"] == "COMPLETED" and found["ExitCode"] == "0:0", f"task {task}: {found}")
        restarts = "1" if task in farm.interrupted else "0"
        require(found["Restarts"] == restarts, f"task {task} restarted {found['Restarts']} times, not {restarts}")
        require(task not in waiting or found["NodeList"] != drained, f"task {task} ran on the drained node")
    logs = "".join(path.read_text(errors="replace") for path in farm.logs.glob(f"{farm.array}_*.log"))
    require("some assets could not be analysed" in logs, f"the logs do not say that an asset is broken:\n{logs}")
    require(logs.count("restart 1: done") == len(farm.interrupted), f"logs of restarts:\n{logs}")


def check_interrupted_array(farm):
    out = farm.folder / "farm"
    farm.array = farm.submit(out, farm.wrapped("--behind-gate", farm.folder / "gates"), f"--array=0-{TASKS - 1}")
    merge = ask("sbatch", "--parsable", f"--dependency=afterany:{farm.array}", f"--output={farm.logs}/merge.log", *SMALL,
                "--wrap", shlex.join([farm.program, "merge", str(out), "--json", f"{out}.json", "--csv", f"{out}.csv"]))
    farm.interrupt(0, "killed", lambda process: os.kill(process, signal.SIGKILL))
    farm.interrupt(1, "requeued", lambda _: ask("scontrol", "requeue", farm.name(1)))
    # As slurmd does shortly before the time limit: only the batch script is told.
    farm.interrupt(2, "time is up", lambda process: os.kill(int(words_of(process)[1]), signal.SIGUSR1))
    wait_for("both nodes work", lambda: len(farm.running()) == len(NODES))
    waiting = drain(farm, NODES[0], farm.running())
    # Slurm gives the last task the number of the array; only this task may restart.
    farm.interrupt(TASKS - 1, "killed", lambda process: os.kill(process, signal.SIGKILL))
    wait_for("the merge job ends", lambda: describe(merge)["JobState"] in ("COMPLETED", "FAILED"))
    check_tasks(farm, waiting, NODES[0])
    ask("scontrol", "update", f"NodeName={NODES[0]}", "State=RESUME")
    ask("sbatch", "--wait", f"--nodelist={NODES[0]}", *SMALL, "--output=/dev/null", "--wrap", "true")
    print(f"{NODES[0]} resumed and works", flush=True)
    return int(describe(merge)["ExitCode"].split(":")[0])


def check_same_bytes(farm, exit_codes):
    require(exit_codes[0] == exit_codes[1], f"merge's exit codes: one machine {exit_codes[0]}, farm {exit_codes[1]}")
    for suffix in ("json", "csv"):
        one, many = ((farm.folder / f"{name}.{suffix}").read_bytes() for name in ("one", "farm"))
        require(len(one) > 0 and one == many, f"the farm's {suffix} differs from that of one machine")
        print(f"{suffix}: {len(one)} bytes, the same", flush=True)


def check_bad_node(farm):
    """Exit code 2 on the first node: the task ends well on the other one."""
    seen = farm.folder / "first-node"
    array = farm.submit(farm.folder / "bad-node", farm.wrapped("--fails-on-first-node", seen), "--array=0")
    wait_for("the task ends", lambda: describe(f"{array}_0")["JobState"] in ("COMPLETED", "FAILED"))
    found = describe(f"{array}_0")
    require((found["JobState"], found["Restarts"]) == ("COMPLETED", "1"), f"on a bad node: {found}")
    require(found["ExcNodeList"] == seen.read_text() != found["NodeList"], f"ran on the bad node again: {found}")
    print(f"exit code 2 on {seen.read_text()}: done on {found['NodeList']}", flush=True)


def check_restarts_end(farm):
    array = farm.submit(farm.folder / "never", farm.wrapped("--always-fails"), "--array=0", variables=[("MAX_RESTARTS", "1")])
    wait_for("the task fails", lambda: describe(f"{array}_0")["JobState"] in ("COMPLETED", "FAILED"))
    found = describe(f"{array}_0")
    require((found["JobState"], found["ExitCode"], found["Restarts"]) == ("FAILED", f"{UNUSABLE}:0", "1"), f"{found}")
    print("exit code 2 everywhere: failed after one restart", flush=True)


def stand_in(option, *words):
    """In front of the program, inside a task."""
    if option == "--always-fails":
        return UNUSABLE
    place, program, *arguments = words
    if option == "--fails-on-first-node" and not os.path.exists(place):
        pathlib.Path(place).write_text(os.environ["SLURMD_NODENAME"], encoding="utf-8")
        return UNUSABLE
    if option == "--behind-gate":  # the test says when each task begins
        while not os.path.exists(os.path.join(place, os.environ["SLURM_ARRAY_TASK_ID"])):
            time.sleep(0.05)
    os.execv(program, [program, *arguments])


def main():
    if "SLURM_CONF" not in os.environ:
        print("run it as: slurm_cluster.py -- slurm_test.py PROGRAM", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory(prefix="scene-analyzer-farm-") as name:
        farm = Farm(os.path.abspath(sys.argv[1]), pathlib.Path(name))
        write_library(farm.library)
        try:
            one = analyse_on_one_machine(farm, farm.folder / "one")
            many = check_interrupted_array(farm)
            check_same_bytes(farm, (one, many))
            check_bad_node(farm)
            check_restarts_end(farm)
        except AssertionError as failure:
            for log in sorted(farm.logs.iterdir()):
                print(f"--- {log.name}\n{log.read_text(errors='replace')}")
            print("FAILED:", failure)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(stand_in(*sys.argv[1:]) if len(sys.argv) > 2 else main())
