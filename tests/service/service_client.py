"""A service under test, and a client of it that shares no code with it: Python's gRPC over TCP.

Arguments of every test program: PROGRAM STUBS LAYERS [unittest's own]. STUBS is a folder with the Python modules that
protoc made of our .proto files and of gRPC's (health, reflection); LAYERS holds the Vulkan layer that injects faults.
"""
import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.request
import zlib

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, sys.argv[2])
LAYERS = pathlib.Path(sys.argv[3])
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
DEMO = SOURCE / "examples" / "living-room.glb"

import grpc  # noqa: E402

grpc.__path__.append(sys.argv[2] + "/grpc")  # grpc.health and grpc.reflection, which Debian has as .proto files only
from scene_analyzer.v1 import service_pb2 as pb  # noqa: E402
from scene_analyzer.v1 import service_pb2_grpc as rpc  # noqa: E402

CHUNK = 1 << 20
QUICK = ["polygons_per_planar_group", "planar_group_variation", "relative_density", "distance",
         "cooccurrence_contrast", "fourier_transform"]
# Nothing takes so long; only what hangs meets it.
PATIENCE = 300


def run_tests():
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], verbosity=2)


def wait_until(condition, what):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"in vain waited until {what}")
        time.sleep(0.01)


class Service:
    """`scene-analyzer serve` on a free port. What it logs is in `lines`."""

    def __init__(self, *options, env=None, uploads=None):
        self.folder = tempfile.TemporaryDirectory(prefix="service-test-")
        self.uploads = uploads or pathlib.Path(self.folder.name) / "uploads"
        self.uploads.mkdir(exist_ok=True)
        listen = () if "--listen" in options else ("--listen", "127.0.0.1:0")
        self.ended = False
        command = [PROGRAM, "serve", *listen, "--metrics-listen", "127.0.0.1:0",
                   "--upload-dir", self.uploads, *options]
        self.process = subprocess.Popen([str(word) for word in command], stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, **(env or {})}, start_new_session=True)
        self.lines = []
        self.address = self.metrics_url = None
        self.changed = threading.Condition()
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        wait_until(lambda: self.address or self.process.poll() is not None, "the service listens")
        if self.address is None:
            self.reader.join()
            raise RuntimeError(f"the service ended with {self.process.returncode}: {self.log()}")
        self.port = int(self.address.rsplit(":", 1)[1])

    def _read(self):
        for line in self.process.stderr:
            with self.changed:
                self.lines.append(line.rstrip("\n"))
                if found := re.search(r"listening on (\S+)", line):
                    self.address = found[1]
                if found := re.search(r"metrics at (http://\S+/metrics)", line):
                    self.metrics_url = found[1]
                self.changed.notify_all()

    def log(self):
        return "\n".join(self.lines)

    def channel(self, *options):
        return grpc.insecure_channel(self.address, options=[("grpc.max_receive_message_length", -1), *options])

    def stub(self):
        return rpc.SceneAnalyzerStub(self.channel(("grpc.use_local_subchannel_pool", 1)))

    def metric(self, name):
        text = urllib.request.urlopen(self.metrics_url, timeout=PATIENCE).read().decode()
        found = re.search(rf"^{re.escape(name)} (\S+)$", text, re.MULTILINE)
        return float(found[1]) if found else 0.0

    def upload_files(self):
        # os.walk does not mind folders that vanish meanwhile.
        return [name for _, _, names in os.walk(self.uploads) for name in names]

    def terminate(self, code=0):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        self.wait(code)

    def wait(self, code=0):
        ended = self.process.wait(PATIENCE)
        self.reader.join()
        self.process.stderr.close()
        self.ended = True
        assert ended == code, f"ended with {ended}, not {code}: {self.log()}"

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        try:
            if kind is None:
                if not self.ended:
                    self.terminate()
                assert not list(self.uploads.iterdir()), "uploads are left"
                assert "validation" not in self.log().lower(), self.log()
            else:
                print(self.log(), file=sys.stderr)
        finally:
            if self.process.poll() is None:
                self.process.kill()
                self.process.wait()
            self.folder.cleanup()


def parts_of(message, files, parameters, chunk=CHUNK):
    yield message(parameters=parameters)
    for name, data in files.items():
        yield message(file=pb.FileHeader(name=name, size=len(data)))
        for begin in range(0, len(data), chunk):
            yield message(data=data[begin:begin + chunk])


