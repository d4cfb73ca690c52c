"""The kinds of domains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _plexway
from ._arrays import Array, plain, real, whole
from ._domain import AccuracyLike, Domain, _restored
from ._geodesics import places_of, shortened, traced
from ._interop import arrays_of, looks_like_mesh
from ._metrics import described
from ._progress import Progress, ProgressLike
from ._results import Path
from ._sides import inside as which_inside
from ._sources import _GivenCurve
from ._warnings import warn

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._sources import Place


_USUAL = {"precision": "single", "triangulation": "auto"}


def _options_of(
    precision: str, triangulation: str, metric: Any, report: Any, mask: Any = None
) -> Dict[str, Any]:
    for name, value in (("precision", precision), ("triangulation", triangulation)):
        if not isinstance(value, str):
            raise TypeError(f"{name}: expected a name such as {_USUAL[name]!r}, got {value!r:.40}")
    return {
        "precision": precision,
        "triangulation": triangulation,
        "metric": described(metric),
        "mask": mask if mask is None or isinstance(mask, str) else np.asarray(mask),
        "progress": report,
    }


class _OfSimplices(Domain):
    """A surface, a solid or a wireframe."""

    _kind = ""
    _cells = ""
    _corners = 0

    def _build(
        self,
        V: Any,
        rows: Any,
        lengths: Any,
        vertices: Optional[int],
        metric: Any,
        mask: Any,
        merge: Optional[float],
        precision: str,
        triangulation: str,
        progress: ProgressLike,
    ) -> None:
        name = type(self).__name__
        if rows is None and looks_like_mesh(V):
            V, cells = arrays_of(V)
            rows = cells.get(self._cells)
            if rows is None:
                raise _plexway.InputError(f"{name}: the mesh has no {self._cells}")
        if rows is None:
            raise TypeError(f"{name}: expected positions and {self._cells}, or a mesh")
        if (V is None) == (lengths is None):
            raise TypeError(f"{name}: give positions, or lengths in their place")
        rows = plain(rows, self._cells)
        if rows.ndim != 2 or rows.shape[1] != self._corners:
            raise ValueError(
                f"{self._cells}: expected shape (m, {self._corners}), got {rows.shape}"
                + _hint(rows, self._corners)
            )
        if V is not None:
            V = plain(V, "V")
            vertices = len(V) if V.ndim else 0
        elif vertices is None:
            vertices = int(rows.max()) + 1 if rows.size else 0
        with Progress(progress, "building") as report:
            options = _options_of(precision, triangulation, metric, report, mask)
            self._native = _plexway.from_arrays(
                self._kind,
                V,
                vertices,
                rows,
                lengths,
                merge=None if merge is None else real(merge, "merge"),
                **options,
            )
        warn(self._native.doubts)


def _hint(rows: Array, corners: int) -> str:
    """What to write instead, for faces as other packages have them."""
    if corners != 3 or rows.dtype.kind not in "iu" or not rows.size:
        return ""
    if rows.ndim == 1 and rows.size % 4 == 0 and np.all(rows[::4] == 3):
        return ": a count before each triangle, as VTK has them: F.reshape(-1, 4)[:, 1:]"
    if rows.ndim == 2 and rows.shape[1] == 4:
        if np.all(rows[:, 0] == 3):
            return ": the first column counts corners: F[:, 1:]"
        return ": quads are two triangles each: np.vstack((F[:, [0, 1, 2]], F[:, [0, 2, 3]]))"
    return ""


class Surface(_OfSimplices):
    """Triangles: with positions in the plane or in space, or by the lengths of their edges alone.

    Parameters
    ----------
    V : array_like of float, shape (n, 3) or (n, 2)
        Positions, of any number type, in C or Fortran order. Or a mesh of trimesh, Open3D, meshio,
        pyvista or VTK; then leave `F` out.
    F : array_like of int, shape (m, 3)
        Triangles by vertices, counted from 0. Edges with more than two triangles, boundaries and
        several parts are welcome.
    lengths : array_like of float, shape (m, 3), optional
        In the place of `V`: lengths of the edges (0,1), (1,2), (2,0) of each triangle.
    vertices : int, optional
        With `lengths`: how many vertices there are.
    metric : optional
        `SimplexSpeeds` (these with `lengths`, too), `VertexSpeeds`, `SimplexTensors`,
        `VertexTensors`, `EdgeLengths`, or a function from a point to a symmetric 3 x 3 matrix.
    mask : array_like of bool, shape (m,) or (n,), or str, optional
        Triangles that are left; or vertices, then triangles all of whose corners are. Or labels
        that are left out, 'FILE:3,7', of a file that gives each vertex one (see `read_labels`); or
        numbers in a file, 'vertices:FILE' and 'simplices:FILE'. Numbers of vertices and triangles
        stay, and a metric measures all of them.
    merge : float, optional
        Vertices no farther apart than this are one: the sides of a seam, or triangles with corners
        of their own. All keep their numbers and get their distances; 0 joins those at one place.
    precision : {'single', 'double'}
    triangulation : {'auto', 'input', 'delaunay', 'refined'}
        Which triangles over the same surface distances are found on.
    progress : bool or callable, optional

    Raises
    ------
    InputError
        For a vertex out of range or a position that is not finite.
    ValueError
        For an array of a wrong shape or type.
    """

    _kind, _cells, _corners = "surface", "triangles", 3

    def __init__(
        self,
        V: Any = None,
        F: Optional[ArrayLike] = None,
        *,
        lengths: Optional[ArrayLike] = None,
        vertices: Optional[int] = None,
        metric: Any = None,
        mask: Union[None, str, ArrayLike] = None,
        merge: Optional[float] = None,
        precision: str = "single",
        triangulation: str = "auto",
        progress: ProgressLike = None,
    ) -> None:
        self._build(V, F, lengths, vertices, metric, mask, merge, precision, triangulation, progress)

    _across: Optional[Array] = None  # kept by `trace`

    def trace(self, start: Place, direction: ArrayLike, length: float) -> Path:
        """Straight ahead, whatever else may be nearer: the straightest geodesic. Where it meets a
        vertex it leaves as much angle to its left as to its right.

        Parameters
        ----------
        start : Place
        direction : array_like of float, shape (3,)
            In space, of any length: what of it lies in the surface.
        length : float
            How far.

        Returns
        -------
        Path
            From the start; shorter than `length` where it meets the boundary.
        """
        return traced(self, start, direction, length)

    def shorten(self, path: Any, *, closed: bool = False) -> Path:
        """Pulls a path tight as a rubber band: the locally shortest one that it can be moved to on
        the surface, so that what leads around a handle or a hole still does.

        Parameters
        ----------
        path : Path, or sequence of Place
            Places are joined by shortest paths first.
        closed : bool
            The ends, which must be at one place, may move: a closed geodesic, or a point.

        Returns
        -------
        Path
        """
        return shortened(self, path, closed)

    def signed_distance(
        self, curve: Any, *, inside: Optional[Place] = None, accuracy: AccuracyLike = None
    ) -> Array:
        """The distance of every vertex from closed curves, negative inside of them. Needs SciPy.

        Parameters
        ----------
        curve : Path, list of Path, Polyline or sequence of Place
            Isolines are paths; places are joined by shortest paths, the last and the first as well.
        inside : Place, optional
            A place on the inner side; without, that is the one with less area.
        accuracy
            As in `distance`.

        Returns
        -------
        ndarray of float64, shape (n,)
        """
        several = isinstance(curve, (list, tuple)) and all(isinstance(c, Path) for c in curve)
        curves = [places_of(self, c, True) for c in (curve if several else [curve])]
        lines = [_GivenCurve(*c) for c in curves]
        distance = self.distance(lines, accuracy=accuracy).astype(float)
        inner = which_inside(self, curves, inside)
        return np.where(inner, -distance, distance)


class Solid(_OfSimplices):
    """Tetrahedra.

    Parameters
    ----------
    V : array_like of float, shape (n, 3)
        Or a mesh, as in `Surface`.
    T : array_like of int, shape (m, 4)
    lengths : array_like of float, shape (m, 6), optional
        In the place of `V`: of the edges (0,1), (0,2), (1,2), (0,3), (1,3), (2,3).
    vertices, metric, mask, merge, precision, progress
        As in `Surface`.
    """

    _kind, _cells, _corners = "solid", "tets", 4

    def __init__(
        self,
        V: Any = None,
        T: Optional[ArrayLike] = None,
        *,
        lengths: Optional[ArrayLike] = None,
        vertices: Optional[int] = None,
        metric: Any = None,
        mask: Union[None, str, ArrayLike] = None,
        merge: Optional[float] = None,
        precision: str = "single",
        progress: ProgressLike = None,
    ) -> None:
        self._build(V, T, lengths, vertices, metric, mask, merge, precision, "auto", progress)


class Wireframe(_OfSimplices):
    """Edges: distances along them, as by Dijkstra's algorithm, and from points inside edges. They lead
    both ways: for directed graphs there is `scipy.sparse.csgraph.dijkstra`.

    Parameters
    ----------
    V : array_like of float, shape (n, 3) or (n, 2)
        Or a mesh, as in `Surface`; or alone a symmetric sparse matrix of SciPy, the lengths of edges.
    E : array_like of int, shape (m, 2)
    lengths : array_like of float, shape (m,), optional
        In the place of `V`.
    vertices, metric, mask, merge, precision, progress
        As in `Surface`.
    """

    _kind, _cells, _corners = "wireframe", "edges", 2

    def __init__(
        self,
        V: Any = None,
        E: Optional[ArrayLike] = None,
        *,
        lengths: Optional[ArrayLike] = None,
        vertices: Optional[int] = None,
        metric: Any = None,
        mask: Union[None, str, ArrayLike] = None,
        merge: Optional[float] = None,
        precision: str = "single",
        progress: ProgressLike = None,
    ) -> None:
        if hasattr(V, "tocoo") and E is None:
            V, E, lengths, vertices = None, *_edges_of(V)
        self._build(V, E, lengths, vertices, metric, mask, merge, precision, "auto", progress)


def _edges_of(graph: Any) -> Tuple[Array, Array, int]:
    """Edges, their lengths and how many vertices there are, of a matrix of SciPy."""
    if graph.shape[0] != graph.shape[1]:
        raise ValueError(f"Wireframe: expected a square matrix, got shape {graph.shape}")
    if (graph != graph.T).nnz:
        raise _plexway.UsageError(
            "the matrix is not symmetric: for directed graphs take scipy.sparse.csgraph.dijkstra; if "
            "edges lead both ways, give graph.maximum(graph.T)"
        )
    upper = graph.tocoo()
    once = upper.row <= upper.col
    edges = np.stack([upper.row[once], upper.col[once]], axis=1)
    return edges, upper.data[once].astype(float), graph.shape[0]


class Cloud(Domain):
    """Points of a surface, without triangles.

    Parameters
    ----------
    V : array_like of float, shape (n, 3)
        Or a cloud of trimesh, Open3D, pyvista or VTK.
    normals : array_like of float, shape (n, 3), optional
        Outward; not necessarily of length 1.
    k : int, optional
        Neighbours of each point; 16, or all within the radius.
    neighbour_radius : float, optional
        No neighbour is farther.
    max_normal_angle : float, optional
        In degrees: no neighbour's normal differs by more.
    smooth : bool
        Measure along a smooth surface near the points: against noise, but not beside thin walls.
    voxel : float, optional
        Thin to one point for each cube of this side. Numbers then count what is left.
    denoise : bool
        Drop points that lie alone first. Numbers then count what is left.
    precision : {'single', 'double'}
    progress : bool or callable, optional

    Raises
    ------
    NotBuilt
        In a build without FLANN; `voxel` and `denoise` take PCL.
    """

    def __init__(
        self,
        V: Any,
        *,
        normals: Optional[ArrayLike] = None,
        k: Optional[int] = None,
        neighbour_radius: Optional[float] = None,
        max_normal_angle: Optional[float] = None,
        smooth: bool = False,
        voxel: Optional[float] = None,
        denoise: bool = False,
        precision: str = "single",
        progress: ProgressLike = None,
    ) -> None:
        if looks_like_mesh(V):
            V, _ = arrays_of(V)
        def number(value: Any, name: str) -> Optional[float]:
            return None if value is None else real(value, name)

        self._neighbours = {
            "k": None if k is None else whole(k, "k", 1),
            "neighbour_radius": number(neighbour_radius, "neighbour_radius"),
            "max_normal_angle": number(max_normal_angle, "max_normal_angle"),
            "smooth": bool(smooth),
        }
        voxel = number(voxel, "voxel")
        with Progress(progress, "building") as report:
            self._native = _plexway.from_points(
                plain(V, "V"),
                normals,
                None,
                **self._neighbours,
                voxel=voxel,
                denoise=bool(denoise),
                **_options_of(precision, "auto", None, report),
            )
        warn(self._native.doubts)

    _neighbours: Dict[str, Any] = {}

    @property
    def original(self) -> Optional[Array]:
        """The number of each point among those given or in the file: uint32, shape (n,); None where
        all are there, or points are means of several."""
        original: Optional[Array] = self._native.cloud["original"]
        return original

    def _recipe(self) -> Tuple[str, Tuple[Any, ...], Dict[str, Any]]:
        native = self._native
        cloud = native.cloud
        arrays = (np.array(native.positions), cloud["normals"], cloud["original"])
        copies = tuple(None if a is None else np.array(a) for a in arrays)
        return "from_points", copies, {**self._neighbours, **self._options()}

    def __reduce__(self) -> Tuple[Any, ...]:
        return _restored_cloud, (self._recipe(), self._neighbours)


def _restored_cloud(recipe: Any, neighbours: Dict[str, Any]) -> Domain:
    made = _restored("Cloud", recipe)
    assert isinstance(made, Cloud)
    made._neighbours = neighbours
    return made


class Simplicial(Domain):
    """Simplices of one dimension, 1 to 4, with any number of coordinates or of intrinsic lengths: a
    robot's states in space and time, for instance.

    Parameters
    ----------
    V : array_like of float, shape (n, axes)
    S : array_like of int, shape (m, dimension + 1)
    lengths : array_like of float, shape (m, dimension (dimension + 1) / 2), optional
        In the place of `V`: lengths of the edges (0,1), (0,2), (1,2), (0,3), ... of each.
    vertices : int, optional
        With `lengths`: how many vertices there are.
    mask, precision, progress
        As in `Surface`.
    """

    def __init__(
        self,
        V: Optional[ArrayLike] = None,
        S: Optional[ArrayLike] = None,
        *,
        lengths: Optional[ArrayLike] = None,
        vertices: Optional[int] = None,
        mask: Union[None, str, ArrayLike] = None,
        precision: str = "single",
        progress: ProgressLike = None,
    ) -> None:
        rows = plain(S, "S")
        if S is None or (V is None) == (lengths is None):
            raise TypeError("Simplicial: give simplices, and positions or lengths")
        if rows.ndim != 2 or not 2 <= rows.shape[1] <= 5:
            raise ValueError(f"S: expected shape (m, 2) to (m, 5), got {rows.shape}")
        axes = 0
        dimension = rows.shape[1] - 1
        if V is not None:
            V = plain(V, "V")
            if V.ndim != 2:
                raise ValueError(f"V: expected shape (n, axes), got {V.shape}")
            vertices, axes = V.shape
        else:
            measured = np.asarray(lengths)
            wanted = (len(rows), dimension * (dimension + 1) // 2)
            if measured.shape != wanted:
                raise ValueError(f"lengths: expected shape {wanted}, got {measured.shape}")
            if vertices is None:
                vertices = int(rows.max()) + 1 if rows.size else 0
        with Progress(progress, "building") as report:
            self._native = _plexway.from_simplices(
                V,
                vertices,
                rows,
                dimension,
                axes,
                lengths,
                **_options_of(precision, "auto", None, report, mask),
            )
        warn(self._native.doubts)

    def _recipe(self) -> Tuple[str, Tuple[Any, ...], Dict[str, Any]]:
        native = self._native
        positions, lengths = native.positions, native.lengths
        axes = 0 if positions is None else positions.shape[1]
        simplices = np.array(native.all_simplices)
        return (
            "from_simplices",
            (
                None if positions is None else np.array(positions),
                native.vertex_count,
                simplices,
                simplices.shape[1] - 1,
                axes,
                None if lengths is None else np.array(lengths),
            ),
            self._options(),
        )


class Mixed(Domain):
    """Parts of different dimension that share vertices: a sheet on a block, wires between.

    Parameters
    ----------
    parts : sequence
        Each a `Surface`, `Solid` or `Wireframe` with positions, or a tuple (V, F), (V, T), (V, E)
        by the number of corners. Vertices are numbered through, part after part.
    tolerance : float
        Vertices of two parts are one if they are this close; 0: in the same place.
    metric : SimplexSpeeds, optional
        A speed for each simplex, part after part, of at most 64 different ones: paths are refracted
        where it changes.
    precision, progress
        As in `Surface`.
    """

    def __init__(
        self,
        parts: Sequence[Any],
        *,
        tolerance: float = 0.0,
        metric: Any = None,
        precision: str = "single",
        progress: ProgressLike = None,
    ) -> None:
        made: List[Tuple[Any, Any, Any, Any]] = []
        if len(parts) == 0:
            raise ValueError("Mixed: expected at least one part")
        for part in parts:
            if isinstance(part, Domain):
                if part.vertices is None or part.simplices is None:
                    raise ValueError(f"Mixed: {part!r} has no positions")
                if part._native.measured is not None:
                    raise ValueError(
                        f"Mixed: {part!r} has a metric of its own: give speeds to the whole"
                    )
                V, rows = part.vertices, part.simplices
            else:
                if not isinstance(part, (tuple, list)) or len(part) != 2:
                    raise ValueError(
                        "Mixed: a part is a Surface, a Solid, a Wireframe, or positions and "
                        f"simplices, got {type(part).__name__}"
                    )
                V, rows = part
                rows = plain(rows, "simplices")
            if rows.ndim != 2 or rows.shape[1] not in (2, 3, 4):
                raise ValueError(f"Mixed: expected simplices (m, 2), (m, 3) or (m, 4), got {rows.shape}")
            edges, triangles, tets = (
                rows if c == rows.shape[1] else np.zeros((0, c), np.int64) for c in (2, 3, 4)
            )
            made.append((V, edges, triangles, tets))
        with Progress(progress, "building") as report:
            self._native = _plexway.from_parts(
                made, real(tolerance, "tolerance"), **_options_of(precision, "auto", metric, report)
            )
        warn(self._native.doubts)

    def _recipe(self) -> Tuple[str, Tuple[Any, ...], Dict[str, Any]]:
        return "from_parts", tuple(self._native.parts), self._options()
