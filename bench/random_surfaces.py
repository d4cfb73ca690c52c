"""Distances of each accuracy against exact ones, on random surfaces.

    PYTHONPATH=build/python python3 bench/random_surfaces.py [SEED [SECONDS]]

Grids with holes, hills, fins that stand on a sheet, Delaunay triangles with gaps, star-shaped
polyhedra, stairs, cones, tubes that wind; sources at a vertex, at three, inside a triangle. Prints
for each kind the worst vertex (over all problems, and of the median problem) and the mean of
`accurate` and of `fast`, and each problem in which `accurate` is off by more than a hundredth, does
not reach what `exact` reaches, or lies below the straight line through space. Ends with 1 if there
was one.
"""

import sys
import time

import numpy as np
from scipy.spatial import ConvexHull, Delaunay

import plexway

rng = np.random.default_rng(int(sys.argv[1]) if len(sys.argv) > 1 else 0)
seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 60.0


def quads(n, m):
    """Triangles of n x m places, each square cut along a random diagonal."""
    triangles = []
    for i in range(n - 1):
        for j in range(m - 1):
            a, b, c, d = i * m + j, (i + 1) * m + j, (i + 1) * m + j + 1, i * m + j + 1
            halves = [[a, b, c], [a, c, d]] if rng.random() < 0.5 else [[a, b, d], [b, c, d]]
            triangles += halves
    return np.array(triangles)


def sheet(jitter=0.0, holes=False, height=0.0):
    n, m = rng.integers(8, 60, 2)
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, m), indexing="ij")
    points = np.stack([x, y, np.zeros_like(x)], -1).reshape(-1, 3)
    points[:, :2] += rng.normal(0, 1, (n * m, 2)) * jitter / n
    waves = rng.uniform(2, 9, 2)
    points[:, 2] = height * np.sin(waves[0] * points[:, 0] + 1) * np.sin(waves[1] * points[:, 1])
    triangles = quads(n, m)
    if holes:
        middle = points[triangles].mean(1)
        keep = np.ones(len(triangles), bool)
        for _ in range(rng.integers(1, 5)):
            away = np.abs(middle[:, :2] - rng.uniform(0, 1, 2))
            radius = rng.uniform(0.03, 0.2)
            if rng.random() < 0.5:
                keep &= np.hypot(*away.T) > radius
            else:
                keep &= np.maximum(away[:, 0], away[:, 1] / rng.uniform(0.2, 3)) > radius
        triangles = triangles[keep]
    return points, triangles, m


def plane_with_holes():
    return sheet(0.2, True)[:2]


def hills_with_holes():
    return sheet(0.25, True, rng.uniform(0.05, 0.6))[:2]


