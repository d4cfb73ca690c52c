"""How it behaves: arrays of any type, errors, threads, Ctrl-C, progress, pickles."""

import concurrent.futures
import multiprocessing
import pickle
import signal
import threading
import time

import meshes
import numpy as np
import pytest

import plexway as px


@pytest.fixture(scope="module")
def sheet():
    return meshes.grid(20, jitter=0.2)


def test_any_type_and_order(sheet):
    V, F = sheet
    d = px.distance(V, F, 3)
    for integers in "int8 int16 int32 int64 uint16 uint32 uint64 intc longlong".split():
        few = F[:100] if integers == "int8" else F
        if integers == "int8":
            few = few[(few < 127).all(axis=1)]
        truth = d if integers != "int8" else px.distance(V, few, 3)
        for rows in (few.astype(integers), np.asfortranarray(few.astype(integers))):
            assert np.array_equal(px.distance(V, rows, 3), truth)
        assert np.array_equal(px.distance(V, few, np.array(3, integers)), truth)
    assert np.array_equal(px.distance(np.asfortranarray(V), F, 3), d)
    assert np.array_equal(px.distance(V[::-1][::-1], F[::1], 3), d)
    assert np.array_equal(px.distance(V.tolist(), F.tolist(), 3), d)
    assert np.array_equal(px.distance(V[:, :2], F, 3), d)
    V32 = V.astype(np.float32)
    assert np.array_equal(px.distance(V32, F, 3), px.distance(V32.astype(float), F, 3))
    assert np.array_equal(px.distance(V.astype(">f8"), F.astype(">i4"), 3), d)
    strided = np.zeros((len(V), 6))
    strided[:, ::2] = V
    assert np.array_equal(px.distance(strided[:, ::2], F, 3), d)
    whole = px.distance(np.array([[0, 0], [3, 0], [0, 4]]), np.array([[0, 1, 2]], np.uint8), 1)
    assert np.allclose(whole, [3, 0, 5])


def test_nothing_asked_for_is_nothing(sheet):
    V, F = sheet
    surface = px.Surface(V, F)
    assert surface.distances([]).shape == (0, len(V))
    assert len(surface.closest(np.zeros((0, 3)))) == 0
    assert surface.at(0, []).shape == (0,)
    assert np.array_equal(surface.distance([0, [1.0, 1.0, 0.0]]), surface.distance([0, len(V) - 1]))


def test_views_and_out_are_no_copies(sheet):
    V, F = sheet
    surface = px.Surface(V, F)
    assert surface.vertices is not surface.vertices
    assert np.shares_memory(surface.vertices, surface.vertices)
    assert np.shares_memory(surface.simplices, surface.simplices)
    assert np.array_equal(surface.vertices, V) and np.array_equal(surface.simplices, F)
    with pytest.raises(ValueError):
        surface.vertices[0, 0] = 1
    kept = surface.vertices
    del surface
    assert np.array_equal(kept, V)
    surface = px.Surface(V, F)
    field = surface.field(0)
    assert np.shares_memory(field.distance, field.distance)
    assert np.array_equal(field.distance, surface.distance(0))
    out = np.full(len(V), -1.0, np.float32)
    assert surface.distance(0, out=out) is out and np.array_equal(out, field.distance)
    for dtype in (np.float32, np.float64):
        for order in "CF":
            rows = np.empty((3, len(V)), dtype, order=order)
            assert surface.distances([0, 1, 2], out=rows) is rows
            assert np.array_equal(rows, surface.distances([0, 1, 2]))


def test_memory_map(sheet, tmp_path):
    V, F = sheet
    rows = np.lib.format.open_memmap(tmp_path / "d.npy", "w+", np.float32, (5, len(V)))
    px.Surface(V, F).distances(range(5), out=rows)
    rows.flush()
    assert np.array_equal(np.load(tmp_path / "d.npy"), px.Surface(V, F).distances(range(5)))


