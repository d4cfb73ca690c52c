"""Domains from files, arrays and meshes, and distances in one line."""

from __future__ import annotations

import os
import tempfile
import webbrowser
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Type, Union

import numpy as np

from . import _plexway
from ._arrays import Array, whole
from ._domain import _INFINITY, AccuracyLike, Domain, _wrapped
from ._interop import arrays_of, looks_like_mesh
from ._kinds import (
    Cloud,
    Mixed,
    Simplicial,
    Solid,
    Surface,
    Wireframe,
    _OfSimplices,
    _options_of,
)
from ._progress import Progress, ProgressLike
from ._results import Field, Path
from ._sources import Boundary, Polyline, Segment, WholeSimplex, located
from ._warnings import warn

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_BY_KIND: Dict[str, Type[Domain]] = {
    "surface": Surface,
    "solid": Solid,
    "wireframe": Wireframe,
    "cloud": Cloud,
    "mixed": Mixed,
    "simplices": Simplicial,
}


def read(
    *files: Union[str, os.PathLike[str]],
    kind: Optional[str] = None,
    tolerance: float = 0.0,
    precision: str = "single",
    triangulation: str = "auto",
    metric: Any = None,
    mask: Any = None,
    progress: ProgressLike = None,
    **options: Any,
) -> Domain:
    """Reads a domain from a file.

    Parameters
    ----------
    *files : path
        {formats}. What may hold several kinds is what has most dimensions. Several files make a
        `Mixed`.
    kind : {'surface', 'solid', 'wireframe', 'simplices', 'cloud', 'mixed'}, optional
        What to take it as: a surface may be filled, unravelled to its edges, or taken as a cloud.
    tolerance : float
        Of several files: vertices are one where they are this close.
    precision, triangulation, metric, progress
        As in `Surface`.
    mask
        As in `Surface`; 'regions:3,7' leaves out these regions of a .msh, .vtu or .vtk.
    **options
        Of clouds: k, neighbour_radius, max_normal_angle, smooth, denoise, deviations, voxel. Of
        surfaces that are filled: max_volume. Of level sets: voxel, grid, repair. Of all: strict, to
        refuse what would be left out, guessed or repaired, such as a face with a corner twice. Of
        surfaces, solids and wireframes: merge, as in `Surface`.

    Returns
    -------
    Domain
        Of the class of its kind.

    Raises
    ------
    InputError
        For a file that is missing, malformed or of an unknown kind: "FILE:LINE: cause".
    NotBuilt
        For a format that this build has no library for.
    """
    known = "k neighbour_radius max_normal_angle smooth denoise deviations voxel grid repair strict merge"
    if not files:
        raise TypeError("read: no file was given")
    for name in options:
        if name not in (*known.split(), "max_volume"):
            raise TypeError(f"read: unknown option {name!r}")
    with Progress(progress, "reading") as report:
        native = _plexway.read(
            [os.fspath(file) for file in files],
            float(tolerance),
            kind,
            **options,
            **_options_of(precision, triangulation, metric, report, mask),
        )
    made = _wrapped(_BY_KIND[native.kind], native)
    warn(native.doubts)
    if isinstance(made, Cloud):
        names = ("k", "neighbour_radius", "max_normal_angle", "smooth")
        made._neighbours = {name: options[name] for name in names if name in options}
    return made


if read.__doc__:
    read.__doc__ = read.__doc__.replace("{formats}", _plexway.known_formats())


def read_labels(file: Union[str, os.PathLike[str]], vertices: int) -> Array:
    """The label that a file gives each vertex of a surface.

    Parameters
    ----------
    file : path
        .label.gii (GIfTI, its first array), .annot (FreeSurfer: the numbers of its colour table, -1
        for what has none), .label (FreeSurfer: 1 for the vertices that it lists, else 0); of any
        other a whole number a line, one a vertex.
    vertices : int
        How many there are.

    Returns
    -------
    ndarray of int64, shape (vertices,)

    Raises
    ------
    InputError
        For a file that is missing or malformed, or has not one a vertex.
    """
    labels: Array = _plexway.read_labels(os.fspath(file), whole(vertices, "vertices", 0))
    return labels


