"""A triangle mesh under construction, and the surfaces everything in the room is made of: lofts and rings."""

from .maths import float32

# Where a loft's own (u, v, w) axes go: even permutations of x, y, z, so that outsides stay outside.
ALONG_X = lambda u, v, w: (w, u, v)
ALONG_Y = lambda u, v, w: (v, w, u)
ALONG_Z = lambda u, v, w: (u, v, w)


class Mesh:
    """Positions and counter-clockwise triangles; `uvs` is empty or has one pair per position."""

    def __init__(self):
        self.positions = []
        self.triangles = []
        self.uvs = []

    def point(self, position):
        self.positions.append(tuple(float32(c) for c in position))
        return len(self.positions) - 1

    def points(self, positions):
        return [self.point(p) for p in positions]

    def band(self, lower, upper):
        """Joins two rings of n points by 2 n triangles; seen from outside `lower` runs counter-clockwise."""
        n = len(lower)
        for j in range(n):
            k = (j + 1) % n
            self.triangles.append((lower[j], lower[k], upper[j]))
            self.triangles.append((lower[k], upper[k], upper[j]))

    def flat_cap(self, ring):
        """n - 2 triangles from the ring's first point, which has to see all others."""
        self.triangles.extend((ring[0], ring[j], ring[j + 1]) for j in range(1, len(ring) - 1))

    def fan_cap(self, ring, centre):
        """n triangles around a point of their own."""
        middle = self.point(centre)
        self.triangles.extend((middle, ring[j], ring[(j + 1) % len(ring)]) for j in range(len(ring)))

    def loft(self, rings, bottom=None, top=None):
        """Skin over a stack of k rings with n points each, closed at both ends.

        An end without a point gets a flat cap, an end with one a fan around it: 2 n k - 4 triangles with
        two flat caps, 2 n k - 2 with one, 2 n k with none.
        """
        stack = [self.points(ring) for ring in rings]
        for lower, upper in zip(stack, stack[1:]):
            self.band(lower, upper)
        for ring, centre in ((stack[0][:1] + stack[0][:0:-1], bottom), (stack[-1], top)):
            if centre is None:
                self.flat_cap(ring)
            else:
                self.fan_cap(ring, centre)

    def ring(self, profiles):
        """Skin over profiles that close to a ring, as a picture frame does: 2 n k triangles."""
        stack = [self.points(profile) for profile in profiles]
        for lower, upper in zip(stack, stack[1:] + stack[:1]):
            self.band(lower, upper)
