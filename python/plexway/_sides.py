"""On which side of closed curves vertices of a surface are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Sequence, Tuple

import numpy as np

from . import _plexway
from ._arrays import Array, scipy_sparse
from ._geodesics import across, carried, open_triangles
from ._sources import place

if TYPE_CHECKING:
    from ._kinds import Surface

# In the middle of each triangle a point, and one on each edge, where a curve mostly has none.
_MIDDLE = np.array([0.3318, 0.3371, 0.3311])
_SHARE = 0.5173


def inside(surface: Surface, curves: Sequence[Tuple[Array, Array]], within: Any) -> Array:
    """Truth values, one a vertex: the side that has the place `within`, or the smaller of the two.

    From triangle to triangle: how often is a curve crossed? Each triangle is taken twice, as one
    side and as the other, and an odd step leads from the one to the other.
    """
    F, free = open_triangles(surface)
    m = len(F)
    lines: Dict[int, List[Tuple[Array, Array]]] = {}
    for simplices, barycentric in curves:
        b = np.where(barycentric[:, :3] < 1e-12, 0, barycentric[:, :3])
        for i, f in enumerate(simplices[:-1].tolist()):
            to = carried(F, int(simplices[i + 1]), f, b[i + 1])
            lines.setdefault(f, []).append((b[i], to))
        ends = carried(F, int(simplices[0]), int(simplices[-1]), b[0])
        if len(b) < 3 or not np.allclose(ends, b[-1], rtol=0, atol=1e-9):
            raise _plexway.UsageError("a curve that is not closed has no inside")

    def odd(f: int, p: Array, q: Array) -> bool:
        return sum(_meet(p, q, a, b) for a, b in lines.get(f, ())) % 2 == 1

    twin = across(F, free)
    if np.any(twin == -2):
        raise _plexway.UsageError("a curve has two sides only where edges have two triangles at most")
    f, k = np.nonzero(twin >= 0)
    g = twin[f, k]
    step = np.zeros(len(f), bool)
    for n in np.flatnonzero(np.isin(f, list(lines)) | np.isin(g, list(lines))):
        one, two, i = int(f[n]), int(g[n]), int(k[n])
        j = (i + 1) % 3
        spot = np.zeros(3)
        spot[i] = _SHARE if F[one, i] < F[one, j] else 1 - _SHARE
        spot[j] = 1 - spot[i]
        step[n] = odd(one, _MIDDLE, spot) != odd(two, _MIDDLE, carried(F, one, two, spot))
    sparse = scipy_sparse()
    from scipy.sparse.csgraph import connected_components  # type: ignore

    start = np.concatenate([f, f + m])
    end = np.concatenate([g + m * step, g + m * ~step])
    graph = sparse.csr_matrix((np.ones(len(start), np.int8), (start, end)), shape=(2 * m, 2 * m))
    part = connected_components(graph, directed=False)[1].reshape(2, m)
    if np.any(part[0] == part[1]):
        raise _plexway.UsageError("the curve does not cut the surface in two")
    side, piece = part[0] < part[1], part.min(axis=0)

    def side_of(f: int, b: Array) -> bool:
        return bool(side[f]) != odd(f, _MIDDLE, b)

    wanted = _smaller(surface, F, free, side, piece)
    if within is not None:
        at = place(surface, within)
        f0 = int(np.flatnonzero((F == at.vertex).any(axis=1))[0]) if at.vertex is not None else at.simplex
        b0 = (F[f0] == at.vertex).astype(float) if at.vertex is not None else np.array(at.barycentric[:3])
        wanted[piece[f0]] = side_of(f0, b0)
    has = np.full(surface.vertex_count, -1)
    has[F[free].ravel()] = np.repeat(np.flatnonzero(free), 3)
    found: Array = (has >= 0) & (side[has] == wanted[piece[has]])
    for v in np.flatnonzero(np.isin(has, list(lines))):
        f1 = int(has[v])
        found[v] = side_of(f1, (F[f1] == v).astype(float)) == wanted[piece[f1]]
    return found


def _smaller(surface: Surface, F: Array, free: Array, side: Array, piece: Array) -> Array:
    """The side of each piece of the surface that has less area; without positions, fewer triangles."""
    size = free.astype(float)
    if surface.vertices is not None:
        a, b, c = (surface.vertices[F[:, i]] for i in range(3))
        size *= np.linalg.norm(np.cross(b - a, c - a), axis=1)
    smaller: Array = np.bincount(piece, size * side) <= np.bincount(piece, size * ~side)
    return smaller


def _meet(p: Array, q: Array, a: Array, b: Array) -> bool:
    """Do the lines p-q and a-b cross, where q may lie on an edge and a-b along it?"""
    for z in np.flatnonzero(q == 0):
        if a[z] == 0 and b[z] == 0:
            i = (z + 1) % 3
            return bool((a[i] < q[i]) != (b[i] < q[i]))

    def turn(x: Array, y: Array, w: Array) -> bool:
        return bool((y[0] - x[0]) * (w[1] - x[1]) > (y[1] - x[1]) * (w[0] - x[0]))

    return turn(p, q, a) != turn(p, q, b) and turn(a, b, p) != turn(a, b, q)