@pytest.mark.parametrize(
    "call, error, words",
    [
        (lambda V, F: px.distance(V, F + 1000, 0), px.InputError, "vertex 1"),
        (lambda V, F: px.distance(V, F - 5, 0), ValueError, "no number of a vertex"),
        (lambda V, F: px.distance(V, F * 1.0, 0), TypeError, "integers"),
        (lambda V, F: px.distance(V, F[:, :1], 0), ValueError, "shape"),
        (lambda V, F: px.Surface(V, F[:, :2]), ValueError, r"\(m, 3\)"),
        (lambda V, F: px.Surface(V.ravel(), F), ValueError, "shape"),
        (lambda V, F: px.Surface(V + 1j, F), TypeError, "complex"),
        (lambda V, F: px.Surface(V.astype(str), F), TypeError, "numbers"),
        (lambda V, F: px.Surface(V * np.nan, F), px.InputError, "finite"),
        (lambda V, F: px.Surface(V, F, precision="half"), ValueError, "'single', 'double'"),
        (lambda V, F: px.Surface(V, F, mask=[True]), ValueError, "mask"),
        (lambda V, F: px.Surface(V), TypeError, "positions"),
        (lambda V, F: px.distance(V, F, len(V)), px.UsageError, "counted from 0"),
        (lambda V, F: px.distance(V, F, len(V)), IndexError, "counted from 0"),
        (lambda V, F: px.distance(V, F, -1), px.UsageError, "counted from 0"),
        (lambda V, F: px.distance(V, F, []), px.UsageError, "no source"),
        (lambda V, F: px.distance(V, F, np.zeros((0, 3))), px.UsageError, "no source"),
        (lambda V, F: px.distance(V, F), TypeError, "source"),
        (lambda V, F: px.distance(V, F, 1.5), TypeError, "a vertex"),
        (lambda V, F: px.distance(V, F, [0.0, 1.0]), None, ""),
        (lambda V, F: px.distance(V, F, [0.0, np.inf, 0.0]), px.UsageError, "finite"),
        (lambda V, F: px.distance(V, F, np.ones(4)), ValueError, "source"),
        (lambda V, F: px.distance(V, F, np.ones(4, bool)), ValueError, "truth"),
        (lambda V, F: px.distance(V, F, [[0, 1], [2]]), ValueError, "a vertex"),
        (lambda V, F: px.distance(V, F, [[0, 1, 2, 3]]), ValueError, "source"),
        (lambda V, F: px.distance(V, F, "zero"), TypeError, "source"),
        (lambda V, F: px.distance(V, F, px.Vertices([0], [-1.0])), ValueError, ""),
        (lambda V, F: px.distance(V, F, px.Vertices([0], [1.0, 2])), ValueError, "offsets"),
        (lambda V, F: px.distance(V, F, px.Point(0, [2.0, -1, 0])), ValueError, ""),
        (lambda V, F: px.distance(V, F, px.Point(10**6, [1, 0, 0])), ValueError, "simplex"),
        (lambda V, F: px.distance(V, F, 0, accuracy="best"), ValueError, "'exact'"),
        (lambda V, F: px.distance(V, F, 0, accuracy=-1.0), ValueError, ""),
        (lambda V, F: px.distance(V, F, 0, accuracy=float("nan")), ValueError, ""),
        (lambda V, F: px.Surface(V, F).estimate(0, accuracy="fast"), px.UsageError, "estimate"),
        (lambda V, F: px.distance(V, F, 0, radius=-1), ValueError, "radius"),
        (lambda V, F: px.distance(V, F, 0, threads=-1), ValueError, "threads"),
        (lambda V, F: px.distance(V, F, 0, executor="tpu"), ValueError, "'serial'"),
        (lambda V, F: px.distance(V, F, 0, visibility="x"), ValueError, "'saddles'"),
        (lambda V, F: px.distance(V, F, 0, colour=1), TypeError, "colour"),
        (lambda V, F: px.distance(V, F, 0, threads=1.5), TypeError, "threads"),
        (lambda V, F: px.distance(V, F, 0, radius=None), TypeError, "radius"),
        (lambda V, F: px.distance(V, F, 0, accuracy=True), TypeError, "accuracy"),
        (lambda V, F: px.Surface(V, F, precision=None), TypeError, "precision"),
        (lambda V, F: px.Surface(np.ma.array(V, mask=V > 0.5), F), ValueError, "masked"),
        (lambda V, F: px.distance(V, [], 0), ValueError, "simplices"),
        (lambda V, F: px.distance("a.obj", F, 0), TypeError, "file"),
        (lambda V, F: px.distance(V, F, 2.0), TypeError, "float 2.0"),
        (lambda V, F: px.distance(V, F, None), TypeError, "source"),
        (lambda V, F: px.distance(V, F, px.Polyline([])), px.UsageError, "at least one"),
        (lambda V, F: px.Surface(V, F).near(count=2.5), TypeError, "count"),
        (lambda V, F: px.Surface(V, F).poisson(count=5, seed=-1), ValueError, "seed"),
        (lambda V, F: px.Surface(V, F).farthest(2.5), TypeError, "count"),
        (lambda V, F: px.Surface(V, F).cvt(0), ValueError, "seeds"),
        (lambda V, F: px.Surface(V, F).distance(0, out=[0.0]), TypeError, "out"),
        (lambda V, F: px.Surface(V, F).distances([0], columns=[-1]), ValueError, "columns"),
        (lambda V, F: px.Surface(V, F).distances([0], columns=[10**6]), IndexError, "columns"),
        (lambda V, F: px.Cloud(V, k=2.5), TypeError, "k:"),
        (lambda V, F: px.Mixed([]), ValueError, "part"),
        (lambda V, F: px.Mixed([(V, F, F)]), ValueError, "part"),
        (lambda V, F: px.Surface(V, F).poisson(), ValueError, "one of"),
        (lambda V, F: px.Surface(V, F).poisson(-1.0), ValueError, "radius"),
        (lambda V, F: px.Surface(V, F).isosurfaces(V[:, 0], 0.5), px.UsageError, "solids"),
        (lambda V, F: px.Surface(V, F).isolines(V[:3, 0], 0.5), ValueError, ""),
        (lambda V, F: px.Surface(V, F).field(px.Ball(0, 0.1)), px.UsageError, "points"),
        (lambda V, F: px.read("/none/such.obj"), px.InputError, "such.obj"),
        (lambda V, F: px.read("x.obj", colour=1), TypeError, "colour"),
        (lambda V, F: px.Domain(), TypeError, "Surface"),
        (lambda V, F: px.Simplicial(V, np.zeros((1, 7), int)), ValueError, "S:"),
        (lambda V, F: px.Mixed([(V, np.zeros((1, 5), int))]), ValueError, "Mixed"),
    ],
)
def test_errors(sheet, call, error, words):
    if error is None:  # a point in the plane
        assert call(*sheet) is not None
        return
    with pytest.raises(error, match=words) as raised:
        call(*sheet)
    assert "\n" not in str(raised.value)


