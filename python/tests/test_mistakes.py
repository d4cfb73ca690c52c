"""The likely mistakes of docs/mistakes.md, made: each answer is the one that the page has."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import plexway as px

TOOL = os.environ.get("PLEXWAY_TOOL")
SOURCE = Path(os.environ.get("PLEXWAY_SOURCE_DIR", Path(__file__).parents[2]))
KNOT = "knot.ply"
V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)
Q = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
F = np.vstack((Q[:, [0, 1, 2]], Q[:, [0, 2, 3]]))
FILES = {
    "seam.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n",
    "loose.obj": "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n",
}

# What was done, by what the page's row has: words for the tool, or a call.
MADE = {
    "-s 0`": ["distance", KNOT, "-s", "0"],
    "-s vertex:5120": ["distance", KNOT, "-s", "vertex:5120"],
    "--out dist": ["distance", KNOT, "-s", "vertex:0", "--out", "dist"],
    "plexway path knot.ply": ["path", KNOT, "-s", "vertex:0"],
    "--source all": ["pairs", KNOT, "--source", "all"],
    "0,0,1700": ["distance", KNOT, "-s", "point:0,0,1700"],
    "A seam": ["distance", "seam.obj", "-s", "vertex:0"],
    "in no triangle": ["distance", "loose.obj", "-s", "vertex:0"],
    "plexway.domain(V, Q)": lambda: px.domain(V, Q),
    "distance([[0, 1]])": lambda: px.Surface(V, F).distance([[0, 1]]),
    "Lengths of edges": lambda: px.Surface(None, [[0, 1, 2], [1, 3, 2]], lengths=[[1, 1, 1], [1, 1, 1.5]]),
}


def rows():
    text = (SOURCE / "docs" / "mistakes.md").read_text()
    return [line.strip("|").split(" | ") for line in text.splitlines() if line.startswith("| ")][1:]


@pytest.mark.parametrize("mistake", MADE)
def test_answer(mistake, tmp_path):
    (row,) = [row for row in rows() if mistake in row[0]]
    kept = re.search("`(.*)`", row[1]).group(1)
    made = MADE[mistake]
    if callable(made):
        with pytest.raises(ValueError) as caught:
            made()
        answer = str(caught.value)
    else:
        if not TOOL:
            pytest.skip("PLEXWAY_TOOL is not set")
        for name, text in FILES.items():
            (tmp_path / name).write_text(text)
        (tmp_path / KNOT).symlink_to(SOURCE / "data" / KNOT)
        answer = subprocess.run([TOOL, *made], cwd=tmp_path, text=True, capture_output=True).stderr
    assert re.search(".*".join(map(re.escape, kept.split("..."))), answer), answer


def test_what_was_meant():
    assert len(rows()) == 13 and len(MADE) == 11
    sheet = px.Surface(V, F)
    with pytest.raises(IndexError):
        sheet.distance(len(V))
    with pytest.warns(px.AccuracyWarning, match="from the domain"):
        sheet.distance(np.array([17.0, 3.0, 200.0]))
    a, b = sheet.distances([0, 5])
    assert np.array_equal(sheet.distance([0, 5]), np.minimum(a, b))
