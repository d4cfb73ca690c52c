"""Cases of the kind that tests of other packages have (tvb-gdist, pygeodesic, potpourri3d,
scikit-fmm, eikonalfm, CGAL, libigl, geometry-central, trimesh, networkx, scipy), made anew: each has
an answer that is known exactly."""

import itertools
import pickle
import zipfile

import numpy as np
import plexway as px
import pytest
from meshes import grid, kuhn, loose_edges, sphere

EXACT = dict(accuracy="exact")


def surface(V, F, **options):
    return px.Surface(V, F, precision="double", **options)


def close(found, truth, tolerance=1e-12):
    np.testing.assert_allclose(found, truth, rtol=tolerance, atol=tolerance)


def lines(V, W=None):
    W = V if W is None else W
    return np.linalg.norm(V[:, None] - W[None], axis=2)


# -- Flat and developable surfaces.


@pytest.mark.parametrize("accuracy, tolerance", [("exact", 1e-12), ("accurate", 2e-3)])
def test_a_flat_sheet_is_euclidean_and_symmetric(accuracy, tolerance):
    V, F = grid(7, jitter=0.3, seed=4)
    D = surface(V, F).distances(accuracy=accuracy)
    close(D, lines(V), tolerance)
    close(D, D.T, tolerance)
    assert (np.diag(D) == 0).all()


def test_a_cube_from_corner_to_corner():
    n = 4
    V, F = grid(n)
    x, y, o = V[:, 0], V[:, 1], np.zeros(len(V))
    sides = [np.stack(s, 1) for s in ((x, y, o), (x, y, o + 1), (x, o, y), (x, o + 1, y), (o, x, y), (o + 1, x, y))]
    P = np.concatenate(sides)
    joined, number = np.unique(P.round(9), axis=0, return_inverse=True)
    number = number.ravel()
    G = number[np.concatenate([F + k * len(V) for k in range(6)])]
    cube = surface(joined, G)
    at = lambda *p: int(np.argmin(np.linalg.norm(joined - p, axis=1)))
    d = cube.distance(at(0, 0, 0), **EXACT)
    for corner, truth in {(1, 0, 0): 1, (1, 1, 0): 2**0.5, (1, 1, 1): 5**0.5, (1, 0.5, 1): 3.25**0.5}.items():
        close(d[at(*corner)], truth)
    # The top by unfolding over either side, as far as that is straight.
    for v in np.flatnonzero(joined[:, 2] == 1):
        a, b = joined[v, :2]
        close(d[v], min(np.hypot(1 + a, b), np.hypot(1 + b, a)))
    close(cube.distance(at(0.5, 0.5, 0), **EXACT)[at(0.5, 0.5, 1)], 2)
    close(cube.path(at(0, 0, 0), at(1, 1, 1)).length, 5**0.5, 1e-3)
    # Triangles with corners of their own, as in an .stl, are the same cube.
    soup = surface(joined[G].reshape(-1, 3), np.arange(3 * len(G)).reshape(-1, 3), merge=0)
    close(soup.distance(0, **EXACT), cube.distance(int(G[0, 0]), **EXACT)[G.ravel()])


@pytest.mark.parametrize("n", [5, 16])
def test_a_cylinder_is_unrolled(n):
    rows = 6
    angle = 2 * np.pi * np.arange(n) / n
    V = np.array([[np.cos(a), np.sin(a), 0.3 * z] for z in range(rows) for a in angle])
    F = []
    for r, k in itertools.product(range(rows - 1), range(n)):
        a, b = r * n + k, r * n + (k + 1) % n
        F += [[a, b, b + n], [a, b + n, a + n]]
    side = 2 * np.sin(np.pi / n)
    step = np.arange(n)
    around = side * np.minimum(step, n - step)
    truth = np.concatenate([np.hypot(around, 0.3 * z) for z in range(rows)])
    close(surface(V, F).distance(0, **EXACT), truth)