def test_out_is_checked(sheet):
    V, F = sheet
    surface = px.Surface(V, F)
    for out in (np.empty((2, 3)), np.empty((1, len(V)), int), [[0.0]]):
        with pytest.raises((ValueError, TypeError)):
            surface.distances([0], out=out)
    locked = np.zeros((1, len(V)))
    locked.flags.writeable = False
    with pytest.raises(ValueError, match="read only"):
        surface.distances([0], out=locked)
    with pytest.raises(ValueError, match="shape"):
        surface.distance(0, out=np.empty(3))
    with pytest.raises(TypeError):
        surface.distance(0, out=np.empty(len(V), int))


def test_errors_know_their_families():
    assert issubclass(px.InputError, (px.Error, ValueError)) and issubclass(px.UsageError, ValueError)
    assert issubclass(px.NotBuilt, px.Error) and issubclass(px.Cancelled, px.Error)
    assert issubclass(px.PrecisionError, px.InputError)
    assert issubclass(px.InputError, px.Error) and not issubclass(px.Cancelled, ValueError)


def test_threads_at_once(sheet):
    V, F = meshes.sphere(40)
    ball = px.Surface(V, F)
    sources = list(range(0, len(V), 37))
    truth = [ball.distance(s) for s in sources]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert all(map(np.array_equal, pool.map(ball.distance, sources), truth))
        ways = list(pool.map(lambda s: ball.path(0, s).length, sources[:8]))
    assert ways == [ball.path(0, s).length for s in sources[:8]]


