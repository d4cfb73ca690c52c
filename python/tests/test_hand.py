"""What stands in users' hands: paths of many kinds, their derivatives, curves on surfaces."""

import meshes
import numpy as np
import pytest

import plexway as px


def bumps(n=14, seed=3):
    """A square with hills, no two edges of the same length."""
    V, F = meshes.grid(n, jitter=0.25, seed=seed)
    x, y = V[:, 0], V[:, 1]
    V[:, 2] = 0.15 * np.sin(5 * x) * np.cos(4 * y) + 0.1 * np.exp(-20 * ((x - 0.6) ** 2 + (y - 0.4) ** 2))
    return V, F


def lattice(seed=5):
    """Struts in space at random."""
    V, T = meshes.kuhn(4, 3)
    V = V + np.random.default_rng(seed).uniform(-0.08, 0.08, V.shape)
    return V, meshes.loose_edges(np.concatenate([T[:, [0, 1, 2]], T[:, [1, 2, 3]]]))


def ball_of_tets(seed=7):
    """A solid with a cavity, so that paths bend."""
    V, T = meshes.kuhn(4, 3)
    middle = V[T].mean(axis=1)
    T = T[np.abs(middle - 0.5).max(axis=1) > 0.25]
    return V + np.random.default_rng(seed).uniform(-0.04, 0.04, V.shape), T


def test_many_paths_and_labels():
    V, F = meshes.grid(10, jitter=0.2)
    surface = px.Surface(V, F, precision="double")
    field = surface.field([0, 120])
    ways = field.paths([5, 60, 110])
    assert [w.length for w in ways] == [field.path(v).length for v in (5, 60, 110)]
    assert np.array_equal(field.label, surface.nearest([0, 120])[1])
    assert np.array_equal(surface.field(3).label, np.zeros(len(V), int))
    assert [w.source for w in ways] == [0, int(field.label[60]), 1]
    assert ways[0].vertices[0] == 5 and ways[0].vertices[-1] == 0


def test_sets_are_one_source():
    V, F = meshes.grid(10, jitter=0.2)
    surface = px.Surface(V, F, precision="double")
    rim = np.flatnonzero(V[:, 0] == 0)
    field = surface.field([px.Vertices(rim), px.Vertex(120, 0.25)])
    assert set(field.label.tolist()) == {0, 1}
    way = field.path(60)
    assert way.source == 0 and way.vertices[-1] in rim
    near = np.linalg.norm(V[60] - V[rim], axis=1)
    assert way.vertices[-1] == rim[near.argmin()] and way.length == pytest.approx(near.min())


@pytest.mark.parametrize("accuracy", ["fast", "accurate", "exact"])
def test_accuracy_and_astar(accuracy):
    V, F = bumps()
    surface = px.Surface(V, F, precision="double")
    way = surface.path(3, 200, accuracy=accuracy)
    truth = surface.distance(3, accuracy="exact")[200]
    assert truth * (1 - 1e-12) <= way.length <= truth * 1.01
    if accuracy == "exact":
        assert way.length == pytest.approx(truth, rel=1e-12)
        assert surface.path(3, 200, astar=True).length == pytest.approx(truth, rel=1e-9)
        with pytest.raises(ValueError, match="margin"):
            surface.path(3, 200, accuracy=accuracy, astar=True)


def test_predecessors_are_those_of_scipy():
    sparse = pytest.importorskip("scipy.sparse")
    from scipy.sparse.csgraph import dijkstra

    V, E = lattice()
    size = np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1)
    graph = sparse.csr_matrix((size, E.T), shape=(len(V), len(V)))
    distance, before = dijkstra(graph, directed=False, indices=7, return_predecessors=True)
    for frame in (px.Wireframe(V, E, precision="double"), px.Wireframe(graph.maximum(graph.T))):
        field = frame.field(7)
        assert np.allclose(field.distance, distance, rtol=1e-6)
        assert np.array_equal(field.predecessors(), before)
    assert np.array_equal(px.Wireframe(V, E, mask=np.ones(len(E), bool)).field(7).predecessors(), before)
    chain = [60]
    while before[chain[-1]] >= 0:
        chain.append(before[chain[-1]])
    assert field.path(60).vertices.tolist() == chain
    flat = px.Wireframe(None, [[0, 1], [1, 2], [2, 3]], lengths=[1.0, 0.0, 1.0], vertices=5).field(0)
    assert flat.predecessors().tolist() == [-9999, 0, 1, 2, -9999]


