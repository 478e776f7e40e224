#!/usr/bin/env python3
"""Times whole processes: the program beside `assimp info` on the demo scene, warm and from nothing.

Runs take turns, so that what else the machine does disturbs all of them; medians are compared.
Prints a Markdown table. Fails when a program fails, not when a target is missed.
"""

import argparse
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
WARM_TARGET = 5.0  # times `assimp info`
COLD_TARGET = 6.0  # seconds
# What the targets are for: all that needs neither a Fourier transform nor a rasteriser.
METRICS = ("polygons_per_planar_group,planar_group_variation,relative_density,distance,"
           "cooccurrence_contrast")


def cpu_seconds():
    """Of all processes that ended and were waited for, import workers of the program included."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def time_run(command, environment):
    """Seconds on the wall and on the processors."""
    started, cpu = time.monotonic(), cpu_seconds()
    done = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
    seconds = time.monotonic() - started
    if done.returncode != 0:
        sys.exit(f"bench: {command[0]} ended with {done.returncode}: {done.stderr.decode(errors='replace')}")
    return seconds, cpu_seconds() - cpu


def with_caches_in(folder):
    """The environment of a user whose caches (the program's own and the driver's) all lie in `folder`."""
    environment = {key: value for key, value in os.environ.items()
                   if not key.startswith(("MESA_SHADER_CACHE", "MESA_GLSL_CACHE"))}
    environment["XDG_CACHE_HOME"] = os.path.join(folder, "xdg")
    environment["MESA_SHADER_CACHE_DIR"] = os.path.join(folder, "mesa")
    return environment


def measure(program, asset, rounds):
    analyze = [program, "analyze", "--no-cache", "--quiet", "--metrics", METRICS, asset]
    times = {"cold": [], "warm": [], "assimp": []}
    with tempfile.TemporaryDirectory() as kept:
        warm = with_caches_in(kept)
        time_run(analyze, warm)
        time_run(["assimp", "info", asset], warm)
        for _ in range(rounds):
            with tempfile.TemporaryDirectory() as fresh:
                times["cold"].append(time_run(analyze, with_caches_in(fresh)))
            times["warm"].append(time_run(analyze, warm))
            times["assimp"].append(time_run(["assimp", "info", asset], warm))
    return times


def median(runs):
    return statistics.median(wall for wall, _ in runs)


def row(name, runs):
    walls = [wall for wall, _ in runs]
    cpu = statistics.median(cpu for _, cpu in runs)
    return f"| {name} | {median(runs):.3f} | {min(walls):.3f} | {max(walls):.3f} | {cpu:.3f} |"


def verdict(met):
    return "met" if met else "missed"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="scene-analyzer to be timed")
    parser.add_argument("--asset", default=str(ROOT / "examples" / "living-room.glb"))
    parser.add_argument("--rounds", type=int, default=11)
    options = parser.parse_args()
    if options.rounds < 1:
        parser.error("--rounds must be at least 1")
    if shutil.which("assimp") is None:
        sys.exit("bench: the program `assimp` is missing (package assimp-utils)")

    times = measure(options.program, options.asset, options.rounds)
    ratio = median(times["warm"]) / median(times["assimp"])
    cold = median(times["cold"])
    print(f"\nWhole processes on {os.path.basename(options.asset)}, {options.rounds} rounds, seconds:\n")
    print("| process | median | least | most | on processors |\n|---|--:|--:|--:|--:|")
    print(row("`assimp info`", times["assimp"]))
    print(row("`scene-analyzer analyze --no-cache`, warm", times["warm"]))
    print(row("`scene-analyzer analyze --no-cache`, no caches at all", times["cold"]))
    print("\n| figure | value | target | |\n|---|--:|---|---|")
    print(f"| warm / `assimp info` | {ratio:.2f} | at most {WARM_TARGET:.0f} | {verdict(ratio <= WARM_TARGET)} |")
    print(f"| no caches at all | {cold:.2f} s | at most {COLD_TARGET:.0f} s | {verdict(cold <= COLD_TARGET)} |")


if __name__ == "__main__":
    main()
