"""Domains with known distances, as arrays."""

import itertools

import numpy as np


def grid(n, jitter=0.0, seed=0):
    """A flat square of side 1: n x n cells, two triangles each; inner vertices moved at random."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    V = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    inner = np.all((V[:, :2] > 1e-9) & (V[:, :2] < 1 - 1e-9), axis=1)
    noise = np.random.default_rng(seed).uniform(-jitter / n, jitter / n, (len(V), 2))
    V[inner, :2] += noise[inner]
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = (i * (n + 1) + j).ravel()
    b, c, d = a + n + 1, a + 1, a + n + 2
    return V, np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])


def kuhn(n, axes):
    """A cube of side 1 in any dimension: n^axes cells, axes! simplices each."""
    steps = np.array(list(itertools.product(range(n + 1), repeat=axes)))
    numbers = {tuple(s): i for i, s in enumerate(steps.tolist())}
    simplices = []
    for cell in itertools.product(range(n), repeat=axes):
        for order in itertools.permutations(range(axes)):
            at = list(cell)
            corners = [numbers[tuple(at)]]
            for axis in order:
                at[axis] += 1
                corners.append(numbers[tuple(at)])
            simplices.append(corners)
    return steps / n, np.array(simplices)


def sphere(n):
    """Unit sphere: rings of latitude."""
    theta = np.linspace(0, np.pi, n + 1)[1:-1]
    phi = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False)
    ring = [
        [np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)] for t in theta for p in phi
    ]
    V = np.array([[0, 0, 1], *ring, [0, 0, -1]], float)
    m, F = 2 * n, []
    for k in range(m):
        F.append([0, 1 + k, 1 + (k + 1) % m])
        last = 1 + (n - 2) * m
        F.append([last + (k + 1) % m, last + k, len(V) - 1])
        for r in range(n - 2):
            a, b = 1 + r * m + k, 1 + r * m + (k + 1) % m
            F += [[a, a + m, b], [b, a + m, b + m]]
    return V, np.array(F)


def loose_edges(F):
    """Edges of triangles, each once."""
    e = np.sort(F[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique(e, axis=0)


def domains():
    """A domain of each kind that lies flat, and whatever solver it takes is right on: functions that
    make them, by name, each with the positions that distances are straight lines between."""
    import plexway as px

    def surface(**options):
        V, F = grid(10, jitter=0.2)
        return px.Surface(V, F, **options), V

    def solid(**options):
        V, T = kuhn(3, 3)
        return px.Solid(V, T, **options), V

    def wireframe(**options):
        V = np.stack([np.linspace(0, 1, 30) ** 2, np.zeros(30), np.zeros(30)], axis=1)
        return px.Wireframe(V, np.stack([np.arange(29), np.arange(1, 30)], 1), **options), V

    def cloud(**options):
        V, _ = grid(20)
        return px.Cloud(V, **options), V

    def simplices(**options):
        V, S = kuhn(2, 4)
        return px.Simplicial(V, S, **options), V

    def mixed(**options):
        # A square in two parts: what is flat as a whole has straight distances.
        V, F = grid(8)
        left = V[F].mean(axis=1)[:, 0] < 0.5
        return px.Mixed([(V, F[left]), (V, F[~left])], **options), np.concatenate([V, V])

    return {
        "surface": surface,
        "solid": solid,
        "wireframe": wireframe,
        "cloud": cloud,
        "simplices": simplices,
        "mixed": mixed,
    }
