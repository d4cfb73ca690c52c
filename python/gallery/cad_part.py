"""A CAD part: thin triangles, a measure that differs, lines as sources."""

# %% A plate of thin triangles: 12 rows of 60.
import numpy as np

import plexway

n, rows = 60, 12
x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, rows + 1), indexing="ij")
V = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
a = np.arange(V.shape[0]).reshape(n + 1, rows + 1)
a, b, c, d = (q.ravel() for q in (a[:-1, :-1], a[1:, :-1], a[:-1, 1:], a[1:, 1:]))
F = np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])
plate = plexway.Surface(V, F, precision="double")

# %% From a point in the middle of a triangle, flat: the straight line.
at = np.array([0.31, 0.52, 0])
error = np.abs(plate.distance(at, accuracy="exact") - np.linalg.norm(V - at, axis=1)).max()
print(f"from a point: {error:.1e} off at worst")
assert error < 1e-6

# %% From an edge of the part, which is a line.
crease = plate.distance(plexway.Segment([0.2, 0.25, 0], [0.8, 0.75, 0]))
t = np.clip(((V - [0.2, 0.25, 0]) @ [0.6, 0.5, 0]) / 0.61, 0, 1)
foot = np.array([0.2, 0.25, 0]) + t[:, None] * [0.6, 0.5, 0]
error = np.abs(crease - np.linalg.norm(V - foot, axis=1)).max()
print(f"from a line: {error:.1e} off at worst")
assert error < 1e-3

# %% Glass fibres along x: twice as fast there.
fibres = plexway.Surface(V, F, metric=lambda p: np.diag([0.25, 1, 1]), precision="double")
truth = np.hypot(V[:, 0] / 2, V[:, 1])
error = np.abs(fibres.distance(0, accuracy="exact") - truth).max()
print(f"with fibres: {error:.1e} off at worst")
assert error < 1e-6

# %% Lines where a tool would go.
lines = plate.isolines(plate.distance(0), np.arange(0.2, 1.0, 0.2))
print(f"{len(lines)} lines, the longest {max(line.length for line in lines):.3f}")
