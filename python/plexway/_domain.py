"""What all domains have in common: distances, paths, matrices, samples, pictures."""

from __future__ import annotations

import base64
import os
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple, Type, Union

import numpy as np

from . import _plexway
from ._arrays import Array, real, scipy_sparse, whole
from ._progress import Progress, ProgressLike
from ._results import (
    Cells,
    Disks,
    FarthestPoints,
    Field,
    Isosurfaces,
    Path,
    Picture,
    Points,
)
from ._sources import columns_of, index, located, only_place, open_sources, place
from ._warnings import warn

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._sources import Place

AccuracyLike = Union[None, str, float]

_INFINITY = float("inf")
_DEFAULT = _plexway.SolveArguments("serial", 0, _INFINITY, "saddles", None)


def _arguments(
    threads: Optional[int],
    executor: Optional[str],
    radius: float,
    visibility: str,
    accuracy: AccuracyLike,
    many: bool = False,
) -> Any:
    """How to solve. Several fields take all threads unless `threads` limits them; one takes one."""
    if threads is not None:
        threads = whole(threads, "threads", 0)
    if accuracy is not None and not isinstance(accuracy, str):
        accuracy = real(accuracy, "accuracy")
    if executor is None:
        if threads is None:
            executor = "openmp" if many and _plexway.openmp_built() else "serial"
        else:
            executor = "serial" if threads == 1 else "openmp"
    reach = real(radius, "radius")
    return _plexway.SolveArguments(executor, threads or 0, reach, visibility, accuracy)


_CLASSES: Dict[str, Type["Domain"]] = {}