def domain(V: Any, simplices: Optional[ArrayLike] = None, *, kind: Optional[str] = None, **options: Any) -> Domain:
    """A domain of arrays, of a file, or of a mesh; its kind by the shapes.

    Parameters
    ----------
    V : array_like of float, shape (n, axes), a path, or a mesh
        Positions. A mesh of another package gives its simplices of the highest dimension.
    simplices : array_like of int, shape (m, corners), optional
        2 corners are edges, 3 triangles, 4 tetrahedra, 5 simplices of dimension 4; positions of
        more than three coordinates make a `Simplicial`, and no simplices a `Cloud`.
    kind : optional
        'surface', 'solid', 'wireframe', 'cloud' or 'simplices', whatever the shapes say.
    **options
        Of the class that it becomes.

    Returns
    -------
    Domain
    """
    if kind is not None and (kind not in _BY_KIND or kind == "mixed"):
        raise ValueError(
            f"kind {kind!r}: choose one of 'surface', 'solid', 'wireframe', 'cloud', 'simplices'"
        )
    if isinstance(V, (str, os.PathLike)):
        if simplices is not None:
            raise TypeError("domain: a file holds its simplices: leave them out, or give positions")
        return read(V, kind=kind, **options)
    if isinstance(V, Domain):
        raise TypeError(f"{V!r} is a domain already: ask it itself, domain.distance(source)")
    if simplices is None and looks_like_mesh(V):
        V, cells = arrays_of(V)
        classes: List[Type[_OfSimplices]] = [Solid, Surface, Wireframe]
        wanted = [c for c in classes if kind in (None, c._kind)]
        found = [cells[c._cells] for c in wanted if c._cells in cells]
        simplices = found[0] if found and kind != "cloud" else None
    if simplices is None:
        if kind not in (None, "cloud"):
            raise _plexway.InputError(f"kind {kind!r} needs simplices")
        return Cloud(V, **options)
    if np.ndim(simplices) != 2:
        raise ValueError(
            f"simplices: expected shape (m, corners), got {np.shape(simplices)}; None is a cloud"
        )
    if kind is None:
        corners, axes = np.shape(simplices)[-1], np.shape(V)[-1] if np.ndim(V) == 2 else 0
        by_corners = {2: "wireframe", 3: "surface", 4: "solid"}
        kind = "simplices" if axes > 3 else by_corners.get(corners, "simplices")
    made: Any = _BY_KIND[kind]
    return made(V, **options) if kind == "cloud" else made(V, simplices, **options)  # type: ignore[no-any-return]


def show(
    thing: Union[Domain, Field],
    distance: Optional[ArrayLike] = None,
    *,
    source: Any = None,
    paths: Sequence[Union[Path, ArrayLike]] = (),
    title: str = "distance",
    map: str = "viridis",
    file: Union[None, str, os.PathLike[str]] = None,
) -> str:
    """Opens a page in the browser, to turn and come nearer: one file that loads nothing.

    Parameters
    ----------
    thing : Domain or Field
        A field shows its distances.
    distance : array_like of float, shape (n,), optional
        Colours.
    source, paths, title, map
        As in `Domain.picture`.
    file : path, optional
        Where to write the page instead; then nothing is opened.

    Returns
    -------
    str
        The file.
    """
    if isinstance(thing, Field):
        distance = thing.distance if distance is None else distance
        thing = thing.domain
    if not isinstance(thing, Domain):
        raise TypeError(f"show: expected a domain or a field, got {type(thing).__name__}")
    if file is None:
        handle, out = tempfile.mkstemp(prefix="plexway-", suffix=".html")
        os.close(handle)
    else:
        out = os.fspath(file)
    marks = [] if source is None else located(thing, source)
    lines = [p.points if isinstance(p, Path) else p for p in paths]
    lines = [line for line in lines if line is not None and len(np.asarray(line))]
    _plexway.page(thing._native, out, distance, marks, lines, title, map)
    if file is None:
        webbrowser.open("file://" + out)
    return out


_NEED_DOUBLE = (Segment, Polyline, WholeSimplex, Boundary)


def distance(
    V: Any,
    simplices: Any = None,
    source: Any = None,
    *,
    accuracy: AccuracyLike = None,
    radius: float = _INFINITY,
    threads: Optional[int] = None,
    executor: Optional[str] = None,
    visibility: str = "saddles",
    progress: ProgressLike = None,
    **options: Any,
) -> Array:
    """The distance of every vertex from the nearest source, in one line.

    Whoever asks more than once keeps a domain: ``plexway.domain(V, F).distance(source)``.

    Parameters
    ----------
    V : array_like of float, shape (n, axes)
        Positions. Or a file, or a mesh of another package, then ``distance(mesh, source)``.
    simplices : array_like of int, shape (m, corners)
        2 corners: edges; 3: triangles; 4: tetrahedra; 5, or positions of more than three
        coordinates: simplices. None: a cloud of points.
    source
        A vertex (int), vertices (integers), a point (three floats), points (k, 3), `Segment`, ...;
        see `Domain.distance`.
    accuracy, radius, threads, executor, visibility, progress
        See `Domain.distance`.
    **options
        Of the domain: kind, metric, mask, precision, triangulation, k, ...

    Returns
    -------
    ndarray of float32 or float64, shape (n,)
        ``inf`` at vertices that are not reached.

    Examples
    --------
    >>> import plexway
    >>> V = [[0, 0], [1, 0], [2, 0]]
    >>> plexway.distance(V, [[0, 1], [1, 2]], 0)
    array([0., 1., 2.], dtype=float32)
    """
    if source is None and (isinstance(V, (str, os.PathLike)) or looks_like_mesh(V)):
        simplices, source = None, simplices
    if source is None:
        raise TypeError("distance: no source was given")
    many = source if isinstance(source, (list, tuple)) else [source]
    if any(isinstance(s, _NEED_DOUBLE) for s in many):
        options.setdefault("precision", "double")
    return domain(V, simplices, **options).distance(
        source,
        accuracy=accuracy,
        radius=radius,
        threads=threads,
        executor=executor,
        visibility=visibility,
        progress=progress,
    )