def test_directed_graphs_are_scipys():
    sparse = pytest.importorskip("scipy.sparse")
    graph = sparse.csr_matrix(([1.0, 2.0], ([0, 1], [1, 2])), shape=(3, 3))
    with pytest.raises(px.UsageError, match="scipy.sparse.csgraph.dijkstra"):
        px.Wireframe(graph)
    assert px.Wireframe(graph.maximum(graph.T)).distance(0).tolist() == [0, 1, 3]


# Of lines: on a flat sheet the nearest point of a segment is known.
def to_segment(P, a, b):
    t = np.clip(((P - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)
    foot = a + t[:, None] * (b - a)
    return np.linalg.norm(P - foot, axis=1), foot


def test_paths_to_lines():
    V, F = meshes.grid(9, jitter=0.25)
    sheet = px.Surface(V, F, precision="double")
    a, b = np.array([0.21, 0.33, 0]), np.array([0.62, 0.71, 0])
    line = px.Segment(a, b)
    field = sheet.field([line, 0])
    assert np.array_equal(field.distance, sheet.distance([line, 0]))
    distance, foot = to_segment(V, a, b)
    own = np.linalg.norm(V - V[0], axis=1)
    targets = np.random.default_rng(1).choice(len(V), 25, replace=False)
    for v, way in zip(targets, field.paths(targets)):
        first = distance[v] < own[v]
        assert way.length == pytest.approx(min(distance[v], own[v]), abs=1e-9)
        assert way.source == (0 if first else 1) == field.label[v]
        assert np.allclose(way.points[-1], foot[v] if first else V[0], atol=1e-6)
        assert np.allclose(way.points[0], V[v])
        length = np.linalg.norm(np.diff(way.points, axis=0), axis=1).sum()
        assert length == pytest.approx(way.length, abs=1e-12)
        assert np.allclose(np.einsum("ik,ikx->ix", way.barycentric[:, :3], V[way.corners[:, :3]]), way.points)
    points = np.array([[0.5, 0.5, 0], [0.11, 0.93, 0]])
    assert np.allclose(field.at(points), np.minimum(to_segment(points, a, b)[0], np.linalg.norm(points, axis=1)))
    rim = sheet.field(px.Boundary())
    inner = int(np.argmin(np.linalg.norm(V - [0.4, 0.3, 0], axis=1)))
    assert rim.path(inner).length == pytest.approx(V[inner, 1], abs=1e-9)
    whole = sheet.field(px.WholeSimplex(40))
    way = whole.path(0)
    assert way.length == pytest.approx(whole.distance[0], abs=1e-9)
    with pytest.raises(px.UsageError, match="offset"):
        sheet.field(px.Segment(a, b, offset=1.0))


def test_a_path_is_a_source():
    V, F = meshes.grid(9, jitter=0.25)
    sheet = px.Surface(V, F, precision="double")
    way = sheet.path([0.62, 0.71, 0], [0.21, 0.33, 0])
    assert np.allclose(sheet.distance(way), to_segment(V, way.points[0], way.points[-1])[0], atol=1e-9)
    ring = sheet.isolines(V[:, 0] - V[:, 1], 0.1)
    assert np.allclose(sheet.distance(ring), to_segment(V, np.array([0.1, 0, 0]), np.array([1, 0.9, 0]))[0], atol=1e-9)


# Derivatives, against differences of exact distances.
@pytest.mark.parametrize(
    "kind, make, options",
    [
        ("surface", bumps, {"accuracy": "exact"}),
        ("solid", ball_of_tets, {}),
        ("wireframe", lattice, {}),
    ],
)
def test_derivatives(kind, make, options):
    V, S = make()
    rng = np.random.default_rng(11)
    used = np.unique(S)
    h, worst, count, apart = 1e-6, 0.0, 0, 0
    while count < 1000:
        a = int(rng.choice(used))
        targets = rng.choice(used[used != a], 50)
        move = rng.standard_normal(V.shape)
        domains = [px.domain(W, S, precision="double", kind=kind) for W in (V, V + h * move, V - h * move)]
        fields = [d.field(a, **options) for d in domains]
        for b in targets.tolist():
            ways = [f.path(b) for f in fields]
            count += 1
            vertices, rows = ways[0].derivative()
            found = float((rows * move[vertices]).sum())
            measured = (ways[1].length - ways[2].length) / (2 * h)
            # Where two paths are about as short, and in solids where strings are stuck, a neighbour
            # has another path.
            if any(abs(w.measure(V) / ways[0].length - 1) > 1e-9 for w in ways[1:]):
                apart += 1
                continue
            worst = max(worst, abs(found - measured) / np.abs(rows).sum())
            assert ways[0].measure(V) == pytest.approx(ways[0].length, rel=1e-12)
    assert worst < 1e-5 and apart < 20
    sparse = pytest.importorskip("scipy.sparse")
    row = fields[0].derivative(b)
    assert sparse.issparse(row) and row.shape == (1, V.size)
    assert np.allclose(row.toarray().reshape(V.shape)[vertices], rows)


def test_any_tensor_will_do():
    """A complex step is exact: as a tensor of another package, it goes through whatever is done."""
    V, F = bumps()
    way = px.Surface(V, F, precision="double").path(3, 180, accuracy="exact")
    vertices, rows = way.derivative()
    for v, k in ((vertices[0], 0), (vertices[3], 2)):
        W = V.astype(complex)
        W[v, k] += 1e-30j
        assert way.measure(W).imag / 1e-30 == pytest.approx(rows[np.flatnonzero(vertices == v)[0], k], rel=1e-9)
    from plexway.torch import distance

    surface = px.Surface(V, F)
    found = distance(V, F, [(3, 180), (3, [0.5, 0.5, 0.0])], precision="double")
    assert np.allclose(found, [surface.distance(3)[180], surface.at(3, [[0.5, 0.5, 0.0]])[0]], rtol=1e-3)


def test_torch():
    torch = pytest.importorskip("torch")
    from plexway.torch import distance

    V, F = bumps()
    W = torch.tensor(V, requires_grad=True)
    distance(W, F, [(3, 180)], precision="double").sum().backward()
    vertices, rows = px.Surface(V, F, precision="double").path(3, 180).derivative()
    assert np.allclose(W.grad.numpy()[vertices], rows)


def test_two_points_of_a_mesh_meet():
    V, F = bumps(8)
    lengths = []
    for _ in range(300):
        way = px.Surface(V, F, precision="double").path(10, 68, accuracy="exact")
        lengths.append(way.length)
        vertices, rows = way.derivative()
        V[vertices] -= 0.5 * way.length * rows / (rows**2).sum()
    assert lengths[-1] < 1e-3 * lengths[0]


# Straight ahead.
def test_trace_is_straight_on_the_plane():
    V, F = meshes.grid(7, jitter=0.25)
    sheet = px.Surface(V, F)
    rng = np.random.default_rng(2)
    for _ in range(50):
        a, angle = rng.uniform(0.3, 0.7, 2), rng.uniform(0, 7)
        d = np.array([np.cos(angle), np.sin(angle), 0.7])  # what points up is no matter
        way = sheet.trace([*a, 0], d, 0.25)
        assert way.length == pytest.approx(0.25, rel=1e-14)
        assert np.allclose(way.points[-1][:2], a + 0.25 * d[:2], atol=1e-9)
    out = sheet.trace([0.5, 0.5, 0], [1, 0, 0], 3.0)
    assert out.length == pytest.approx(0.5) and np.allclose(out.points[-1], [1, 0.5, 0])
    vertex = sheet.trace(27, [0.3, 1, 0], 0.2)
    assert np.allclose(vertex.points[-1], V[27] + 0.2 * np.array([0.3, 1, 0]) / np.hypot(0.3, 1), atol=1e-9)


def test_trace_goes_on_where_a_path_leads():
    V, F = bumps()
    surface = px.Surface(V, F, precision="double")
    rng = np.random.default_rng(4)
    done = 0
    for _ in range(60):
        a, b = rng.uniform(0.1, 0.9, (2, 2))
        way = surface.path([*b, 0], [*a, 0], accuracy="exact")
        if len(way) < 3 or np.any(way.vertices >= 0):
            continue
        done += 1
        again = surface.trace(px.Point(int(way.simplices[0]), way.barycentric[0, :3]), way.points[1] - way.points[0], way.length)
        assert np.allclose(again.points[-1], way.points[-1], atol=1e-7)
    assert done > 40


def test_trace_through_a_vertex_halves_the_angle():
    # The corner of a cube: 270 degrees, 135 on either side.
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], float)
    F = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 6], [0, 6, 4], [0, 4, 5], [0, 5, 1]])
    way = px.Surface(V, F).trace([0.5, 0.5, 0], [-1, -1, 0], 2**0.5 / 2 + 0.5)
    assert np.allclose(way.points[-1], [0, 0, 0.5], atol=1e-12)
    assert way.vertices[1] == 0