class Domain:
    """A space with distances: the base of `Surface`, `Solid`, `Wireframe`, `Cloud`,
    `Mixed` and `Simplicial`.

    Domains do not change, may be used by any number of threads at once, and can be pickled.
    Vertices and simplices are counted from 0, as given. Distances are in the unit of the positions.
    """

    _native: Any
    _diagonal: Optional[float] = None

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        _CLASSES[cls.__name__] = cls

    def __init__(self) -> None:
        raise TypeError("make a Surface, Solid, Wireframe, Cloud, Mixed or Simplicial")

    # -- What it is.

    @property
    def kind(self) -> str:
        """'surface', 'solid', 'wireframe', 'simplices', 'cloud' or 'mixed'."""
        kind: str = self._native.kind
        return kind

    @property
    def vertex_count(self) -> int:
        """How many vertices there are."""
        count: int = self._native.vertex_count
        return count

    @property
    def vertices(self) -> Optional[Array]:
        """Positions: float64, shape (n, axes), read only and no copy; None where there are only
        lengths."""
        positions: Optional[Array] = self._native.positions
        return positions

    @property
    def simplices(self) -> Optional[Array]:
        """Vertices of each simplex: uint32, shape (m, corners), read only and no copy; with a mask
        those that are left, and of merged vertices the first; None for clouds and mixed domains."""
        simplices: Optional[Array] = self._native.simplices
        return simplices

    @property
    def components(self) -> int:
        """The number of parts that no path connects."""
        count: int = self._native.components
        return count

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of its distances: float32, or float64 with precision='double'."""
        return np.dtype(np.float64 if self._native.double else np.float32)

    @property
    def notes(self) -> Tuple[str, ...]:
        """What to know of all its distances, a sentence each: where they may be far off and what to
        do, which points count as others. What says that they may be wrong was an `AccuracyWarning`
        when the domain was made."""
        found: Tuple[str, ...] = self._native.notes
        return found

    def info(self) -> Dict[str, Any]:
        """Counts, sizes and how it was built.

        Returns
        -------
        dict
            kind, dimension, vertices, simplices, components, precision, bytes (held beside the
            positions), build_seconds, and where they mean something: file, bounds, mean_edge,
            triangulation, refracting_edges, violations (simplices whose lengths no flat one has),
            cloud; and dropped_simplices (with a vertex twice: domains are built without) and
            merged_vertices (which are one with an earlier one), of files
            also split_polygons and split_cells, cut into triangles and tetrahedra, and passed_over.
        """
        native = self._native
        found: Dict[str, Any] = {
            "kind": self.kind,
            "dimension": native.dimension,
            "vertices": native.vertex_count,
            "simplices": native.simplex_count,
            "components": native.components,
            "precision": "double" if native.double else "single",
            "bytes": native.bytes,
            "build_seconds": native.build_seconds,
            **native.file_report,
        }
        if native.file:
            found["file"] = native.file
        positions = self.vertices
        if positions is not None and len(positions):
            found["bounds"] = (positions.min(axis=0), positions.max(axis=0))
        if self.kind == "surface":
            found["mean_edge"] = native.mean_edge
            found["triangulation"] = native.triangulation
            found["refracting_edges"] = native.refracting_edges
        if self.kind in ("surface", "solid"):
            found["violations"] = native.violations[0]
        if native.cloud is not None:
            found["cloud"] = {
                k: v for k, v in native.cloud.items() if k not in ("normals", "original")
            }
        return found

    def __repr__(self) -> str:
        def counted(count: int, name: str) -> str:
            one = {"vertices": "vertex", "tetrahedra": "tetrahedron", "simplices": "simplex"}
            return f"{count} {one.get(name, name.rstrip('s')) if count == 1 else name}"

        native = self._native
        sizes = [counted(native.vertex_count, "points" if self.kind == "cloud" else "vertices")]
        if self.kind != "cloud":
            sizes.append(counted(native.simplex_count, native.simplex_name))
        return f"plexway.{type(self).__name__}({', '.join(sizes)})"

    def _repr_html_(self) -> Optional[str]:
        return self._shown(None)

    def _shown(self, distance: Optional[ArrayLike]) -> Optional[str]:
        """A small picture over what it is, for notebooks; None where none can be drawn."""
        try:
            png = self.picture(distance, size=(480, 360), transparent=True).png()
        except _plexway.Error:
            return None
        image = base64.b64encode(png).decode()
        return f'<img src="data:image/png;base64,{image}" width="480"><br><code>{self!r}</code>'

    # -- Distances.

    def distance(
        self,
        source: Any,
        *,
        accuracy: AccuracyLike = None,
        radius: float = _INFINITY,
        threads: Optional[int] = None,
        executor: Optional[str] = None,
        visibility: str = "saddles",
        out: Optional[Array] = None,
        progress: ProgressLike = None,
    ) -> Array:
        """The distance of every vertex from the nearest source.

        Parameters
        ----------
        source
            A vertex (int), vertices (integers), a point (three floats), points (k, 3), or one or a
            list of `Vertex`, `Point`, `Vertices`, `Segment`, `Polyline`, `Ball`, `WholeSimplex`,
            `Boundary`.
        accuracy : {'fast', 'accurate', 'exact'} or float, optional
            On surfaces, clouds and solids, how near to the exact distances: 'fast' has mean relative
            errors around 1e-3, 'accurate' below 1e-4, 'exact' (in double precision, not of solids)
            none but rounding; a number is the mean error to expect. None: 'accurate' where it is
            supported, else 'fast'.
        radius : float
            Go no farther: what is beyond is at ``inf``.
        threads : int, optional
            1 by default, which is fastest for all but the largest domains; 0: all.
        executor : {'serial', 'openmp', 'gl'}, optional
            'gl' is a graphics processor, in single precision.
        visibility : {'saddles', 'centroid', 'upper_bound'}
            The rule; 'upper_bound' is never below the exact distance.
        out : ndarray, shape (n,), optional
            Where to put the distances.
        progress : bool or callable, optional
            True draws a bar; a function is called with the share that is done.

        Returns
        -------
        ndarray, shape (n,)
            float32, or float64 from a domain of precision 'double' and where 'exact', or lines and
            triangles with 'fast', need it. ``inf`` at vertices that are not reached.

        Notes
        -----
        The interpreter is free meanwhile, and Ctrl-C ends the work. Where distances may be wrong by
        more than the accuracy promises there is an `AccuracyWarning`; `Field.notes` has all that
        is known.
        """
        if type(source) is int and radius == _INFINITY and threads is None and progress is None:
            if executor is None and visibility == "saddles" and accuracy is None:
                vertex = _plexway.Point(index(source, self._native.vertex_count, "vertex"), 0.0)
                self._native.require_open([vertex])
                found, _, _, doubts = _plexway.solve(
                    self._native, [vertex], _DEFAULT, False, False, None
                )
                warn(doubts, self)
                return found if out is None else _into(out, found)
        arguments = _arguments(threads, executor, radius, visibility, accuracy)
        sources = open_sources(self, source)
        with Progress(progress, "solving") as report:
            found, _, _, doubts = _plexway.solve(
                self._native, sources, arguments, False, False, report
            )
        warn(doubts, self)
        return found if out is None else _into(out, found)

    def nearest(
        self,
        sources: Any,
        *,
        accuracy: AccuracyLike = None,
        radius: float = _INFINITY,
        threads: Optional[int] = None,
        executor: Optional[str] = None,
        visibility: str = "saddles",
        progress: ProgressLike = None,
    ) -> Tuple[Array, Array]:
        """The distance of every vertex from the nearest source, and which one that is.

        Parameters
        ----------
        sources
            As in `distance`; ``[0, 7]`` are two sources, ``Vertices([0, 7])`` is one.
        accuracy, radius, threads, executor, visibility, progress
            As in `distance`.

        Returns
        -------
        distance : ndarray, shape (n,)
        label : ndarray of int32, shape (n,)
            The place of the nearest source in the list; -1 where none is reached.
        """
        arguments = _arguments(threads, executor, radius, visibility, accuracy)
        located_sources = open_sources(self, sources, none_is_well=True)
        if not located_sources:
            n = self.vertex_count
            return np.full(n, _INFINITY, self.dtype), np.full(n, -1, np.int32)
        with Progress(progress, "solving") as report:
            found, label, _, doubts = _plexway.solve(
                self._native, located_sources, arguments, True, False, report
            )
        warn(doubts, self)
        return found, label

    def estimate(
        self,
        source: Any,
        *,
        accuracy: AccuracyLike = "accurate",
        radius: float = _INFINITY,
        progress: ProgressLike = None,
    ) -> Tuple[Array, Array]:
        """The distance of every vertex from the nearest source, and how far off it may be: on
        surfaces and clouds.

        Parameters
        ----------
        source
            As in `distance`, without lines and triangles.
        accuracy, radius, progress
            As in `distance`; 'fast' has no estimate.

        Returns
        -------
        distance : ndarray, shape (n,)
        error : ndarray of float64, shape (n,)
            An estimate, mostly several times too large, now and then too small; no bound. 0 where
            unreached or exact. On a cloud it has the solver's error on the sheet of triangles, not
            that of the sampling, which is mostly larger.
        """
        arguments = _arguments(None, None, radius, "saddles", accuracy)
        sources = open_sources(self, source)
        with Progress(progress, "solving") as report:
            found, _, error, doubts = _plexway.solve(
                self._native, sources, arguments, False, True, report
            )
        if len(error) != len(found):
            raise _plexway.UsageError(
                "errors are estimated on surfaces and clouds, by other accuracies than 'fast'"
            )
        warn(doubts, self)
        return found, error

    def _rows(self, sources: Any, none_is_well: bool = True) -> List[Any]:
        """Sources that are a row each; without any all vertices, masked or not."""
        if sources is None:
            return located(self, np.arange(self.vertex_count), none_is_well)
        return open_sources(self, sources, none_is_well)

    def _number(self, dtype: Any, accuracy: AccuracyLike) -> np.dtype[Any]:
        if dtype is not None:
            return np.dtype(dtype)
        return np.dtype(np.float64) if accuracy == "exact" else self.dtype

    def distances(
        self,
        sources: Any = None,
        *,
        columns: Optional[ArrayLike] = None,
        accuracy: AccuracyLike = None,
        radius: float = _INFINITY,
        threads: Optional[int] = None,
        executor: Optional[str] = None,
        visibility: str = "saddles",
        out: Optional[Array] = None,
        dtype: Any = None,
        progress: ProgressLike = None,
    ) -> Array:
        """The distance of every vertex from *each* of k sources.

        Parameters
        ----------
        sources
            As in `distance`, each for itself; None: every vertex.
        columns : array_like of int, optional
            Which vertices are columns, in any order; all without.
        threads : int, optional
            One source a thread; all threads by default (0), whatever their number the same bits.
        out : ndarray of float32 or float64, shape (k, n), optional
            Where to put them, such as an `numpy.memmap`.
        dtype : float32 or float64, optional
            Of the result where there is no `out`; that of the domain by default, and float64 with
            'exact'.
        accuracy, radius, executor, visibility, progress
            As in `distance`.

        Returns
        -------
        ndarray, shape (k, n)
            Row i: the distances from source i.

        Notes
        -----
        Memory beside the result, for each thread: 12 bytes a vertex, and a triangle some 20 for
        'fast' and some 50 for 'accurate'. What does not fit into memory goes into a file by
        `pairs`.
        """
        arguments = _arguments(threads, executor, radius, visibility, accuracy, many=True)
        located_sources = self._rows(sources)
        columns = columns_of(self, columns)
        width = self.vertex_count if columns is None else np.size(columns)
        shape = (len(located_sources), width)
        if out is None:
            out = np.empty(shape, self._number(dtype, accuracy))
        elif not isinstance(out, np.ndarray):
            raise TypeError(f"out: expected an ndarray, got {type(out).__name__}")
        elif dtype is not None and np.dtype(dtype) != out.dtype:
            raise ValueError(f"dtype: {np.dtype(dtype)}, but out has {out.dtype}")
        if out.dtype not in (np.float32, np.float64):
            raise ValueError(f"distances are float32 or float64, not {out.dtype}")
        if out.shape != shape:
            raise ValueError(f"out: expected shape {shape}, got {out.shape}")
        if not out.flags.writeable:
            raise ValueError("out: the array is read only")
        with Progress(progress, "solving") as report:
            doubtful, first, doubts = _plexway.solve_each(
                self._native, located_sources, arguments, out, columns, report
            )
        rows = f"{doubtful} of {len(out)} rows, such as row {first}: "
        warn((rows + text for text in doubts), self)
        return out

    def pairs(
        self,
        out: Union[str, os.PathLike[str]],
        sources: Any = None,
        *,
        columns: Optional[ArrayLike] = None,
        radius: float = _INFINITY,
        count: Optional[int] = None,
        dtype: Any = None,
        block: int = 32,
        restart: bool = True,
        threads: Optional[int] = None,
        accuracy: AccuracyLike = None,
        visibility: str = "saddles",
        progress: ProgressLike = None,
    ) -> Any:
        """Writes the distances from each source into a file of any size; the same call continues
        after an interruption.

        Parameters
        ----------
        out : path
            .npy: a dense matrix. .npz (as `scipy.sparse.load_npz` reads it) or .mtx (Matrix
            Market): a sparse one, of what is near.
        sources
            As in `distances`, each a row; None: every vertex.
        columns : array_like of int, optional
            Which vertices are columns, in any order; all without.
        radius : float
            A sparse matrix has no larger entry; in a dense one what is beyond is ``inf``.
        count : int, optional
            A sparse matrix has so many entries a row, the nearest.
        dtype : float16, float32 or float64, optional
            Of the file; that of the domain by default, and float64 with 'exact'. Sparse ones have
            no float16.
        block : int
            So many rows are finished together.
        restart : bool
            True: continue what an interrupted call with the same arguments left in `out`.part and
            `out`.journal. False: begin anew. A finished `out` is replaced in both cases.
        threads, accuracy, visibility, progress
            As in `distances`.

        Returns
        -------
        numpy.memmap, shape (k, columns)
            Of an .npy file; read only. Of .npz and .mtx a scipy.sparse.csr_matrix.

        Raises
        ------
        Error
            If an interrupted call had other arguments, another process writes the file, or the
            disk has no room. Finished rows stay.

        Notes
        -----
        Rows have the bits of `distances`, those of sparse matrices the bits of `near`, whatever the
        number of threads, and however often it was ended. Memory: a row a thread, beside what the
        solver takes; of a sparse matrix that is returned all of it.
        """
        file = os.fspath(out)
        ending = os.path.splitext(file)[1]
        dense = ending == ".npy"
        if ending not in (".npy", ".npz", ".mtx"):
            raise ValueError(f"out: expected a file .npy (dense), .npz or .mtx (sparse), got {file!r}")
        if not dense:
            _check_near(radius, count)
        elif count is not None:
            raise ValueError("count: only for sparse matrices, .npz or .mtx")
        columns = columns_of(self, columns)
        number = self._number(dtype, accuracy)
        reach = radius if dense else _INFINITY
        arguments = _arguments(threads, None, reach, visibility, accuracy, many=True)
        with Progress(progress, "solving") as report:
            doubts = _plexway.pairs_file(
                self._native,
                self._rows(sources, none_is_well=False),
                columns,
                file,
                real(radius, "radius"),
                None if count is None else whole(count, "count", 1),
                number.name,
                whole(block, "block", 1),
                bool(restart),
                arguments,
                report,
            )
        warn(doubts, self)
        if dense:
            return np.load(file, mmap_mode="r")
        return _loaded_sparse(file)

    def near(
        self,
        sources: Any = None,
        *,
        radius: float = _INFINITY,
        count: Optional[int] = None,
        columns: Optional[ArrayLike] = None,
        threads: Optional[int] = None,
        accuracy: AccuracyLike = None,
        progress: ProgressLike = None,
    ) -> Any:
        """The distances that are small, as a sparse matrix: from each source to what lies within a
        radius, or to the nearest vertices.

        Parameters
        ----------
        sources
            As in `distances`, each a row; None: every vertex.
        radius : float
            No entry is larger.
        count : int, optional
            So many entries a row, the nearest. Give one of the two, or both.
        columns : array_like of int, optional
            Which vertices are columns; all without.
        threads, accuracy, progress
            As in `distances`.

        Returns
        -------
        scipy.sparse.csr_matrix, shape (k, columns)
            Of float64; needs SciPy. A source's own vertex is an entry, with the value 0, also
            where a mask closes it.

        Notes
        -----
        On surfaces and clouds a row costs what it reaches and a look at each vertex (30 ns); with
        ``accuracy='fast'`` only what it reaches.
        """
        csr_matrix = scipy_sparse().csr_matrix
        _check_near(radius, count)
        columns = columns_of(self, columns)
        width = self.vertex_count if columns is None else np.size(columns)
        arguments = _arguments(threads, None, _INFINITY, "saddles", accuracy, many=True)
        located_sources = self._rows(sources)
        if not located_sources:
            return csr_matrix((0, width), dtype=np.float64)
        with Progress(progress, "solving") as report:
            *rows, doubts = _plexway.near(
                self._native,
                located_sources,
                columns,
                float(radius),
                None if count is None else int(count),
                arguments,
                report,
            )
        warn(doubts, self)
        return csr_matrix(tuple(rows), shape=(len(located_sources), width))

    def field(
        self,
        source: Any,
        *,
        accuracy: AccuracyLike = None,
        radius: float = _INFINITY,
        threads: Optional[int] = None,
        visibility: str = "saddles",
        progress: ProgressLike = None,
    ) -> Field:
        """A distance field that is kept: it traces paths, and evaluates the distance of any point.

        Parameters
        ----------
        source
            As in `distance`. From lines (`Segment`, `Polyline`, `Path`, `WholeSimplex`, `Boundary`)
            on surfaces and wireframes each path takes a solve of its own.
        accuracy, radius, threads, visibility, progress
            As in `distance`.

        Returns
        -------
        Field
        """
        arguments = _arguments(threads, None, radius, visibility, accuracy)
        sources = open_sources(self, source)
        owner: Optional[Array] = None
        sets = [s.points if isinstance(s, _plexway.VertexSet) else [s] for s in sources]
        if any(isinstance(s, _plexway.VertexSet) for s in sources):
            owner = np.repeat(np.arange(len(sets)), [len(points) for points in sets])
        points = [point for one in sets for point in one]
        if not all(isinstance(point, _plexway.Point) for point in points):
            return self._line_field(source, sources, arguments, progress)
        with Progress(progress, "solving") as report:
            native = _plexway.path_field(self._native, points, arguments, report)
        warn(native.doubts, self)
        return Field(self, native, owner)

    def _line_field(self, source: Any, sources: Any, arguments: Any, progress: ProgressLike) -> Field:
        from ._curves import LineField, lines_of

        if self.kind not in ("surface", "wireframe") or self._native.measured is not None:
            raise _plexway.UsageError(
                "paths lead to points and vertices; to lines on surfaces and wireframes without a metric"
            )
        lines = lines_of(self, source)
        with Progress(progress, "solving") as report:
            found, label, _, doubts = _plexway.solve(
                self._native, sources, arguments, True, False, report
            )
        warn(doubts, self)
        return LineField(self, lines, found, label)

    def path(
        self,
        source: Any,
        target: Place,
        *,
        accuracy: AccuracyLike = None,
        margin: Optional[float] = None,
        astar: bool = False,
    ) -> Path:
        """The shortest path from `target` to the nearest source. For several paths to one source
        keep a `field`.

        Parameters
        ----------
        source
            As in `distance`, vertices and points alone.
        target : Place
            A vertex, a point in space, or a `Point`.
        accuracy
            As in `distance`.
        margin : float, optional
            See `Field.path`.
        astar : bool
            On a surface: look toward the target and stop there, instead of at everything.

        Returns
        -------
        Path
            From the target to the source.
        """
        if not astar:
            return self.field(source, accuracy=accuracy).path(target, margin=margin)
        if accuracy is not None:
            raise ValueError("accuracy: a search by A* goes by its margin")
        ends = [only_place(self, target)]
        found = _plexway.find_paths(
            self._native, open_sources(self, source), ends, margin, None
        )
        return Path(*found[0])

    def at(self, source: Any, points: ArrayLike, *, level: str = "neighbours") -> Array:
        """Distances of any points of the domain from the nearest source; see `Field.at`.

        Returns
        -------
        ndarray of float64, shape (k,)
        """
        return self.field(source).at(points, level=level)

    def gradient(self, source: Any) -> Array:
        """Directions away from the source at the centre of each simplex; see `Field.gradient`.

        Returns
        -------
        ndarray of float64, shape (m, 3)
        """
        return self.field(source).gradient()

    # -- What people do with distances.

    def isolines(self, distance: ArrayLike, values: ArrayLike) -> List[Path]:
        """Lines on a surface, a cloud's sheet or a mixed domain where a field has given values.

        Parameters
        ----------
        distance : array_like of float, shape (n,)
            Any numbers, one a vertex.
        values : array_like of float
            A number, or several.

        Returns
        -------
        list of Path
            Value by value; `Path.source` is the place of its value. Closed lines end where they
            begin. Of a cloud `Path.simplices` are triangles of its sheet.
        """
        lines = _plexway.isolines(self._native, distance, np.atleast_1d(np.asarray(values, float)))
        return [Path(*line) for line in lines]

    def isosurfaces(self, distance: ArrayLike, values: ArrayLike) -> Isosurfaces:
        """Surfaces in a solid where a field has given values; see `isolines`.

        Returns
        -------
        Isosurfaces
        """
        return Isosurfaces(
            *_plexway.isosurfaces(
                self._native, distance, np.atleast_1d(np.asarray(values, float))
            )
        )

    def poisson(
        self,
        radius: Optional[float] = None,
        *,
        count: Optional[int] = None,
        seed: int = 1,
        at_vertices: bool = False,
        by_simplices: bool = False,
        spacing: Optional[ArrayLike] = None,
        progress: ProgressLike = None,
    ) -> Disks:
        """Points no nearer to each other than a radius, and none missing (Poisson disks).

        Parameters
        ----------
        radius : float
            No two points are nearer, and no point of the domain is farther from all.
        count : int
            Or so many: the radius is searched for. Give one of the two.
        seed : int
            The same seed gives the same points.
        at_vertices : bool
            Vertices only; so it is on clouds, always.
        by_simplices : bool
            One simplex after the other in random order: denser where they are smaller.
        spacing : array_like of float, shape (n,), optional
            The radius at a vertex is `radius` times this.
        progress
            As in `distance`.

        Returns
        -------
        Disks
        """
        if (radius is None) == (count is None):
            raise ValueError("give one of radius and count")
        if radius is not None and not 0 < real(radius, "radius") < _INFINITY:
            raise ValueError(f"radius: expected a number > 0, got {radius}")
        if count is not None:
            count = whole(count, "count", 1)
        with Progress(progress, "throwing darts") as report:
            points, found, maximal = _plexway.poisson(
                self._native,
                float(radius or 0),
                count or 0,
                whole(seed, "seed", 0),
                at_vertices,
                by_simplices,
                spacing,
                report,
            )
        return Disks(Points(self, points), found, maximal)

    def farthest(
        self,
        count: int,
        *,
        start: Any = 0,
        radius: float = 0.0,
        progress: ProgressLike = None,
    ) -> FarthestPoints:
        """Vertices one after the other, each the farthest from those before.

        Parameters
        ----------
        count : int
            So many points, those of `start` included.
        start
            As `source` in `distance`, vertices and points alone.
        radius : float
            Stop when no vertex is farther than this from them.

        Returns
        -------
        FarthestPoints
        """
        sources = open_sources(self, start)
        count = whole(count, "count", 1)
        with Progress(progress, "choosing points") as report:
            points, distance, covering = _plexway.farthest(
                self._native, sources, count, real(radius, "radius"), report
            )
        return FarthestPoints(Points(self, points), distance, covering)

    def cvt(
        self,
        seeds: Any,
        *,
        iterations: int = 100,
        tolerance: float = 1e-3,
        progress: ProgressLike = None,
    ) -> Cells:
        """Moves seeds until each lies in the middle of its Voronoi cell (Lloyd's algorithm).

        Parameters
        ----------
        seeds : int, Points or as in `distance`
            Where they begin; a number of seeds begins with so many Poisson disks.
        iterations : int
            At most so many.
        tolerance : float
            Done when seeds move by less than this share of a cell's size.

        Returns
        -------
        Cells
        """
        iterations = whole(iterations, "iterations", 1)
        if isinstance(seeds, (int, np.integer)):
            seeds = self.poisson(count=whole(seeds, "seeds", 1)).points
        native = seeds._native if isinstance(seeds, Points) else open_sources(self, seeds)
        with Progress(progress, "moving seeds") as report:
            points, label, content, energy, converged = _plexway.cvt(
                self._native, native, iterations, real(tolerance, "tolerance"), report
            )
        return Cells(Points(self, points), label, content, energy, converged)

    def closest(self, point: ArrayLike) -> Points:
        """The points of the domain closest to points in space.

        Parameters
        ----------
        point : array_like of float, shape (3,) or (k, 3)

        Returns
        -------
        Points
            How far each is: ``np.linalg.norm(points.positions - point, axis=1)``.
        """
        rows = np.asarray(point, float)
        if rows.ndim in (1, 2) and rows.shape[-1] == 2:
            rows = np.insert(rows, 2, 0, axis=-1)
        if rows.ndim not in (1, 2) or (rows.size and rows.shape[-1] != 3):
            raise ValueError(f"point: expected shape (3,) or (k, 3), got {rows.shape}")
        if not np.all(np.isfinite(rows)):
            raise _plexway.UsageError("point: a coordinate is not finite")
        found = [self._native.closest(xyz)[0] for xyz in rows.reshape(-1, 3).tolist()]
        return Points(self, found)

    def picture(
        self,
        distance: Optional[ArrayLike] = None,
        *,
        source: Any = None,
        paths: Sequence[Union[Path, ArrayLike]] = (),
        size: Tuple[int, int] = (800, 600),
        view: Optional[Tuple[float, float]] = None,
        isolines: Optional[int] = None,
        map: str = "viridis",
        transparent: bool = False,
        title: str = "distance",
        cut: bool = False,
    ) -> Picture:
        """Draws the domain, by OpenGL without a window.

        Parameters
        ----------
        distance : array_like of float, shape (n,), optional
            Colours.
        source
            Vertices and points that get a red ball.
        paths : sequence of Path or of array_like, shape (p, 3)
        size : (int, int)
            Width and height in pixels.
        view : (float, float), optional
            Azimuth and elevation of the camera in degrees.
        isolines : int, optional
            So many lines of equal value; at round numbers without.
        map : {'viridis', 'magma', 'cividis'}
        transparent : bool
            The background.
        title : str
            Over the colour bar.
        cut : bool
            Cut it through the middle, across x; the half nearer to the camera goes.

        Returns
        -------
        Picture
            ndarray of uint8, shape (height, width, 4).
        """
        marks = [] if source is None else located(self, source)
        lines = [p.points if isinstance(p, Path) else p for p in paths]
        width, height = (whole(number, "size", 1) for number in size)
        return _plexway.picture(
            self._native,
            distance,
            marks,
            [line for line in lines if line is not None and len(np.asarray(line))],
            width,
            height,
            view,
            isolines,
            map,
            transparent,
            title,
            cut,
        ).view(Picture)

    def write(
        self,
        file: Union[str, os.PathLike[str]],
        distance: ArrayLike,
        label: Optional[ArrayLike] = None,
    ) -> None:
        """Writes one distance a vertex, with the domain where the format holds it: .vtu, .ply,
        .npy, .csv, .gii and others, by extension.

        Parameters
        ----------
        file : path
        distance : array_like of float, shape (n,)
        label : array_like of int, shape (n,), optional
        """
        self._native.write_field(os.fspath(file), distance, label)

    def keep(self, file: Union[str, os.PathLike[str]]) -> None:
        """Writes what was built to a file, mostly called NAME.plexway, which `read` takes as any
        other: it then maps into memory instead of being built, and gives the same bits.

        Surfaces, solids, wireframes and clouds, without a metric or a mask.

        Parameters
        ----------
        file : path
        """
        self._native.keep(os.fspath(file))

    def _options(self) -> Dict[str, Any]:
        """How it was built, for pickles."""
        native = self._native
        metric = None
        if native.measured is not None:
            metric = ("measured", np.array(native.measured), native.refracts)
        return {
            "precision": "double" if native.double else "single",
            "triangulation": native.wanted_triangulation,
            "metric": metric,
            "mask": native.mask,
            "merge": native.merge,
            "progress": None,
        }

    def _recipe(self) -> Tuple[str, Tuple[Any, ...], Dict[str, Any]]:
        """The function of the native module that makes it again, and what that takes."""
        native = self._native
        given = native.lengths
        lengths = None if given is None else np.array(given)
        positions = None if native.positions is None else np.array(native.positions)
        arrays = (positions, native.vertex_count, np.array(native.all_simplices), lengths)
        return "from_arrays", (self.kind, *arrays), self._options()

    def __reduce__(self) -> Tuple[Any, ...]:
        return _restored, (type(self).__name__, self._recipe())


def _check_near(radius: Any, count: Any) -> None:
    if real(radius, "radius") == _INFINITY and count is None:
        raise ValueError("give a radius, a count, or both; all distances are `distances`")
    if count is not None:
        whole(count, "count", 1)
    if not radius >= 0:
        raise ValueError(f"radius: expected 0 or more, got {radius}")


def _loaded_sparse(file: str) -> Any:
    if file.endswith(".npz"):
        return scipy_sparse().load_npz(file)
    scipy_sparse()
    from scipy.io import mmread  # type: ignore

    return mmread(file).tocsr()


def _into(out: Array, found: Array) -> Array:
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out: expected an ndarray, got {type(out).__name__}")
    if not out.flags.writeable:
        raise ValueError("out: the array is read only")
    if out.shape != found.shape:
        raise ValueError(f"out: expected shape {found.shape}, got {out.shape}")
    np.copyto(out, found, casting="same_kind")
    return out


def _restored(name: str, recipe: Any) -> Domain:
    function, arguments, options = recipe
    return _wrapped(_CLASSES[name], getattr(_plexway, function)(*arguments, **options))


def _wrapped(cls: Type[Domain], native: Any) -> Domain:
    made = cls.__new__(cls)
    made._native = native
    return made
