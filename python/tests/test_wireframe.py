"""Wireframes against SciPy's Dijkstra."""

import numpy as np
import pytest

import plexway as px

sparse = pytest.importorskip("scipy.sparse")
csgraph = pytest.importorskip("scipy.sparse.csgraph")


def random_graph(n, m, seed):
    random = np.random.default_rng(seed)
    E = random.integers(0, n, (m, 2))
    E = E[E[:, 0] != E[:, 1]]
    E = np.unique(np.sort(E, axis=1), axis=0)
    return random.uniform(size=(n, 3)), E


@pytest.mark.parametrize("n, m, seed", [(50, 60, 0), (500, 1500, 1), (2000, 2200, 2)])
def test_dijkstra(n, m, seed):
    V, E = random_graph(n, m, seed)
    lengths = np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1)
    chosen = np.arange(0, n, n // 5)
    graph = sparse.csr_matrix((lengths, (E[:, 0], E[:, 1])), (n, n))
    truth = csgraph.dijkstra(graph, directed=False, indices=chosen)
    for frame in (
        px.Wireframe(V, E, precision="double"),
        px.Wireframe(E=E, lengths=lengths, vertices=n, precision="double"),
    ):
        found = frame.distances(chosen)
        assert np.array_equal(np.isinf(found), np.isinf(truth))
        reached = np.isfinite(truth)
        assert np.abs(found[reached] - truth[reached]).max() < 1e-12
        nearest, label = frame.nearest(chosen)
        far = truth.min(axis=0)
        near = np.isfinite(far)
        assert np.array_equal(label >= 0, near)
        assert np.abs(nearest[near] - far[near]).max() < 1e-12
        assert np.abs(truth[label, np.arange(n)][near] - far[near]).max() < 1e-12
