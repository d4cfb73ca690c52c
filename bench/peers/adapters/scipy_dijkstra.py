#!/usr/bin/env python3
"""Dijkstra along the edges of a surface (.off) or solid (.mesh), by scipy."""
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.csgraph import dijkstra

from common import arguments, read_medit, read_off, write

domain, sources, out = arguments()
points, cells = (read_medit if domain.endswith(".mesh") else read_off)(domain)
corners = cells.shape[1]
pairs = np.vstack([cells[:, [a, b]] for a in range(corners) for b in range(a)])
edges = np.unique(np.sort(pairs, axis=1), axis=0)
lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
graph = sparse.csr_matrix((lengths, (edges[:, 0], edges[:, 1])), shape=(len(points), len(points)))
write(out, (dijkstra(graph, directed=False, indices=source) for source in sources))
