#!/usr/bin/env python3
"""slurm_cluster.py leaves neither process nor file behind, however it ends: slurm_cluster_test.py SLURM_CLUSTER

It is ended by its command, by signals and by SIGKILL while a job runs that ignores SIGTERM.
"""
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
PATIENCE = 100
JOB = "trap '' TERM; touch {started}; while :; do sleep 0.1; done"


def processes_with(text):
    """Whose environment has the text: all that a cluster started, as all know where its configuration is."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if text.encode() in (folder / "environ").read_bytes():
                found.append((folder.name, (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")))
        except OSError:
            continue  # it ended, or is not ours
    return found


def wait_for(is_so):
    end = time.monotonic() + PATIENCE
    while not is_so() and time.monotonic() < end:
        time.sleep(0.1)
    return is_so()


def left_behind(place):
    """After the cluster whose files were in `place` has ended."""
    if not wait_for(lambda: not processes_with(place) and not pathlib.Path(place).exists()):
        return [f"left behind: {processes_with(place)}, files: {pathlib.Path(place).exists()}"]
    return []


def end_by_command(cluster):
    run = subprocess.run([sys.executable, cluster, "--", "sh", "-c",
                          "sinfo --noheader --format=%D; sbatch --wait --gres=gpu:1 --output=/dev/null --wrap 'exit 3' || "
                          "echo $?; echo $SLURM_CLUSTER_FOLDER; exit 7"],
                         capture_output=True, text=True, check=False, timeout=PATIENCE)
    if run.returncode == SKIPPED:
        print(run.stdout, run.stderr)
        sys.exit(SKIPPED)
    *lines, place = run.stdout.split("\n")[:-1]
    if run.returncode != 7 or lines[0] != "2" or lines[-1] != "3":
        return [f"by its command: exit code {run.returncode}\n{run.stdout}\n{run.stderr}"]
    return left_behind(place)


def end_by_signal(cluster, number):
    with tempfile.TemporaryDirectory() as name:
        started, place = pathlib.Path(name, "started"), pathlib.Path(name, "place")
        with subprocess.Popen([sys.executable, cluster, "--", "sh", "-c",
                               f"echo $SLURM_CLUSTER_FOLDER > {place}; sbatch --output=/dev/null --wrap "
                               f"\"{JOB.format(started=started)}\"; while :; do sleep 0.1; done"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            running = wait_for(started.exists)
            process.send_signal(number)
            code = process.wait(timeout=PATIENCE)
        if not running:
            return ["the job did not start"]
        wanted = -number if number == signal.SIGKILL else 128 + number
        found = [] if code == wanted else [f"exit code {code}, not {wanted}"]
        return [f"{number.name}: {problem}" for problem in found + left_behind(place.read_text(encoding="utf-8").strip())]


def main():
    cluster = sys.argv[1]
    problems = end_by_command(cluster)
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL):
        problems += end_by_signal(cluster, number)
    for problem in problems:
        print("FAILED:", problem)
    if not problems:
        print("nothing was left behind")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
