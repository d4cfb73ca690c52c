"""The Python package of the .deb does what README.md says:

    python3 tests/package.py DATA
"""

import sys
from importlib.metadata import requires, version
from pathlib import Path

import numpy as np
import plexway

data = Path(sys.argv[1])
assert "dist-packages" in plexway.__file__, plexway.__file__
assert version("plexway") == plexway.__version__ and requires("plexway") == ["numpy"]

V = np.array([[0, 0], [4, 0], [4, 3], [0, 3]])
F = np.array([[0, 1, 2], [0, 2, 3]])
distance = plexway.distance(V, F, 0)
assert distance.tolist() == [0, 4, 5, 3], distance

knot = plexway.read(data / "knot.ply")
assert np.array_equal(knot.distances([0, 5])[1], knot.distance(5))
try:
    solid = plexway.read(data / "elbow.off", kind="solid")
    assert np.isfinite(solid.distance(0)).all()
except plexway.NotBuilt as missing:
    assert "tetgen" in str(missing).lower(), missing
