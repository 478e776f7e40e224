#!/usr/bin/env python3
"""Files of every bad kind, given to the program at once: hostile_files.py PROGRAM

Each ends in a result or in one error line that names it; those of which the reason is known have to give that
reason. Prints how many files of how many kinds were tried. The program has to end with exit code 3, within its
limits, and leave nothing behind.
"""
import json
import os
import re
import stat
import struct
import subprocess
import sys
import tempfile
import time
import zipfile

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
LEVELS = 100_000
MEMORY = 1 << 29


def gltf(change=None, positions=b"", count=3):
    """One triangle as .gltf with its buffer inside; `change` edits the JSON."""
    import base64
    data = positions or struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    root = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    if change:
        change(root)
    return json.dumps(root)


def glb(text, binary):
    text = text.encode()
    text += b" " * (-len(text) % 4)
    return (b"glTF" + struct.pack("<II", 2, 20 + len(text) + 8 + len(binary)) +
            struct.pack("<I", len(text)) + b"JSON" + text + struct.pack("<I", len(binary)) + b"BIN\0" + binary)


def set_in(path, value):
    def change(root):
        at = root
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = value
    return change


def chain(root):
    root["nodes"] = [{"children": [i + 1]} for i in range(LEVELS)] + [{"mesh": 0}]


def ply(header, data=b""):
    return ("ply\nformat binary_little_endian 1.0\n" + header + "end_header\n").encode() + data


def dae(nodes):
    return ('<?xml version="1.0"?><COLLADA version="1.4.1"><library_geometries><geometry id="g"><mesh><source id="p">'
            '<float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#pa" '
            'count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" '
            'type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" '
            'source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>'
            '</triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="vs">' + nodes +
            '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>')


INSTANCE = '<node><instance_geometry url="#g"/></node>'
ENTITIES = ('<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "aaaaaaaaaaaaaaaa">' +
            "".join(f'<!ENTITY {chr(b + 1)} "{("&" + chr(b) + ";") * 16}">' for b in range(97, 107)) +
            ']><X3D><Scene><Shape><Text string="&k;"/></Shape></Scene></X3D>')

