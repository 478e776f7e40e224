"""The game controller on the table, lying flat with its buttons up (+y) and its cable side towards -z."""

import math

from .maths import mix, sincos
from .mesh import ALONG_X, ALONG_Y, Mesh
from .shapes import circle, ellipse, lifted


def controller():
    """4404 triangles: body 2376, four round buttons and two shoulder buttons 190 each, sticks 398, pad 92."""
    mesh = Mesh()
    body(mesh)
    for u, v in ((0.012, 0.0), (-0.012, 0.0), (0.0, 0.012), (0.0, -0.012)):
        round_button(mesh, (0.050 + u, 0.0095, -0.010 + v), 0.005)
    for x in (-0.026, 0.026):
        stick(mesh, (x, 0.013, 0.014))
    pad(mesh, (-0.050, 0.0105, -0.010))
    for x in (-0.052, 0.052):
        shoulder_button(mesh, (x, 0.000, -0.037))
    return mesh


def body(mesh):
    """Slices of 34 points along x, 35 of them: thick in the middle, a grip reaching forward on each side."""
    rings = []
    for k in range(35):
        x = mix(-0.085, 0.085, k / 34)
        side = abs(x) / 0.085
        end = math.sqrt(math.sqrt(1 - mix(0.0, 0.993, side * side * side * side)))
        grip = side * side * (3 - 2 * side)
        front = mix(0.030, 0.072, grip) * end
        back = -0.042 * end
        height = mix(0.018, 0.015, grip) * end
        ring = ellipse(34, height, (front - back) / 2)
        rings.append(lifted(ring, x, ALONG_X, (0, -0.010 * grip, (front + back) / 2)))
    mesh.loft(rings)


def round_button(mesh, place, radius):
    """16 x 6 points with a curved top."""
    rows = ((1.0, -0.6), (1.0, 0.3), (0.92, 0.55), (0.75, 0.72), (0.5, 0.83), (0.25, 0.88))
    dome(mesh, place, rows, 16, radius)


def stick(mesh, place):
    """20 x 10 points: a stem with a wide, hollowed head."""
    rows = ((0.55, -0.3), (0.5, 0.1), (0.5, 0.5), (0.85, 0.65), (1.0, 0.8), (1.0, 0.95), (0.93, 1.05),
            (0.8, 1.08), (0.55, 1.0), (0.25, 0.95))
    dome(mesh, place, rows, 20, 0.011)


def dome(mesh, place, rows, n, size):
    """A turned piece: (radius, height) per row in units of size, flat below, a point on top."""
    x, y, z = place
    rings = [lifted(circle(n, radius * size), height * size, ALONG_Y, place) for radius, height in rows]
    mesh.loft(rings, top=(x, y + (rows[-1][1] + 0.02) * size, z))


def pad(mesh, place):
    """A cross of 12 x 4 points with a bevelled rim."""
    # Arms narrow outwards, or a triangle of the flat caps would have no height.
    inner, tip, reach = 0.0045, 0.0038, 0.014
    cross = []
    for turn in range(4):
        sine, cosine = sincos(turn / 4)
        cross += [(cosine * u - sine * v, sine * u + cosine * v)
                  for u, v in ((inner, inner), (tip, reach), (-tip, reach))]
    mesh.loft([lifted([(u * f, v * f) for u, v in cross], y, ALONG_Y, place)
               for y, f in ((-0.003, 1.0), (0.002, 1.0), (0.0035, 0.95), (0.004, 0.85))])


def shoulder_button(mesh, place):
    """16 x 6 points: a curved bar across the back edge."""
    rings = []
    for k in range(6):
        t = k / 5
        swell = sincos(t / 2)[0]
        outline = ellipse(16, mix(0.005, 0.009, swell), mix(0.004, 0.008, swell))
        rings.append(lifted(outline, mix(-0.02, 0.02, t), ALONG_X,
                            (place[0], place[1], place[2] + 0.006 * (1 - swell))))
    x, y, z = place
    mesh.loft(rings, top=(x + 0.022, y, z + 0.006))
