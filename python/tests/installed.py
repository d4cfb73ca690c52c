"""An installed package does what README.md says:

    python3 python/tests/installed.py CLONE ENVIRONMENT
"""

import re
import sys
from pathlib import Path

import numpy as np

clone, environment = Path(sys.argv[1]), Path(sys.argv[2])
V = np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]], float)
F = np.array([[0, 1, 2], [0, 2, 3]])

# The snippet itself, word for word.
snippet = re.search(r"## Python\n\n```python\n(.*?)```", (clone / "README.md").read_text(), re.S)
names = {"V": V, "F": F}
exec(snippet.group(1), names)
assert names["distance"].tolist() == [0, 4, 5, 3], names["distance"]

plexway = names["plexway"]
assert Path(plexway.__file__).is_relative_to(environment), plexway.__file__
knot = plexway.read(clone / "data" / "knot.ply")
assert np.array_equal(knot.distances([0, 5])[1], knot.distance(5))
try:  # a program beside the module
    solid = plexway.read(clone / "data" / "elbow.off", kind="solid")
    assert np.isfinite(solid.distance(0)).all()
except plexway.NotBuilt as missing:
    assert "program" not in str(missing), missing
