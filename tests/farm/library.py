"""A small library of assets: nested folders, two formats, sizes from 32 to 320000 triangles, one asset that is broken.

Deterministic, and large enough that a task is some seconds at work and can be stopped in the middle.
"""
import array
import json
import math
import struct

ASSETS = 30
BROKEN = "broken/cut_off.glb"


def heightfield(side):
    """Positions and triangle indices of side x side squares; every fourth column is flat."""
    positions, indices = array.array("f"), array.array("I")
    for y in range(side + 1):
        for x in range(side + 1):
            positions.extend((x, y, 0 if x % 4 == 0 else 2 * math.sin(0.3 * x) * math.cos(0.2 * y)))
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x
            c = a + side + 1
            indices.extend((a, a + 1, c + 1, a, c + 1, c))
    return positions, indices


def obj(positions, indices):
    lines = [f"v {positions[i]:.6g} {positions[i + 1]:.6g} {positions[i + 2]:.6g}\n" for i in range(0, len(positions), 3)]
    lines += [f"f {indices[i] + 1} {indices[i + 1] + 1} {indices[i + 2] + 1}\n" for i in range(0, len(indices), 3)]
    return "".join(lines).encode()


def glb(positions, indices):
    binary = positions.tobytes() + indices.tobytes()
    corners = [positions[i::3] for i in range(3)]
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "field"}],
        "meshes": [{"name": "field", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions) // 3, "type": "VEC3",
                       "min": [min(c) for c in corners], "max": [max(c) for c in corners]},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 4 * len(positions)},
                        {"buffer": 0, "byteOffset": 4 * len(positions), "byteLength": 4 * len(indices)}],
        "buffers": [{"byteLength": len(binary)}]}).encode()
    text += b" " * (-len(text) % 4)
    return (b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(binary)) + struct.pack("<I", len(text)) + b"JSON" + text +
            struct.pack("<I", len(binary)) + b"BIN\0" + binary)


def write_library(folder):
    """ASSETS files below `folder`, which is made; BROKEN is one of them."""
    for i in range(ASSETS - 1):
        side = 4 if i % 5 == 0 else 400 if i % 7 == 0 else 150 + 8 * i
        write, suffix = (obj, "obj") if i % 3 == 0 else (glb, "glb")
        # Equal names in different folders, and names with spaces.
        path = folder / ("terrain", "town/old part", "town/new")[i % 3] / f"piece {i // 3}.{suffix}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(write(*heightfield(side)))
    broken = folder / BROKEN
    broken.parent.mkdir(parents=True)
    broken.write_bytes(glb(*heightfield(4))[:-40])