@pytest.mark.parametrize("n, height", [(4, 0.2), (7, 1.5), (9, 4.0)])
def test_a_cone_is_straight_or_through_the_apex(n, height):
    angle = 2 * np.pi * np.arange(n) / n
    V = np.vstack([[[0, 0, height]], np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)])
    F = np.array([[0, 1 + k, 1 + (k + 1) % n] for k in range(n)])
    slant = np.hypot(1, height)
    apex = 2 * np.arcsin(np.sin(np.pi / n) / slant)
    turn = apex * np.minimum(np.arange(n), n - np.arange(n))
    truth = np.where(turn < np.pi, 2 * slant * np.sin(np.minimum(turn, np.pi) / 2), 2 * slant)
    d = surface(V, F).distance(1, **EXACT)
    close(d[1:], truth)
    close(d[0], slant)


def test_platonic_solids():
    s = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / 8**0.5
    F = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    tetrahedron = surface(s, F)
    close(tetrahedron.distances(**EXACT), 1 - np.eye(4))
    middle = [px.Point(0, (0.5, 0.5, 0)), px.Point(2, (0, 0.5, 0.5))]  # of opposite edges
    close(tetrahedron.field(middle[0], **EXACT).at([middle[1]]), [1])
    V = np.vstack([np.eye(3), -np.eye(3)]) / 2**0.5
    F = [[a, b + 0, c] for a in (0, 3) for b in (1, 4) for c in (2, 5)]
    D = surface(V, F).distances(**EXACT)
    close(D[0, [1, 2, 3, 4, 5]], [1, 1, 3**0.5, 1, 1])


def test_a_flat_torus_has_no_positions():
    n, side = 8, 1 / 8
    index = np.arange(n * n).reshape(n, n)
    right, up = np.roll(index, -1, 0), np.roll(index, -1, 1)
    both = np.roll(right, -1, 1)
    F = np.concatenate([np.stack([index, right, both], -1), np.stack([index, both, up], -1)]).reshape(-1, 3)
    d = side * 2**0.5
    lengths = np.concatenate([np.tile([side, side, d], (n * n, 1)), np.tile([d, side, side], (n * n, 1))])
    torus = px.Surface(None, F, lengths=lengths, precision="double")
    step = side * np.minimum(np.arange(n), n - np.arange(n))
    close(torus.distance(0, **EXACT), np.hypot(step[:, None], step[None]).ravel())


def test_soups_are_pickled_kept_read_and_asked_at_any_vertex(tmp_path):
    V, F = grid(4, jitter=0.2)
    P, G = V[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3)
    soup, truth = surface(P, G, merge=0), lines(P)
    close(soup.distances(**EXACT), truth)
    again = pickle.loads(pickle.dumps(soup))
    soup.keep(tmp_path / "soup.plexway")
    kept = px.read(tmp_path / "soup.plexway", precision="double")
    with open(tmp_path / "soup.obj", "w") as out:
        out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in P.tolist())
        out.writelines(f"f {a} {b} {c}\n" for a, b, c in (G + 1).tolist())
    for one in (soup, again, kept, px.read(tmp_path / "soup.obj", merge=0, precision="double")):
        close(one.distance(len(P) - 1, **EXACT), truth[-1])
        assert one.components == 1 and one.info()["merged_vertices"] == len(P) - len(V)
        close(one.path(7, len(P) - 1).length, truth[7, -1], 1e-3)
        d, label = one.nearest([0, len(P) - 1], **EXACT)
        close(d, np.minimum(truth[0], truth[-1]))
        assert (d == np.where(label == 0, one.distance(0, **EXACT), one.distance(len(P) - 1, **EXACT))).all()
    with pytest.raises(px.UsageError, match="merge must be a number >= 0"):
        surface(P, G, merge=-1)


def test_pages_of_a_book_unfold_in_pairs():
    n = 4
    V, F = grid(n)
    pages, faces, flat = [], [], []
    for k, turn in enumerate((0.3, 2.0, 4.1)):
        pages.append(np.stack([V[:, 0] * np.cos(turn), V[:, 0] * np.sin(turn), V[:, 1]], 1))
        faces.append(F + k * len(V))
        flat.append(np.column_stack([V[:, :2], np.full(len(V), k)]))
    P, flat, G = np.concatenate(pages), np.concatenate(flat), np.concatenate(faces)
    book = surface(P, G, merge=1e-12)
    s = int(np.flatnonzero((flat == [0.5, 0.25, 0]).all(1))[0])
    x = np.where(flat[:, 2] == 0, flat[:, 0], -flat[:, 0])
    close(book.distance(s, **EXACT), np.hypot(x - 0.5, flat[:, 1] - 0.25))