# name: (contents, a pattern of the reason; None: a result; "": either)
TEXTS = {
    "truncated.obj": (TRIANGLE[:-5], ""),
    "nan.obj": ("v nan 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n", None),
    "huge_index.obj": (TRIANGLE + "f 1 2 4294967299\n", "index"),
    "negative_index.obj": (TRIANGLE + "f -9 -8 -7\n", "index"),
    "zero_index.obj": (TRIANGLE + "f 0 1 2\n", ""),
    "points.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n", None),
    "lines.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n", None),
    "vertices_only.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\n", None),
    "no_texture_coordinates.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n", "0 triangles"),
    "long_line.obj": ("#" + "x" * (1 << 22) + "\n" + TRIANGLE, None),
    "many_corners.obj": (TRIANGLE + "f" + " 1 2 3" * 20_000 + "\n", ""),
    "unit.off": ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", None),
    "lying.off": ("OFF\n4000000000 1 0\n0 0 0\n", ""),
    "index.off": ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999\n", ""),
    "deep.gltf": (gltf(chain), ""),
    "deep_json.gltf": (gltf()[:-1] + ',"extras":' + "[" * LEVELS + "]" * LEVELS + "}", ""),
    "deep_unclosed.gltf": ('{"a":' * LEVELS, "JSON is broken"),
    "twice.gltf": (gltf()[:-1] + ',"nodes":[]}', "twice"),
    "count.gltf": (gltf(set_in(("accessors", 0, "count"), 4_000_000_000)), "counts 4000000000"),
    "count_negative.gltf": (gltf(set_in(("accessors", 0, "count"), -1)), "not a whole number"),
    "count_1e300.gltf": (gltf(set_in(("accessors", 0, "count"), 1e300)), "not a whole number"),
    "stride.gltf": (gltf(set_in(("bufferViews", 0, "byteStride"), 4)), "stride of 4"),
    "stride_negative.gltf": (gltf(set_in(("bufferViews", 0, "byteStride"), -12)), "not a whole number"),
    "offset.gltf": (gltf(set_in(("bufferViews", 0, "byteOffset"), 2**64 - 4)), "ends at byte"),
    "length.gltf": (gltf(set_in(("buffers", 0, "byteLength"), 2**40)), "promises"),
    "cycle.gltf": (gltf(set_in(("nodes",), [{"children": [1]}, {"children": [0]}])), "cycle"),
    "shared.gltf": (gltf(set_in(("nodes",), [{"children": [i + 1, i + 1]} for i in range(40)] + [{"mesh": 0}])),
                    "more than ten million"),
    "nan_matrix.gltf": (gltf(set_in(("nodes", 0, "matrix"), [1e39] * 16)), None),
    "nan.gltf": (gltf(positions=struct.pack("<9f", *[float("nan")] * 9)), None),
    "url.gltf": (gltf(set_in(("buffers", 0, "uri"), "https://example.com/a.bin")), "address"),
    "passwd.gltf": (gltf(set_in(("buffers", 0, "uri"), "../../../../../../etc/passwd")), "leads out"),
    "absolute.gltf": (gltf(set_in(("buffers", 0, "uri"), "/etc/passwd")), "leads out"),
    "scene.gltf": (gltf(set_in(("scene",), 7)), "scene 7 does not exist"),
    "bom.gltf": ("\ufeff" + gltf(), None),
    "empty_object.gltf": ("{}", ""),
    "null.gltf": ("null", "not an object"),
    "half.gltf": (gltf()[:200], "JSON is broken"),
    "plain.dae": (dae(INSTANCE), None),
    "deep.dae": (dae("<node>" * LEVELS + INSTANCE + "</node>" * LEVELS), ""),
    "half.dae": (dae(INSTANCE)[:600], "Assimp cannot read it"),
    "entities.x3d": (ENTITIES, ""),
    "deep.x3d": ("<X3D><Scene>" + "<Group>" * LEVELS + "</Group>" * LEVELS + "</Scene></X3D>", ""),
    "count.dae": (dae(INSTANCE).replace('count="9"', 'count="4000000000"'), ""),
    "header.ply": ("ply\nformat ascii 1.0\nelement vertex 3\n", "no end"),
    "short.stl": ("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0", ""),
    "empty.stl": ("solid x\nendsolid x\n", None),
    "empty.dxf": ("0\nEOF\n", ""),
    "web_page.fbx": ("<!doctype html><html></html>", "web page"),
    "brackets.fbx": ("; FBX 7.4.0 project file\n" + "A: {\n" * LEVELS, ""),
    "quote \"'$(x)`.obj": (TRIANGLE, None),
    "new\nline.obj": (TRIANGLE, None),
    "-dash.obj": (TRIANGLE, None),
    "\udcff\udcfe.obj": (TRIANGLE, None),
    "wrong.docx": ("words", "unsupported format"),
    "..obj": (TRIANGLE, ""),
}
STL_HEADER = b"x" * 80
BYTES = {
    "utf16.obj": (TRIANGLE.encode("utf-16"), "UTF-16"),
    "utf16.gltf": (gltf().encode("utf-16"), "UTF-16"),
    "utf16.dae": (dae(INSTANCE).encode("utf-16"), ""),
    "zeros.obj": (bytes(100_000), ""),
    "zeros.fbx": (bytes(100_000), ""),
    "zeros.blend": (bytes(100_000), ""),
    "zeros.3ds": (bytes(100_000), ""),
    "ones.3ds": (b"\xff" * 4096, ""),
    "ones.lwo": (b"FORM" + b"\xff" * 4096, ""),
    "count.stl": (STL_HEADER + struct.pack("<I", 2**32 - 1) + bytes(50), "4294967295 triangles takes"),
    "none.stl": (STL_HEADER + struct.pack("<I", 0), "0 triangles"),
    "count.ply": (ply("element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n", bytes(36)),
                  "is cut off"),
    "list.ply": (ply("element face 1\nproperty list uint uint vertex_indices\n", struct.pack("<II", 2**32 - 1, 0)),
                 "is cut off"),
    "index.ply": (ply("element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                      "property list uchar uint vertex_indices\n",
                      bytes(36) + struct.pack("<BIII", 3, 0, 1, 2**31)), ""),
    "chunk.glb": (glb(gltf(), b"")[:30], "is cut off"),
    "header.glb": (b"glTF\2\0\0\0", "is cut off"),
    "version.glb": (b"glTF" + struct.pack("<II", 9, 12), "version 9"),
    "gzip.obj": (b"\x1f\x8b\x08" + bytes(50), "gzip"),
    "empty.obj": (b"", "is empty"),
}


