"""The brand name below the screen: four letters, each one bent tube with a hexagonal profile."""

from .maths import sincos
from .mesh import Mesh
from .shapes import circle, swept

HEIGHT = 0.038
STROKE = 0.0039
OUT = (0, 0, 1)  # letters stand on y = 0 and face +z


def brand_name():
    """2244 triangles: L, U and M as open tubes of 40, 50 and 50 stations, O as a closed one of 48."""
    mesh = Mesh()
    letters = ((0.0, letter_l, 40), (0.030, letter_u, 50), (0.068, letter_m, 50))
    for x, corners, count in letters:
        mesh.loft(swept(stroke, [(x + px - 0.065, py, 0) for px, py in along(corners, count)], OUT))
    ring = []
    for j in range(48):
        sine, cosine = sincos(j / 48)
        ring.append((0.0535 + 0.014 * cosine, HEIGHT / 2 * (1 + sine), 0))
    mesh.ring(swept(stroke, ring, OUT, closed=True))
    return mesh


def stroke(station, _):
    """Hexagons, turned a little against each other along the way in pairs, as if embossed."""
    return circle(6, STROKE, 0.5 + (station // 2 % 2) * 0.08)


letter_l = ((0.0, HEIGHT), (0.0, 0.004), (0.004, 0.0), (0.020, 0.0))
letter_u = ((0.0, HEIGHT), (0.0, 0.010), (0.003, 0.003), (0.011, 0.0), (0.019, 0.003), (0.022, 0.010),
            (0.022, HEIGHT))
letter_m = ((0.0, 0.0), (0.002, HEIGHT), (0.015, 0.008), (0.028, HEIGHT), (0.030, 0.0))


def along(corners, count):
    """`count` points along a polyline, evenly by corner number rather than by length: bends get more."""
    points = []
    for i in range(count):
        position = i / (count - 1) * (len(corners) - 1)
        k = min(int(position), len(corners) - 2)
        t = position - k
        a, b = corners[k], corners[k + 1]
        points.append((a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t))
    return points
