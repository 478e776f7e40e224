"""Both couches (one design, two widths) and their feet, and the table with its taller feet.

Every piece stands on y = 0 and faces +z.
"""

from .maths import add, rotated, sincos
from .mesh import ALONG_X, ALONG_Y, ALONG_Z, Mesh
from .shapes import circle, lifted, rounded_rectangle, shrunk, staggered

COUCH_DEPTH, ARM_WIDTH = 0.90, 0.20
COUCH_LEG_HEIGHT, TABLE_LEG_HEIGHT = 0.1206, 0.4122
TABLE_WIDTH, TABLE_DEPTH = 1.10, 0.64


def leg(height):
    """10-sided prism with fan caps, 40 triangles: its ratings are known in closed form."""
    mesh = Mesh()
    mesh.loft([lifted(circle(10, 0.03), y, ALONG_Y) for y in (0.0, height)], (0, 0, 0), (0, height, 0))
    return mesh


def couch(width):
    """1430 triangles: base 44, backrest 166, and twice arm rest 146, seat 276, back cushion 188."""
    mesh = Mesh()
    base = rounded_rectangle(COUCH_DEPTH - 0.06, width - 0.06, 0.05, 3)
    mesh.loft([lifted(base, y, ALONG_Y) for y in (0.0, 0.16)])
    backrest(mesh, width - 0.02)
    for side in (-1, 1):
        arm_rest(mesh, side * (width / 2 - ARM_WIDTH / 2))
        half = width / 2 - ARM_WIDTH
        seat(mesh, side * half / 2, half - 0.012)
        back_cushion(mesh, side * half / 2, half - 0.03)
    return mesh


def stations(first, last, bevel):
    """Places along a bevelled bar of five rings and the factor its outline shrinks by."""
    return ((first, 0.9), (first + bevel, 1.0), ((first + last) / 2, 1.0), (last - bevel, 1.0), (last, 0.9))


def arm_rest(mesh, x):
    """A bar from back to front with a round top: 15 x 5 points."""
    outline = [(-ARM_WIDTH / 2, 0.02), (ARM_WIDTH / 2, 0.02)]
    for j in range(13):
        sine, cosine = sincos(j / 24)
        outline.append((ARM_WIDTH / 2 * cosine, 0.43 + 0.09 * sine))
    mesh.loft([lifted(shrunk(outline, f), z, ALONG_Z, (x, 0, 0))
               for z, f in stations(-COUCH_DEPTH / 2, COUCH_DEPTH / 2, 0.025)])


def backrest(mesh, width):
    """A leaning bar from left to right: 17 x 5 points; u is y and v is z here."""
    outline = [(0.03, -0.19), (0.03, -0.40)]
    for j in range(15):
        sine, cosine = sincos(j / 28)
        outline.append((0.64 + 0.08 * sine, -0.375 - 0.065 * cosine))
    mesh.loft([lifted(shrunk(outline, f), x, ALONG_X) for x, f in stations(-width / 2, width / 2, 0.03)])


def seat(mesh, x, width):
    """A padded block, 28 x 5 points; the padding's upper rows are quilted."""
    def ring(inset, y, quilted=False):
        outline = rounded_rectangle(0.66, width, 0.07, 7, inset)
        return lifted(staggered(outline) if quilted else outline, y, ALONG_Y, (x, 0, 0.10))

    mesh.loft([ring(0.02, 0.165), ring(0.0, 0.185), ring(0.0, 0.265), ring(0.018, 0.295, True),
               ring(0.06, 0.312)])


def back_cushion(mesh, x, width):
    """A padded block leaning against the backrest, 24 x 4 points."""
    def ring(inset, z, quilted=False):
        outline = rounded_rectangle(width, 0.38, 0.09, 6, inset)
        points = lifted(staggered(outline) if quilted else outline, z, ALONG_Z)
        return [add(rotated(p, -0.035), (x, 0.50, -0.20)) for p in points]

    mesh.loft([ring(0.0, 0.0), ring(0.0, 0.07), ring(0.035, 0.12, True), ring(0.09, 0.135)])


def board(width, depth, thickness, edge):
    """332 triangles: a table board with a rounded, ground edge, 28 x 6 points."""
    def ring(inset, y, ground=False):
        outline = rounded_rectangle(depth, width, 0.10, 7, inset)
        return lifted(staggered(outline) if ground else outline, y, ALONG_Y)

    mesh = Mesh()
    mesh.loft([ring(edge, 0.0), ring(edge / 4, edge, True), ring(0.0, thickness / 2),
               ring(0.0, thickness * 0.6), ring(edge / 4, thickness - edge / 2), ring(edge, thickness)])
    return mesh
