"""Meshes of other packages: by what they look like, and where installed the real ones."""

import sys
from types import SimpleNamespace

import meshes
import numpy as np
import pytest

import plexway as px


def test_trimesh_and_open3d_by_their_looks():
    V, F = meshes.grid(5)
    d = px.distance(V, F, 3)
    mesh = SimpleNamespace(vertices=V, faces=F)
    assert np.array_equal(px.distance(mesh, 3), d)
    assert np.array_equal(px.Surface(mesh).distance(3), d)
    assert np.array_equal(px.distance(mesh, source=3), d)
    mesh = SimpleNamespace(vertices=V.tolist(), triangles=F.astype(np.int32))
    assert np.array_equal(px.distance(mesh, 3), d)
    V, T = meshes.kuhn(2, 3)
    mesh = SimpleNamespace(vertices=V, tetras=T)
    assert np.array_equal(px.distance(mesh, 3), px.distance(V, T, 3))
    lines = SimpleNamespace(points=V, lines=meshes.loose_edges(T[:, :3]))
    assert np.array_equal(px.distance(lines, 3), px.distance(V, lines.lines, 3))
    with pytest.raises(px.InputError, match="triangles"):
        px.Surface(lines)
    with pytest.raises(ValueError, match="faces"):
        px.Surface(SimpleNamespace(vertices=V, faces=T))


def test_meshio():
    meshio = pytest.importorskip("meshio")
    V, F = meshes.grid(5)
    mesh = meshio.Mesh(V, [("triangle", F[:20]), ("triangle", F[20:])])
    assert np.array_equal(px.distance(mesh, 3), px.distance(V, F, 3))
    X, T = meshes.kuhn(2, 3)
    mesh = meshio.Mesh(X, [("triangle", T[:, :3]), ("tetra", T)])
    assert isinstance(px.domain(mesh), px.Solid)
    assert isinstance(px.domain(mesh, kind="surface"), px.Surface)
    assert np.array_equal(px.distance(mesh, 3), px.distance(X, T, 3))


def test_vtk():
    core = pytest.importorskip("vtkmodules.vtkCommonCore")
    model = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    V, F = meshes.grid(5)
    points = core.vtkPoints()
    points.SetDataTypeToDouble()
    for p in V:
        points.InsertNextPoint(p)
    cells = model.vtkCellArray()
    for f in F:
        cells.InsertNextCell(3, f.tolist())
    poly = model.vtkPolyData()
    poly.SetPoints(points)
    poly.SetPolys(cells)
    assert np.array_equal(px.distance(poly, 3), px.distance(V, F, 3))
    X, T = meshes.kuhn(2, 3)
    grid = model.vtkUnstructuredGrid()
    points = core.vtkPoints()
    points.SetDataTypeToDouble()
    for p in X:
        points.InsertNextPoint(p)
    grid.SetPoints(points)
    grid.InsertNextCell(5, 3, T[0, :3].tolist())
    for t in T:
        grid.InsertNextCell(10, 4, t.tolist())
    assert np.array_equal(px.distance(grid, 3), px.distance(X, T, 3))


def test_nobody_is_imported():
    import subprocess

    code = "import plexway, sys; print([m for m in sys.modules if m.split('.')[0] in " + repr(
        ["trimesh", "pyvista", "meshio", "open3d", "vtk", "vtkmodules", "scipy", "tqdm"]
    ) + "])"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"
