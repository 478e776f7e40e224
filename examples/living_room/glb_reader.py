"""Reads back what glb.py writes: mesh instances in depth-first order with local float32 geometry."""

import json
import struct
from collections import namedtuple

from .maths import times

Geometry = namedtuple("Geometry", "positions triangles")
# rotation: unit quaternion (x, y, z, w); scale: one factor for all axes, the scene uses no other.
Transform = namedtuple("Transform", "translation rotation scale")
Instance = namedtuple("Instance", "name mesh transform")

IDENTITY = Transform((0, 0, 0), (0, 0, 0, 1), 1.0)


def read(data):
    """(instances, geometries by mesh index, document)."""
    magic, version, size = struct.unpack_from("<III", data)
    assert (magic, version, size) == (0x46546C67, 2, len(data)), "not a whole GLB 2 file"
    text_size, = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20:20 + text_size])
    binary = data[28 + text_size:]
    geometries = [geometry(document, binary, mesh) for mesh in document["meshes"]]
    instances = []
    for root in document["scenes"][document["scene"]]["nodes"]:
        visit(document, root, IDENTITY, instances)
    return instances, geometries, document


def visit(document, index, parent, instances):
    node = document["nodes"][index]
    transform = combined(parent, local_transform(node))
    if "mesh" in node:
        instances.append(Instance(node["name"], node["mesh"], transform))
    for child in node.get("children", ()):
        visit(document, child, transform, instances)


def local_transform(node):
    assert "matrix" not in node, "the scene places its nodes by translation, rotation and scale"
    scale = node.get("scale", (1, 1, 1))
    assert scale[0] == scale[1] == scale[2], "ratings of instances need similarities"
    return Transform(node.get("translation", (0, 0, 0)), node.get("rotation", (0, 0, 0, 1)), scale[0])


def combined(outer, inner):
    return Transform(apply(outer, inner.translation), times(outer.rotation, inner.rotation),
                     outer.scale * inner.scale)


def apply(transform, point):
    x, y, z, w = transform.rotation
    turned = times(times((x, y, z, w), (*point, 0)), (-x, -y, -z, w))
    return tuple(t + transform.scale * c for t, c in zip(transform.translation, turned))


def geometry(document, binary, mesh):
    primitive, = mesh["primitives"]
    positions = accessor(document, binary, primitive["attributes"]["POSITION"], "f", 3)
    corners = [c for c, in accessor(document, binary, primitive["indices"], "H", 1)]
    return Geometry(positions, list(zip(corners[::3], corners[1::3], corners[2::3])))


def accessor(document, binary, index, kind, width):
    item = document["accessors"][index]
    start = document["bufferViews"][item["bufferView"]]["byteOffset"]
    size = item["count"] * width * struct.calcsize(kind)
    return list(struct.iter_unpack("<%d%s" % (width, kind), binary[start:start + size]))
