"""The metrics of docs/metrics.md once more, in plain double precision, for the meshes of the demo scene.

Written apart from the product's code on purpose: the two are compared. It covers manifold meshes without
degenerate triangles and at most `dim` distinct areas, and refuses others.
"""

import math
from collections import namedtuple

from .maths import cross, dot, length, subtract

Measures = namedtuple("Measures", "triangles groups pppg pgv ccm area")


class Surface:
    """Welded triangles with normals (length = twice the area), areas, heights and edge neighbours."""

    def __init__(self, geometry):
        first = {}
        weld = [first.setdefault(p, i) for i, p in enumerate(geometry.positions)]
        self.positions = geometry.positions
        self.triangles = [tuple(weld[c] for c in t) for t in geometry.triangles]
        self.normals, self.areas, self.heights = [], [], []
        for triangle in self.triangles:
            self.measure(*(self.positions[c] for c in triangle))
        self.pairs = self.edge_pairs()
        self.neighbours = [[] for _ in self.triangles]
        for i, j, _ in self.pairs:
            self.neighbours[i].append(j)
            self.neighbours[j].append(i)

    def measure(self, a, b, c):
        normal = cross(subtract(b, a), subtract(c, a))
        longest = max(length(subtract(b, a)), length(subtract(c, b)), length(subtract(a, c)))
        double_area = length(normal)
        if not double_area > 1e-6 * longest * longest:
            raise ValueError("degenerate triangle")
        self.normals.append(normal)
        self.areas.append(double_area / 2)
        self.heights.append(double_area / longest)

    def edge_pairs(self):
        """(i, j, flipped): triangles on both sides of an edge, flipped when they wind against each other."""
        owners = {}
        for i, triangle in enumerate(self.triangles):
            for a, b in zip(triangle, triangle[1:] + triangle[:1]):
                owners.setdefault((min(a, b), max(a, b)), []).append((i, a < b))
        if any(len(sides) > 2 for sides in owners.values()):
            raise ValueError("an edge has more than two triangles")
        return [(s[0][0], s[1][0], s[0][1] == s[1][1]) for s in owners.values() if len(s) == 2]

    def planar_groups(self, alpha=0.0):
        """Sizes of the planar groups."""
        used = {c for t in self.triangles for c in t}
        rounding = 2.0**-24 * max(abs(x) for c in used for x in self.positions[c])
        parent = list(range(len(self.triangles)))

        def root(i):
            while parent[i] != i:
                parent[i] = parent[parent[i]]
                i = parent[i]
            return i

        for i, j, flipped in self.pairs:
            cosine = dot(self.normals[i], self.normals[j]) * (-1 if flipped else 1)
            angle = math.atan2(length(cross(self.normals[i], self.normals[j])), cosine)
            tolerance = 4 * rounding * (1 / self.heights[i] + 1 / self.heights[j])
            if angle <= math.radians(alpha) + min(max(tolerance, math.pi / 18000), math.pi / 180):
                parent[root(i)] = root(j)
        sizes = {}
        for i in range(len(parent)):
            sizes[root(i)] = sizes.get(root(i), 0) + 1
        return list(sizes.values())


def area_classes(areas, dim=20000):
    """Each area replaced by the least of its class: those within 1.19209e-07 relative of it."""
    start, classes, count = None, {}, 0
    for value in sorted(set(areas)):
        if start is None or value - start > 1.19209e-07 * value:
            start, count = value, count + 1
        classes[value] = start
    if count > dim:
        raise ValueError("more than %d distinct areas" % dim)
    return [classes[a] for a in areas]


def cooccurrence_contrast(surface):
    values = area_classes(surface.areas, dim=len(surface.areas))
    span = max(values) - min(values)
    linked = [i for i, n in enumerate(surface.neighbours) if n]
    if not linked or span <= 1e-5 * max(values):
        return 0.0
    total = sum(sum((values[i] - values[j])**2 for j in surface.neighbours[i]) / len(surface.neighbours[i])
                for i in linked)
    return total / (len(linked) * span * span)


def measures(geometry):
    surface = Surface(geometry)
    sizes, n = surface.planar_groups(), len(surface.triangles)
    return Measures(n, len(sizes), (n - len(sizes)) / (n - 1) if n > 1 else 0.0,
                    math.sqrt(sum(s * s for s in sizes if s > 1)) / n, cooccurrence_contrast(surface),
                    sum(surface.areas))


def relative_densities(densities):
    """R_rd of every mesh of the scene, in order."""
    mean = sum(densities) / len(densities)
    sigma = math.sqrt(sum((d - mean)**2 for d in densities) / len(densities))
    low, high, noise = mean - sigma, mean + sigma, 1e-6 * mean
    if sigma <= noise:
        return [0.0] * len(densities)

    def rate(d):
        if d < low - noise:
            return -0.5 - 0.5 * (d - low) / (min(densities) - low)
        if d > high + noise:
            return 0.5 + 0.5 * (d - high) / (max(densities) - high)
        return min(max(-0.5 + (d - low) / (2 * sigma), -0.5), 0.5)

    return [rate(d) for d in densities]
