"""What each method takes, for the table of docs/reference/python.md: processor time, the lesser of two calls.

    PYTHONPATH=build/python python3 python/bench/methods.py FILE [SOLID]

Of a surface, as Stanford's bunny; `isosurfaces` are of a solid: SOLID, or the cube that is made here.
"""

import itertools
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import plexway


def least(work):
    times = []
    for _ in range(2):
        begun = time.process_time()
        work()
        times.append(time.process_time() - begun)
    return min(times)


def cube(n=24):
    """n^3 cells, six tetrahedra each."""
    steps = np.array(list(itertools.product(range(n + 1), repeat=3)))
    tets = []
    step = [(n + 1) ** 2, n + 1, 1]
    cells = np.array(list(itertools.product(range(n), repeat=3))) @ step
    for order in itertools.permutations(range(3)):
        corners = np.cumsum([0] + [step[axis] for axis in order])
        tets.append(cells[:, None] + corners[None])
    return plexway.Solid(steps / n, np.concatenate(tets))


def told(seconds):
    return f"{1e3 * seconds:.2g} ms" if seconds < 1 else f"{seconds:.2g} s"


def main(file, solid=None):
    surface = plexway.read(file)
    V = np.array(surface.vertices)
    n = surface.vertex_count
    some = np.linspace(0, n - 1, 20).astype(int)
    distance = surface.distance(0, accuracy="accurate")
    field = surface.field(0, accuracy="accurate")
    size = float(distance[np.isfinite(distance)].max())
    block = plexway.read(solid) if solid else cube()
    folder = tempfile.TemporaryDirectory()
    name = Path(folder.name)
    work = {
        "distance, accurate": lambda: surface.distance(0, accuracy="accurate"),
        "distance, fast": lambda: surface.distance(0, accuracy="fast"),
        "distance, exact": lambda: surface.distance(0, accuracy="exact"),
        "distances, 20 rows": lambda: surface.distances(some, threads=1, accuracy="accurate"),
        "nearest, 20 sources": lambda: surface.nearest(some, accuracy="accurate"),
        "estimate": lambda: surface.estimate(0),
        "near, a row of 100": lambda: surface.near(some, count=100, threads=1),
        "pairs, 20 rows": lambda: surface.pairs(name / "d.npy", some, threads=1, accuracy="accurate"),
        "field": lambda: surface.field(0, accuracy="accurate"),
        "field.path": lambda: field.path(n // 2),
        "field.at, 1000 points": lambda: field.at(V[:1000]),
        "field.gradient": field.gradient,
        "isolines, 10": lambda: surface.isolines(distance, np.linspace(0, size, 12)[1:-1]),
        "isosurfaces, 10": lambda: block.isosurfaces(block.vertices[:, 0], np.linspace(0.05, 0.95, 10)),
        "poisson, 1000": lambda: surface.poisson(count=1000),
        "farthest, 100": lambda: surface.farthest(100),
        "cvt, 20 seeds, 10 times": lambda: surface.cvt(some, iterations=10, tolerance=0),
        "closest, 1000 points": lambda: surface.closest(V[:1000]),
        "picture": lambda: surface.picture(distance),
        "info": surface.info,
        "write, .ply": lambda: surface.write(name / "d.ply", distance),
        "Surface(V, F)": lambda: plexway.Surface(V, surface.simplices),
    }
    print(surface, block)
    for what, call in work.items():
        try:
            print(f"{what}: {told(least(call))}", flush=True)
        except plexway.NotBuilt as missing:
            print(f"{what}: {missing}")


if __name__ == "__main__":
    main(*sys.argv[1:])