def analyze(stub, files, measuring=None, path="", **call):
    """The result; progress goes to `progress` where that is a list."""
    progress = call.pop("progress", [])
    parameters = pb.AnalyzeParameters(measuring=measuring, path=path)
    call.setdefault("timeout", PATIENCE)
    result = None
    for event in stub.Analyze(parts_of(pb.AnalyzeRequest, files, parameters), **call):
        assert result is None, "something comes after the result"
        if event.HasField("progress"):
            progress.append(event.progress)
        else:
            result = event.result
    return result


def render(stub, files, **parameters):
    picture = None
    for event in stub.Render(parts_of(pb.RenderRequest, files, pb.RenderParameters(**parameters)), timeout=PATIENCE):
        if event.HasField("picture"):
            picture = event.picture
    return picture


def rate(stub, *analyses, **rating):
    references = [pb.AnalysisReference(content_key=one) if isinstance(one, str) else pb.AnalysisReference(analysis=one)
                  for one in analyses]
    return stub.Rate(pb.RateRequest(assets=references, rating=pb.RatingParameters(**rating)), timeout=PATIENCE)


def analyze_here(*arguments):
    """What the command `analyze` says of the same, as parsed JSON."""
    ended = subprocess.run([PROGRAM, "analyze", *map(str, arguments), "--json", "-", "--no-cache"],
                           capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    return json.loads(ended.stdout)


# --- Assets ---

def png(width=4, height=4):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(value for x in range(width) for value in (40 * x % 256, 60 * y % 256, 128))
                    for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def grid(columns, rows, bump=0.25):
    """Positions and triangles of an uneven grid."""
    positions = [(x, y, bump * ((x * 7 + y * 3) % 5)) for y in range(rows + 1) for x in range(columns + 1)]
    triangles = []
    for y in range(rows):
        for x in range(columns):
            a = y * (columns + 1) + x
            triangles += [(a, a + 1, a + columns + 2), (a, a + columns + 2, a + columns + 1)]
    return positions, triangles


def obj(columns=6, rows=5, bump=0.25, material=""):
    positions, triangles = grid(columns, rows, bump)
    lines = [f"mtllib {material}.mtl", f"usemtl {material}"] if material else []
    lines = lines[:1] + [f"v {x} {y} {z}" for x, y, z in positions] + lines[1:]
    lines += ["f " + " ".join(str(corner + 1) for corner in triangle) for triangle in triangles]
    return ("\n".join(lines) + "\n").encode()


def gltf_files(name="hall"):
    """A glTF with a .bin and a texture below folders of their own."""
    positions, triangles = grid(9, 7)
    texture = [(x / 9, y / 7) for x, y, _ in positions]
    vertices = b"".join(struct.pack("<3f", *p) for p in positions)
    coordinates = b"".join(struct.pack("<2f", *uv) for uv in texture)
    indices = b"".join(struct.pack("<3H", *t) for t in triangles)
    views, offset = [], 0
    for block in (vertices, coordinates, indices):
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(block)})
        offset += len(block)
    low = [min(p[i] for p in positions) for i in range(3)]
    high = [max(p[i] for p in positions) for i in range(3)]
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 1]}], "scene": 0,
        "nodes": [{"mesh": 0, "name": "floor"}, {"mesh": 0, "name": "wall", "rotation": [0.70710678, 0, 0, 0.70710678],
                                                 "scale": [2, 2, 2]}],
        "meshes": [{"name": "plate", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2,
                                                     "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "textures/wood%20grain.png"}],
        "buffers": [{"uri": f"data/{name}.bin", "byteLength": offset}], "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5126, "count": len(positions), "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 3 * len(triangles), "type": "SCALAR"}]}
    return {f"{name}.gltf": json.dumps(document).encode(), f"data/{name}.bin": vertices + coordinates + indices,
            "textures/wood grain.png": png()}


def obj_files(name="shelf"):
    return {f"{name}.obj": obj(material=name), f"{name}.mtl": f"newmtl {name}\nKd 0.5 0.25 0.125\n".encode()}


def write_files(folder, files):
    """Returns the asset's path."""
    for name, data in files.items():
        path = pathlib.Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return pathlib.Path(folder) / next(iter(files))
