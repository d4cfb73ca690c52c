"""What a field may start from."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Type, Union

import numpy as np

from . import _plexway
from ._arrays import plain
from ._warnings import warn

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    #: An integer: a vertex. Three floats: the closest point of the domain. Or a Vertex or Point.
    Place = Union[int, ArrayLike, "Vertex", "Point"]


class Source:
    """Base of all sources that have a name.

    Beside these, a source may be an integer (a vertex), integers or truth values for all vertices
    (vertices), or rows of three floats (the points of the domain closest to them).
    """


@dataclass(frozen=True)
class Vertex(Source):
    """A vertex, counted from 0.

    Parameters
    ----------
    vertex : int
    offset : float
        What the field starts with there, >= 0, in the unit of the domain.
    """

    vertex: int
    offset: float = 0.0


@dataclass(frozen=True)
class Point(Source):
    """A point of a simplex.

    Parameters
    ----------
    simplex : int
        Counted from 0.
    barycentric : sequence of float
        One coordinate a corner, >= 0, sum 1; at most four corners.
    offset : float
        What the field starts with there, >= 0.
    """

    simplex: int
    barycentric: Sequence[float]
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Vertices(Source):
    """Vertices that are one source together: the distance from the nearest.

    Parameters
    ----------
    vertices : array_like of int, shape (k,)
    offsets : array_like of float, shape (k,), optional
        What the field starts with at each, >= 0: so a field goes on from the values of another.
    offset : float
        Added to each.
    """

    vertices: ArrayLike
    offsets: Optional[ArrayLike] = None
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Ball(Source):
    """All points at the distance `radius` from `centre`: a circle, or a sphere.

    Parameters
    ----------
    centre : Place
    radius : float
    offset : float
    """

    centre: Place
    radius: float
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Polyline(Source):
    """Points joined by shortest paths, on a surface or a wireframe with positions.

    Parameters
    ----------
    points : sequence of Place
    offset : float
    """

    points: Sequence[Place]
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Segment(Source):
    """The shortest path from `start` to `end`, all of it; see `Polyline`.

    Parameters
    ----------
    start, end : Place
    offset : float
    """

    start: Place
    end: Place
    offset: float = 0.0


@dataclass(frozen=True)
class WholeSimplex(Source):
    """All of a triangle of a surface, or of an edge of a wireframe.

    Parameters
    ----------
    simplex : int
    offset : float
    """

    simplex: int
    offset: float = 0.0


@dataclass(frozen=True)
class Boundary(Source):
    """The whole boundary: of a surface its rim, of a solid its faces (under a metric, or by
    intrinsic lengths, their vertices), of a wireframe its loose ends.

    Parameters
    ----------
    offset : float
    """

    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class _GivenCurve(Source):
    """Points of simplices, each in one with the next: what a path is as a source."""

    simplices: Any
    barycentric: Any


class OutOfRange(_plexway.UsageError, IndexError):
    """A vertex or a simplex that the domain does not have."""


OutOfRange.__module__ = "plexway"


def index(value: Any, count: int, what: str) -> int:
    """`value` as a number from 0 to below `count`; IndexError says what is out of range."""
    number = operator.index(value)
    if not 0 <= number < count:
        raise OutOfRange(f"{what} {number}: there are {count}, counted from 0")
    return number


def columns_of(domain: Any, columns: Any) -> Any:
    """The vertices that are columns, or None for all; IndexError for one that does not exist."""
    if columns is None:
        return None
    array = plain(columns, "columns")
    if array.dtype.kind in "iu" and array.size:
        for vertex in (array.min(), array.max()):
            index(vertex, domain.vertex_count, "columns: vertex")
    return array


def _diagonal(domain: Any) -> float:
    """Of the box around all positions."""
    if domain._diagonal is None:
        at = domain.vertices
        domain._diagonal = float(np.linalg.norm(at.max(axis=0) - at.min(axis=0)))
    return float(domain._diagonal)


def _closest(domain: Any, xyz: List[float], planar: bool) -> Any:
    """The closest point of the domain; a warning says where that is far away."""
    if planar and domain.vertices is not None and np.any(domain.vertices[:, 2:]):
        raise ValueError(f"the point {xyz[:2]} has two coordinates, those of the domain have three")
    point, away = domain._native.closest(xyz)
    if away > 0.01 * _diagonal(domain):
        times = away / (_diagonal(domain) or 1)
        text = f"the point {xyz} is {away:.4g} from the domain ({times:.2g} of its diagonal)"
        warn([text + ": the closest point was taken"], domain)
    return point


def place(domain: Any, at: Any) -> Any:
    """A single place as the library has it."""
    if isinstance(at, _plexway.Point):
        return at
    if isinstance(at, Vertex):
        return _plexway.Point(index(at.vertex, domain.vertex_count, "vertex"), float(at.offset))
    if isinstance(at, Point):
        simplex = index(at.simplex, domain._native.given_simplices, "simplex")
        return _plexway.Point(simplex, [float(b) for b in at.barycentric], float(at.offset))
    if isinstance(at, Source):
        raise TypeError(f"expected a vertex or a point, got {type(at).__name__}")
    if not isinstance(at, (bool, np.bool_)):
        try:
            return _plexway.Point(index(at, domain.vertex_count, "vertex"), 0.0)
        except TypeError:
            pass
    array = np.asarray(at)
    if array.shape in ((3,), (2,)) and array.dtype.kind in "fiu":
        xyz = [float(x) for x in array] + [0.0] * (3 - len(array))
        if not np.all(np.isfinite(xyz)):
            raise _plexway.UsageError(f"the point {xyz} is not finite")
        return _closest(domain, xyz, len(array) == 2)
    raise _wrong(array)(
        f"expected a vertex (an integer) or a point (three floats), got {at!r:.60}"
    )


def _wrong(array: Any) -> Type[Exception]:
    """What NumPy would raise: of rows of numbers their shape is wrong, of all else the type."""
    return ValueError if array.ndim and array.dtype.kind in "fiu" else TypeError


def only_place(domain: Any, at: Any) -> Any:
    """As `place`, where a row of integers would be vertices if several might stand there."""
    if np.ndim(at) == 1 and np.asarray(at).dtype.kind in "iu":
        raise ValueError(
            f"one place, a vertex (an integer) or a point (three floats); got {at!r:.60}; "
            "paths from several places: field(source).paths([1, 2])"
        )
    return place(domain, at)


def open_sources(domain: Any, source: Any, none_is_well: bool = False) -> List[Any]:
    """As `located`; raises UsageError for one that is masked."""
    found = located(domain, source, none_is_well)
    domain._native.require_open(found)
    return found


def located(domain: Any, source: Any, none_is_well: bool = False) -> List[Any]:
    """A source, or several, as the library has them: one each.

    Integers in one row are so many vertices; truth values, one a vertex, those that are true; three
    floats are a point in space, and rows of three floats are points.
    """
    if type(source) is int:
        return [_plexway.Point(index(source, domain.vertex_count, "vertex"), 0.0)]
    if isinstance(source, Source):
        return [_one(domain, source)]
    if isinstance(source, (list, tuple)) and any(isinstance(s, Source) for s in source):
        return [one for s in source for one in located(domain, s)]
    try:
        array = plain(source, "source")
    except ValueError:
        if isinstance(source, np.ma.MaskedArray):
            raise
        if isinstance(source, (list, tuple)):  # vertices beside points
            return [place(domain, one) for one in source]
        array = np.empty((), object)
    if array.dtype.kind == "b":
        if array.shape != (domain.vertex_count,):
            raise ValueError(
                f"sources by truth values: expected shape ({domain.vertex_count},), got {array.shape}"
            )
        array = np.flatnonzero(array)
    if array.dtype.kind in "iu" and array.ndim == 2 and array.size:
        raise ValueError(
            f"a source of integers in rows, {array.dtype} of shape {array.shape}: vertices are one "
            "row, [0, 1], and points are floats, [[0.0, 1.0, 0.0]]"
        )
    if array.dtype.kind == "f" and array.ndim == 2 and array.shape[1] in (2, 3) and len(array):
        return [place(domain, row) for row in array]
    if array.dtype.kind in "iu" and array.ndim <= 1 and array.size:
        count = domain.vertex_count
        return [
            _plexway.Point(index(v, count, "vertex"), 0.0) for v in array.ravel().tolist()
        ]
    if array.dtype.kind == "f" and array.shape in ((3,), (2,)):
        return [place(domain, array)]
    if array.size == 0 and array.dtype.kind != "O":
        if none_is_well:
            return []
        raise _plexway.UsageError("no source: the list is empty")
    raise _wrong(array)(
        "a source is a vertex (an integer), vertices (integers), a point (three floats), points "
        f"(k, 3), or one of plexway's sources; got {_told(source, array)}"
    )


def _told(source: Any, array: Any) -> str:
    if array.ndim == 0 or array.dtype.kind in "OUS":
        return f"{type(source).__name__} {source!r:.40}"
    return f"{array.dtype} of shape {array.shape}"


def _one(domain: Any, source: Source) -> Any:
    native = domain._native
    if isinstance(source, (Vertex, Point)):
        return place(domain, source)
    if isinstance(source, Vertices):
        vertices = np.asarray(source.vertices)
        if vertices.dtype.kind == "b":
            vertices = np.flatnonzero(vertices)
        return _plexway.VertexSet(vertices, source.offsets, float(source.offset))
    if isinstance(source, Ball):
        return _plexway.Ball(place(domain, source.centre), float(source.radius), float(source.offset))
    if isinstance(source, Segment):
        source = Polyline([source.start, source.end], source.offset)
    if isinstance(source, Polyline):
        points = [place(domain, p) for p in source.points]
        if not points:
            raise _plexway.UsageError("a line needs at least one point")
        return native.joined(points, float(source.offset))
    if isinstance(source, WholeSimplex):
        simplex = index(source.simplex, native.given_simplices, "simplex")
        return _plexway.WholeSimplex(simplex, float(source.offset))
    if hasattr(source, "simplices"):  # a Path
        rows = zip(source.simplices.tolist(), getattr(source, "barycentric").tolist())
        return _plexway.Curve([_plexway.Point(simplex, b, 0.0) for simplex, b in rows], 0.0)
    if isinstance(source, Boundary):
        return native.boundary(float(source.offset))
    raise TypeError(f"{type(source).__name__} is no source that plexway knows")
