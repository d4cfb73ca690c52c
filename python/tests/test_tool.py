"""The same bits as the command-line tool."""

import os
import subprocess
from pathlib import Path

import meshes
import numpy as np
import pytest

import plexway as px

TOOL = os.environ.get("PLEXWAY_TOOL")
DATA = Path(os.environ.get("PLEXWAY_SOURCE_DIR", Path(__file__).parents[2])) / "data"
pytestmark = pytest.mark.skipif(not TOOL, reason="PLEXWAY_TOOL is not set")


def told(file, out, *options):
    subprocess.run(
        [TOOL, "distance", file, "--out", out, "--quiet", *options], check=True, text=True
    )
    return np.load(out)


@pytest.mark.parametrize("precision", ["single", "double"])
def test_surface(tmp_path, precision):
    V, F = meshes.sphere(30)
    V = V * [1, 1.3, 0.6] + 0.1 * np.sin(7 * V[:, [1, 2, 0]])
    file = tmp_path / "blob.obj"
    file.write_text(
        "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in V.tolist())
        + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in F.tolist())
    )
    name = ["--precision", "float" if precision == "single" else "double"]
    surface = px.Surface(V, F, precision=precision)
    d = told(file, tmp_path / "a.npy", "--source", "vertex:7", *name)
    assert np.array_equal(d, surface.distance(7))
    assert np.array_equal(d, px.read(file, precision=precision).distance(7))
    two = ["--source", "vertex:7", "--source", "vertex:300"]
    d = told(file, tmp_path / "b.npy", *two, *name, "--radius", "1")
    assert np.array_equal(d, surface.distance([7, 300], radius=1))
    d = told(file, tmp_path / "c.npy", "--source", "point:0.3,0.4,0.5", *name)
    assert np.array_equal(d, surface.distance([0.3, 0.4, 0.5]))
    line = px.Segment([1, 0, 0], [0, 1, 0.5])
    d = told(file, tmp_path / "d.npy", "--source", "segment:1,0,0,0,1,0.5", *name)
    assert np.array_equal(d, surface.distance(line))
    if precision == "double":
        assert np.array_equal(d, px.distance(V, F, line))


def test_files(tmp_path):
    found = 0
    for file in sorted(DATA.rglob("*")) if DATA.is_dir() else []:
        if file.suffix not in (".obj", ".ply", ".off", ".mesh", ".edges") or found == 8:
            continue
        if file.stat().st_size > 2_000_000:
            continue
        try:
            domain = px.read(file)
        except px.Error:
            continue
        found += 1
        d = told(file, tmp_path / "d.npy", "--source", "vertex:0")
        assert np.array_equal(d, domain.distance(0)), file
    if DATA.is_dir():
        assert found > 0


def test_several_files(tmp_path):
    X, T = meshes.kuhn(2, 3)
    solid = tmp_path / "block.mesh"
    rows = [" ".join(map(repr, x)) + " 0" for x in X.tolist()]
    cells = [" ".join(str(v + 1) for v in t) + " 0" for t in T.tolist()]
    solid.write_text(
        "MeshVersionFormatted 2\nDimension 3\n"
        f"Vertices {len(rows)}\n" + "\n".join(rows) + "\n"
        f"Tetrahedra {len(cells)}\n" + "\n".join(cells) + "\nEnd\n"
    )
    wire = tmp_path / "wire.obj"
    wire.write_text("v 0 0 0\nv -1 0 0\nv -2 0 0\nl 1 2 3\n")
    both = px.read(solid, wire, precision="double")
    assert isinstance(both, px.Mixed)
    d = both.distance(len(X) + 2)
    assert np.abs(d[: len(X)] - (2 + np.linalg.norm(X, axis=1))).max() < 1e-9


def test_a_surface_is_filled(tmp_path):
    # By TetGen, in a program of its own, which must be found from an interpreter, too.
    off = DATA / "elbow.off"
    if not off.exists():
        pytest.skip("no data here")
    try:
        solid = px.read(off, kind="solid")
    except px.NotBuilt as missing:
        assert "program" not in str(missing)
        pytest.skip(str(missing))
    d = told(off, tmp_path / "d.npy", "--as", "solid", "--source", "vertex:0")
    assert isinstance(solid, px.Solid) and np.array_equal(d, solid.distance(0))


def test_prepared(tmp_path):
    """A file that the tool prepared, and one that Python keeps."""
    V, F = meshes.sphere(30)
    domain = px.Surface(V, F)
    domain.keep(tmp_path / "kept.plexway")
    (tmp_path / "blob.obj").write_text(
        "".join(f"v {float(x)!r} {float(y)!r} {float(z)!r}\n" for x, y, z in V)
        + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in F)
    )
    prepared = tmp_path / "prepared.plexway"
    subprocess.run(
        [TOOL, "prepare", tmp_path / "blob.obj", "--out", prepared, "--quiet"], check=True
    )
    assert prepared.read_bytes() == (tmp_path / "kept.plexway").read_bytes()
    opened = px.read(prepared)
    assert np.array_equal(opened.distance(3), domain.distance(3))
    with pytest.raises(px.Error, match="damaged"):
        damaged = bytearray(prepared.read_bytes())
        damaged[500] ^= 1
        (tmp_path / "damaged.plexway").write_bytes(damaged)
        px.read(tmp_path / "damaged.plexway")
