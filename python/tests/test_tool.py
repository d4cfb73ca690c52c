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
    if precision == "double":
        line = "segment:1,0,0,0,1,0.5"
        d = told(file, tmp_path / "d.npy", "--source", line)
        assert np.array_equal(d, px.distance(V, F, px.Segment([1, 0, 0], [0, 1, 0.5])))
        assert np.array_equal(d, px.Surface(V, F).distance(px.Segment([1, 0, 0], [0, 1, 0.5])))


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
