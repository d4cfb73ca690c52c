"""Matrices in files, in blocks that a journal remembers, on every kind of domain."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import meshes
import numpy as np
import pytest

import plexway as px

scipy_sparse = pytest.importorskip("scipy.sparse")


def surface(n=12, **options):
    V, F = meshes.grid(n, jitter=0.2)
    return px.Surface(V, F, **options)


def mixed():
    X, T = meshes.kuhn(2, 3)
    W = np.array([[0.0, 0, 0], [-1, 0, 0], [-2, 0, 0]])
    return px.Mixed([(X, T), (W, [[0, 1], [1, 2]])])


def with_speeds():
    V, F = meshes.grid(12, jitter=0.2)
    speeds = np.random.default_rng(0).uniform(1, 2, len(F))
    return px.Surface(V, F, metric=px.SimplexSpeeds(speeds), mask=np.arange(len(F)) % 7 > 0)


DOMAINS = {
    "surface": surface,
    "double": lambda: surface(precision="double"),
    "speeds, masked": with_speeds,
    "solid": lambda: px.Solid(*meshes.kuhn(3, 3)),
    "wireframe": lambda: px.Wireframe(
        meshes.grid(8, jitter=0.2)[0], meshes.loose_edges(meshes.grid(8)[1])
    ),
    "simplices": lambda: px.Simplicial(*meshes.kuhn(1, 4)),
    "cloud": lambda: px.Cloud(meshes.grid(12, jitter=0.2)[0], k=8),
    "mixed": mixed,
}


def made(name):
    try:
        return DOMAINS[name]()
    except px.NotBuilt as missing:
        pytest.skip(str(missing))


@pytest.mark.parametrize("name", DOMAINS)
def test_dense(tmp_path, name):
    domain = made(name)
    truth = domain.distances()
    found = domain.pairs(tmp_path / "all.npy", block=5, threads=2)
    assert isinstance(found, np.memmap) and found.dtype == domain.dtype
    assert np.array_equal(found, truth)
    assert os.listdir(tmp_path) == ["all.npy"]
    columns = np.arange(domain.vertex_count)[::-3]
    some = [px.Vertices([0, 3]), 5, px.Vertex(2, 0.25)]
    for dtype in (np.float16, np.float32, np.float64):
        few = domain.pairs(tmp_path / "few.npy", some, columns=columns, dtype=dtype)
        wanted = domain.distances(some, columns=columns, dtype=np.float64)
        assert np.array_equal(wanted, domain.distances(some, dtype=np.float64)[:, columns])
        assert few.dtype == dtype and np.array_equal(few, wanted.astype(dtype))
    near = domain.pairs(tmp_path / "near.npy", [0, 1], radius=0.4)
    assert np.array_equal(near, domain.distances([0, 1], radius=0.4))
    assert np.isinf(near).any()


@pytest.mark.parametrize("name", DOMAINS)
@pytest.mark.parametrize("ending", ["npz", "mtx"])
def test_sparse(tmp_path, name, ending):
    domain = made(name)
    columns = np.arange(domain.vertex_count)[::-2]
    for limits in ({"radius": 0.5}, {"count": 3}, {"radius": 0.5, "count": 4, "columns": columns}):
        near = domain.near(**limits)
        found = domain.pairs(tmp_path / f"near.{ending}", block=5, **limits)
        assert scipy_sparse.issparse(found) and found.format == "csr"
        assert found.shape == near.shape and found.nnz == near.nnz
        assert np.array_equal(found.indptr, near.indptr)
        assert np.array_equal(found.indices, near.indices)
        assert np.array_equal(found.data.astype(domain.dtype), near.data.astype(domain.dtype))
    assert os.listdir(tmp_path) == [f"near.{ending}"]


def test_near_on_mixed_domains():
    domain = mixed()
    truth = domain.distances(dtype=np.float64)
    found = domain.near(radius=1.1)
    inside = truth <= 1.1
    assert found.nnz == inside.sum() and np.array_equal(found.toarray()[inside], truth[inside])
    few = domain.near([4, 9], count=5)
    for k, row in enumerate((4, 9)):
        entries = few.data[few.indptr[k] : few.indptr[k + 1]]
        assert np.array_equal(np.sort(entries), np.sort(truth[row])[:5])


def stopped_after(rows, file, domain, **options):
    """Ends a call when about so many rows are there."""
    share = rows / domain.vertex_count
    with pytest.raises(px.Cancelled):
        domain.pairs(file, threads=1, block=4, progress=lambda done: done < share, **options)


def test_it_goes_on_where_it_was_ended(tmp_path):
    domain = surface(40)
    truth = domain.distances()
    file, part = tmp_path / "d.npy", tmp_path / "d.npy.part"
    stopped_after(600, file, domain)
    assert part.exists() and not file.exists()
    # A row of a block that was finished is not solved again: it keeps what is written here.
    rows = np.load(part, mmap_mode="r+")
    assert np.array_equal(rows[:400], truth[:400]) and not np.array_equal(rows, truth)
    rows[7] = 42
    rows.flush()
    del rows
    # Others than it was begun with: named, and nothing is lost.
    for other in ({"accuracy": 0.123}, {"dtype": "float64"}, {"radius": 3.0}, {"columns": [0]}):
        with pytest.raises(px.Error, match="begun with"):
            domain.pairs(file, block=4, **other)
    with pytest.raises(px.Error, match="now it is 'mask"):
        surface(40, mask=np.arange(3200) > 0).pairs(file, block=4)
    found = domain.pairs(file, block=4)
    assert np.all(found[7] == 42)
    found = np.array(found)
    found[7] = truth[7]
    assert np.array_equal(found, truth)
    assert os.listdir(tmp_path) == ["d.npy"]


def test_it_begins_anew(tmp_path):
    domain = surface(40)
    file = tmp_path / "d.npy"
    stopped_after(600, file, domain)
    rows = np.load(tmp_path / "d.npy.part", mmap_mode="r+")
    rows[7] = 42
    rows.flush()
    assert np.array_equal(
        domain.pairs(file, [5, 7], radius=1.0, restart=False), domain.distances([5, 7], radius=1.0)
    )
    (tmp_path / "d.npy.journal").write_text("somebody's notes\n")
    with pytest.raises(px.Error, match="in the way"):
        domain.pairs(file, restart=False)
    assert (tmp_path / "d.npy.journal").read_text() == "somebody's notes\n"


def test_killed_it_goes_on(tmp_path):
    script = tmp_path / "run.py"
    script.write_text(
        "import sys; sys.path.insert(0, sys.argv[2]); import meshes, plexway\n"
        "domain = plexway.Surface(*meshes.grid(60, jitter=0.2))\n"
        "domain.pairs(sys.argv[1], block=4, threads=2, accuracy='fast')\n"
    )
    file, journal = tmp_path / "d.npy", tmp_path / "d.npy.journal"
    kills = 0
    for _ in range(3):
        run = subprocess.Popen([sys.executable, script, file, Path(meshes.__file__).parent])
        before = journal.stat().st_size if journal.exists() else 0
        while run.poll() is None:
            if journal.exists() and journal.stat().st_size > before + 200:
                if before == 0:  # meanwhile nobody else may write
                    with pytest.raises(px.Error, match="another run"):
                        px.Surface(*meshes.grid(60, jitter=0.2)).pairs(file, block=4)
                run.send_signal(signal.SIGKILL)
                kills += 1
                break
            time.sleep(0.005)
        run.wait()
        if file.exists():
            break
    assert kills > 0
    domain = px.Surface(*meshes.grid(60, jitter=0.2))
    found = domain.pairs(file, block=4, accuracy="fast")
    some = np.arange(0, domain.vertex_count, 97)
    assert np.array_equal(found[some], domain.distances(some, accuracy="fast"))
    assert np.isfinite(found).all() and np.abs(found - found.T).max() < 1e-5


def test_control_c_keeps_what_is_finished(tmp_path):
    if not hasattr(signal, "setitimer"):
        pytest.skip("no such timers here")
    domain = surface(60)
    file = tmp_path / "d.npy"

    class Pressed(Exception):
        pass

    def press(number, frame):
        raise Pressed

    old = signal.signal(signal.SIGPROF, press)
    try:
        signal.setitimer(signal.ITIMER_PROF, 0.3)
        with pytest.raises(Pressed):
            domain.pairs(file, block=4)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, old)
    assert (tmp_path / "d.npy.journal").stat().st_size > 0
    few = domain.pairs(file, block=4)[:50]
    assert np.array_equal(few, domain.distances(np.arange(50)))


@pytest.mark.parametrize(
    "arguments, error, words",
    [
        ({"out": "d.txt"}, ValueError, ".npy"),
        ({"out": "d.npz"}, ValueError, "radius"),
        ({"count": 3}, ValueError, "sparse"),
        ({"out": "d.npz", "count": 0}, ValueError, "count"),
        ({"out": "d.npz", "count": 2.5}, TypeError, "count"),
        ({"out": "d.npz", "radius": -1}, ValueError, "radius"),
        ({"out": "d.npz", "radius": 1, "dtype": "float16"}, px.UsageError, "float16"),
        ({"dtype": int}, px.UsageError, "int64"),
        ({"columns": [10**6]}, px.UsageError, "1000000"),
        ({"columns": []}, ValueError, "columns"),
        ({"sources": []}, px.UsageError, "no source"),
        ({"sources": [-1]}, px.UsageError, "vertex -1"),
        ({"block": 0}, ValueError, "block"),
        ({"out": "none/d.npy"}, px.Error, "none"),
    ],
)
def test_errors(tmp_path, arguments, error, words):
    given = {"out": "d.npy", **arguments}
    with pytest.raises(error, match=words):
        surface(4).pairs(tmp_path / given.pop("out"), **given)
    assert os.listdir(tmp_path) == []
