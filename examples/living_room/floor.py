"""The floor: a flat 4 x 4 grid, uneven by about a tenth of a millimetre, with a parquet picture on it."""

from .mesh import Mesh
from .png import png

WIDTH, DEPTH = 5.2, 4.4
# How far the three inner grid lines in x and z are off their places, in micrometres: found by trying, for the
# contrast the thesis measured on its floor.
OFF_X, OFF_Z = (0, 40, 40), (-30, -60, 20)
TEXTURE_SIZE = 64


def floor(off_x=OFF_X, off_z=OFF_Z):
    """32 triangles with texture coordinates."""
    mesh = Mesh()
    xs = [WIDTH * (i / 4 - 0.5) + (0, *off_x, 0)[i] * 1e-6 for i in range(5)]
    zs = [DEPTH * (i / 4 - 0.5) + (0, *off_z, 0)[i] * 1e-6 for i in range(5)]
    for i, z in enumerate(zs):
        for j, x in enumerate(xs):
            mesh.point((x, 0, z))
            mesh.uvs.append((j, i))
    for i in range(4):
        for j in range(4):
            a = 5 * i + j
            mesh.triangles += [(a, a + 5, a + 6), (a, a + 6, a + 1)]
    return mesh


def parquet():
    """64 x 64 planks in four shades of oak, laid in alternating directions, repeatable."""
    def pixel(x, y):
        block = (x // 32 + y // 32) % 2
        along, across = (x, y) if block else (y, x)
        plank = across // 8
        shade = (plank * 37 + block * 11 + (x // 32) * 5) % 4
        grain = (along * 3 + plank * 7) % 13 // 6
        groove = 34 if across % 8 == 0 or along % 32 == 0 else 0
        tone = 6 * shade + 5 * grain - groove
        return (168 + tone, 124 + tone, 80 + tone)

    return png(TEXTURE_SIZE, TEXTURE_SIZE, pixel)