def rows_of(domain, source):
    return domain.distances([source, 0], threads=2)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes(method):
    # A child has none of the threads that its parent worked with.
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip("not here")
    V, F = meshes.sphere(12)
    ball = px.Surface(V, F)
    truth = ball.distances([3, 4, 0], threads=2)
    with multiprocessing.get_context(method).Pool(2) as pool:
        first, second = pool.starmap_async(rows_of, [(ball, 3), (ball, 4)]).get(120)
    assert np.array_equal(first, truth[[0, 2]]) and np.array_equal(second, truth[[1, 2]])


def test_the_interpreter_is_free():
    V, F = meshes.sphere(100)
    ball = px.Surface(V, F)
    counted = [0]
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    before = counted[0]
    ball.distances(range(60), threads=1)
    during = counted[0] - before
    stop.set()
    other.join()
    assert during >= 3


class Pressed(Exception):
    pass


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no such timers here")
@pytest.mark.parametrize("threads", [1, 2])
def test_control_c(threads):
    # In processor time, so that a busy machine does not matter.
    V, F = meshes.sphere(250)
    ball = px.Surface(V, F)

    def press(number, frame):
        raise Pressed

    def late_once(call, after):
        begun = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, after)
        try:
            with pytest.raises(Pressed):
                call()
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
        return time.process_time() - begun - after

    # Caches that other programs share make a step late at times, but not three times in a row.
    def in_time(call, after, limit):
        return any(late_once(call, after) < limit for _ in range(3))

    old = signal.signal(signal.SIGPROF, press)
    try:
        many = np.arange(3000)
        assert in_time(lambda: ball.distances(many, threads=threads), 0.3, 0.1 * threads)
        assert in_time(lambda: ball.poisson(count=3000), 0.1, 0.1)
        V, E = np.random.default_rng(0).uniform(size=(20000, 3)), np.arange(20000)
        chain = px.Wireframe(V, np.stack([E[:-1], E[1:]], 1))
        assert in_time(lambda: chain.distances(many, threads=threads), 0.3, 0.1 * threads)
        # Around a hole in four dimensions, where a step takes long.
        V, S = meshes.kuhn(6, 4)
        S = S[np.abs(V[S].mean(axis=1) - 0.5).max(axis=1) > 0.2]
        robot = px.Simplicial(V, S)
        assert in_time(lambda: robot.distances(threads=threads), 0.3, 0.1 * threads)
    finally:
        signal.signal(signal.SIGPROF, old)
    # And it goes on as if nothing had been.
    assert np.array_equal(ball.distance(5), px.Surface(*meshes.sphere(250)).distance(5))


def test_progress(sheet, capsys):
    V, F = meshes.sphere(60)
    ball = px.Surface(V, F)
    shares = []
    ball.distances(range(400), threads=1, progress=shares.append)
    assert shares and all(0 <= s <= 1 for s in shares) and shares == sorted(shares)
    with pytest.raises(px.Cancelled):
        ball.distances(range(400), threads=1, progress=lambda share: False)
    with pytest.raises(ZeroDivisionError):
        ball.distances(range(400), threads=2, progress=lambda share: 1 / 0)
    with pytest.raises(TypeError):
        ball.distance(0, progress=3)
    assert np.array_equal(ball.distances(range(20), progress=True), ball.distances(range(20)))


