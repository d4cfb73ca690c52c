"""Paths on surfaces that lead straight ahead, and given ones pulled tight."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Tuple

import numpy as np

from . import _plexway
from ._arrays import Array, real
from ._results import Path
from ._sources import Polyline, Segment, place

if TYPE_CHECKING:
    from ._kinds import Surface
    from ._sources import Place

_NEXT = np.array([1, 2, 0])


def open_triangles(surface: Surface) -> Tuple[Array, Array]:
    """Vertices of all triangles, and which of them no mask closes."""
    F: Array = surface._native.all_simplices.astype(np.int64)
    mask = surface._native.mask
    free = np.ones(len(F), bool)
    if mask is not None:
        vertices, simplices = (np.asarray(m, bool) for m in mask)
        if len(simplices):
            free &= ~simplices
        if len(vertices):
            free &= ~vertices[F].any(axis=1)
    return F, free


def across(F: Array, free: Array) -> Array:
    """The triangle across the edge behind each corner, shape (m, 3); -1 at the boundary, -2 where
    there are several."""
    edges = np.sort(np.stack([F, F[:, _NEXT]], axis=2).reshape(-1, 2), axis=1)
    open_edges = np.flatnonzero(np.repeat(free, 3))
    _, name, count = np.unique(
        edges[open_edges], axis=0, return_inverse=True, return_counts=True
    )
    twin = np.full(len(edges), -1)
    twin[open_edges[count[name] > 2]] = -2
    pairs = open_edges[np.argsort(name, kind="stable")][count[np.sort(name)] == 2].reshape(-1, 2)
    twin[pairs] = pairs[:, ::-1] // 3
    return twin.reshape(-1, 3)


def places_of(surface: Any, way: Any, closed: bool) -> Tuple[Array, Array]:
    """Simplices and barycentric coordinates of a path, or of one through given places: the straight
    line from each point to the next lies in the simplex of the first of the two."""
    if isinstance(way, Path):
        return way.simplices, way.barycentric
    if isinstance(way, Segment):
        way = [way.start, way.end]
    stops = list(way.points if isinstance(way, Polyline) else way)
    if len(stops) < 2:
        raise _plexway.UsageError("a path leads through two places at least")
    if closed:
        stops.append(stops[0])
    legs = [surface.path(b, a) for a, b in zip(stops, stops[1:])]
    if not all(len(leg) for leg in legs):
        raise _plexway.InputError("one of the places cannot be reached from the one before")
    return (
        np.concatenate([leg.simplices for leg in legs]),
        np.concatenate([leg.barycentric for leg in legs]),
    )


def shortened(surface: Any, way: Any, closed: bool) -> Path:
    """Pulls a path tight; see `Surface.shorten`."""

    def pulled(simplices: Array, barycentric: Array) -> Path:
        points = [
            _plexway.Point(f, b, 0.0) for f, b in zip(simplices.tolist(), barycentric.tolist())
        ]
        return Path(*_plexway.shortened(surface._native, points))

    path = pulled(*places_of(surface, way, closed))
    if not closed:
        return path
    # From its middle to its middle the other way around: the corner at the ends is pulled straight,
    # and there is another where the ends are now, by so much smaller.
    for _ in range(1000):
        if len(path) < 3:
            break
        k = len(path) // 2
        again = pulled(
            *(np.concatenate([a[k:], a[: k + 1]]) for a in (path.simplices, path.barycentric))
        )
        done = again.length >= path.length * (1 - 1e-13)
        path = again
        if done:
            break
    return path


def traced(surface: Surface, start: Place, direction: Any, length: float) -> Path:
    """Straight ahead; see `Surface.trace`."""
    V = surface.vertices
    if V is None or surface._native.measured is not None:
        raise _plexway.UsageError("straight ahead is traced on surfaces with positions, without a metric")
    ahead = np.asarray(direction, float)
    if ahead.shape != (3,) or not np.all(np.isfinite(ahead)):
        raise ValueError(f"direction: expected three numbers, got {direction!r:.40}")
    left = real(length, "length")
    if not 0 <= left < np.inf:
        raise ValueError(f"length: expected a number of 0 or more, got {length!r:.40}")
    F, free = open_triangles(surface)
    if surface._across is None:
        surface._across = across(F, free)
    twin, at_rest = surface._across, V

    def rates(f: int, d: Array) -> Array:
        """How fast barycentric coordinates change, in the direction of d in the triangle's plane."""
        a, b, c = at_rest[F[f]]
        found = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), d, rcond=None)[0]
        return np.array([-found.sum(), *found])

    def heading(f: int, rate: Array) -> Array:
        d: Array = rate @ at_rest[F[f]]
        return d

    at = place(surface, start)
    if at.vertex is not None:
        choice = np.flatnonzero(free & (F == at.vertex).any(axis=1))
        starts = [(int(f), (F[f] == at.vertex).astype(float)) for f in choice]
    else:
        b = np.array(at.barycentric[:3])
        starts = [(at.simplex, b)]
        if np.count_nonzero(b == 0) == 1:
            corner = int(np.flatnonzero(b == 0)[0])
            other = int(twin[at.simplex, _NEXT[corner]])
            if other >= 0:
                starts.append((other, carried(F, at.simplex, other, b)))
    if not starts:
        raise _plexway.UsageError("the start is in no triangle")
    best = None
    for f, b in starts:
        rate = rates(f, ahead)
        speed = float(np.linalg.norm(heading(f, rate)))
        inward = min([*(rate[b == 0] / max(np.abs(rate).max(), 1e-300)), 1.0])
        key = (min(inward, 0.0), speed)
        if best is None or key > best[0]:
            best = (key, f, b, np.where((b == 0) & (rate < 0), 0.0, rate))
    assert best is not None
    _, f, b, rate = best
    rate = rate - np.where(b > 0, rate.sum() / np.count_nonzero(b > 0), 0.0)
    d = heading(f, rate)
    speed = float(np.linalg.norm(d))
    if not speed > 1e-12 * float(np.linalg.norm(ahead)):
        raise _plexway.UsageError("the direction points straight away from the surface")
    d = d / speed
    simplices, coordinates, gone = [f], [b], 0.0
    while left > 0:
        rate = rates(f, d)
        leaving = rate < -1e-14 * np.abs(rate).max()
        steps = np.where(leaving, b / np.where(leaving, -rate, 1), np.inf)
        out = int(np.argmin(steps))
        step = float(steps[out])
        if step >= left:
            coordinates.append(b + left * rate)
            simplices.append(f)
            gone += left
            break
        left, gone = left - step, gone + step
        b = np.maximum(b + step * rate, 0)
        b[out] = 0
        b[b < 1e-13] = 0
        b /= b.sum()
        if np.count_nonzero(b) == 1:
            turn = _around(V, F, twin, f, int(np.argmax(b)), d)
        else:
            g = int(twin[f, _NEXT[out]])
            turn = None if g < 0 else (g, carried(F, f, g, b), _unfolded(V, F, f, g, out, d))
        if turn is None:  # the boundary
            coordinates.append(b)
            simplices.append(f)
            break
        f, b, d = turn
        simplices.append(f)
        coordinates.append(b)
    barycentric = np.zeros((len(simplices), 4))
    barycentric[:, :3] = coordinates
    corners = np.full((len(simplices), 4), -1)
    corners[:, :3] = F[simplices]
    points = np.einsum("ik,ikx->ix", barycentric[:, :3], V[corners[:, :3]])
    return Path(points, np.array(simplices), barycentric, gone, 0, corners)


