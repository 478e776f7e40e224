"""R_ft of a small connected mesh, with all distances written out: good for the rows of a few triangles."""

import heapq
import math

from .maths import length, subtract


def fourier_transform(surface):
    signal = [surface.areas[i] for i in surface_order(surface)]
    n = len(signal)
    amplitudes = [amplitude(signal, k) for k in range(n // 2 + 1)]
    alternating = sum(amplitudes[1:])
    if n < 2 or alternating <= 1e-12 * amplitudes[0]:
        return 0.0
    weighted = sum(k * a for k, a in enumerate(amplitudes))
    return max(amplitudes[1:]) / amplitudes[0] * weighted / (n // 2 * alternating)


def amplitude(signal, k):
    turns = [2 * math.pi * (k * i % len(signal)) / len(signal) for i in range(len(signal))]
    return math.hypot(sum(x * math.cos(t) for x, t in zip(signal, turns)),
                      sum(x * math.sin(t) for x, t in zip(signal, turns)))


def surface_order(surface):
    """Triangles by distance from the most remote one; ties by area, then by index."""
    arcs = surface_arcs(surface)
    distances = [distances_from(arcs, i) for i in range(len(arcs))]
    if any(math.inf in row for row in distances):
        raise ValueError("the surface has more than one component")
    totals = [sum(row) for row in distances]
    highest, areas = max(totals), surface.areas
    remote = [i for i, total in enumerate(totals) if total >= highest * (1 - 1e-9)]
    least = min(areas[i] for i in remote)
    start = min(i for i in remote if areas[i] <= least * (1 + 1e-9))
    step, grain = 1e-9 * max(distances[start]), 1e-9 * max(areas)
    return sorted(range(len(arcs)),
                  key=lambda i: (round(distances[start][i] / step), round(areas[i] / grain), i))


def surface_arcs(surface):
    centre = [tuple(sum(surface.positions[c][axis] for c in t) / 3 for axis in range(3))
              for t in surface.triangles]
    arcs = [[] for _ in surface.triangles]
    for i, j, _ in surface.pairs:
        a, b = (surface.positions[c] for c in set(surface.triangles[i]) & set(surface.triangles[j]))
        middle = tuple((p + q) / 2 for p, q in zip(a, b))
        cost = length(subtract(centre[i], middle)) + length(subtract(middle, centre[j]))
        arcs[i].append((j, cost))
        arcs[j].append((i, cost))
    return arcs


def distances_from(arcs, start):
    distance = [math.inf] * len(arcs)
    distance[start] = 0.0
    queue = [(0.0, start)]
    while queue:
        d, i = heapq.heappop(queue)
        if d > distance[i]:
            continue
        for j, cost in arcs[i]:
            if d + cost < distance[j]:
                distance[j] = d + cost
                heapq.heappush(queue, (d + cost, j))
    return distance