def test_a_line_without_tqdm(monkeypatch, capsys):
    import sys

    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    ball = px.Surface(*meshes.sphere(60))
    ball.distances(range(300), threads=1, progress=True)
    assert "solving: " in capsys.readouterr().err


def domains():
    V, F = meshes.grid(8, jitter=0.2)
    X, T = meshes.kuhn(2, 3)
    S, Q = meshes.kuhn(1, 4)
    E = meshes.loose_edges(F)
    lengths = np.linalg.norm(V[F] - V[F[:, [1, 2, 0]]], axis=2)
    speeds = np.random.default_rng(0).uniform(1, 2, len(F))
    yield lambda: px.Surface(V, F)
    yield lambda: px.Surface(V, F, precision="double", triangulation="input")
    yield lambda: px.Surface(F=F, lengths=lengths)
    yield lambda: px.Surface(V, F, metric=px.SimplexSpeeds(speeds))
    yield lambda: px.Surface(V, F, metric=px.SimplexSpeeds(speeds, refract=False))
    yield lambda: px.Surface(V, F, mask=np.arange(len(F)) % 5 > 0)
    yield lambda: px.Solid(X, T)
    yield lambda: px.Solid(X, T, metric=px.SimplexSpeeds(np.arange(1.0, 1 + len(T))))
    yield lambda: px.Wireframe(V, E)
    yield lambda: px.Wireframe(E=E, lengths=np.arange(1.0, 1 + len(E)))
    yield lambda: px.Simplicial(S, Q)
    yield lambda: px.Mixed([(X, T), (X + [0, 0, 1], meshes.loose_edges(T[:, :3]))])
    yield lambda: px.Cloud(V, k=8)


@pytest.mark.parametrize("number", range(13))
def test_pickle(number):
    try:
        made = list(domains())[number]()
    except px.NotBuilt:
        pytest.skip("not in this build")
    again = pickle.loads(pickle.dumps(made))
    assert type(again) is type(made) and repr(again) == repr(made)
    assert again.info().keys() == made.info().keys()
    assert np.array_equal(again.distances([0, 3, 7]), made.distances([0, 3, 7]))
    third = pickle.loads(pickle.dumps(again))
    assert np.array_equal(third.distances([0, 3, 7]), made.distances([0, 3, 7]))
    if made._native.mask is not None:
        assert np.array_equal(third.gradient(0), made.gradient(0))
        assert all(np.array_equal(*pair) for pair in zip(third._native.mask, made._native.mask))


def test_without_numpy(tmp_path):
    import os
    import subprocess
    import sys

    (tmp_path / "numpy.py").write_text("raise ImportError('no numpy')\n")
    path = os.pathsep.join([str(tmp_path), *sys.path])
    ran = subprocess.run(
        [sys.executable, "-c", "import plexway"],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
    )
    assert ran.returncode == 1 and "plexway needs NumPy" in ran.stderr


def test_picture():
    V, F = meshes.sphere(20)
    ball = px.Surface(V, F)
    try:
        shown = ball.picture(ball.distance(0), source=0, paths=[ball.path(0, 99)], size=(160, 120))
    except px.NotBuilt as error:
        pytest.skip(str(error))
    assert shown.shape == (120, 160, 4) and shown.dtype == np.uint8
    assert len(np.unique(np.asarray(shown).reshape(-1, 4), axis=0)) > 50
    assert shown._repr_png_()[:8] == b"\x89PNG\r\n\x1a\n"


def test_picture_is_a_png(tmp_path):
    from plexway import Picture

    shown = np.random.default_rng(0).integers(0, 256, (5, 7, 4)).astype(np.uint8).view(Picture)
    shown.save(tmp_path / "a.png")
    image = pytest.importorskip("PIL.Image")
    assert np.array_equal(np.asarray(image.open(tmp_path / "a.png")), shown)
    assert shown[0]._repr_png_() is None
