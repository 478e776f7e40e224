"""Places the furniture: the node tree, the materials and the one texture of the demo scene."""

from collections import namedtuple

from . import brand_name, controller, couch, cushion, floor, television
from .glb import GlbWriter
from .maths import quaternion, times

UP, RIGHT = (0, 1, 0), (1, 0, 0)

# Where a couch stands (turned in turns about y) and how its cushion sits on it.
Couch = namedtuple("Couch", "name width first_leg fabric at turned cushion_at cushion_turned cushion_scale")
BIG = Couch("Big", 2.20, 1, "Blue fabric", (0.55, 0.0, -1.6), 0.0, (-0.62, 0.537, 0.06), 0.05, 1.2)
SMALL = Couch("Small", 1.50, 5, "Red fabric", (1.75, 0.0, 0.6), -0.22, (0.27, 0.50, 0.06), -0.06, None)


def living_room():
    """The whole GLB file: 32 mesh instances of 25 meshes, 94074 triangles drawn."""
    glb = GlbWriter("examples/generate_living_room.py")
    materials = add_materials(glb)
    cushion_mesh = glb.mesh("Cushion", cushion.cushion())
    couch_leg = glb.mesh("Couch leg", couch.leg(couch.COUCH_LEG_HEIGHT), materials["Dark wood"])
    rows = [
        node(glb, "Floor", glb.mesh("Floor", floor.floor(), materials["Parquet"])),
        whole_couch(glb, BIG, couch_leg, cushion_mesh, materials),
        whole_couch(glb, SMALL, couch_leg, cushion_mesh, materials),
        table(glb, materials),
        media_corner(glb),
    ]
    glb.add("scenes", {"name": "Living room", "nodes": [node(glb, "Living room", children=rows)]})
    return glb.bytes()


def add_materials(glb):
    parquet = glb.texture("Parquet", floor.parquet())
    surfaces = {"Parquet": {"baseColorTexture": {"index": parquet}},
                "Blue fabric": {"baseColorFactor": [0.16, 0.25, 0.45, 1]},
                "Red fabric": {"baseColorFactor": [0.55, 0.14, 0.12, 1]},
                "Light wood": {"baseColorFactor": [0.72, 0.53, 0.33, 1]},
                "Dark wood": {"baseColorFactor": [0.23, 0.14, 0.08, 1]}}
    return {name: glb.add("materials", {"name": name, "pbrMetallicRoughness": {
        **surface, "metallicFactor": 0, "roughnessFactor": 0.8}}) for name, surface in surfaces.items()}


def node(glb, name, mesh=None, at=None, rotation=None, scale=None, children=None):
    """Adds a node; numbers are cut to nine digits, which is all a float32 holds."""
    item = {"name": name}
    if mesh is not None:
        item["mesh"] = mesh
    if at:
        item["translation"] = [round(c, 9) for c in at]
    if rotation:
        item["rotation"] = [round(c, 9) for c in rotation]
    if scale:
        item["scale"] = [scale] * 3
    if children:
        item["children"] = children
    return glb.add("nodes", item)


def whole_couch(glb, spec, leg, cushion_mesh, materials):
    """A couch with its four feet and its cushion as children."""
    body = glb.mesh(spec.name + " couch", couch.couch(spec.width), materials[spec.fabric])
    children = feet(glb, "Couch leg", spec.first_leg, leg, -couch.COUCH_LEG_HEIGHT, spec.width / 2 - 0.10,
                    couch.COUCH_DEPTH / 2 - 0.10)
    leaning = times(quaternion(UP, spec.cushion_turned), quaternion(RIGHT, 0.20))
    children.append(node(glb, spec.name + " cushion", cushion_mesh, at=spec.cushion_at, rotation=leaning,
                         scale=spec.cushion_scale))
    x, _, z = spec.at
    return node(glb, spec.name + " couch", body, at=(x, couch.COUCH_LEG_HEIGHT, z),
                rotation=quaternion(UP, spec.turned), children=children)


def feet(glb, name, first, leg, y, x, z):
    """Four numbered nodes of one mesh at the corners (+-x, y, +-z)."""
    corners = ((-x, z), (x, z), (x, -z), (-x, -z))
    return [node(glb, "%s %d" % (name, first + i), leg, at=(u, y, w)) for i, (u, w) in enumerate(corners)]


def table(glb, materials):
    """Two boards on four feet, the controller on top."""
    wood = materials["Light wood"]
    leg = glb.mesh("Table leg", couch.leg(couch.TABLE_LEG_HEIGHT), materials["Dark wood"])
    top = glb.mesh("Table: top boards", couch.board(couch.TABLE_WIDTH, couch.TABLE_DEPTH, 0.030, 0.006), wood)
    bottom = glb.mesh("Table: bottom boards",
                      couch.board(couch.TABLE_WIDTH - 0.1, couch.TABLE_DEPTH - 0.1, 0.018, 0.004), wood)
    pad = glb.mesh("Controller", controller.controller())
    parts = [node(glb, "Table: top boards", top, at=(0, couch.TABLE_LEG_HEIGHT, 0)),
             node(glb, "Table: bottom boards", bottom, at=(0, 0.16, 0))]
    parts += feet(glb, "Table leg", 1, leg, 0, couch.TABLE_WIDTH / 2 - 0.08, couch.TABLE_DEPTH / 2 - 0.08)
    parts.append(node(glb, "Controller", pad, at=(0.24, couch.TABLE_LEG_HEIGHT + 0.053, 0.06),
                      rotation=quaternion(UP, 0.19)))
    return node(glb, "Table", at=(0.15, 0, -0.15), rotation=quaternion(UP, 0.015), children=parts)


def media_corner(glb):
    """TV stand and TV, in one group that faces the small couch."""
    tv, legs = television, glb.mesh("TV stand: legs", television.stand_legs())
    x = tv.STAND_WIDTH / 2 - 0.10
    stand = [node(glb, "TV stand: both boards", glb.mesh("TV stand: both boards", tv.stand_boards())),
             node(glb, "TV stand: left legs", legs, at=(-x, 0, 0)),
             node(glb, "TV stand: right legs", legs, at=(x, 0, 0), rotation=quaternion(UP, 0.5)),
             node(glb, "TV stand: rack", glb.mesh("TV stand: rack", tv.rack()), at=(0.36, 0, 0))]
    # The set leans back by a degree, as a picture does; its screen starts above the foot.
    low = tv.SCREEN_BOTTOM
    pieces = (("Base of TV", tv.base(), (0, 0, 0)),
              ("TV buttons: case", tv.button_case(), (0.42, low - tv.RIM - 0.010, -0.008)),
              ("TV frame: two buttons", tv.buttons(), (0.42, low - tv.RIM - 0.011, 0.002)),
              ("TV screen", tv.screen(), (0, low, 0)),
              ("TV frame", tv.frame(), (0, low, 0)),
              ("TV casing: bottom sides", tv.casing_sides(), (0, low, -0.045)),
              ("TV casing: bottom front", tv.casing_front(), (0, low - tv.RIM - 0.012, 0.0)),
              ("TV: brand name", brand_name.brand_name(), (0, low - tv.RIM - 0.031, 0.0165)))
    tv_nodes = [node(glb, name, glb.mesh(name, mesh), at=at) for name, mesh, at in pieces]
    groups = [node(glb, "TV stand", children=stand),
              node(glb, "TV", at=(0, tv.STAND_HEIGHT, -0.02), rotation=quaternion(RIGHT, -1 / 360),
                   children=tv_nodes)]
    return node(glb, "Media corner", at=(-2.05, 0, -0.25), rotation=quaternion(UP, 0.25), children=groups)
