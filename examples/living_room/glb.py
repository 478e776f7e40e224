"""Binary glTF 2.0 with one primitive per mesh."""

import json
import struct

FLOAT, UNSIGNED_SHORT = 5126, 5123
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


class GlbWriter:
    """Collects buffer views and accessors; `document` is the JSON part, free to be filled in."""

    def __init__(self, generator):
        self.binary = bytearray()
        self.document = {"asset": {"version": "2.0", "generator": generator}, "scene": 0}

    def add(self, key, item):
        self.document.setdefault(key, []).append(item)
        return len(self.document[key]) - 1

    def view(self, data, target=None):
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data + bytes(-len(data) % 4)
        return self.add("bufferViews", view)

    def vectors(self, values, bounds=False):
        """Accessor of float32 tuples; positions must carry their bounds."""
        width = len(values[0])
        data = b"".join(struct.pack("<%df" % width, *v) for v in values)
        accessor = {"bufferView": self.view(data, ARRAY_BUFFER), "componentType": FLOAT, "count": len(values),
                    "type": "VEC%d" % width}
        if bounds:
            accessor["min"] = [min(c) for c in zip(*values)]
            accessor["max"] = [max(c) for c in zip(*values)]
        return self.add("accessors", accessor)

    def mesh(self, name, mesh, material=None):
        assert len(mesh.positions) < 65536
        corners = [c for triangle in mesh.triangles for c in triangle]
        indices = self.view(struct.pack("<%dH" % len(corners), *corners), ELEMENT_ARRAY_BUFFER)
        primitive = {"attributes": {"POSITION": self.vectors(mesh.positions, bounds=True)},
                     "indices": self.add("accessors", {"bufferView": indices, "componentType": UNSIGNED_SHORT,
                                                       "count": len(corners), "type": "SCALAR"})}
        if mesh.uvs:
            primitive["attributes"]["TEXCOORD_0"] = self.vectors(mesh.uvs)
        if material is not None:
            primitive["material"] = material
        return self.add("meshes", {"name": name, "primitives": [primitive]})

    def texture(self, name, image):
        source = self.add("images", {"name": name, "mimeType": "image/png", "bufferView": self.view(image)})
        return self.add("textures", {"name": name, "source": source})

    def bytes(self):
        self.document["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        body = (struct.pack("<II", len(text), 0x4E4F534A) + text
                + struct.pack("<II", len(self.binary), 0x004E4942) + bytes(self.binary))
        return struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body