def test_great_circles_and_antipodes():
    V, F = sphere(40)
    ball = surface(V, F)
    for source in (0, len(V) // 3):
        angle = np.arccos(np.clip(V @ V[source], -1, 1))
        d = ball.distance(source, **EXACT)
        np.testing.assert_allclose(d, angle, rtol=4e-3, atol=1e-7)  # the facets'
        assert (d <= angle + 1e-12).all()
    # From pole to pole down the middle of a lune, over the middles of its rings' edges.
    polar = np.linspace(0, np.pi, 41)
    middle = np.stack([np.sin(polar) * np.cos(np.pi / 80), np.cos(polar)], 1)
    close(ball.distance(0, **EXACT)[-1], np.linalg.norm(np.diff(middle, axis=0), axis=1).sum())


# -- What metrics do, whatever the shape.


def test_curved_matrices_are_metrics_in_any_frame():
    V, F = grid(6, jitter=0.2, seed=2)
    V[:, 2] = 0.4 * np.random.default_rng(1).random(len(V))
    D = surface(V, F).distances(**EXACT)
    close(D, D.T)
    assert (D[:, None, :] <= D[:, :, None] + D[None] + 1e-12).all()
    assert (D >= lines(V) - 1e-12).all()
    turn, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
    order = np.random.default_rng(3).permutation(len(V))
    where = np.argsort(order)
    moved = surface(1000 * (V @ turn + [3, -2, 7])[order], where[F][::-1, [2, 0, 1]])
    close(moved.distances(**EXACT), 1000 * D[np.ix_(order, order)], 1e-9)


def test_several_repeated_and_all_sources():
    V, F = grid(6, jitter=0.2)
    sheet, some = surface(V, F), [3, 30, 17]
    least = lines(V)[:, some].min(1)
    for sources in (some, some * 3, some[::-1]):
        close(sheet.distance(sources, **EXACT), least)
    d, label = sheet.nearest(some, **EXACT)
    close(d, lines(V)[np.arange(len(V)), np.array(some)[label]])
    assert (sheet.distance(np.arange(len(V)), **EXACT) == 0).all()
    with pytest.raises(px.UsageError):
        sheet.distance([])
    d, label = sheet.nearest([])
    assert np.isinf(d).all() and (label == -1).all()


def test_boundaries_and_lines_as_sources():
    V, F = grid(8, jitter=0.2)
    sheet = surface(V, F)
    x, y = V[:, 0], V[:, 1]
    close(sheet.distance(px.Boundary(), **EXACT), np.min([x, y, 1 - x, 1 - y], axis=0))
    segment = px.Segment((0.5, 0.0, 0.0), (0.5, 1.0, 0.0))
    close(sheet.distance(segment, **EXACT), abs(x - 0.5), 1e-9)
    W, T = kuhn(4, 3)
    close(px.Solid(W, T, precision="double").distance(px.Boundary()), np.minimum(W, 1 - W).min(1))


def test_radii_cut_and_sparse_rows_agree():
    V, F = grid(8, jitter=0.2)
    sheet, D = surface(V, F), lines(V)
    d = sheet.distance(5, radius=0.4, **EXACT)
    assert (np.isfinite(d) == (D[5] <= 0.4)).all()
    close(d[np.isfinite(d)], D[5][D[5] <= 0.4])
    pytest.importorskip("scipy")
    near = sheet.near(radius=0.3, accuracy="exact")
    close(near.toarray(), np.where(D <= 0.3, D, 0))
    assert abs(near - near.T).max() < 1e-12


# -- Masks, speeds, more dimensions: what fast marching is asked.


def test_around_a_mask_and_into_nothing():
    n = 10
    V, F = grid(n)
    centre = V[F].mean(1)
    wall = (abs(centre[:, 0] - 0.45) < 0.05) & (centre[:, 1] < 0.6)  # a column, 0.4 to 0.5
    sheet = surface(V, F, mask=~wall)
    s = int(np.argmin(lines(V, np.array([[0.1, 0.2, 0]]))))
    d = sheet.distance(s, **EXACT)
    left, right = np.array([0.4, 0.6, 0]), np.array([0.5, 0.6, 0])
    start = np.linalg.norm(left - V[s])
    for v in np.flatnonzero((V[:, 0] >= 0.5) & (V[:, 1] <= 0.6)):
        close(d[v], start + 0.1 + np.linalg.norm(V[v] - right))
    inside = (abs(V[:, 0] - 0.45) < 0.04) & (V[:, 1] < 0.55)
    assert np.isinf(d[inside]).all()
    # A mask that cuts the sheet in two.
    apart = surface(V, F, mask=~(abs(centre[:, 0] - 0.45) < 0.05))
    assert (np.isinf(apart.distance(s)) == (V[:, 0] > 0.45)).all() and apart.components == 2


def test_travel_times_through_layers():
    n = 10
    V, F = grid(n)
    speed = np.where(V[F].mean(1)[:, 0] < 0.5, 1.0, 2.0)
    wave = px.Segment((0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    layered = surface(V, F, metric=px.SimplexSpeeds(speed))
    x = V[:, 0]
    close(layered.distance(wave), np.minimum(x, 0.5) + np.maximum(x - 0.5, 0) / 2, 1e-9)
    close(surface(V, F, metric=px.SimplexSpeeds(np.full(len(F), 4.0))).distance(0, **EXACT),
          np.linalg.norm(V, axis=1) / 4)


@pytest.mark.parametrize("axes", [2, 3, 4])
def test_boxes_of_any_dimension(axes):
    V, T = kuhn(3, axes)
    box = px.Simplicial(V, T, precision="double")
    close(box.distance(0), np.linalg.norm(V, axis=1))
    if axes == 3:
        D = px.Solid(V, T, precision="double").distances()
        close(D, lines(V))


# -- Graphs.


def floyd(n, E, w):
    D = np.full((n, n), np.inf)
    np.fill_diagonal(D, 0)
    for (a, b), x in zip(E, w):
        D[a, b] = D[b, a] = min(D[a, b], x)
    for k in range(n):
        D = np.minimum(D, D[:, k, None] + D[None, k])
    return D


def test_graphs_of_all_sorts():
    n = 12
    path = np.array([[i, i + 1] for i in range(n - 1)])
    index = np.arange(n)
    graph = lambda E, w=None: px.Wireframe(
        None, E, lengths=np.ones(len(E)) if w is None else w, vertices=n, precision="double")
    close(graph(path).distances(), abs(index[:, None] - index))
    ring = np.vstack([path, [[n - 1, 0]]])
    steps = abs(index[:, None] - index)
    close(graph(ring).distances(), np.minimum(steps, n - steps))
    close(graph(np.array(list(itertools.combinations(index, 2)))).distances(), 1 - np.eye(n))
    star = np.array([[0, k] for k in range(1, n)])
    close(graph(star).distances()[1], np.where(index == 1, 0, np.where(index == 0, 1, 2)))
    x, y = index % 4, index // 4
    lattice = [[a, b] for a, b in itertools.combinations(index, 2) if abs(x[a] - x[b]) + abs(y[a] - y[b]) == 1]
    close(graph(np.array(lattice)).distances(), abs(x[:, None] - x) + abs(y[:, None] - y))
    # Parallel edges, loops, edges without length, vertices without edges, two parts.
    random = np.random.default_rng(8)
    E = random.integers(0, n - 1, (20, 2))  # the last one is in none
    w = random.random(20).round(1)
    with pytest.warns(px.AccuracyWarning, match="vertex 11 is in none of the edges"):
        close(graph(E, w).distances(), floyd(n, E, w))
    assert np.isinf(graph(E, w).distance(0)[n - 1])


def test_edges_of_a_mesh_are_never_shorter_than_its_surface():
    V, F = grid(5, jitter=0.3)
    E = loose_edges(F)
    edges = px.Wireframe(V, E, precision="double").distances()
    close(edges, floyd(len(V), E, np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1)))
    assert (edges >= surface(V, F).distances(**EXACT) - 1e-12).all()


# -- Meshes that are none, or hardly.


def test_parts_points_and_pinches():
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0], [9, 9, 9], [10, 9, 9], [9, 10, 9], [5, 5, 5]], float)
    two = surface(V, [[0, 1, 2], [1, 3, 4], [5, 6, 7]])  # a pinch at 1, a part apart, 8 in none
    d = two.distance(0, **EXACT)
    close(d[:5], [0, 1, 1, 2, 1 + 2**0.5])
    assert np.isinf(d[5:]).all()
    with pytest.warns(px.AccuracyWarning, match="vertex 8 is in none of the triangles"):
        alone = two.distance(8)
    assert np.isinf(alone[:8]).all() and alone[8] == 0
    close(surface(V[:3], [[0, 1, 2]]).distances(**EXACT), lines(V[:3]))


