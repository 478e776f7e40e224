"""Closed outlines in a plane, counter-clockwise, and how to stack or sweep them."""

from .maths import add, cross, mix, scaled, sincos, subtract, unit


def circle(n, radius, phase=0.0):
    """n points; `phase` shifts them by that part of one segment."""
    return ellipse(n, radius, radius, phase)


def ellipse(n, half_width, half_height, phase=0.0):
    outline = []
    for j in range(n):
        sine, cosine = sincos((j + phase) / n)
        outline.append((half_width * cosine, half_height * sine))
    return outline


def rounded_rectangle(width, height, radius, per_corner, inset=0.0):
    """4 x per_corner points around the origin. An inset keeps all edges parallel, so that walls stay flat."""
    radius = max(radius - inset, 1e-3)
    half_width, half_height = width / 2 - inset - radius, height / 2 - inset - radius
    outline = []
    for corner, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for j in range(per_corner):
            sine, cosine = sincos(corner / 4 + j / (per_corner - 1) / 4)
            outline.append((sx * half_width + radius * cosine, sy * half_height + radius * sine))
    return outline


def staggered(outline):
    """Midpoints of the outline's sides. A band to a staggered ring is a zigzag instead of flat panels."""
    return [(mix(a[0], b[0], 0.5), mix(a[1], b[1], 0.5)) for a, b in zip(outline, outline[1:] + outline[:1])]


def shrunk(outline, factor):
    """The outline scaled about the middle of its bounds."""
    u = (min(p[0] for p in outline) + max(p[0] for p in outline)) / 2
    v = (min(p[1] for p in outline) + max(p[1] for p in outline)) / 2
    return [(u + (p[0] - u) * factor, v + (p[1] - v) * factor) for p in outline]


def lifted(outline, w, axis, origin=(0, 0, 0)):
    """The outline as points of space: (u, v, w) through one of the ALONG_* axes, then moved to origin."""
    return [add(axis(u, v, w), origin) for u, v in outline]


def swept(profile_at, path, binormal, closed=False):
    """Profiles standing upright along a path in the plane with that normal.

    profile_at(i, t) gives station i (0 <= t <= 1 along the path) as outline: u to the left of the path,
    v along the binormal.
    """
    last = len(path) - 1
    profiles = []
    for i, point in enumerate(path):
        before, after = (path[i - 1], path[(i + 1) % len(path)]) if closed else (path[max(i - 1, 0)],
                                                                                path[min(i + 1, last)])
        normal = cross(binormal, unit(subtract(after, before)))
        profiles.append([add(point, add(scaled(normal, u), scaled(binormal, v)))
                         for u, v in profile_at(i, i / last)])
    return profiles
