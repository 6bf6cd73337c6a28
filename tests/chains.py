"""Chains of cubics and dense curves, and their distances by brute force."""

import numpy as np


def lines(points, closed):
    """Straight cubics along a polygon."""
    points = np.asarray(points, dtype=float)
    ends = np.roll(points, -1, axis=0)
    if not closed:
        points, ends = points[:-1], ends[:-1]
    way = ends - points
    return np.stack([points, points + way / 3, ends - way / 3, ends], axis=1)


def chain(seed, count, closed):
    """Random cubics, joined."""
    controls = np.random.default_rng(seed).uniform(0, 50, size=(count, 4, 2))
    controls[1:, 0] = controls[:-1, 3]
    if closed:
        controls[-1, 3] = controls[0, 0]
    return controls


def drawn(controls, steps=500):
    """Points of the cubics by de Casteljau's algorithm, shape (n, steps + 1)."""
    level = (controls @ (1, 1j))[:, :, None]
    u = np.linspace(0, 1, steps + 1)
    while level.shape[1] > 1:
        level = (1 - u) * level[:, :-1] + u * level[:, 1:]
    return level[:, 0, :]


def furthest(points, polygon):
    """Largest distance of points from a polygon, all complex."""
    start, way = polygon[:-1], np.diff(polygon)
    square = np.where(way == 0, 1, np.abs(way) ** 2)
    away = 0.0
    for block in np.array_split(points, -(-len(points) // 200)):
        off = block[:, None] - start
        share = np.clip((off * way.conj()).real / square, 0, 1)
        away = max(away, np.abs(off - share * way).min(axis=1).max())
    return away


def dense(curve, level):
    points = curve.points(level) @ (1, 1j)
    return np.append(points, points[:1]) if curve.closed else points
