"""Fields of lines: the shortest path from any point to the nearest point of a line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Tuple

import numpy as np

from . import _plexway
from ._arrays import Array
from ._geodesics import across, carried, open_triangles, places_of
from ._results import Field, Path
from ._sources import Boundary, Polyline, Segment, Source, WholeSimplex, located, place

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._domain import Domain
    from ._sources import Place

_Legs = Tuple[Array, Array, Array]  # simplices, and where each line begins and ends in its own


def lines_of(domain: Any, source: Any) -> List[Any]:
    """Each source as its lines; those that are points as points of no length."""
    if isinstance(source, (list, tuple)) and any(isinstance(s, Source) for s in source):
        return [one for s in source for one in lines_of(domain, s)]
    if getattr(source, "offset", 0):
        raise _plexway.UsageError("beside lines, sources of a field that tells paths have no offset")
    if isinstance(source, (Segment, Polyline, Path)):
        simplices, b = places_of(domain, source, False)
        return [(simplices[:-1], b[:-1], _next(domain, simplices, b))]
    if isinstance(source, WholeSimplex):
        corners = len(domain._native.corners(source.simplex))
        ends = np.eye(4)[[(i, (i + 1) % corners) for i in range(corners)]]
        return [(np.full(corners, source.simplex), ends[:, 0], ends[:, 1])]
    if isinstance(source, Boundary) and domain.kind == "surface":
        F, free = open_triangles(domain)
        f, k = np.nonzero((across(F, free) == -1) & free[:, None])
        return [(f, np.eye(4)[k], np.eye(4)[(k + 1) % 3])]
    found = []
    for native in located(domain, source):
        if not isinstance(native, (_plexway.Point, _plexway.VertexSet)):
            raise _plexway.UsageError("paths lead to points, sets of vertices, lines and boundaries")
        points = [native] if isinstance(native, _plexway.Point) else native.points
        rows = domain._native.all_simplices
        spots = [
            (p.simplex, p.barycentric)
            if p.vertex is None
            else _corner(rows, p.vertex)
            for p in points
        ]
        b = np.array([s[1] for s in spots])
        found.append((np.array([s[0] for s in spots]), b, b))
    return found


def _corner(rows: Array, vertex: int) -> Tuple[int, List[float]]:
    simplex, corner = (int(i[0]) for i in np.nonzero(rows == vertex))
    return simplex, np.eye(4)[corner].tolist()


def _next(domain: Any, simplices: Array, b: Array) -> Array:
    """Where the line from each point but the last ends, in the simplex that it begins in."""
    rows = domain._native.all_simplices
    ends = np.zeros((len(b) - 1, 4))
    for i, (f, g) in enumerate(zip(simplices[:-1].tolist(), simplices[1:].tolist())):
        ends[i, : rows.shape[1]] = carried(rows, g, f, b[i + 1, : rows.shape[1]])
    return ends


class LineField(Field):
    """The distances from lines, and paths to them: to each point leads a field of its own, back from
    the nearest point of the lines."""

    def __init__(self, domain: Domain, lines: Sequence[_Legs], distance: Array, label: Array) -> None:
        super().__init__(domain, None)
        self._lines = lines
        self._distance = distance
        self._label = label
        distance.flags.writeable = False

    @property
    def distance(self) -> Array:
        """One distance a vertex, shape (n,); read only."""
        return self._distance

    @property
    def label(self) -> Array:
        """The place of the nearest source of each vertex in the list; -1 where none is reached."""
        return self._label

    @property
    def notes(self) -> Tuple[str, ...]:
        """What to know of its distances: see `Domain.notes`."""
        return self._domain.notes

    def path(self, start: Place, *, margin: Optional[float] = None) -> Path:
        """The shortest path from `start` to the nearest point of the lines."""
        field, k, simplex, b, _ = self._foot(place(self._domain, start))
        if k < 0:
            return Path(None, np.zeros(0, int), np.zeros((0, 4)), np.inf, -1, np.zeros((0, 4), int))
        way = Path(*field.trace(_plexway.Point(simplex, b, 0.0), margin))
        return way.reversed(k)

    def at(self, points: ArrayLike, *, level: str = "neighbours") -> Array:
        """Distances of any points of the domain: exact, whatever the level."""
        native = located(self._domain, points, none_is_well=True)
        return np.array([self._foot(p)[-1] for p in native], float)

    def gradient(self) -> Array:
        """Not of lines."""
        raise _plexway.UsageError("directions are those of fields from points and vertices")

    def _foot(self, start: Any) -> Tuple[Any, int, int, List[float], float]:
        """The field of `start`; which line is nearest, where, and how far."""
        accuracy = "exact" if self._domain.kind == "surface" else None
        how = _plexway.SolveArguments("serial", 0, np.inf, "saddles", accuracy)
        field = _plexway.path_field(self._domain._native, [start], how, None)
        found = [(*_nearest(self._domain, field, legs), k) for k, legs in enumerate(self._lines)]
        value, simplex, b, k = min(found, key=lambda one: one[0])
        return field, k if value < np.inf else -1, simplex, b, value


def _nearest(domain: Any, field: Any, legs: _Legs) -> Tuple[float, int, List[float]]:
    """The point of the lines where the field is least: intervals are halved as long as the field,
    which changes by no more than the length, may be less in them; then in each it has one least."""
    simplices, begin, end = legs
    rows = domain._native.all_simplices[simplices]
    V = domain.vertices

    def spot(b: Array) -> Array:
        found: Array = np.einsum("ik,ikx->ix", b[:, : rows.shape[1]], V[rows])
        return found

    length = np.linalg.norm(spot(end) - spot(begin), axis=1)

    def point(n: int, t: float) -> Tuple[int, List[float]]:
        return int(simplices[n]), ((1 - t) * begin[n] + t * end[n]).tolist()

    def values(n: Array, t: Array) -> Array:
        where = [_plexway.Point(*point(i, s), 0.0) for i, s in zip(n.tolist(), t.tolist())]
        found: Array = field.at(where, "neighbours")
        return found

    n = np.arange(len(length))
    low, high = np.zeros(len(n)), np.ones(len(n))
    at_low, at_high = values(n, low), values(n, high)
    least = min(at_low.min(), at_high.min())
    if not least < np.inf:
        return np.inf, 0, []
    for _ in range(60):
        size = (high - low) * length[n]
        keep = (at_low + at_high - size) / 2 <= least
        n, low, high, at_low, at_high = (a[keep] for a in (n, low, high, at_low, at_high))
        if not np.any(size[keep] > 1e-3 * least):
            break
        middle = (low + high) / 2
        at_middle = values(n, middle)
        least = min(least, at_middle.min())
        n, low, high = np.tile(n, 2), np.append(low, middle), np.append(middle, high)
        at_low, at_high = np.append(at_low, at_middle), np.append(at_middle, at_high)
    for _ in range(50):
        one, two = low + 0.382 * (high - low), high - 0.382 * (high - low)
        left = values(n, one) < values(n, two)
        low, high = np.where(left, low, one), np.where(left, two, high)
    t = np.concatenate([low, high, 0 * low, 0 * low + 1])
    n = np.tile(n, 4)
    found = values(n, t)
    best = int(np.argmin(found))
    return (float(found[best]), *point(int(n[best]), float(t[best])))
