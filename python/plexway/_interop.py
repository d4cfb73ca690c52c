"""Meshes of other packages, known by what they look like: none of these packages is imported."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np

from ._arrays import Array

# VTK's numbers for cells, and meshio's names.
_EDGE, _TRIANGLE, _TET = "edges", "triangles", "tets"
_CELLS = {3: _EDGE, 5: _TRIANGLE, 10: _TET, "line": _EDGE, "triangle": _TRIANGLE, "tetra": _TET}
_CORNERS = {_EDGE: 2, _TRIANGLE: 3, _TET: 4}

Arrays = Tuple[Array, Dict[str, Array]]


def looks_like_mesh(thing: Any) -> bool:
    """Whether `arrays_of` may know it: arrays and lists are none."""
    if isinstance(thing, (np.ndarray, list, tuple)):
        return False
    return any(hasattr(thing, name) for name in ("vertices", "points", "GetPoints"))


def arrays_of(mesh: Any) -> Arrays:
    """Positions, and simplices by kind: "edges", "triangles", "tets".

    Knows meshes of trimesh (Trimesh, PointCloud), Open3D (TriangleMesh, TetraMesh, LineSet,
    PointCloud), meshio (Mesh), pyvista (PolyData, UnstructuredGrid) and VTK itself.
    """
    if hasattr(mesh, "cells_dict") and hasattr(mesh, "points"):  # meshio; pyvista's grids
        return np.asarray(mesh.points), _by_kind(mesh.cells_dict)
    if hasattr(mesh, "GetPoints"):  # VTK; pyvista's PolyData is one
        return _of_vtk(mesh)
    if hasattr(mesh, "vertices"):
        found: Dict[str, Array] = {}
        for name, kind in (("faces", _TRIANGLE), ("triangles", _TRIANGLE), ("tetras", _TET)):
            rows = _rows(mesh, name, _CORNERS[kind])
            if rows is not None:
                found.setdefault(kind, rows)
        return np.asarray(mesh.vertices), found
    if hasattr(mesh, "points"):
        rows = _rows(mesh, "lines", 2)
        return np.asarray(mesh.points), {} if rows is None else {_EDGE: rows}
    raise TypeError(f"{type(mesh).__name__} is no mesh that plexway knows: give arrays")


def _rows(mesh: Any, name: str, corners: int) -> Optional[Array]:
    if not hasattr(mesh, name):
        return None
    rows = np.asarray(getattr(mesh, name))
    if rows.size == 0:
        return None
    if rows.ndim != 2 or rows.shape[1] != corners:
        raise ValueError(f"{type(mesh).__name__}.{name}: expected shape (m, {corners}), got {rows.shape}")
    return rows


def _by_kind(cells: Any) -> Dict[str, Array]:
    found: Dict[str, Array] = {}
    for name, rows in cells.items():
        kind = _CELLS.get(name)
        if kind is not None and len(rows):
            found[kind] = np.asarray(rows)
    return found


def _of_vtk(mesh: Any) -> Arrays:
    if mesh.GetPoints() is None:
        raise ValueError(f"{type(mesh).__name__} has no points")
    data = mesh.GetPoints().GetData()
    points = np.array(data, dtype=float).reshape(-1, 3)
    found: Dict[str, Array] = {}
    if hasattr(mesh, "GetPolys"):
        for cells, kind in ((mesh.GetLines(), _EDGE), (mesh.GetPolys(), _TRIANGLE)):
            if cells.GetNumberOfCells():
                found[kind] = _even(cells, _CORNERS[kind])
        return points, found
    if hasattr(mesh, "GetCellTypesArray"):
        cells = mesh.GetCells()
        starts = np.array(cells.GetOffsetsArray()).ravel()
        corners = np.array(cells.GetConnectivityArray()).ravel()
        types = np.array(mesh.GetCellTypesArray()).ravel()
        for number in np.unique(types):
            name = _CELLS.get(int(number))
            if name is not None:
                first = starts[:-1][types == number]
                found[name] = corners[first[:, None] + np.arange(_CORNERS[name])]
        return points, found
    raise TypeError(f"{type(mesh).__name__} is no mesh that plexway knows: give arrays")


def _even(cells: Any, corners: int) -> Array:
    starts = np.array(cells.GetOffsetsArray()).ravel()
    if np.any(np.diff(starts) != corners):
        raise ValueError(f"cells with other than {corners} corners: triangulate the mesh first")
    return np.array(cells.GetConnectivityArray()).reshape(-1, corners)
