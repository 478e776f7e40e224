"""Numbers that come out the same on every machine.

Only + - * / and sqrt are used, which IEEE 754 rounds exactly; the C library's sin, cos and pow may differ
in the last bit from one machine to the next, and the scene has to be the same file everywhere.
"""

import math
import struct

TWO_PI = 6.283185307179586


def sincos(turns):
    """Sine and cosine of an angle given in turns (1 = full circle)."""
    quadrant = math.floor(turns * 4 + 0.5)
    x = (turns - quadrant / 4) * TWO_PI  # |x| <= pi / 4
    sine = cosine = 1.0
    for k in range(9, 0, -1):  # both Taylor series in Horner form, past double precision
        sine = 1 - x * x * sine / (2 * k * (2 * k + 1))
        cosine = 1 - x * x * cosine / ((2 * k - 1) * 2 * k)
    sine *= x
    return ((sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine))[quadrant % 4]


def float32(value):
    """The nearest float32, as a Python float."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def mix(a, b, t):
    return a + (b - a) * t


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scaled(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scaled(a, 1 / length(a))


def quaternion(axis, turns):
    """Rotation about a unit axis as (x, y, z, w)."""
    sine, cosine = sincos(turns / 2)
    return (axis[0] * sine, axis[1] * sine, axis[2] * sine, cosine)


def times(p, q):
    """Quaternion product: rotate by q first, then by p."""
    px, py, pz, pw = p
    qx, qy, qz, qw = q
    return (pw * qx + px * qw + py * qz - pz * qy, pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw, pw * qw - px * qx - py * qy - pz * qz)


def rotated(point, turns_about_x):
    """The point turned about the x axis."""
    sine, cosine = sincos(turns_about_x)
    x, y, z = point
    return (x, y * cosine - z * sine, y * sine + z * cosine)
