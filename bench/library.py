#!/usr/bin/env python3
"""A library from folder to merged table: library.py PROGRAM RECORDS [--quick] [LIBRARY]

Copies the assets of LIBRARY (default: the collection beside the repository) under other names to 200 and to 2000
(--quick: 40 and 400), and compares `batch` with a process per asset under GNU xargs -P2, the second run with the
first, the memory of the large library with that of the small one; kills a run 20 times at random moments and compares
what it comes to with what an undisturbed one did; and merges a million meshes that RECORDS (bench/library_records.cpp)
makes up. Then what docs/farm.md computes with: rates by --jobs, what starting and skipping a shard takes, how unequal
assets and shards are, bytes written. Prints Markdown tables. Fails when something is lost or doubled, not when a target
is missed.
"""
import argparse
import csv
import json
import os
import pathlib
import random
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
METRICS = ("polygons_per_planar_group,planar_group_variation,relative_density,distance,cooccurrence_contrast,"
           "fourier_transform")
EXTENSIONS = {".glb", ".gltf", ".obj", ".fbx", ".ply", ".stl"}
KILLS = 20


def assets_of(source):
    assets = sorted(path for path in source.rglob("*") if path.suffix.lower() in EXTENSIONS)
    return assets or sys.exit(f"library: no assets in {source}")


def copy_library(source, target, count):
    """`count` assets, with what lies beside them, so that materials are found."""
    assets = assets_of(source)
    for i in range(count):
        asset = assets[i % len(assets)]
        folder = target / f"{i // len(assets):04}"
        folder.mkdir(parents=True, exist_ok=True)
        for beside in asset.parent.glob(asset.stem + ".*"):
            shutil.copy(beside, folder / beside.name)
    return sorted(path for path in target.rglob("*") if path.suffix.lower() in EXTENSIONS)


def run(command, codes=(0,)):
    """Seconds, and the largest memory of the process or one of its import workers, in MiB."""
    started = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    errors = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in codes:
        sys.exit(f"library: {' '.join(map(str, command))}: exit code {process.returncode}: {errors.decode(errors='replace')}")
    return time.monotonic() - started, usage.ru_maxrss / 1024


def batch(program, library, out):
    return [program, "batch", library, "--out", out, "--metrics", METRICS]


def per_asset(program, assets, folder):
    """Assets per minute of a process each, two at a time."""
    names = folder / "names"
    names.write_bytes(b"\0".join(os.fsencode(asset) for asset in assets))
    seconds, _ = run(["xargs", "-0", "-a", names, "-P2", "-n1", program, "analyze", "--quiet", "--cache-dir",
                      folder / "per-asset", "--metrics", METRICS, "--"])
    return len(assets) / seconds * 60


