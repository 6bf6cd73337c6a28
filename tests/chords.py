"""Curves that are hard to cut, and how far they are from chords by brute force."""

import numpy as np
from hypothesis import strategies as st

KINDS = st.sampled_from(["rough", "stops", "straight", "needles"])


def polygon(kind, seed, count):
    """A rough one, or such whose curve stops, runs straight at a changing speed, or turns back."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(0, 30, size=(count, 2))
    if kind == "stops":
        points = np.repeat(points, 4, axis=0)
    elif kind == "straight":
        points[: 3 * count // 4, 1] = 7.0
    elif kind == "needles":
        points[::2] = points[0]
    return points + rng.uniform(-1e4, 1e4, size=2)


def distance(points, start, stop):
    """Largest distance of points (2, k) from a segment."""
    way = stop - start
    off = points - start[:, None]
    shares = np.clip(way @ off / max(way @ way, 1e-300), 0, 1)
    return np.hypot(*(off - way[:, None] * shares)).max()


def some_places(stretch, seed):
    """Places of long chords and of short ones, where bounds are close."""
    last = stretch.fixed()[-1]
    rng = np.random.default_rng(seed)
    far = rng.integers(0, last + 1, 8)
    near = far[:, None] + rng.integers(1, 200, 6)
    return np.unique(np.concatenate([[0, last], far, near[near < last]]))


def bounds(stretch, places, asked=0.0):
    """What a stretch says of chords between places."""
    points = stretch.at(places)
    return stretch.deviations(places[:-1], places[1:], points[:, :-1], points[:, 1:], asked)


def deviation(stretch, first, last):
    """What is seen of it at places in between."""
    between = np.unique(np.linspace(first, last, 200).astype(int))
    points = stretch.at(between)
    return distance(points, points[:, 0], points[:, -1])