# Pulled tight.
def cylinder(n, m, height):
    phi = 2 * np.pi * np.arange(n) / n
    V = np.array([[np.cos(p), np.sin(p), height * k / m] for k in range(m + 1) for p in phi])
    F = []
    for k in range(m):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            F += [[a, b, a + n], [b, b + n, a + n]]
    return V, np.array(F)


def test_shorten_keeps_turns():
    n, m, height = 12, 8, 2.0
    V, F = cylinder(n, m, height)
    tube = px.Surface(V, F, precision="double")
    around = 2 * n * np.sin(np.pi / n)
    # Up by one of the eight rows at each of twelve steps to the side: once around and up.
    start, end = 0, m * n
    stops = [min(k, m) * n + k % n for k in range(n)] + [end]
    once = tube.shorten(stops)
    assert once.length == pytest.approx(np.hypot(around, height), rel=1e-12)
    assert tube.path(end, start).length == pytest.approx(height, rel=1e-12)
    assert tube.shorten(tube.path(end, start)).length == pytest.approx(height, rel=1e-12)
    ring = tube.shorten([3 * n, 4 * n + 4, 3 * n + 8], closed=True)
    assert ring.length == pytest.approx(around, rel=1e-9)
    assert tube.shorten([0, 1, n + 1, n], closed=True).length == pytest.approx(0, abs=1e-12)