def merged_rows(program, out, table):
    run([program, "merge", out, "--csv", table, "--json", str(table) + ".json"])
    with open(table, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def kill_and_finish(program, library, out, seconds):
    """Runs that are killed after a random part of what one would take; returns how many met the run at work."""
    met = 0
    generator = random.Random(1)
    for _ in range(KILLS):
        process = subprocess.Popen(batch(program, library, out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(generator.uniform(0.05, 2 * seconds / KILLS))
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            met += 1
        process.wait()
    run(batch(program, library, out))
    return met


def row2(name, value):
    print(f"| {name} | {value} |", flush=True)


def row(name, value, target="", met=""):
    print(f"| {name} | {value} | {target} | {met} |")


def verdict(good):
    return "met" if good else "missed"


def measure(program, source, small, large, folder):
    few = copy_library(source, folder / "few", small)
    copy_library(source, folder / "many", large)
    run(batch(program, folder / "few", folder / "warm-up"))
    alone = per_asset(program, few, folder)
    _, small_peak = run(batch(program, folder / "few", folder / "few-out"))
    seconds, peak = run(batch(program, folder / "many", folder / "many-out"))
    again, _ = run(batch(program, folder / "many", folder / "many-out"))
    rate = large / seconds * 60
    row("assets per minute, a process each, xargs -P2", f"{alone:.0f}")
    row(f"assets per minute, batch of {large}", f"{rate:.0f}")
    row("times as many", f"{rate / alone:.1f}", "at least 4", verdict(rate >= 4 * alone))
    row("first run, seconds", f"{seconds:.1f}")
    row("second, unchanged run, seconds", f"{again:.2f}")
    row("times as fast", f"{seconds / again:.0f}", "at least 20", verdict(seconds >= 20 * again))
    row(f"peak memory, {small} assets, MiB", f"{small_peak:.0f}")
    row(f"peak memory, {large} assets, MiB", f"{peak:.0f}", "flat", verdict(peak < 1.1 * small_peak + 10))
    return seconds


def compare_killed(program, large, folder, seconds):
    met = kill_and_finish(program, folder / "many", folder / "killed-out", seconds)
    expected = merged_rows(program, folder / "many-out", folder / "undisturbed.csv")
    found = merged_rows(program, folder / "killed-out", folder / "killed.csv")
    row("kills that met the run", f"{met} of {KILLS}")
    row("assets after them", len({line[1] for line in found[1:]}), large, verdict(found == expected))
    return found == expected


def merge_million(program, records, folder, meshes):
    subprocess.run([records, folder / "records", str(meshes // 100), "100"], check=True)
    seconds, peak = run([program, "merge", folder / "records", "--json", folder / "records.json"])
    row(f"merging {meshes} meshes, seconds", f"{seconds:.1f}")
    row(f"merging {meshes} meshes, peak MiB", f"{peak:.0f}", "under 2048", verdict(peak < 2048))
    table_seconds, table_peak = run([program, "merge", folder / "records", "--csv", folder / "records.csv"])
    row("the same with the table of all meshes, seconds", f"{table_seconds:.1f}")
    row("the same, peak MiB", f"{table_peak:.0f}", "under 2048", verdict(table_peak < 2048))


def shard_loads(program, folder, source, seconds_of, shards):
    """Seconds of each of `shards` shards of the large library, from what each of its assets takes alone."""
    out = folder / "cut"
    run(batch(program, folder / "many", out) + ["--shard-index", "0", "--shard-count", str(shards)])
    loads = [0.0] * shards
    with open(out / "library.jsonl", encoding="utf-8") as lines:
        next(lines)
        for line in lines:
            asset = json.loads(line)
            loads[asset["shard"]] += seconds_of[pathlib.Path(asset["asset"]).name]
    return loads


def farm_figures(program, records, source, large, folder):
    print("\n| for docs/farm.md | value |\n|---|--:|")
    for jobs in (1, 2, 4):
        seconds, _ = run(batch(program, folder / "many", folder / f"jobs-{jobs}") + ["--jobs", str(jobs)])
        row2(f"assets per minute, --jobs {jobs}", f"{large / seconds * 60:.0f}")
    one, _ = run(batch(program, folder / "many", folder / "start") + ["--shard-index", "0", "--shard-count", str(large)])
    row2(f"a shard of one asset in a library of {large}: a, seconds", f"{one:.2f}")
    again, _ = run(batch(program, folder / "many", folder / "jobs-4"))
    row2("skipping a shard that is done, seconds per 1000 assets", f"{again / large * 1000:.2f}")
    seconds_of = {}
    for asset in copy_library(source, folder / "each", len(assets_of(source))):
        seconds_of[asset.name], _ = run([program, "analyze", "--quiet", "--no-cache", "--metrics", METRICS, "--", asset])
    times = list(seconds_of.values())
    row2(f"time of {len(times)} assets alone, standard deviation / mean: c",
         f"{statistics.pstdev(times) / statistics.mean(times):.2f}")
    loads = shard_loads(program, folder, source, seconds_of, 32)
    mean = statistics.mean(loads)
    row2(f"longest and shortest of 32 shards of {large} assets, part of their mean",
         f"{max(loads) / mean:.2f}, {min(loads) / mean:.2f}")
    written = [path.stat().st_size for path in (folder / "jobs-4").rglob("*") if path.is_file()]
    row2("bytes written per asset: b", f"{sum(written) / large:.0f}")
    row2("files written per asset: w", f"{len(written) / large:.3f}")
    subprocess.run([records, folder / "assets", str(50 * large), "1"], check=True)
    seconds, peak = run([program, "merge", folder / "assets", "--json", folder / "assets.json"])
    row2(f"merging {50 * large} assets of one mesh, seconds", f"{seconds:.1f}")
    row2("the same, peak KiB per asset", f"{peak * 1024 / (50 * large):.1f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("records", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("library", nargs="?", type=pathlib.Path, default=ROOT.parent / "shared/assets/library")
    arguments = parser.parse_args()
    if not arguments.library.is_dir():
        sys.exit(f"library: {arguments.library} is no folder; name a folder of assets")
    program, records = arguments.program.resolve(), arguments.records.resolve()
    share = 5 if arguments.quick else 1
    print("| figure | value | target | |\n|---|--:|---|---|")
    with tempfile.TemporaryDirectory(prefix="scene-analyzer-library-") as name:
        folder = pathlib.Path(name)
        seconds = measure(program, arguments.library, 200 // share, 2000 // share, folder)
        same = compare_killed(program, 2000 // share, folder, seconds)
        merge_million(program, records, folder, 1_000_000 // share)
        farm_figures(program, records, arguments.library, 2000 // share, folder)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
