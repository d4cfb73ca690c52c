"""Every method on every kind of domain: right, or refused in one clear line, as docs/reference/python.md has it."""

import os
import pickle
import re
import tempfile
from pathlib import Path

import meshes
import numpy as np
import pytest

import plexway as px

SOURCE = Path(os.environ.get("PLEXWAY_SOURCE_DIR", Path(__file__).parents[2]))
KINDS = list(meshes.domains())
# Sums of rounding, and for clouds the surface that they are taken for.
BOUNDS = {"single": 3e-5, "double": 1e-9}


def made(kind, **options):
    try:
        return meshes.domains()[kind](**options)
    except px.NotBuilt as missing:
        pytest.skip(str(missing))


def used(domain, V):
    if domain.kind != "mixed":
        return np.ones(len(V), bool)
    n = len(V) // 2  # each part uses its half of the square
    return np.concatenate([V[:n, 0] < 0.5 + 1e-9, V[n:, 0] > 0.5 - 1e-9])


def works(name):
    """The kinds that the table of docs/reference/python.md names for a method."""
    page = SOURCE / "docs" / "reference" / "python.md"
    if not page.exists():
        pytest.skip("no docs here")
    rows = re.findall(r"^\| `(\w+)[(`].*?\|.*?\| (.*?) \|", page.read_text(), re.M)
    told = dict(rows)[name]
    every = {"surface", "solid", "wireframe", "cloud", "simplices", "mixed"}
    if told == "all":
        return every
    names = {"surfaces": "surface", "solids": "solid", "wireframes": "wireframe", "clouds": "cloud"}
    names.update({"mixed domains": "mixed", "mixed": "mixed", "simplices": "simplices"})
    kinds = {names[word] for word in re.split(r", | and ", told.removeprefix("all but "))}
    return every - kinds if told.startswith("all but ") else kinds


def calls(domain, V):
    """A call of each method, with a check of what comes back."""
    n = domain.vertex_count
    source = 1
    d = domain.distance(source)

    def near():
        pytest.importorskip("scipy.sparse")
        found = domain.near([source], count=3)
        assert found.shape == (1, n) and found.nnz == 3
        assert np.abs(found.data.max() - np.sort(d)[2]) < 1e-5

    def path():
        target = int(np.argmax(np.where(np.isfinite(d), d, -1)))
        way = domain.path(source, target)
        assert way.length == pytest.approx(d[target], rel=1e-2) and way.source == 0
        assert np.linalg.norm(way.points[-1] - V[source]) < 1e-9
        assert "Path(" in repr(way)

    def at():
        found = domain.at(source, [V[3][:3].tolist(), V[5][:3].tolist()])
        assert np.abs(found - d[[3, 5]]).max() < 1e-4
        assert domain.at(source, []).shape == (0,)

    def gradient():
        g = domain.gradient(source)
        lengths = np.linalg.norm(g, axis=1)
        assert g.shape == (domain.info()["simplices"], 3)
        assert np.all((np.abs(lengths - 1) < 1e-6) | (lengths == 0)) and lengths.max() > 0

    def field():
        kept = domain.field(source)
        assert np.array_equal(kept.distance, d) and kept.domain is domain
        with pytest.raises(TypeError, match="not pickled"):
            pickle.dumps(kept)

    def isolines():
        lines = domain.isolines(d, 0.4)
        assert lines and all(line.source == 0 for line in lines)

    def isosurfaces():
        found = domain.isosurfaces(V[:, 0], 0.4)
        assert len(found.triangles) and np.abs(found.positions[:, 0] - 0.4).max() < 1e-9

    def poisson():
        disks = domain.poisson(0.3)
        again = pickle.loads(pickle.dumps(disks))
        assert disks.maximal and len(disks.points) > 1
        assert np.array_equal(again.points.positions, disks.points.positions)
        nearest = domain.distance(list(disks.points))
        assert nearest.max() < 0.3 * 1.05

    def farthest():
        found = domain.farthest(3)
        assert len(found.points) == 3 and np.all(np.diff(found.distance[1:]) <= 1e-6)

    def cvt():
        found = domain.cvt([0, n - 1], iterations=5)
        assert len(found.seeds) == 2 and set(np.unique(found.label)) <= {-1, 0, 1}

    def closest():
        found = domain.closest(V[[2, 4], :3])
        if domain.kind != "simplices":
            assert np.abs(found.positions - V[[2, 4]]).max() < 1e-9

    def picture():
        shown = domain.picture(d, source=source, size=(60, 40))
        assert shown.shape == (40, 60, 4)

    def distances():
        rows = domain.distances([source, 0], columns=[0, 2])
        assert np.array_equal(rows[0], d[[0, 2]])

    def pairs():
        with tempfile.TemporaryDirectory() as name:
            rows = np.array(domain.pairs(Path(name) / "d.npy", [source, 0], columns=[0, 2]))
        assert np.array_equal(rows[0], d[[0, 2]])

    def nearest():
        found, label = domain.nearest([source, 0])
        assert np.array_equal(found, domain.distance([source, 0]))
        assert label[source] == 0 and label[0] == 1

    def estimate():
        found, error = domain.estimate(source)
        assert found.shape == error.shape and np.all(error >= 0)

    def info():
        assert domain.info()["vertices"] == n and repr(n) in repr(domain)

    def write():
        with tempfile.TemporaryDirectory() as name:
            domain.write(Path(name) / "d.npy", d)
            assert np.array_equal(np.load(Path(name) / "d.npy").astype(d.dtype), d)

    def distance():
        out = np.empty_like(d)
        assert domain.distance(source, out=out) is out and np.array_equal(out, d)

    return {name: call for name, call in locals().items() if callable(call)}


