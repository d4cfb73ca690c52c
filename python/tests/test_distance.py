"""Distances against closed forms, on every kind of domain."""

import pickle

import meshes
import numpy as np
import pytest

import plexway as px


def straight(V, at):
    return np.linalg.norm(np.asarray(V, float) - np.asarray(at, float), axis=1)


@pytest.mark.parametrize(
    "precision, accuracy, bound",
    [
        ("single", "fast", 2e-6),
        ("double", "fast", 1e-9),
        ("double", "exact", 1e-9),
        ("single", None, 2e-4),
        ("double", None, 2e-4),
    ],
)
def test_flat_surface(precision, accuracy, bound):
    V, F = meshes.grid(30, jitter=0.2)
    d = px.distance(V, F, 17, precision=precision, accuracy=accuracy)
    assert d.dtype == (np.float32 if precision == "single" else np.float64)
    assert np.abs(d - straight(V, V[17])).max() < bound


def test_accuracy():
    # Around a hole: exact distances are those of the straight lines that bend at its corners.
    n = 40
    V, F = meshes.grid(n)
    centre = V[F].mean(axis=1)
    hole = np.abs(centre[:, :2] - [0.5, 0.5]).max(axis=1) < 0.2
    sheet = px.Surface(V, F, mask=~hole)
    used = np.unique(F[~hole])
    corners = np.array([[0.3, 0.3], [0.3, 0.7], [0.7, 0.3], [0.7, 0.7]])

    def free(a, b):
        t = np.linspace(0, 1, 4001)[:, None]
        return not (np.abs(a + t * (b - a) - 0.5).max(axis=1) < 0.2 - 1e-6).any()

    P = np.concatenate([V[used, :2], corners])
    graph = np.full((4, 4), np.inf)
    for i in range(4):
        for j in range(4):
            if free(corners[i], corners[j]):
                graph[i, j] = np.linalg.norm(corners[i] - corners[j])
    start = np.array([0.1, 0.45])
    first = np.array([np.linalg.norm(c - start) if free(start, c) else np.inf for c in corners])
    for _ in range(4):
        first = np.minimum(first, (first[:, None] + graph).min(axis=0))
    some = np.random.default_rng(0).choice(len(used), 150, replace=False)
    truth = []
    for p in P[some]:
        ways = [first[k] + np.linalg.norm(p - corners[k]) for k in range(4) if free(p, corners[k])]
        truth.append(min(ways + [np.linalg.norm(p - start)] * free(p, start)))
    truth, at = np.array(truth), [*start, 0.0]
    bounds = {"exact": 1e-6, "accurate": 1e-3, "fast": 5e-2}
    for accuracy, bound in bounds.items():
        d = sheet.distance(at, accuracy=accuracy)[used[some]]
        assert np.abs(d - truth).max() < bound * np.sqrt(2)
        assert d.dtype == (np.float64 if accuracy == "exact" else np.float32)
    assert np.array_equal(sheet.distance(at), sheet.distance(at, accuracy="accurate"))
    for labels in ({"visibility": "centroid"}, {"visibility": "upper_bound"}):
        known = sheet.distance(at, **labels)
        assert np.array_equal(known, sheet.distance(at, accuracy="fast", **labels))
        with pytest.raises(px.UsageError, match="visibility"):
            sheet.distance(at, accuracy="accurate", **labels)
    d, error = sheet.estimate(at, accuracy="exact")
    assert np.all(error == 0) and np.array_equal(d, sheet.distance(at, accuracy="exact"))
    d, error = sheet.estimate(at)
    assert error.shape == (len(V),) and np.all(error >= 0)
    off = np.abs(d[used[some]] - truth)
    assert (off <= error[used[some]] + 1e-6).mean() > 0.9


