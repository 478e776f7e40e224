"""The one cushion both couches share."""

import math

from .maths import mix, sincos
from .mesh import Mesh

SEGMENTS, RINGS = 142, 143  # 2 x 142 x 143 = 40612 triangles, the thesis' count
HALF_WIDTH, HALF_HEIGHT = 0.20, 0.075


def cushion():
    """A stuffed pillow of 0.4 m with pointed corners and a few wrinkles, standing on no flat spot."""
    mesh = Mesh()
    rings = [[surface_point(ring / (RINGS + 1), (j + ring % 2 / 2) / SEGMENTS) for j in range(SEGMENTS)]
             for ring in range(RINGS, 0, -1)]
    mesh.loft(rings, bottom=surface_point(1.0, 0.0), top=surface_point(0.0, 0.0))
    return mesh


def surface_point(down, around):
    """From the top pole (down = 0) to the bottom pole (1); around in turns, from x to -z."""
    rim, height = sincos(down / 2)
    sine, cosine = sincos(around)
    square = 1 / eighth_root(cosine * cosine, sine * sine)  # 1 amid the sides, up to 1.3 at the corners
    corner = (square - 1) / 0.2968
    reach = rim * mix(1.0, square - 0.07 * (1 - corner), rim * rim)
    stuffing = height * mix(1.0, 0.45, corner * rim * rim)
    # Wrinkles towards the seam; a symmetric pillow would have flat panels along its axes.
    wrinkle = (0.0018 * rim * rim * rim * sincos(9 * around + 0.4 * down)[0]
               + 0.0025 * rim * sincos(2 * around + 0.11)[0])
    return (HALF_WIDTH * reach * cosine, HALF_HEIGHT * stuffing + wrinkle, -HALF_WIDTH * reach * sine)


def eighth_root(c2, s2):
    """(c^8 + s^8)^(1/8) from the squares of c and s, by square roots alone."""
    return math.sqrt(math.sqrt(math.sqrt(c2 * c2 * c2 * c2 + s2 * s2 * s2 * s2)))