METHODS = [
    "distance", "distances", "nearest", "estimate", "near", "pairs", "field", "path", "at",
    "gradient", "isolines", "isosurfaces", "poisson", "farthest", "cvt", "closest", "picture",
    "info", "write",
]  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", METHODS)
def test_method(kind, name):
    domain, V = made(kind)
    call = calls(domain, V)[name]
    if kind in works(name):
        try:
            call()
        except px.NotBuilt as missing:
            pytest.skip(str(missing))
        return
    with pytest.raises((px.UsageError, px.NotBuilt)) as refused:
        call()
    assert "\n" not in str(refused.value) and len(str(refused.value)) > 20


def test_the_table_is_whole():
    told = re.findall(r"^\| `(\w+)[(`]", (SOURCE / "docs" / "reference" / "python.md").read_text(), re.M)
    methods = {n for n, v in vars(px.Domain).items() if callable(v) and not n.startswith("_")}
    assert methods <= set(told) and set(METHODS) <= set(told)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("precision", BOUNDS)
def test_keywords(kind, precision):
    domain, V = made(kind, precision=precision)
    assert domain.dtype == (np.float32 if precision == "single" else np.float64)
    bound = 2e-2 if kind == "cloud" else BOUNDS[precision]
    here = used(domain, V)
    source = int(np.flatnonzero(here)[5])
    truth = np.linalg.norm(V - V[source], axis=1)
    d = domain.distance(source)
    assert np.all(np.isinf(d[~here]))
    assert np.abs(d - truth)[here].max() < bound
    # radius: what is nearer is there, the rest is not.
    short = domain.distance(source, radius=0.5)
    assert np.all(np.isinf(short[here & (truth > 0.5 + bound)]))
    assert np.abs(short - truth)[here & (truth < 0.5 - bound)].max() < bound
    # threads: the same.
    for threads in (1, 2, 0, np.int64(2)):
        if domain.kind in ("surface", "cloud") and threads != 1:
            found = domain.distance(source, threads=threads, accuracy="fast")
            assert np.abs(found - truth)[here].max() < max(bound, 1e-4)
        else:
            assert np.abs(domain.distance(source, threads=threads) - truth)[here].max() < bound
        rows = domain.distances([source, 0], threads=threads)
        assert np.array_equal(rows[0], d)
    # accuracy: names and numbers where there are several, else 'fast' alone.
    for accuracy in ("fast", "accurate", "exact", 1e-3, np.float32(1e-3), 0):
        if kind in ("surface", "cloud") or (kind == "solid" and accuracy not in ("exact", 0)):
            off = np.abs(domain.distance(source, accuracy=accuracy) - truth)[here & (truth > 0)]
            relative = off / truth[here & (truth > 0)]
            mean = max(bound, 1e-4, accuracy if not isinstance(accuracy, str) else 0)
            assert relative.mean() < mean and relative.max() < 10 * mean
        elif accuracy == "fast":
            assert np.abs(domain.distance(source, accuracy=accuracy) - truth)[here].max() < bound
        elif isinstance(accuracy, str) or kind == "solid":
            with pytest.raises(px.UsageError, match="accurac"):
                domain.distance(source, accuracy=accuracy)


