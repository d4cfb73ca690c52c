"""What may be meant in two ways is refused, or said."""

import warnings

import numpy as np
import pytest

import meshes
import plexway as px


def test_quads_are_no_tetrahedra():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)
    quads = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
    with pytest.raises(px.InputError, match=r"2 tetrahedra are flat.*\(0, 1, 2\) and \(0, 2, 3\)"):
        px.domain(V, quads)
    triangles = np.vstack((quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]))
    assert px.distance(V, triangles, 0) == pytest.approx(np.linalg.norm(V, axis=1))
    # Bent quads are not flat, but share edges alone.
    V[4:, 2] = 0.3, 0.6
    V[0, 2] = 0.2
    with pytest.warns(px.AccuracyWarning, match="share a face; if they are quads"):
        px.domain(V, quads)


def test_two_lengths_for_one_edge():
    F = [[0, 1, 2], [1, 3, 2]]
    for at, L in ((1.5, [[1, 1, 1], [1, 1, 1.5]]), (1, [[1, 1, 1], [1, 1, 1 + 1e-7]])):
        if at > 1:
            with pytest.raises(px.InputError, match="edge 1 - 2 .* 1 in one .* 1.5 in another"):
                px.Surface(None, F, lengths=L)
        else:
            px.Surface(None, F, lengths=L)
    with pytest.raises(px.InputError, match="edge"):
        px.Solid(None, [[0, 1, 2, 3], [4, 1, 2, 3]], lengths=[[1] * 6, [1, 1, 1.5, 1, 1, 1]])


def test_integers_in_rows_are_no_points():
    V, F = meshes.grid(6)
    sheet = px.Surface(V, F)
    for source in ([[0, 1]], [[0, 1, 2]], np.array([[3, 4, 5], [6, 7, 8]])):
        with pytest.raises(ValueError, match=r"vertices are one row.*points are floats"):
            sheet.distance(source)
    assert np.array_equal(sheet.distance([0, 1]), sheet.distance(np.array([0, 1])))
    assert sheet.distance([[0.0, 0.0]])[0] == 0
    bent = px.Surface(V + [0, 0, 1] * V[:, :1], F)
    with pytest.raises(ValueError, match="two coordinates"):
        bent.distance([[0.5, 0.5]])


def test_near_is_as_accurate_as_all_else():
    V, F = meshes.grid(12, jitter=0.2)
    V = V + 0.3 * np.random.default_rng(2).uniform(size=len(V))[:, None] * [0, 0, 1]
    sheet = px.Surface(V, F)
    whole = sheet.distances()
    pytest.importorskip("scipy")
    near = sheet.near(radius=0.4).toarray()
    reached = near > 0
    assert np.array_equal(reached, (whole > 0) & (whole <= 0.4))
    off = np.abs(near[reached] / whole[reached] - 1)  # windows end at the radius: others are merged
    assert off.mean() < 1e-5 and off.max() < 1e-3
    few = sheet.near([5], count=9)
    assert np.sort(few.data) == pytest.approx(np.sort(whole[5])[:9], rel=1e-6)


def test_points_far_off_are_said():
    V, F = meshes.grid(6)
    sheet = px.Surface(V, F)
    with pytest.warns(px.AccuracyWarning, match="is 1700 from the domain"):
        sheet.distance([0.5, 0.5, 1700.0])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sheet.distance([0.5, 0.5, 0.01])
        found = sheet.closest([[0.5, 0.5, 1700.0]])  # who asks for the closest means it
    assert np.linalg.norm(found.positions - [0.5, 0.5, 1700.0], axis=1) == pytest.approx([1700.0])


def test_a_path_that_does_not_exist_has_no_points():
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]], float)
    parts = [[0, 1, 2], [3, 4, 5]]
    for domain in (px.Surface(V, parts), px.Wireframe(V, [[0, 1], [1, 2], [3, 4], [4, 5]])):
        path = domain.path(0, 4)
        assert path.points.shape == (0, 3) and len(path) == 0 and path.length == np.inf
        assert np.diff(path.points, axis=0).shape == (0, 3)
    by_lengths = px.Surface(None, parts, lengths=[[1, 1, 1], [1, 1, 1]])
    assert by_lengths.path(0, 4).points is None


def test_what_is_out_of_range_is_an_index_error():
    V, F = meshes.grid(3)
    for source in (len(V), -1, [0, len(V)], px.Point(len(F), (1, 0, 0))):
        with pytest.raises(IndexError, match="counted from 0"):
            px.distance(V, F, source)
        with pytest.raises(px.UsageError):
            px.distance(V, F, source)


def test_one_place_is_no_row_of_vertices():
    V, F = meshes.grid(6)
    sheet = px.Surface(V, F)
    for wrong in ([1, 2], [1, 2, 0], np.array([3])):
        for path in (sheet.field(0).path, lambda at: sheet.path(0, at), lambda at: sheet.path(0, at, astar=True)):
            with pytest.raises(ValueError, match=r"paths\(\[1, 2\]\)"):
                path(wrong)
    assert [w.length for w in sheet.field(0).paths([1, 2])] == [sheet.path(0, v).length for v in (1, 2)]
    assert sheet.path(0, [1.0, 0.0, 0.0]).length == pytest.approx(1)


def test_faces_of_other_packages():
    V, F = meshes.grid(6)
    counted = np.c_[np.full(len(F), 3), F]
    for wrong, hint in (
        (counted, r"F\[:, 1:\]"),
        (counted.ravel(), r"reshape\(-1, 4\)\[:, 1:\]"),
        ([[0, 1, 8, 7]], "two triangles each"),
    ):
        with pytest.raises(ValueError, match=hint):
            px.Surface(V, wrong)
    assert len(px.Surface(V, counted[:, 1:]).distance(0)) == len(V)
