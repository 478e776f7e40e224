#!/usr/bin/env python3
"""Large assets from file to table: sizes.py PROGRAM [--quick] [FILE...]

Generates a binary PLY of 10 million triangles and a glTF of 100000 instances of one mesh (--quick: a tenth of both),
analyses them and the FILEs one by one, with all metrics that need neither a Fourier transform nor a rasteriser, and
prints a Markdown table of times and peak memory. Fails when an analysis fails, and when an instance costs memory as
a mesh does.
"""
import argparse
import array
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import time

METRICS = "polygons_per_planar_group,planar_group_variation,relative_density,distance,cooccurrence_contrast"
MOST_BYTES_PER_INSTANCE = 400  # of the import's answer: a matrix, a name, no triangle


def height(x, y):
    return math.sin(x * 0.013) * math.cos(y * 0.017) * 20


def write_heightfield(path, side):
    """Binary PLY of 2 side^2 triangles."""
    width = side + 1
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {width * width}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {2 * side * side}\nproperty list uchar uint vertex_indices\nend_header\n")
    face = struct.Struct("<BIIIBIII").pack
    with open(path, "wb") as file:
        file.write(header.encode())
        for y in range(width):
            row = array.array("f", (value for x in range(width) for value in (x, y, height(x, y))))
            file.write(row.tobytes())
        for y in range(side):
            begin = y * width
            file.write(b"".join(face(3, i, i + 1, i + width + 1, 3, i, i + width + 1, i + width)
                                for i in range(begin, begin + side)))


def write_instances(path, instances, side=16):
    """glTF of `instances` nodes that show one mesh of 2 side^2 triangles."""
    width = side + 1
    positions = array.array("f", (v for y in range(width) for x in range(width) for v in (x, y, height(x * 20, y * 20))))
    indices = array.array("H", (i for y in range(side) for x in range(side)
                                for a in (y * width + x,)
                                for i in (a, a + 1, a + width + 1, a, a + width + 1, a + width)))
    data = positions.tobytes() + indices.tobytes()
    row = math.isqrt(instances) + 1
    root = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(instances))}],
        "nodes": [{"mesh": 0, "name": f"n{i}", "translation": [i % row * side, i // row * side, 0]}
                  for i in range(instances)],
        "meshes": [{"name": "tile", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": width * width, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions) * 4},
                        {"buffer": 0, "byteOffset": len(positions) * 4, "byteLength": len(indices) * 2}],
        "buffers": [{"byteLength": len(data), "uri": os.path.basename(path) + ".bin"}]}
    with open(path + ".bin", "wb") as file:
        file.write(data)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(root, file)


def figure(pattern, text):
    found = re.search(pattern, text)
    if not found:
        sys.exit(f"sizes: the log lacks {pattern}:\n{text}")
    return float(found.group(1))


def measure(program, asset, folder):
    out = os.path.join(folder, "out.json")
    started = time.monotonic()
    done = subprocess.run([program, "analyze", "--no-cache", "--verbose", "--metrics", METRICS, "--json", out, "--", asset],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace", check=False)
    seconds = time.monotonic() - started
    if done.returncode != 0:
        sys.exit(f"sizes: {asset}: exit code {done.returncode}: {done.stderr}")
    with open(out, encoding="utf-8") as file:
        scene = json.load(file)["scene"]
    return {"asset": os.path.basename(asset), "bytes": os.path.getsize(asset), "scene": scene, "seconds": seconds,
            "import": figure(r"imported in ([0-9.]+) s", done.stderr),
            "arrays": figure(r"arrays take ([0-9.]+) MiB", done.stderr),
            "worker": figure(r"worker's peak was ([0-9.]+) MiB", done.stderr),
            "process": figure(r"peak memory of this process ([0-9.]+) MiB", done.stderr)}


def print_table(results):
    print("| asset | file, MiB | triangles | instances | drawn | seconds | of it import | scene, MiB | peak of the worker | "
          "peak of the program |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    for r in results:
        scene = r["scene"]
        print(f"| {r['asset']} | {r['bytes'] / 2**20:.1f} | {scene['unique_triangles']} | {scene['mesh_count']} | "
              f"{scene['drawn_triangles']} | {r['seconds']:.1f} | {r['import']:.1f} | {r['arrays']:.1f} | "
              f"{r['worker']:.0f} | {r['process']:.0f} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    share = 10 if arguments.quick else 1
    with tempfile.TemporaryDirectory(prefix="scene-analyzer-sizes-") as folder:
        ply = os.path.join(folder, "heightfield.ply")
        write_heightfield(ply, math.isqrt(10_000_000 // share // 2) + 1)
        gltf = os.path.join(folder, "instances.gltf")
        instances = 100_000 // share
        write_instances(gltf, instances)
        results = [measure(program, asset, folder) for asset in [ply, gltf, *arguments.files]]
    print_table(results)
    per_instance = results[1]["arrays"] * 2**20 / instances
    print(f"\n{per_instance:.0f} bytes of the imported scene per instance, at most {MOST_BYTES_PER_INSTANCE}")
    return 0 if per_instance <= MOST_BYTES_PER_INSTANCE else 1


if __name__ == "__main__":
    sys.exit(main())