def test_signed_distance():
    pytest.importorskip("scipy.sparse")
    V, F = meshes.grid(12, jitter=0.25)
    sheet = px.Surface(V, F, precision="double")
    corners = np.array([[0.3, 0.25, 0], [0.8, 0.35, 0], [0.7, 0.8, 0], [0.35, 0.6, 0]])
    signed = sheet.signed_distance(corners)
    d = np.min([to_segment(V, a, b)[0] for a, b in zip(corners, np.roll(corners, -1, 0))], axis=0)
    turn = [np.cross(b - a, V - a)[:, 2] > 0 for a, b in zip(corners, np.roll(corners, -1, 0))]
    truth = np.where(np.all(turn, axis=0), -d, d)
    assert np.allclose(signed, truth, atol=1e-9)
    assert np.allclose(sheet.signed_distance(corners, inside=[0.05, 0.05, 0]), -truth, atol=1e-9)
    # Along edges and through vertices: a square of a grid that is not moved.
    V, F = meshes.grid(12)
    sheet = px.Surface(V, F, precision="double")
    square = np.array([[0.25, 0.25, 0], [0.75, 0.25, 0], [0.75, 0.75, 0], [0.25, 0.75, 0]])
    off = np.abs(V[:, :2] - 0.5) - 0.25
    truth = np.minimum(off.max(axis=1), 0) + np.linalg.norm(np.maximum(off, 0), axis=1)
    assert np.allclose(sheet.signed_distance(square), truth, atol=1e-9)
    # Two rings between which is the outside.
    level = np.minimum(np.hypot(V[:, 0] - 0.25, V[:, 1] - 0.5), np.hypot(V[:, 0] - 0.75, V[:, 1] - 0.5))
    rings = sheet.isolines(level, 0.15)
    signed = sheet.signed_distance(rings)
    assert len(rings) == 2 and np.array_equal(signed < 0, level < 0.15)
    tube = px.Surface(*cylinder(12, 8, 2.0))
    with pytest.raises(px.UsageError, match="closed"):
        sheet.signed_distance(sheet.path(0, 100))
    torus = meshes_torus(12, 8)
    with pytest.raises(px.UsageError, match="in two"):
        px.Surface(*torus).signed_distance([0, 4 * 8, 8 * 8])
    assert np.sum(tube.signed_distance([0, 4, 8][::-1]) < 0) == 0