def carried(F: Array, f: int, g: int, b: Array) -> Array:
    """Coordinates of a point of an edge or a vertex in another triangle there."""
    return np.array([b[F[f] == v].sum() for v in F[g]])


def _unfolded(V: Array, F: Array, f: int, g: int, out: int, d: Array) -> Array:
    """The direction d in triangle f, carried over the edge across from corner `out` into g."""
    p, q = V[F[f, _NEXT[out]]], V[F[f, _NEXT[_NEXT[out]]]]
    far = V[F[g][~np.isin(F[g], F[f])][0]]
    e = (q - p) / np.linalg.norm(q - p)
    along = float(d @ e)
    inward = far - p - ((far - p) @ e) * e
    away: Array = along * e + np.sqrt(max(1 - along**2, 0)) * inward / np.linalg.norm(inward)
    return away


def _around(
    V: Array, F: Array, twin: Array, f: int, corner: int, d: Array
) -> Optional[Tuple[int, Array, Array]]:
    """Straight on through a vertex: as much angle to the left as to the right; None at the boundary."""
    v = int(F[f, corner])

    def wedge(g: int) -> Tuple[int, Array, Array, float]:
        k = int(np.flatnonzero(F[g] == v)[0])
        a, b = (V[F[g, _NEXT[k]]] - V[v], V[F[g, _NEXT[_NEXT[k]]]] - V[v])
        a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
        return k, a, b, _angle(a, b)

    # Around from edge to edge; which of its two edges a triangle is left by depends on the last.
    fan, g, k = [], f, corner
    by = int(F[f, _NEXT[_NEXT[corner]]])  # it is left by the edge to this vertex
    while True:
        k, a, b, angle = wedge(g)
        first = int(F[g, _NEXT[k]]) == by  # left by the edge `a`
        fan.append((g, k, (b, a) if first else (a, b), angle))
        g = int(twin[g, k if first else _NEXT[_NEXT[k]]])
        if g < 0:
            return None
        if g == f:
            break
        by = int(next(w for w in F[g] if w != v and w != by))
    to_go = sum(angle for *_, angle in fan) / 2 - _angle(-d, fan[0][2][1])
    for g, k, (a, b), angle in [*fan[1:], fan[0]]:
        if to_go <= angle:
            e: Array = b - (a @ b) * a
            ahead = np.cos(to_go) * a + np.sin(to_go) * e / np.linalg.norm(e)
            at = np.zeros(3)
            at[k] = 1
            return g, at, ahead
        to_go -= angle
    return None


def _angle(a: Array, b: Array) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))
