#!/usr/bin/env python3
"""The service beside processes and beside the pipeline itself: service.py PROGRAM CLIENTS [--quick]

Small assets, none like another, all on this machine: requests per second of 8 clients against one process per asset, two
at a time, under GNU xargs; the time that the service adds to what the pipeline takes in a process of its own, asset by
asset in turns; and the memory of the service over 10000 requests (--quick: 1000). Prints a Markdown table. Fails when an
answer is wrong or missing, not when a target is missed.
"""
import argparse
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

METRICS = ("polygons_per_planar_group,planar_group_variation,relative_density,distance,cooccurrence_contrast,"
           "fourier_transform")
CLIENTS = 8


class Service:
    def __init__(self, program, uploads):
        self.process = subprocess.Popen([program, "serve", "--listen", "127.0.0.1:0", "--upload-dir", uploads],
                                        stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            if found := re.search(r"listening on (\S+)", line):
                self.address = found[1]
                break
        else:
            sys.exit(f"service: ended with {self.process.wait()}")
        self.log = tempfile.TemporaryFile()
        self.drain = subprocess.Popen(["cat"], stdin=self.process.stderr, stdout=self.log)

    def memory(self):
        """Resident, in MiB."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        if self.process.wait() != 0:
            sys.exit(f"service: ended with {self.process.returncode}")


def ask(clients, *arguments):
    done = subprocess.run([clients, *map(str, arguments)], stdout=subprocess.PIPE, check=False)
    if done.returncode != 0:
        sys.exit("service: " + " ".join(map(str, arguments)) + " has failed")
    return json.loads(done.stdout)


def processes(program, clients, count, folder):
    """Assets per second of a process each."""
    ask(clients, "write", folder, 0, count)
    names = folder / "names"
    assets = sorted(folder.glob("*.ply"))
    names.write_bytes(b"\0".join(os.fsencode(asset) for asset in assets))
    started = time.monotonic()
    subprocess.run(["xargs", "-0", "-a", names, "-P2", "-n1", program, "analyze", "--quiet", "--no-cache", "--metrics",
                    METRICS, "--"], stdout=subprocess.DEVNULL, check=True)
    return count / (time.monotonic() - started)


def row(name, value, target="", met=None):
    print(f"| {name} | {value} | {target} | {'' if met is None else 'met' if met else 'missed'} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("clients", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    program, clients = arguments.program.resolve(), arguments.clients.resolve()
    share = 10 if arguments.quick else 1
    print("| figure | value | target | |\n|---|--:|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        service = Service(program, folder)
        ask(clients, "load", service.address, CLIENTS, 10**9, 100)  # kernels are made
        alone = processes(program, clients, 200 // share, folder)
        count = 2000 // share
        rate = count / ask(clients, "load", service.address, CLIENTS, 2 * 10**9, count)["seconds"]
        row("assets per second, a process each, xargs -P2", f"{alone:.1f}")
        row(f"assets per second, the service, {CLIENTS} clients", f"{rate:.1f}")
        row("times as many", f"{rate / alone:.1f}", "at least 10", rate >= 10 * alone)
        times = ask(clients, "latency", service.address, 3 * 10**9, 500 // share)
        row("the pipeline in a process of its own, median ms", f"{1000 * times['in_process']:.1f}")
        row("the service, one client, median ms", f"{1000 * times['service']:.1f}")
        row("added, median of the differences, ms", f"{1000 * times['added']:.1f}", "under 5", times["added"] < 0.005)
        memory = [service.memory()]
        for i in range(10):
            ask(clients, "load", service.address, CLIENTS, 4 * 10**9 + i * 1000, 1000 // share)
            memory.append(service.memory())
        row(f"memory before {10000 // share} requests, MiB", f"{memory[0]:.0f}")
        row("after every tenth of them, MiB", ", ".join(f"{one:.0f}" for one in memory[1:]))
        row("growth over the last half, MiB", f"{memory[-1] - memory[5]:.1f}", "flat", memory[-1] - memory[5] < 4)
        service.stop()


if __name__ == "__main__":
    main()