def meshes_torus(n, m):
    u, v = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
    V = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], axis=-1)
    F = []
    for i in range(n):
        for j in range(m):
            a, b = i * m + j, i * m + (j + 1) % m
            c, d = (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m
            F += [[a, c, b], [b, c, d]]
    return V.reshape(-1, 3), np.array(F)


def test_notebooks_and_pages(tmp_path):
    V, F = bumps(6)
    surface = px.Surface(V, F)
    assert f"{surface}" == repr(surface) == "plexway.Surface(49 vertices, 72 triangles)"
    html = surface.field(0)._repr_html_()
    assert html is None or ("data:image/png;base64," in html and "49 vertices" in html)
    assert px.Surface(None, F, lengths=np.ones((72, 3)))._repr_html_() is None
    out = px.show(surface.field(0), source=0, paths=[surface.path(0, 48)], file=tmp_path / "a.html")
    assert "<canvas" in open(out).read()
    with pytest.raises(TypeError, match="domain"):
        px.show(V)


# Grids.
def test_grid():
    grid = px.Grid((9, 12), spacing=(0.5, 0.25), precision="double")
    x, y = np.meshgrid(0.5 * np.arange(9), 0.25 * np.arange(12), indexing="ij")
    assert np.allclose(grid.distance((3, 4)), np.hypot(x - 1.5, y - 1))
    assert np.allclose(grid.distance([[0, 0], [8, 11]]), np.minimum(np.hypot(x, y), np.hypot(x - 4, y - 2.75)))
    assert np.allclose(grid.distance(x == 0), x)
    slow = px.Grid((9, 12), (0.5, 0.25), np.full((9, 12), 0.5), precision="double")
    assert np.allclose(slow.distance((3, 4)), 2 * np.hypot(x - 1.5, y - 1))
    wall = np.ones((9, 12), bool)
    wall[4, :-1] = False
    around = px.Grid((9, 12), (0.5, 0.25), mask=wall, precision="double").distance((0, 0))
    assert np.isinf(around[4, 0])
    box = px.Grid((5, 4, 6), 0.5)
    where = np.indices(box.shape) * 0.5
    assert np.allclose(box.distance((1, 1, 1)), np.linalg.norm(where - 0.5, axis=0), rtol=1e-6)
    for wrong in ((3,), (1, 4), (3, 3, 3, 3)):
        with pytest.raises(ValueError, match="shape"):
            px.Grid(wrong)
    with pytest.raises(ValueError, match=r"\(9, 12\)"):
        grid.from_level_set(np.zeros((3, 3)))


def test_speeds_that_change_evenly():
    """Time in a medium of speed 1 + g x: arcosh(1 + g^2 r^2 / (2 c0 c)) / g."""
    g, errors = np.array([0.5, 1.0]), []
    for n in (21, 41, 81):
        x = np.indices((n, n)) / (n - 1)
        speed = 1 + np.tensordot(g, x, 1)
        centre = (n // 2, n // 2)
        r2 = sum((x[k] - x[k][centre]) ** 2 for k in (0, 1))
        truth = np.arccosh(1 + g @ g * r2 / (2 * speed[centre] * speed)) / np.sqrt(g @ g)
        found = px.Grid((n, n), 1 / (n - 1), speed, precision="double").distance(centre)
        errors.append((np.abs(found - truth)[truth > 0] / truth[truth > 0]).mean())
    assert errors[1] < 1e-4 and np.all(np.array(errors[:-1]) > 3 * np.array(errors[1:]))


def test_speeds_with_lengths_and_at_vertices():
    V, F = meshes.grid(12, jitter=0.2)
    lengths = np.linalg.norm(V[np.roll(F, -1, axis=1)] - V[F], axis=2)
    for fast, refract, close in ((3, True, 1e-9), (3, False, 1e-4), (1.05, True, 1e-9)):
        speed = np.where(V[F].mean(axis=1)[:, 0] < 0.5, 1.0, fast)
        metric = px.SimplexSpeeds(speed, refract)
        there = px.Surface(V, F, metric=metric, precision="double").distance(0)
        alone = px.Surface(None, F, lengths=lengths, metric=metric, precision="double").distance(0)
        assert np.allclose(alone, there, rtol=close, atol=0)
    with pytest.raises(ValueError, match="numbers > 0"):
        px.Surface(None, F, lengths=lengths, metric=px.SimplexSpeeds(0 * speed))
    # A ring: what is glued has no positions, and twice the speed half the distance.
    ring = np.where(F % 13 == 12, F - 12, F)
    whole = px.Surface(None, ring, lengths=lengths).distance(0)
    fast = px.Surface(None, ring, lengths=lengths, metric=px.SimplexSpeeds(np.full(len(F), 2.0))).distance(0)
    reached = np.isfinite(whole)
    assert np.allclose(2 * fast[reached], whole[reached], rtol=1e-3)

    plane = px.Surface(V, F, precision="double").distance(0)
    half = px.Surface(V, F, metric=px.VertexSpeeds(np.full(len(V), 2.0)), precision="double").distance(0)
    assert np.allclose(2 * half, plane, rtol=1e-3)
    with pytest.raises(ValueError, match="one axis"):
        px.Surface(V, F, metric=px.VertexSpeeds(np.ones((len(V), 2))))


@pytest.mark.parametrize("source", ["a", {}, 1.5, [0, "a"]])
def test_what_is_no_number_is_a_type_error(source):
    V, F = meshes.grid(4)
    with pytest.raises(TypeError, match="a source is a vertex"):
        px.distance(V, F, source)
    with pytest.raises(ValueError, match="shape"):
        px.distance(V, F, np.zeros((2, 4)))


def test_fields_as_gifti(tmp_path):
    import base64
    import re

    V, F = meshes.grid(4)
    surface = px.Surface(V, F)
    distance = surface.distance(0)
    surface.write(tmp_path / "d.func.gii", distance)
    data = re.search("<Data>([^<]*)</Data>", (tmp_path / "d.func.gii").read_text())
    assert np.array_equal(np.frombuffer(base64.b64decode(data[1]), "<f4"), distance.astype("<f4"))


def test_level_sets():
    grid = px.Grid((41, 41), 0.05, precision="double")
    x, y = np.indices(grid.shape) * 0.05
    line = 0.6 * x + 0.8 * y - 1.3  # a straight contour, and another scale than that of distances
    assert np.allclose(grid.from_level_set(3 * line)[8:-8, 8:-8], line[8:-8, 8:-8], atol=1e-9)
    ring = np.hypot(x - 1, y - 1) - 0.5
    assert np.abs(grid.from_level_set(ring) - ring).max() < 2e-3
    box = px.Grid((17, 17, 17), 0.125)
    where = np.indices(box.shape) * 0.125 - 1
    flat = where[0] * 0.6 + where[2] * 0.8
    inner = np.linalg.norm(where, axis=0) < 0.7
    assert np.abs(box.from_level_set(2 * flat) - flat)[inner].max() < 5e-3  # of first order
    with pytest.raises(px.UsageError, match="nowhere"):
        grid.from_level_set(np.ones(grid.shape))
