#!/usr/bin/env python3
"""Pictures of the gallery that take more than one command: `docs/gallery.py NAME FILE`, with the package on the path.

errors      errors of Dijkstra's algorithm, of the heat method and of plexway, beside exact distances
farthest    landmarks on a torus
grain       a flat L with a grain
roll        points of rolled-up paper
space-time  a robot and a door that opens late
"""

import itertools
import struct
import sys
import warnings
import zlib

import numpy as np

import plexway


def refined(V, F, times):
    """Each triangle cut into four at the middles of its edges, over and over: the same surface."""
    for _ in range(times):
        edges = np.sort(F[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        unique, where = np.unique(edges, axis=0, return_inverse=True)
        a, b, c = F.T
        ab, bc, ca = (len(V) + where.reshape(-1, 3)).T
        V = np.vstack((V, V[unique].mean(axis=1)))
        F = np.vstack([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return V, F


def heat(V, F, source):
    """The heat method of Crane, Weischedel and Wardetzky (2013): heat flows for the square of the mean edge, its
    normalized gradient is integrated by Poisson's equation."""
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import spsolve

    corner = V[F]
    opposite = corner[:, [2, 0, 1]] - corner[:, [1, 2, 0]]  # of corners 0, 1, 2
    normal = np.cross(opposite[:, 0], opposite[:, 1])
    double_area = np.linalg.norm(normal, axis=1)
    normal /= double_area[:, None]
    n = len(V)
    weight = coo_matrix((n, n))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        cotangent = -np.einsum("ij,ij->i", opposite[:, j], opposite[:, k]) / double_area / 2
        weight = weight + coo_matrix((cotangent, (F[:, j], F[:, k])), (n, n))
    weight = weight + weight.T
    laplace = diags(np.asarray(weight.sum(axis=1)).ravel()) - weight
    area = np.bincount(F.ravel(), np.repeat(double_area / 6, 3), n)
    mean = np.linalg.norm(opposite, axis=2).mean()
    start = np.zeros(n)
    start[source] = 1
    warm = spsolve((diags(area) + mean**2 * laplace).tocsc(), start)
    gradient = np.einsum("fi,fid->fd", warm[F], np.cross(normal[:, None], opposite))
    flow = -gradient / np.linalg.norm(gradient, axis=1)[:, None]
    side = np.cross(normal[:, None], opposite)  # the gradient of a corner's hat, times twice the area
    divergence = np.bincount(F.ravel(), np.einsum("fd,fid->fi", flow, side).ravel() / 2, n)
    rest = np.arange(n) != source
    found = np.zeros(n)
    found[rest] = spsolve(laplace.tocsr()[rest][:, rest].tocsc(), divergence[rest])
    return found - found[source]


def errors():
    knot = plexway.read("data/knot.ply", precision="double")
    V, F = np.array(knot.vertices), np.array(knot.simplices).astype(int)
    source = 0
    exact = knot.distance(source, accuracy="exact")
    edges = np.unique(np.sort(F[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    fields = [plexway.Wireframe(V, edges, precision="double").distance(source), heat(V, F, source),
              plexway.read("data/knot.ply").distance(source)]
    off = [np.abs(field - exact) / np.where(exact > 0, exact, np.inf) for field in fields]
    for name, error in zip(("Dijkstra", "heat", "plexway"), off):
        print(f"{name}: mean {error.mean():.1e}, worst {error.max():.1e}")
    width = 1.08 * np.ptp(V[:, 0])
    three = plexway.Surface(np.vstack([V + [i * width, 0, 0] for i in range(3)]),
                            np.vstack([F + i * len(V) for i in range(3)]))
    value = np.log10(np.clip(np.concatenate(off), 1e-6, 1))
    return three.picture(value, source=[i * len(V) for i in range(3)], size=(1000, 330), view=(0, 75), isolines=0,
                         map="magma", title="log10 of the error")


def farthest():
    u, v = np.meshgrid(np.arange(240), np.arange(96), indexing="ij")
    a, b = 2 * np.pi * u.ravel() / 240, 2 * np.pi * v.ravel() / 96
    V = np.stack(((1 + 0.42 * np.cos(b)) * np.cos(a), (1 + 0.42 * np.cos(b)) * np.sin(a), 0.42 * np.sin(b)), axis=1)
    at = (lambda i, j: (i % 240) * 96 + j % 96)
    u, v = u.ravel(), v.ravel()
    quad = np.stack((at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)), axis=1)
    torus = plexway.Surface(V, np.vstack((quad[:, [0, 1, 2]], quad[:, [0, 2, 3]])))
    found = torus.farthest(30)
    distance = torus.distance(found.points.positions)
    # Only those that face the camera: others would be rings.
    azimuth, elevation = np.radians((20, 40))
    camera = np.array([np.sin(azimuth) * np.cos(elevation), -np.cos(azimuth) * np.cos(elevation), np.sin(elevation)])
    where = found.points.positions
    ring = where * [1, 1, 0] / np.linalg.norm(where[:, :2], axis=1)[:, None]
    seen = where[(where - ring) @ camera > 0]
    return torus.picture(distance, source=seen, size=(640, 480), view=(20, 40), isolines=8, map="cividis")


def grain():
    flat = plexway.read("data/ell.obj")
    V, F = refined(np.array(flat.vertices), np.array(flat.simplices).astype(int), 3)
    xx, xy, yy = np.loadtxt("data/grain.txt")
    tensor = np.array([[xx, xy, 0], [xy, yy, 0], [0, 0, 1]])
    sheet = plexway.Surface(V, F, metric=lambda point: tensor, precision="double")
    return sheet.picture(sheet.distance([0.5, 0.5, 0.0]), source=[0.5, 0.5, 0.0], size=(640, 480), view=(0, 90),
                         isolines=12, title="cost")


def roll():
    random = np.random.default_rng(1)
    t = np.repeat(np.linspace(0, 1, 260), 60)
    height = np.tile(np.linspace(0, 1.1, 60), 260) + random.normal(0, 0.003, t.size)
    angle = 0.6 + 8.6 * t + random.normal(0, 0.003, t.size)
    radius = 0.25 + 0.11 * angle
    V = np.stack((radius * np.cos(angle), radius * np.sin(angle), height), axis=1)
    paper = plexway.Cloud(V)
    source = V.shape[0] - 30
    return paper.picture(paper.distance(source), source=source, size=(640, 480), view=(40, 50))


def space_time():
    """Two axes of space, and time upwards: a wall stands until half time, and who comes early waits at it."""
    n = 16
    steps = np.array(list(itertools.product(range(n + 1), repeat=3)))
    number = {tuple(s): i for i, s in enumerate(steps.tolist())}
    tets = []
    for cell in itertools.product(range(n), repeat=3):
        if cell[1] == n // 2 and cell[2] < n // 2:
            continue
        for order in itertools.permutations(range(3)):
            at, corners = list(cell), [number[cell]]
            for axis in order:
                at[axis] += 1
                corners.append(number[tuple(at)])
            tets.append(corners)
    world = plexway.Solid(steps / n, tets)
    start = number[n // 2, 0, 0]
    field = world.field(start)
    paths = [field.path(number[n // 2, n, t]) for t in (9, 12, 16)]
    return world.picture(field.distance, source=start, paths=paths, size=(640, 480), view=(68, 16), cut=True,
                         title="length")


def save(picture, file):
    """As a PNG of 256 colours, a quarter of the bytes."""
    from scipy.cluster.vq import kmeans2, vq

    height, width = picture.shape[:2]
    colours, where, count = np.unique(np.asarray(picture)[..., :3].reshape(-1, 3), axis=0, return_inverse=True,
                                      return_counts=True)
    palette = colours[np.argsort(-count)[:256]].astype(float)
    if len(colours) > 256:
        # Spread over all colours first, as a popular one is not better known for that.
        start = colours[np.linspace(0, len(colours) - 1, 256).astype(int)].astype(float)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a colour of the palette that nothing needs
            palette, _ = kmeans2(colours.astype(float), start, iter=20, minit="matrix")
    palette = np.clip(np.rint(palette), 0, 255).astype(np.uint8)
    common = colours[count.argmax()]  # the background stays what it is
    palette[np.abs(palette.astype(int) - common).sum(axis=1).argmin()] = common
    index = vq(colours.astype(float), palette.astype(float))[0].astype(np.uint8)[where].reshape(height, width)
    rows = np.zeros((height, 1 + width), np.uint8)
    rows[:, 1:] = index

    def chunk(name, data):
        body = name + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    with open(file, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) +
                  chunk(b"PLTE", palette.tobytes()) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) +
                  chunk(b"IEND", b""))


if __name__ == "__main__":
    name, file = sys.argv[1:]
    save({"errors": errors, "farthest": farthest, "grain": grain, "roll": roll, "space-time": space_time}[name](), file)