def write_archives(folder):
    """A few megabytes that unpack to more than the limit."""
    types = '<Types xmlns="x"><Default Extension="model" ContentType="m"/></Types>'
    rels = ('<Relationships xmlns="x"><Relationship Target="/3D/3dmodel.model" Id="r" '
            'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
    with zipfile.ZipFile(os.path.join(folder, "bomb.3mf"), "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr("[Content_Types].xml", types)
        archive.writestr("_rels/.rels", rels)
        with archive.open("3D/3dmodel.model", "w", force_zip64=True) as model:
            for _ in range(600):  # MiB, more than MEMORY
                model.write(b" " * (1 << 20))
    with open(os.path.join(folder, "cut.3mf"), "wb") as cut, open(os.path.join(folder, "bomb.3mf"), "rb") as whole:
        cut.write(whole.read(100_000))
    return {"bomb.3mf": "limit of", "cut.3mf": ""}


def write_odd_kinds(folder):
    """What is no plain file, or not readable, or not as large as it looks."""
    at = lambda name: os.path.join(folder, name)
    os.mkfifo(at("fifo.obj"))
    os.mkdir(at("folder.obj"))
    os.symlink("/dev/zero", at("zero.obj"))
    os.symlink("loop.obj", at("loop.obj"))
    os.symlink("nowhere.obj", at("dangling.obj"))
    os.symlink(at("plain.dae"), at("link.dae"))
    for name in ("sparse.obj", "sparse.stl", "sparse.glb"):
        with open(at(name), "wb") as file:
            file.write(b"glTF" if name.endswith("glb") else b"# x\n")
            file.truncate(1 << 40)
    kinds = {"fifo.obj": "not a regular file", "folder.obj": "is a folder", "zero.obj": "not a regular file",
             "loop.obj": "cannot be read", "dangling.obj": "no such file", "link.dae": None,
             "missing.obj": "no such file", "sparse.obj": "limit of", "sparse.stl": "limit of", "sparse.glb": "limit of"}
    if os.geteuid() != 0:
        with open(at("secret.obj"), "w") as file:
            file.write(TRIANGLE)
        os.chmod(at("secret.obj"), 0)
        kinds["secret.obj"] = "Permission denied"
    return kinds


def write_all(folder):
    expected = {}
    for name, (contents, reason) in {**TEXTS, **BYTES}.items():
        with open(os.path.join(os.fsencode(folder), os.fsencode(name)), "wb") as file:
            file.write(contents if isinstance(contents, bytes) else contents.encode())
        expected[name] = reason
    expected.update(write_archives(folder))
    expected.update(write_odd_kinds(folder))
    return expected


def shown(name):
    """As messages print it."""
    return re.sub("[\x00-\x1f\x7f]", "", os.fsencode(name).decode(errors="replace"))


def check(name, reason, errors):
    mine = [line for line in errors if line.startswith(f"error: {shown(name)}: ")]
    if reason is None and mine:
        return f"should be analysed: {mine[0]}"
    if len(mine) > 1:
        return f"{len(mine)} errors for one file"
    if reason and (not mine or reason not in mine[0]):
        return f"should say \"{reason}\": {mine}"
    return None


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="scene-analyzer-hostile-") as folder:
        expected = write_all(folder)
        before = sorted(os.listdir(folder))
        begin = time.monotonic()
        run = subprocess.run(
            [program, "analyze", "--quiet", "--no-cache", "--metrics", "polygons_per_planar_group", "--import-memory",
             str(MEMORY), "--import-timeout", "30", "--json", "-", "--", *map(os.fsencode, expected)],
            cwd=folder, capture_output=True, timeout=900)
        seconds = time.monotonic() - begin
        failures = [] if run.returncode == 3 else [f"exit code {run.returncode}"]
        errors = run.stderr.decode(errors="replace").splitlines()
        if "--verbose" in sys.argv:
            print("\n".join(errors))
        document = json.loads(run.stdout, parse_constant=lambda word: failures.append(f"JSON holds {word}"))
        for name, reason in expected.items():
            problem = check(name, reason, errors)
            if problem:
                failures.append(f"{shown(name)}: {problem}")
        if any(not line.startswith("error: ") for line in errors):
            failures.append("standard error holds more than errors: " + repr(errors))
        if sorted(os.listdir(folder)) != before:
            failures.append("files were left behind: " + str(sorted(set(os.listdir(folder)) - set(before))))
        if len(errors) + len(document["assets"]) != len(expected):
            failures.append(f"{len(expected)} files, {len(document['assets'])} results and {len(errors)} reasons")
        print(f"{len(expected)} files: {len(document['assets'])} analysed, {len(errors)} refused with one reason each, "
              f"in {seconds:.1f} s")
        for failure in failures:
            print("FAILED:", failure)
        return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
