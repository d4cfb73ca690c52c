"""What is told of distances though nothing failed."""

import inspect
import pickle
import warnings

import numpy as np
import pytest

import plexway as px

import meshes


def squares():
    """Two squares of points in one plane, corner to corner, that no triangles join."""
    i, j = np.meshgrid(np.arange(12.0), np.arange(12.0))
    one = np.stack([i.ravel(), j.ravel(), 0 * i.ravel()], axis=1)
    return np.concatenate([one, one + [13.5, 13.5, 0]])


def strip(edges):
    """Two rows of triangles, so many edges long."""
    i = np.arange(edges + 1.0)
    V = np.stack([np.stack([i, 0 * i, 0 * i], 1), np.stack([i + 0.3, 0 * i + 1, 0 * i], 1)], 1)
    a = 2 * np.arange(edges)
    return V.reshape(-1, 3), np.concatenate(
        [np.stack([a, a + 2, a + 1], 1), np.stack([a + 2, a + 3, a + 1], 1)]
    )


def warned(call):
    """The warnings of a call, each with the line that it names."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        call()
    assert all(w.category is px.AccuracyWarning for w in told)
    return told


def test_a_doubtful_domain_warns_once_at_the_line_that_makes_it():
    assert issubclass(px.AccuracyWarning, RuntimeWarning)
    assert pickle.loads(pickle.dumps(px.AccuracyWarning("x"))).args == ("x",)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        line = inspect.currentframe().f_lineno + 1
        cloud = px.Cloud(squares())
        # Fields of it have no doubts of their own, so near to the source.
        cloud.distance(0, radius=5)
        cloud.field(0, radius=5).path(5)
        cloud.distances([0, 1], radius=5)
    assert [(w.filename, w.lineno) for w in told] == [(__file__, line)]
    assert told[0].category is px.AccuracyWarning
    text = str(told[0].message)
    assert "join parts that have no triangles between them" in text
    assert "normals=" in text and "--" not in text
    assert cloud.notes == (text,)
    assert cloud.field(0, radius=5).notes[0] == text
    # So does the one-liner, which makes one.
    told = warned(lambda: px.distance(squares(), None, 0, radius=5))
    assert len(told) == 1 and told[0].filename == __file__


def test_every_row_of_many_is_looked_at():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", px.AccuracyWarning)
        cloud = px.Cloud(squares())
    assert warned(lambda: cloud.distances([0, 287, 5], radius=5)) == []
    told = warned(lambda: cloud.distances([0, 287, 5]))
    assert len(told) == 1 and told[0].filename == __file__
    text = str(told[0].message)
    assert text.startswith("3 of 3 rows, such as row 0: ") and "farther from the source" in text


def test_a_doubtful_field_warns_at_the_line_that_solves_it():
    V, F = strip(60_000)
    single = px.Surface(V, F, triangulation="input")
    assert single.notes == ()
    asked = [
        lambda: single.distance(0),
        lambda: single.distance(0, threads=1),
        lambda: single.nearest([0, 1]),
        lambda: single.estimate(0),
        lambda: single.field(0),
    ]
    for call in asked:
        told = warned(call)
        assert {w.filename for w in told} == {__file__}
        assert sum("use precision='double'" in str(w.message) for w in told) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", px.AccuracyWarning)
        field = single.field(0)
    assert any("use precision='double'" in text for text in field.notes)
    assert warned(lambda: field.at([[3.0, 0, 0]])) == []  # once a field
    double = px.Surface(V, F, triangulation="input", precision="double")
    assert warned(lambda: double.distance(0)) == []


def test_what_is_not_reached_is_told_and_no_warning():
    V, F = meshes.grid(4)
    two = px.Surface(np.concatenate([V, V + [3, 0, 0]]), np.concatenate([F, F + len(V)]))
    assert warned(lambda: two.field(0)) == []
    field = two.field(0)
    assert field.notes == ("25 vertices not reached (inf): the surface has 2 components",)
    assert two.field([0, 30]).notes == ()
    near = two.field(0, radius=0.3)
    assert "radius= ends the search early" in near.notes[0]
    assert warned(lambda: two.distance(0, radius=0.3)) == []


def test_lengths_and_speeds_that_are_not_taken_as_given_are_told():
    sheet = [None]

    def made():
        sheet[0] = px.Surface(F=[[0, 1, 2], [0, 2, 3]], lengths=[[4, 3, 50], [50, 40, 30]])

    told = warned(made)
    assert sheet[0].notes == (str(told[0].message),)
    V, T = meshes.kuhn(4, 3)
    speeds = px.SimplexSpeeds(np.linspace(1, 2, len(T)))
    told = warned(lambda: px.Solid(V, T, metric=speeds))
    assert len(told) == 1 and "refract=False says that this is meant" in str(told[0].message)


def test_good_distances_are_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        V, F = meshes.sphere(20)
        surface = px.Surface(V, F)
        surface.distance(0)
        surface.distances([0, 1, 2])
        assert surface.notes == surface.field(0).notes == ()
        cloud = px.Cloud(V)
        cloud.distance(0)
        assert cloud.notes == cloud.field(0).notes == ()


def test_points_that_are_dropped_keep_their_number(tmp_path):
    file = tmp_path / "holes.pcd"
    V, _ = meshes.grid(12)
    rows = [" ".join(map(str, v)) for v in V.tolist()]
    rows.insert(5, "nan nan nan")
    head = f"""VERSION .7
FIELDS x y z
SIZE 4 4 4
TYPE F F F
COUNT 1 1 1
WIDTH {len(rows)}
HEIGHT 1
VIEWPOINT 0 0 0 1 0 0 0
POINTS {len(rows)}
DATA ascii
"""
    file.write_text(head + "\n".join(rows) + "\n")
    try:
        cloud = px.read(file)
    except px.NotBuilt:
        pytest.skip("this build has no PCL")
    assert cloud.vertex_count == len(V)
    assert any("`original` has their numbers" in text for text in cloud.notes)
    assert cloud.original[4] == 4 and cloud.original[5] == 6
    assert px.Cloud(V).original is None


def test_a_loop_over_sources_warns_once():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", px.AccuracyWarning)
        cloud, other, third = (px.Cloud(squares()) for _ in range(3))

    def all_of(domain):
        for source in range(0, 288, 40):
            domain.distance(source)

    assert len(warned(lambda: all_of(cloud))) == 1
    assert warned(lambda: all_of(cloud)) == []
    assert len(warned(lambda: all_of(other))) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error", px.AccuracyWarning)
        for _ in range(2):
            with pytest.raises(px.AccuracyWarning):
                all_of(third)