def test_a_point_and_a_segment_on_a_surface():
    V, F = meshes.grid(30, jitter=0.2)
    at = [0.237, 0.581, 0]
    assert np.abs(px.distance(V, F, at, accuracy="fast") - straight(V, at)).max() < 3e-6
    assert np.abs(px.distance(V, F, at) - straight(V, at)).max() < 2e-4
    for points in ([[0.0, 0, 0], [1, 1, 0]], np.array([[0.0, 0], [1, 1]]), ([0.0, 0, 0], (1, 1, 0))):
        truth = np.minimum(straight(V, [0, 0, 0]), straight(V, [1, 1, 0]))
        assert np.abs(px.distance(V, F, points, accuracy="fast") - truth).max() < 3e-6
        assert np.abs(px.distance(V, F, points) - truth).max() < 2e-4
        assert px.Surface(V, F).field(0).at(points) == pytest.approx([0, np.sqrt(2)], abs=1e-6)
    a, b = np.array([0.21, 0.33, 0]), np.array([0.74, 0.52, 0])
    d = px.distance(V, F, px.Segment(a, b))
    along = np.clip((V - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    truth = np.linalg.norm(V - (a + along[:, None] * (b - a)), axis=1)
    assert d.dtype == np.float64
    assert np.abs(d - truth).max() < 1e-4


def test_sets_offsets_and_truth_values():
    V, F = meshes.grid(20, jitter=0.2)
    sheet = px.Surface(V, F, precision="double")
    chosen = np.array([3, 77, 200])
    offsets = np.array([0.1, 0.0, 0.25])
    each = np.array([straight(V, V[v]) for v in chosen])
    mask = np.zeros(len(V), bool)
    mask[chosen] = True
    for source in (chosen, chosen.tolist(), mask, px.Vertices(chosen), tuple(chosen.tolist())):
        assert np.abs(sheet.distance(source) - each.min(axis=0)).max() < 1e-6
    d = sheet.distance(px.Vertices(chosen, offsets))
    assert np.abs(d - (each + offsets[:, None]).min(axis=0)).max() < 1e-6
    d, label = sheet.nearest([px.Vertex(int(v), o) for v, o in zip(chosen, offsets)])
    assert np.abs(d - (each + offsets[:, None]).min(axis=0)).max() < 1e-6
    gap = np.sort(each + offsets[:, None], axis=0)
    clear = gap[1] - gap[0] > 1e-3
    assert np.array_equal(label[clear], (each + offsets[:, None]).argmin(axis=0)[clear])


def test_ball_boundary_and_whole_simplex():
    V, F = meshes.grid(20, jitter=0.2)
    sheet = px.Surface(V, F, precision="double")
    d = sheet.distance(px.Ball(0, 0.3))
    assert np.abs(d - np.abs(straight(V, V[0]) - 0.3)).max() < 1e-6
    d = sheet.distance(px.Boundary())
    truth = np.minimum.reduce([V[:, 0], 1 - V[:, 0], V[:, 1], 1 - V[:, 1]])
    assert np.abs(d - truth).max() < 1e-5
    d = sheet.distance(px.WholeSimplex(99))
    assert np.all(d[F[99]] == 0) and d.max() > 0.5


def test_sphere_falls_with_refinement():
    errors = []
    for n in (10, 20, 40):
        V, F = meshes.sphere(n)
        truth = np.arccos(np.clip(V[:, 2], -1, 1))
        error = truth - px.distance(V, F, 0)
        # Chords along the meridian are a way, and shorter than the arc.
        assert error.min() > -1e-6
        errors.append(error.max())
    assert errors[0] < 0.02 * np.pi
    assert errors[1] < errors[0] / 3 and errors[2] < errors[1] / 3


def test_solid():
    V, T = meshes.kuhn(6, 3)
    for source in (0, 100):
        assert np.abs(px.distance(V, T, source) - straight(V, V[source])).max() < 1e-5


@pytest.mark.parametrize("axes, n", [(1, 9), (2, 6), (3, 4), (4, 2)])
def test_simplices(axes, n):
    V, S = meshes.kuhn(n, axes)
    d = px.Simplicial(V, S, precision="double").distance(1)
    assert np.abs(d - straight(V, V[1])).max() < 1e-9
    if axes == 4:
        assert np.abs(px.distance(V, S, 1) - straight(V, V[1])).max() < 1e-5


def test_lengths_alone():
    V, F = meshes.grid(12, jitter=0.2)
    lengths = np.linalg.norm(V[F] - V[F[:, [1, 2, 0]]], axis=2)
    sheet = px.Surface(F=F, lengths=lengths, precision="double")
    assert sheet.vertices is None
    assert np.abs(sheet.distance(5) - straight(V, V[5])).max() < 1e-6


def test_cloud():
    V, F = meshes.grid(40)
    try:
        d = px.distance(V, None, 0)
    except px.NotBuilt:
        pytest.skip("no FLANN in this build")
    assert np.abs(d - straight(V, V[0])).max() < 1e-2


def test_mixed():
    V, T = meshes.kuhn(4, 3)
    W = np.array([[0.0, 0, 0], [-1, 0, 0], [-2, 0, 0]])
    both = px.Mixed([(V, T), (W, [[0, 1], [1, 2]])], precision="double")
    d = both.distance(len(V) + 2)
    assert np.abs(d[: len(V)] - (2 + straight(V, [0, 0, 0]))).max() < 1e-9
    assert np.allclose(d[len(V) :], [2, 1, 0])


def test_metrics():
    V, F = meshes.grid(20, jitter=0.2)
    M = np.array([[4.0, 1, 0], [1, 2, 0], [0, 0, 1]])
    truth = np.sqrt(np.einsum("ni,ij,nj->n", V - V[0], M, V - V[0]))
    for metric in (
        px.SimplexTensors(np.tile(M, (len(F), 1, 1))),
        px.VertexTensors(np.tile(M, (len(V), 1, 1))),
        lambda at: M,
    ):
        d = px.distance(V, F, 0, metric=metric, precision="double")
        assert np.abs(d - truth).max() < 1e-6
    d = px.distance(V, F, 0, metric=px.SimplexSpeeds(np.full(len(F), 2.0)), precision="double")
    assert np.abs(d - straight(V, V[0]) / 2).max() < 1e-6
    E = meshes.loose_edges(F)
    lengths = px.EdgeLengths(E, 3 * np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1))
    d = px.distance(V, F, 0, metric=lengths, precision="double")
    assert np.abs(d - 3 * straight(V, V[0])).max() < 1e-6


def test_masks_by_labels_and_regions(tmp_path):
    n = 12
    V, F = meshes.grid(n)
    labels = np.where(np.abs(V[:, 0] - 0.5) < 0.06, np.where(V[:, 1] < 0.7, 3, 7), 0)
    wall = (labels == 3)
    assert wall.any() and (labels == 7).any()
    file = tmp_path / "parcels.txt"
    np.savetxt(file, labels, fmt="%d")
    assert np.array_equal(px.read_labels(file, len(V)), labels)
    truth = px.Surface(V, F, mask=~wall).distance(0)
    assert np.isinf(truth[wall]).all()
    assert np.array_equal(px.Surface(V, F, mask=f"{file}:3").distance(0), truth)
    both = px.distance(V, F, 0, mask=f"{file}:3,7")
    assert np.isinf(both[V[:, 0] > 0.6]).all()

    mesh = tmp_path / "sheet.vtk"
    cells = "\n".join("3 %d %d %d" % tuple(f) for f in F)
    region = np.where(V[F].mean(axis=1)[:, 0] < 0.5, 4, 9)
    mesh.write_text(
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
        f"POINTS {len(V)} double\n"
        + "\n".join("%.17g %.17g %.17g" % tuple(np.append(v, 0)[:3]) for v in V)
        + f"\nCELLS {len(F)} {4 * len(F)}\n{cells}\nCELL_TYPES {len(F)}\n" + "5\n" * len(F)
        + f"CELL_DATA {len(F)}\nSCALARS region int 1\nLOOKUP_TABLE default\n"
        + "\n".join(map(str, region)) + "\n"
    )
    read = px.read(mesh, mask=f"{file}:3")
    assert np.array_equal(read.distance(0), truth)
    left = px.read(mesh, mask="regions:9", precision="double")
    assert np.array_equal(
        left.distance(0), px.Surface(V, F, mask=region == 4, precision="double").distance(0)
    )
    for wrong, error, text in (
        (f"{file}:8", px.InputError, "nothing has the label 8"),
        (f"{file}", ValueError, "FILE:3,7"),
        ("regions:5", px.InputError, "region 5"),
        (tmp_path.name, ValueError, "FILE:3,7"),
    ):
        with pytest.raises(error, match=text):
            px.read(mesh, mask=wrong)
    cloud = tmp_path / "c.xyz"
    np.savetxt(cloud, np.random.default_rng(1).random((60, 3)))
    with pytest.raises((px.UsageError, px.NotBuilt)):
        px.read(cloud, mask=f"{file}:3")
    closed = tmp_path / "closed.txt"
    np.savetxt(closed, np.flatnonzero(wall), fmt="%d")
    assert np.array_equal(px.read(mesh, mask=f"vertices:{closed}").distance(0), truth)


def test_sources_behind_a_mask_are_refused():
    V, F = meshes.grid(6)
    closed = np.zeros(len(V), bool)
    closed[7] = True
    sheet = px.Surface(V, F, mask=~closed)
    for call in (
        lambda: sheet.distance(7),
        lambda: sheet.distance([0, 7]),
        lambda: sheet.nearest(px.Vertices([7])),
        lambda: sheet.field(7),
        lambda: sheet.distances([0, 7]),
        lambda: sheet.near(7, radius=1.0),
        lambda: sheet.path(7, 0),
        lambda: sheet.farthest(3, start=7),
        lambda: sheet.cvt([0, 7]),
    ):
        with pytest.raises(px.UsageError, match="vertex 7 is masked"):
            call()
    assert sheet.near([], radius=1.0).dtype == np.float64
    assert sheet.distances([0], accuracy="exact").dtype == np.float64
    # All vertices as rows are all of them.
    rows = sheet.distances()
    assert np.isinf(np.delete(rows[7], 7)).all() and rows[7, 7] == 0
    assert sheet.near(radius=1.0).shape == (len(V), len(V))


def test_mask():
    # A wall in the middle of the sheet with a gap at the top: the way bends once at its corner.
    n = 20
    V, F = meshes.grid(n)
    centre = V[F].mean(axis=1)
    wall = (np.abs(centre[:, 0] - 0.5) < 0.05) & (centre[:, 1] < 0.5)
    sheet = px.Surface(V, F, mask=~wall, precision="double")
    target = int(np.argmin(straight(V, [1, 0, 0])))
    corners = np.array([[0.45, 0.5, 0], [0.55, 0.5, 0]])
    truth = np.hypot(0.45, 0.5) + 0.1 + np.hypot(0.45, 0.5)
    assert corners[1, 0] - corners[0, 0] == pytest.approx(0.1)
    field = sheet.field(0)
    assert field.distance[target] == pytest.approx(truth, abs=1e-6)
    inside = int(np.argmin(straight(V, [0.5, 0.2, 0])))
    assert np.isinf(field.distance[inside])
    # Triangles keep the numbers that they had.
    path = field.path(target)
    assert path.length == pytest.approx(truth, abs=1e-6)
    assert not wall[path.simplices].any()
    where = np.einsum("pk,pkx->px", path.barycentric[:, :3], V[F[path.simplices]])
    assert np.abs(where - path.points).max() < 1e-9
    gradient = field.gradient()
    assert gradient.shape == (len(F), 3)
    assert np.all(gradient[wall] == 0)
    free = np.flatnonzero(~wall)[7]
    assert np.all(sheet.distance(px.Point(int(free), [1 / 3] * 3))[F[free]] < 0.05)
    with pytest.raises(px.UsageError, match="mask"):
        sheet.distance(px.Point(int(np.flatnonzero(wall)[0]), [1, 0, 0]))
    # By vertices: a triangle stays if all its corners do.
    keep = V[:, 0] < 0.45 + 1e-9
    d = px.distance(V, F, 0, mask=keep)
    assert np.all(np.isfinite(d) == keep)


def test_mask_and_the_callers_numbers():
    # The left half of a sheet is closed: triangles that are left do not begin at 0.
    V, F = meshes.grid(10)
    left = (V[F][:, :, 0] > 0.5 - 1e-9).all(axis=1)
    sheet = px.Surface(V, F, mask=left, precision="double", triangulation="input")
    assert np.array_equal(sheet.simplices, F[left])
    assert sheet.info()["simplices"] == left.sum()
    # What a metric says of triangles that are left out does not matter.
    speeds = np.where(left, 2.0, 7.0)
    fast = px.Surface(V, F, mask=left, metric=px.SimplexSpeeds(speeds), precision="double")
    corner = int(np.argmin(straight(V, [1, 0, 0])))
    inside = np.isfinite(sheet.distance(corner))
    assert np.array_equal(np.flatnonzero(inside), np.unique(F[left]))
    assert np.abs(2 * fast.distance(corner) - straight(V, [1, 0, 0]))[inside].max() < 1e-9
    # The closest point is one that is open.
    at = sheet.closest([0.1, 0.25, 0])
    assert left[at.simplices[at.simplices >= 0]].all()
    assert at.positions[0] == pytest.approx([0.5, 0.25, 0])
    inner = sheet.closest([0.83, 0.41, 0])
    assert left[inner.simplices[0]] and inner.positions[0] == pytest.approx([0.83, 0.41, 0])
    # Lines, rims, samples and level sets.
    d = sheet.distance(px.Segment([0.6, 0.55, 0], [0.9, 0.55, 0]))
    assert d[corner] == pytest.approx(np.hypot(0.1, 0.55), abs=1e-9)
    rim = sheet.distance(px.Boundary())
    truth = np.minimum.reduce([V[:, 0] - 0.5, 1 - V[:, 0], V[:, 1], 1 - V[:, 1]])
    assert np.abs(rim - truth)[inside].max() < 1e-9
    disks = sheet.poisson(0.2)
    assert left[disks.points.simplices[disks.points.simplices >= 0]].all()
    assert np.all(disks.points.positions[:, 0] > 0.5 - 1e-9)
    cells = sheet.cvt(3, iterations=2)
    assert left[cells.seeds.simplices[cells.seeds.simplices >= 0]].all()
    assert len(cells.label) == len(F) and np.array_equal(cells.label >= 0, left)
    for line in sheet.isolines(V[:, 0], 0.71):
        assert left[line.simplices].all()
        where = np.einsum("pk,pkx->px", line.barycentric[:, :3], V[F[line.simplices]])
        assert np.abs(where - line.points).max() < 1e-9


def test_unreached_is_inf_and_radius():
    V, F = meshes.grid(10)
    two = np.concatenate([V, V + [3, 0, 0]])
    faces = np.concatenate([F, F + len(V)])
    d = px.distance(two, faces, 0)
    assert np.all(np.isinf(d[len(V) :])) and np.all(np.isfinite(d[: len(V)]))
    assert not np.isnan(d).any()
    label = px.Surface(two, faces).nearest([0])[1]
    assert np.all(label[: len(V)] == 0) and np.all(label[len(V) :] == -1)
    d = px.distance(V, F, 0, radius=0.5)
    truth = straight(V, V[0])
    assert np.all(np.isinf(d[truth > 0.5 + 1e-6])) and np.all(np.isfinite(d[truth < 0.5 - 1e-6]))


def test_rows_are_fields():
    V, F = meshes.sphere(16)
    ball = px.Surface(V, F)
    chosen = [0, 5, 99, 200]
    rows = ball.distances(chosen)
    assert rows.shape == (4, len(V)) and rows.dtype == np.float32
    for threads in (0, 1, 2, 3):
        assert np.array_equal(ball.distances(chosen, threads=threads), rows)
    for row, source in zip(rows, chosen):
        assert np.array_equal(row, ball.distance(source))
    assert np.array_equal(ball.distances()[chosen], rows)
    assert np.array_equal(ball.distances([px.Vertices([0, 5]), 99])[0], ball.distance([0, 5]))


def test_near():
    pytest.importorskip("scipy.sparse")
    V, F = meshes.grid(20, jitter=0.2)
    for domain in (
        px.Surface(V, F, precision="double"),
        px.Wireframe(V, meshes.loose_edges(F), precision="double"),
    ):
        truth = domain.distances(accuracy="fast")
        found = domain.near(radius=0.2, accuracy="fast")
        assert found.shape == truth.shape
        inside = np.zeros(truth.shape, bool)
        inside[found.nonzero()] = True
        inside[np.arange(len(V)), np.arange(len(V))] = True
        assert np.all(inside[truth < 0.2 - 1e-9]) and not inside[truth > 0.2 + 1e-9].any()
        dense = found.toarray()
        assert np.abs(dense[inside] - truth[inside]).max() < 1e-9
        rows = [5, 99]
        few = domain.near(rows, count=7, columns=np.arange(0, len(V), 3), accuracy="fast")
        assert few.shape == (2, len(range(0, len(V), 3)))
        for k, row in enumerate(rows):
            entries = np.sort(few.data[few.indptr[k] : few.indptr[k + 1]])
            assert np.abs(entries - np.sort(truth[row, ::3])[:7]).max() < 1e-9
    with pytest.raises(ValueError, match="radius"):
        domain.near()


def test_paths_and_read_out():
    V, F = meshes.grid(30, jitter=0.2)
    sheet = px.Surface(V, F)
    field = sheet.field([0, len(V) - 1])
    start = np.array([0.31, 0.44, 0])
    path = field.path(start)
    assert path.source == 0
    assert path.length == pytest.approx(np.linalg.norm(start), rel=1e-6)
    assert np.linalg.norm(path.points[0] - start) < 1e-9
    assert np.linalg.norm(path.points[-1] - V[0]) < 1e-9
    steps = np.linalg.norm(np.diff(path.points, axis=0), axis=1).sum()
    assert steps == pytest.approx(path.length, rel=1e-9)
    asked = np.random.default_rng(1).uniform(0, 1, (200, 3)) * [1, 1, 0]
    truth = np.minimum(np.linalg.norm(asked, axis=1), np.linalg.norm(asked - [1, 1, 0], axis=1))
    assert np.abs(field.at(asked) - truth).max() < 2e-4
    labels = sheet.field([0, len(V) - 1], accuracy="fast")
    assert np.abs(labels.at(asked) - truth).max() < 1e-5
    assert np.array_equal(sheet.path(0, 40).points, sheet.field(0).path(40).points)
    centre = V[F].mean(axis=1)
    truth = centre / np.linalg.norm(centre, axis=1)[:, None]
    outside = ~(F == 0).any(axis=1)
    for triangulation in ("input", "delaunay"):
        twice = px.Surface(V, F, precision="double", triangulation=triangulation)
        for accuracy in ("fast", "accurate", "exact"):
            away = twice.field(0, accuracy=accuracy).gradient()
            assert np.abs(away - truth)[outside].max() < 1e-9


def test_isolines_and_isosurfaces():
    V, F = meshes.grid(40)
    lines = px.Surface(V, F).isolines(V[:, 0], [0.31, 0.77])
    assert sorted({line.source for line in lines}) == [0, 1]
    for line in lines:
        assert np.abs(line.points[:, 0] - [0.31, 0.77][line.source]).max() < 1e-12
        assert line.length == pytest.approx(1)
    try:
        sheet = px.Cloud(V)
    except px.NotBuilt:
        sheet = None
    if sheet is not None:  # straight in the triangles of its sheet, numbers rounded to single
        lines = sheet.isolines(V[:, 0], [0.31, 0.77])
        assert sorted({line.source for line in lines}) == [0, 1]
        for line in lines:
            assert np.abs(line.points[:, 0] - [0.31, 0.77][line.source]).max() < 1e-6
            assert line.length == pytest.approx(1, abs=1e-5)
    V, T = meshes.kuhn(5, 3)
    found = px.Solid(V, T).isosurfaces(V[:, 2], 0.43)
    assert np.abs(found.positions[:, 2] - 0.43).max() < 1e-12
    p = found.positions[found.triangles]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2
    assert area == pytest.approx(1)


def test_samples():
    V, F = meshes.grid(30, jitter=0.2)
    sheet = px.Surface(V, F)
    disks = sheet.poisson(0.1)
    p = disks.points.positions
    apart = np.linalg.norm(p[:, None] - p[None], axis=2) + np.eye(len(p))
    assert apart.min() > 0.1 * (1 - 2e-3) and disks.maximal
    assert np.array_equal(p, sheet.poisson(0.1).points.positions)
    assert sheet.distance(list(disks.points)).max() < 0.1 * (1 + 1e-3)
    assert len(sheet.poisson(count=30).points) == 30
    far = sheet.farthest(5, start=0)
    corners = {0, 30, 31 * 30, 31 * 31 - 1}
    assert corners <= set(far.points.vertices.tolist())
    assert far.distance[1] == pytest.approx(np.sqrt(2), rel=1e-5)
    cells = sheet.cvt(12, iterations=30)
    assert cells.label.shape == (len(F),) and cells.label.min() == 0
    assert cells.content.sum() == pytest.approx(1, rel=1e-5)
    assert cells.energy[-1] < cells.energy[0]
    centre = sheet.closest([[0.5, 0.5, 2.0], [0, 0, 0]])
    assert np.allclose(centre.positions, [[0.5, 0.5, 0], [0, 0, 0]])


def test_kinds_by_name_and_info():
    V, F = meshes.grid(4)
    E = meshes.loose_edges(F)
    assert isinstance(px.domain(V, F), px.Surface)
    assert isinstance(px.domain(V, E), px.Wireframe)
    assert isinstance(px.domain(V[:, :2], F, kind="simplices"), px.Simplicial)
    told = px.Surface(V, F).info()
    assert told["kind"] == "surface" and told["vertices"] == 25 and told["simplices"] == 32
    assert told["components"] == 1 and told["bytes"] > 0
    assert np.array_equal(told["bounds"][1], [1, 1, 0])
    assert repr(px.Surface(V, F)) == "plexway.Surface(25 vertices, 32 triangles)"
    assert repr(px.Wireframe([[0, 0], [1, 0]], [[0, 1]])) == "plexway.Wireframe(2 vertices, 1 edge)"


def test_speeds_that_jump_in_a_solid_refract():
    V, T = meshes.kuhn(6, 3)
    speed = np.where(V[T].mean(axis=1)[:, 2] < 0.5, 1.0, 2.0)
    source = int(np.argmin(np.linalg.norm(V - [0, 0.5, 0], axis=1)))
    x = np.hypot(V[:, 0] - V[source, 0], V[:, 1] - V[source, 1])[:, None]
    above, s = V[:, 2] > 0.5, np.linspace(0, 1, 20001)[None]
    truth = np.min(np.hypot(s * x, 0.5) + np.hypot(x - s * x, V[:, 2:] - 0.5) / 2, axis=1)
    solid = px.Solid(V, T, metric=px.SimplexSpeeds(speed), precision="double")
    d = solid.distance(source)
    off = np.abs(d / truth - 1)[above]
    assert off.mean() < 1e-4 and off.max() < 2e-2
    # The mean of both sides is another metric, so it must be asked for.
    mean = px.Solid(V, T, metric=px.SimplexSpeeds(speed, refract=False), precision="double")
    assert np.abs(mean.distance(source) / truth - 1)[above].mean() > 1e-3
    with pytest.warns(RuntimeWarning, match="64 speeds"):
        px.Solid(V, T, metric=px.SimplexSpeeds(np.linspace(1, 2, len(T))))
    # Paths are refracted as well, and a copy by pickle knows the speeds.
    for target in np.flatnonzero(above)[::20]:
        assert solid.path(source, int(target)).length == pytest.approx(truth[target], rel=1e-6)
    again = pickle.loads(pickle.dumps(solid))
    assert np.array_equal(again.distance(source), d)