@pytest.mark.parametrize("kind", ["surface", "solid", "wireframe", "mixed"])
def test_metric(kind):
    domain, V = made(kind)
    count = domain.info()["simplices"]
    fast, _ = made(kind, metric=px.SimplexSpeeds(np.full(count, 4.0)))
    here = used(domain, V)
    source = int(np.flatnonzero(here)[5])
    truth = np.linalg.norm(V - V[source], axis=1) / 4
    assert np.abs(fast.distance(source) - truth)[here].max() < 1e-5
    again = pickle.loads(pickle.dumps(fast))
    assert np.array_equal(again.distance(source), fast.distance(source))
    for wrong in (np.full(count + 1, 1.0), np.zeros(count), np.full(count, np.nan)):
        with pytest.raises(px.InputError, match="speed"):
            made(kind, metric=px.SimplexSpeeds(wrong))


@pytest.mark.parametrize("kind", ["surface", "solid", "wireframe", "simplices"])
def test_mask(kind):
    domain, V = made(kind)
    rows = domain.simplices
    # Of convex domains cut by a plane both halves are convex: straight where they are.
    left = (V[rows][:, :, 0] < 0.5 + 1e-9).all(axis=1)
    masked, _ = made(kind, mask=left)
    d = masked.distance(int(rows[left][0, 0]))
    truth = np.linalg.norm(V - V[rows[left][0, 0]], axis=1)
    inside = np.zeros(len(V), bool)
    inside[np.unique(rows[left])] = True
    if kind != "surface":  # there the cut runs to and fro, and ways bend at it
        assert np.abs(d - truth)[inside].max() < 1e-5
    assert np.all(d[inside] > truth[inside] - 1e-5)
    assert np.all(np.isinf(d[~inside])) and np.all(np.isfinite(d[inside]))
    again = pickle.loads(pickle.dumps(masked))
    assert np.array_equal(again.distance(0), masked.distance(0))
    with pytest.raises(ValueError, match="mask"):
        made(kind, mask=left[:-1])


def test_parts_keep_no_metric_in_silence():
    V, F = meshes.grid(3)
    with pytest.raises(ValueError, match="metric"):
        px.Mixed([px.Surface(V, F, metric=px.SimplexSpeeds(np.ones(len(F)))), (V, F)])
    with pytest.raises(TypeError, match="domain already"):
        px.distance(px.Surface(V, F), 0)
    with pytest.raises(px.UsageError, match="only lengths"):
        lengths = np.linalg.norm(V[F] - V[F[:, [1, 2, 0]]], axis=2)
        px.Surface(F=F, lengths=lengths, metric=px.SimplexTensors(np.tile(np.eye(3), (len(F), 1, 1))))


def test_lengths_that_are_no_metric_are_told():
    F = [[0, 1, 2], [0, 2, 3]]
    with pytest.warns(RuntimeWarning, match="triangle inequality in 1 triangle of 2, such as triangle 0"):
        sheet = px.Surface(F=F, lengths=[[4, 3, 50], [50, 40, 30]])
    assert sheet.info()["violations"] == 1


def test_farthest_takes_each_vertex_once():
    V, F = meshes.grid(1)
    found = px.Surface(V, F).farthest(10)
    assert sorted(found.points.vertices.tolist()) == [0, 1, 2, 3]
    assert found.covering == 0