def test_paths_have_the_length_of_distances_and_lie_on_the_surface():
    V, F = grid(6, jitter=0.2, seed=2)
    V[:, 2] = 0.3 * np.random.default_rng(1).random(len(V))
    for options in ({}, {"triangulation": "delaunay"}):
        field = surface(V, F, **options).field(0, **EXACT)
        for v in range(1, len(V), 5):
            path = field.path(v)
            close(path.length, field.distance[v], 1e-11)
            close(np.linalg.norm(np.diff(path.points, axis=0), axis=1).sum(), path.length, 1e-11)
            close(path.points[[0, -1]], V[[v, 0]], 1e-9)


# -- Features that meet.


def three_mf(file, V, F, transform):
    rows = lambda name, keys, rows: "".join(
        f"<{name} " + " ".join(f'{k}="{x}"' for k, x in zip(keys, row)) + "/>" for row in rows
    )
    model = (
        f'<model unit="millimeter"><resources><object id="1" type="model"><mesh><vertices>'
        f'{rows("vertex", "xyz", V.tolist())}</vertices><triangles>'
        f'{rows("triangle", ("v1", "v2", "v3"), F.tolist())}</triangles></mesh></object></resources>'
        f'<build><item objectid="1" transform="{transform}"/></build></model>'
    )
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("_rels/.rels", '<R><R Target="/m" Type="http://x/3dmodel"/></R>')
        archive.writestr("m", model)


