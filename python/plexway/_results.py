"""What comes back."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Iterator, List, Optional, Tuple, Union

import numpy as np

from ._arrays import Array, scipy_sparse
from ._plexway import UsageError
from ._sources import Point, Source, Vertex, located, only_place, place

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._domain import Domain
    from ._sources import Place


@dataclass(frozen=True, eq=False, repr=False)
class Path(Source):
    """A path from a point back to the nearest source, straight in each simplex. It is empty, with a
    length of ``inf``, where none exists. On surfaces and wireframes it is a source, too: all of its
    line.

    Attributes
    ----------
    points : ndarray of float64, shape (p, 3), or None
        Where its points are; None where the domain has no positions.
    simplices : ndarray of int64, shape (p,)
        The straight line from each point to the next lies in the simplex of the first of the two.
        (Of a cloud: triangles of its sheet.)
    barycentric : ndarray of float64, shape (p, 4)
        Coordinates of each point in its simplex, 0 beyond its corners.
    length : float
        Summed over the straight lines, in the unit of the domain.
    source : int
        The place of the source in the list of sources; -1 if there is no path.
    corners : ndarray of int64, shape (p, 4)
        The vertices that `barycentric` belongs to; -1 beyond the corners, and on a cloud's sheet.
    """

    points: Optional[Array]
    simplices: Array
    barycentric: Array
    length: float
    source: int
    corners: Array

    def __len__(self) -> int:
        return len(self.simplices)

    @property
    def vertices(self) -> Array:
        """Which vertex each point is: int64, shape (p,); -1 for a point between vertices."""
        found: Array = np.where(self.barycentric == 1, self.corners, -1).max(axis=1, initial=-1)
        return found

    def reversed(self, source: int) -> Path:
        """The same path from its end to its start, to the source of this number."""
        order = slice(None, None, -1)
        simplices, b, corners = (a[order].copy() for a in (self.simplices, self.barycentric, self.corners))
        for i in range(len(self) - 1):  # the line that begins here now lies in the next one's simplex
            weight = {v: w for v, w in zip(corners[i].tolist(), b[i].tolist()) if w}
            simplices[i], corners[i] = simplices[i + 1], corners[i + 1]
            b[i] = [weight.get(v, 0.0) for v in corners[i].tolist()]
        points = None if self.points is None else self.points[order].copy()
        return Path(points, simplices, b, self.length, source, corners)

    def measure(self, V: Any) -> Any:
        """The length that the same points have in another place: the sum of straight lines between
        them, on vertices at `V`.

        `V` is an array of NumPy, a tensor of PyTorch, an array of JAX: whatever has an index, sums
        and powers. The derivative of what is returned is that of the length of the shortest path.

        Parameters
        ----------
        V : array or tensor, shape (n, axes)

        Returns
        -------
        number, or tensor without axes
        """
        if len(self) < 2:
            return (V[:1] * 0).sum() + self.length
        tensor = getattr(V, "new_tensor", np.asarray)
        used = [k for k in range(4) if np.any(self.barycentric[:, k])]
        points = sum(
            tensor(self.barycentric[:, k])[:, None] * V[np.maximum(self.corners[:, k], 0)]
            for k in used
        )
        lines = (points[1:] - points[:-1])[np.flatnonzero(self._lines()[1])]
        return ((lines**2).sum(-1) ** 0.5).sum()

    def derivative(self) -> Tuple[Array, Array]:
        """How its length changes when vertices move: exact, as the derivative of the distance
        wherever there is a single shortest path.

        Points on edges need not be followed: where the path crosses an edge it is shortest, so that
        moving the crossing changes nothing. What counts is how the edge moves below it.

        Returns
        -------
        vertices : ndarray of int64, shape (k,)
            Those on which the path depends, ascending.
        rows : ndarray of float64, shape (k, 3)
            The derivative of the length with respect to the position of each.
        """
        line, length = self._lines()
        straight = np.divide(line, length[:, None], out=np.zeros_like(line), where=length[:, None] > 0)
        pull = np.zeros((len(self), 3))
        pull[:-1] -= straight
        pull[1:] += straight
        used = self.barycentric != 0
        vertices, place = np.unique(self.corners[used], return_inverse=True)
        rows = np.zeros((len(vertices), 3))
        np.add.at(rows, place, (self.barycentric[:, :, None] * pull[:, None, :])[used])
        return vertices, rows

    def _lines(self) -> Tuple[Array, Array]:
        """From each point to the next, and how long that is."""
        if self.points is None or np.any(self.corners[:, 0] < 0):
            raise UsageError("the length of this path is no function of positions of vertices")
        line = np.diff(self.points, axis=0)
        return line, np.linalg.norm(line, axis=1)

    def __repr__(self) -> str:
        if not len(self):
            return "plexway.Path(unreachable)"
        return f"plexway.Path({_counted(len(self), 'point')}, length {self.length:.6g})"


def _counted(count: int, name: str) -> str:
    return f"{count} {name}{'' if count == 1 else 's'}"


class Points:
    """Points of a domain.

    Attributes
    ----------
    vertices : ndarray of int64, shape (k,)
        Which vertex each one is; -1 for a point of a simplex.
    simplices : ndarray of int64, shape (k,)
        The simplex that each lies in; -1 for a vertex.
    barycentric : ndarray of float64, shape (k, 4)
        Its coordinates there.

    ``points[i]`` and iteration give `Vertex` or `Point`, which are sources.
    """

    def __init__(self, domain: Domain, native: List[Any]) -> None:
        self._domain = domain
        self._native = native
        self.vertices = np.array([-1 if p.vertex is None else p.vertex for p in native], np.int64)
        self.simplices = np.array([-1 if p.simplex is None else p.simplex for p in native], np.int64)
        self.barycentric = np.array([p.barycentric for p in native], float).reshape(-1, 4)

    @property
    def positions(self) -> Array:
        """Where they are: float64, shape (k, 3)."""
        return np.array(
            [self._domain._native.position(p) for p in self._native], float
        ).reshape(-1, 3)

    def __len__(self) -> int:
        return len(self._native)

    def __getitem__(self, i: int) -> Union[Vertex, Point]:
        if self.vertices[i] >= 0:
            return Vertex(int(self.vertices[i]))
        return Point(int(self.simplices[i]), tuple(self.barycentric[i].tolist()))

    def __iter__(self) -> Iterator[Union[Vertex, Point]]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"plexway.Points({len(self)})"

    def __reduce__(self) -> Tuple[Any, ...]:
        return _restored_points, (self._domain, list(self))


def _restored_points(domain: Domain, points: List[Any]) -> Points:
    return Points(domain, [place(domain, point) for point in points])


@dataclass(frozen=True, eq=False, repr=False)
class Disks:
    """Points none of which is nearer to another than the radius.

    Attributes
    ----------
    points : Points
        In the order in which they were thrown.
    radius : float
        What was requested, or found for the count.
    maximal : bool
        No room is left for another.
    """

    points: Points
    radius: float
    maximal: bool

    def __repr__(self) -> str:
        room = "" if self.maximal else ", with room left"
        return f"plexway.Disks({_counted(len(self.points), 'point')}, radius {self.radius:.6g}{room})"


@dataclass(frozen=True, eq=False, repr=False)
class FarthestPoints:
    """Points each of which was the farthest from those before.

    Attributes
    ----------
    points : Points
        Those it started from first.
    distance : ndarray of float64, shape (k,)
        How far each was from those before it; 0 for those given, ``inf`` for the first of a part
        that none of them reaches.
    covering : float
        No vertex is farther from the points.
    """

    points: Points
    distance: Array
    covering: float

    def __repr__(self) -> str:
        count = _counted(len(self.points), "point")
        return f"plexway.FarthestPoints({count}, covering {self.covering:.6g})"


@dataclass(frozen=True, eq=False, repr=False)
class Cells:
    """A centroidal Voronoi tessellation.

    Attributes
    ----------
    seeds : Points
    label : ndarray of int32
        The nearest seed of the centre of each simplex, of a cloud of each point; -1 if unreached.
    content : ndarray of float64, shape (k,)
        Area or volume of each seed's cell.
    energy : ndarray of float64
        The integral of the squared distance from the nearest seed, before each iteration and at
        the end.
    converged : bool
    """

    seeds: Points
    label: Array
    content: Array
    energy: Array
    converged: bool

    def __repr__(self) -> str:
        end = "converged" if self.converged else "not converged"
        return f"plexway.Cells({_counted(len(self.seeds), 'seed')}, {end})"


@dataclass(frozen=True, eq=False, repr=False)
class Isosurfaces:
    """Triangles in a solid where a field has given values.

    Attributes
    ----------
    positions : ndarray of float64, shape (n, 3)
    triangles : ndarray of uint32, shape (m, 3)
    value : ndarray of uint32, shape (n,)
        Of each vertex, the place of its value in the list of values.
    """

    positions: Array
    triangles: Array
    value: Array

    def __repr__(self) -> str:
        return f"plexway.Isosurfaces({_counted(len(self.triangles), 'triangle')})"


class Field:
    """A distance field that is kept: it traces paths, and evaluates the distance of any point.

    Made by `Domain.field`. Any number of threads may use it at once.
    """

    def __init__(self, domain: Domain, native: Any, owner: Optional[Array] = None) -> None:
        self._domain = domain
        self._native = native
        self._owner = owner  # of each point of the field: which source it is of

    @property
    def domain(self) -> Domain:
        """The domain that it lies on."""
        return self._domain

    @property
    def distance(self) -> Array:
        """One distance a vertex, shape (n,); not a copy, and read only."""
        array: Array = self._native.distance
        return array

    @property
    def notes(self) -> Tuple[str, ...]:
        """What to know of its distances, a sentence each: where they may be far off and what to do,
        which vertices are not reached and why; those of the domain first. What says that they may be
        wrong was an `AccuracyWarning` when the field was made, or the domain."""
        found: Tuple[str, ...] = self._native.notes
        return found

    def path(self, start: Place, *, margin: Optional[float] = None) -> Path:
        """The shortest path from `start` back to the nearest source.

        Parameters
        ----------
        start : Place
            A vertex, a point in space (the closest of the domain is taken), or a `Point`.
        margin : float, optional
            On a surface or a cloud: the path is the shortest of all if nowhere near it the field is
            too long by more than this share. If not given, 0.003 on clouds and after the accuracy
            'fast'; else the path is the one that distances were found by. 0: not looked for, some
            ten times faster, locally shortest. Refused on other domains.

        Returns
        -------
        Path
        """
        found = Path(*self._native.trace(only_place(self._domain, start), margin))
        if self._owner is not None and found.source >= 0:
            found = replace(found, source=int(self._owner[found.source]))
        return found

    def paths(self, starts: Any, *, margin: Optional[float] = None) -> List[Path]:
        """The shortest paths from many places, in their order.

        Parameters
        ----------
        starts
            Vertices, points (k, 3), truth values, or a list of places.
        margin : float, optional
            As in `path`.
        """
        native = located(self._domain, starts, none_is_well=True)
        return [self.path(start, margin=margin) for start in native]

    @property
    def label(self) -> Array:
        """The place of the nearest source of each vertex in the list: int32, shape (n,); -1 where
        none is reached."""
        found: Array = self._native.label()
        if self._owner is None:
            return found
        return np.append(self._owner, -1).astype(np.int32)[found]

    def predecessors(self) -> Array:
        """On a wireframe: the vertex before each on the shortest path from its source, as
        `scipy.sparse.csgraph.dijkstra` has them.

        Returns
        -------
        ndarray of int32, shape (n,)
            -9999 at sources, next to a source inside an edge, and where none is reached.
        """
        if self._domain.kind != "wireframe":
            raise UsageError("predecessors exist on wireframes: on other domains take a path")
        native, d = self._domain._native, self.distance.astype(float)
        found = np.full(len(d), -9999, np.int32)
        left = np.isfinite(d)
        if native.mask is None:
            edges = native.all_simplices.astype(np.int64)
            size = native.measured if native.measured is not None else native.lengths
            if size is None:
                size = np.linalg.norm(np.diff(native.positions[edges], axis=1)[:, 0], axis=1)
            before, after = np.concatenate([edges, edges[:, ::-1]]).T
            ways = d[before] + np.tile(size, 2)
            good = (d[before] < d[after]) & (
                ways <= d[after] * (1 + 8 * np.finfo(self.distance.dtype).eps)
            )
            order = np.flatnonzero(good)[np.argsort(-ways[good], kind="stable")]
            found[after[order]] = before[order]  # the shortest comes last
            left &= found < 0
        for vertex in np.flatnonzero(left).tolist():  # sources, and along edges without length
            way = self.path(vertex).vertices
            found[vertex] = way[1] if len(way) > 1 else -9999
        found[found < 0] = -9999
        return found

    def derivative(self, start: Place) -> Any:
        """How the distance of `start` changes when vertices move: exact where there is a single
        shortest path, with sources and `start` at rest on the simplices that they are in.

        Parameters
        ----------
        start : Place

        Returns
        -------
        scipy.sparse.csr_matrix, shape (1, 3 n)
            Three columns a vertex. Needs SciPy; `Path.derivative` does without.
        """
        if self._domain._native.measured is not None:
            raise UsageError("by a metric a distance is no function of positions alone")
        vertices, rows = self.path(start).derivative()
        columns = (3 * vertices[:, None] + np.arange(3)).ravel()
        shape = (1, 3 * self._domain.vertex_count)
        return scipy_sparse().csr_matrix((rows.ravel(), columns, [0, len(columns)]), shape=shape)

    def at(self, points: ArrayLike, *, level: str = "neighbours") -> Array:
        """Distances of any points of the domain.

        Parameters
        ----------
        points : array_like, shape (k, 3), or a list of places
            Points in space (the closest of the domain are taken), vertices, `Point`.
        level : {'neighbours', 'linear', 'simplex', 'star'}
            'linear' interpolates between the corners, the others evaluate virtual sources.

        Returns
        -------
        ndarray of float64, shape (k,)
        """
        found: Array = self._native.at(located(self._domain, points, none_is_well=True), level)
        return found

    def gradient(self) -> Array:
        """The direction away from the source at the centre of each triangle or tetrahedron.

        Returns
        -------
        ndarray of float64, shape (m, 3)
            Of length 1; 0 where it is not reached, or the source is there.
        """
        directions: Array = self._native.gradient()
        return directions

    def _repr_html_(self) -> Optional[str]:
        return self._domain._shown(self.distance)

    def __repr__(self) -> str:
        return f"plexway.Field(on {self._domain!r})"

    def __reduce__(self) -> Tuple[Any, ...]:
        raise TypeError("a Field is not pickled: send the domain, and make it there by `field`")


class Picture(Array):
    """A picture: ndarray of uint8, shape (height, width, 4), rows from the top; red, green, blue,
    alpha. Notebooks show it."""

    def _repr_png_(self) -> Optional[bytes]:
        if self.ndim != 3 or self.shape[2] != 4 or self.dtype != np.uint8:
            return None
        return self.png()

    def png(self) -> bytes:
        """The bytes of a PNG file."""
        height, width = self.shape[:2]
        rows = np.zeros((height, 1 + 4 * width), np.uint8)
        rows[:, 1:] = np.asarray(self).reshape(height, 4 * width)

        def chunk(name: bytes, data: bytes) -> bytes:
            body = name + data
            return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

        head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
        return (
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", head)
            + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6))
            + chunk(b"IEND", b"")
        )

    def save(self, file: Any) -> None:
        """Writes a PNG file."""
        with open(file, "wb") as out:
            out.write(self.png())