def fin_on_a_sheet():
    points, triangles, m = sheet(0.15, rng.random() < 0.5, rng.uniform(0, 0.3))
    row = (len(points) // m // 2) * m + np.arange(m)
    foot, steps = points[row], int(rng.integers(1, 8))
    for step in range(1, steps + 1):
        above = len(points) + np.arange(m)
        points = np.vstack([points, foot + [rng.normal(0, 0.01), 0, step / steps / 2]])
        lower, upper = (row[:-1], row[1:]), (above[:-1], above[1:])
        triangles = np.vstack([triangles, np.stack([*lower, upper[0]], -1),
                               np.stack([lower[1], upper[1], upper[0]], -1)])
        row = above
    return points, triangles


def delaunay_with_gaps():
    plane = rng.uniform(0, 1, (int(rng.integers(30, 1500)), 2))
    triangles = Delaunay(plane).simplices
    z = sum(rng.normal(0, 0.08) * np.sin(plane @ rng.normal(0, 8, 2) + rng.uniform(0, 6))
            for _ in range(4))
    if rng.random() < 0.5:
        triangles = triangles[rng.random(len(triangles)) > rng.uniform(0, 0.3)]
    return np.c_[plane, z], triangles


def star():
    v = rng.normal(size=(int(rng.integers(20, 1200)), 3))
    v /= np.linalg.norm(v, axis=1)[:, None]
    waves = np.sin(v @ rng.normal(0, 3, 3)) * np.sin(v @ rng.normal(0, 4, 3) + 1)
    radius = np.maximum(1 + rng.uniform(0, 0.9) * waves, 0.15)
    return v * radius[:, None] * rng.uniform(0.2, 3, 3), ConvexHull(v).simplices


def stairs():
    points, triangles, _ = sheet()
    steps = rng.integers(2, 6)
    points[:, 2] = np.floor(points[:, 0] * steps * 0.999) / steps
    return points, triangles


def cone():
    points, triangles, _ = sheet(0.1)
    away = np.hypot(*(points[:, :2] - rng.uniform(0.2, 0.8, 2)).T)
    points[:, 2] = np.maximum(0, 0.2 - away) * rng.uniform(1, 20)
    return points, triangles


def winding_tube():
    n, m = int(rng.integers(60, 200)), int(rng.integers(6, 30))
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    a, b = rng.integers(1, 4), rng.integers(2, 6)
    middle = np.c_[(2 + np.cos(b * t)) * np.cos(a * t), (2 + np.cos(b * t)) * np.sin(a * t), np.sin(b * t)]
    along = np.roll(middle, -1, 0) - np.roll(middle, 1, 0)
    side = np.cross(along, [0, 0, 1])
    side /= np.linalg.norm(side, axis=1)[:, None]
    up = np.cross(along / np.linalg.norm(along, axis=1)[:, None], side)
    s = np.linspace(0, 2 * np.pi, m, endpoint=False)[None, :, None]
    points = middle[:, None] + rng.uniform(0.1, 0.5) * (np.cos(s) * side[:, None] + np.sin(s) * up[:, None])
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    here, next_i = i * m + j, (i + 1) % n * m + j
    next_j, both = i * m + (j + 1) % m, (i + 1) % n * m + (j + 1) % m
    triangles = [np.stack([here, next_i, both], -1), np.stack([here, both, next_j], -1)]
    return points.reshape(-1, 3), np.concatenate([t.reshape(-1, 3) for t in triangles])


def a_source(points, triangles):
    used = np.unique(triangles)
    kind = rng.integers(3)
    if kind == 0:
        return int(rng.choice(used))
    if kind == 1:
        return [int(v) for v in rng.choice(used, 3)]
    return rng.dirichlet([1, 1, 1]) @ points[triangles[rng.integers(len(triangles))]]


kinds = [plane_with_holes, hills_with_holes, fin_on_a_sheet, delaunay_with_gaps, star, stairs, cone,
         winding_tube]
errors = {kind.__name__: [] for kind in kinds}
complaints = 0
end = time.monotonic() + seconds
while time.monotonic() < end:
    kind = kinds[rng.integers(len(kinds))]
    points, triangles = kind()
    if len(triangles) == 0:
        continue
    surface = plexway.Surface(points, triangles)
    source = a_source(points, triangles)
    fast, accurate, exact = (surface.distance(source, accuracy=name)
                             for name in ("fast", "accurate", "exact"))
    reached = np.isfinite(exact) & (exact > 0)
    said = []
    if (np.isfinite(accurate) != np.isfinite(exact)).any():
        said.append("reaches other vertices")
    off = [np.abs(d[reached] / exact[reached] - 1) if reached.any() else np.zeros(1)
           for d in (accurate, fast)]
    errors[kind.__name__].append([off[0].max(), off[0].mean(), off[1].max(), off[1].mean()])
    if off[0].max() > 1e-2:
        said.append(f"{off[0].max():.2e} at worst")
    if isinstance(source, int):
        straight = np.linalg.norm(points - points[source], axis=1)
        if (accurate < straight * (1 - 1e-3)).any():
            said.append("below the straight line")
    if said:
        complaints += 1
        print(f"{kind.__name__}, {len(points)} vertices, source {source}: {', '.join(said)}")

print("kind, problems, accurate: worst, median worst, mean, fast: worst, median worst, mean")
for name, rows in errors.items():
    if rows:
        a, b, c, d = np.array(rows).T
        print(f"{name}, {len(rows)}, {a.max():.1e}, {np.median(a):.1e}, {b.mean():.1e}, "
              f"{c.max():.1e}, {np.median(c):.1e}, {d.mean():.1e}")
sys.exit(1 if complaints else 0)