@pytest.mark.parametrize("precision, rounding", [("single", 1e-6), ("double", 1e-13)])
def test_speeds_and_a_mask_on_what_a_3mf_mirrors_and_scales(tmp_path, precision, rounding):
    n = 20
    V, F = grid(n)
    three_mf(tmp_path / "a.3mf", n * V, F, "-0.5 0 0 0 0.5 0 0 0 0.5 3 1 2")
    try:
        sheet = px.read(tmp_path / "a.3mf")
    except px.NotBuilt:
        pytest.skip("no pugixml")
    X, T = np.asarray(sheet.vertices), np.asarray(sheet.simplices)
    close(X, n * V * [-0.5, 0.5, 0.5] + [3, 1, 2])
    assert np.array_equal(np.sort(T), np.sort(F))
    assert (np.cross(X[T[:, 1]] - X[T[:, 0]], X[T[:, 2]] - X[T[:, 0]])[:, 2] > 0).all()
    # Slow on the right of x = -2, where nothing is left but a strip.
    x, y = X[T].mean(axis=1)[:, :2].T
    speed, left = np.where(x < -2, 1.0, 0.5), (x < -2) | (np.abs(y - 6) < 1)
    options = dict(precision=precision, metric=px.SimplexSpeeds(speed), mask=left)
    source = int(np.argmin(np.linalg.norm(X - [-5, 3, 2], axis=1)))
    d = px.read(tmp_path / "a.3mf", **options).distance(source)
    assert np.array_equal(px.Surface(X, T, **options).distance(source), d)
    # A path enters the strip once, where that is best.
    entries = np.stack([np.full(20001, -2), np.linspace(5, 7, 20001)], axis=1)
    first = np.linalg.norm(entries - X[source, :2], axis=1)
    straight = np.linalg.norm(X - X[source], axis=1)
    open_half = X[:, 0] < -2 + 1e-9
    np.testing.assert_allclose(d[open_half], straight[open_half], rtol=rounding)
    strip = ~open_half & (np.abs(X[:, 1] - 6) < 1 + 1e-9)
    assert np.isinf(d[~open_half & ~strip]).all()
    truth = [(first + 2 * np.linalg.norm(entries - p, axis=1)).min() for p in X[strip, :2]]
    error = np.abs(d[strip] / truth - 1)
    assert error.mean() < 5e-4 and error.max() < 1.2e-2
