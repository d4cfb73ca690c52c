"""An organ: how far is tissue from the wall, and from the vessel that runs through it."""

# %% A block of tissue, in tetrahedra, and a vessel: a line of edges through its middle.
import itertools

import numpy as np

import plexway

n = 8
steps = np.array(list(itertools.product(range(n + 1), repeat=3)))
number = {tuple(s): i for i, s in enumerate(steps.tolist())}
tets = []
for cell in itertools.product(range(n), repeat=3):
    for order in itertools.permutations(range(3)):
        at, corners = list(cell), [number[cell]]
        for axis in order:
            at[axis] += 1
            corners.append(number[tuple(at)])
        tets.append(corners)
tissue = plexway.Solid(steps / n, tets)
print(tissue)

# %% From the wall: of a cube the distance from the nearest of six planes.
wall = tissue.distance(plexway.Boundary())
truth = np.minimum(steps, n - steps).min(axis=1) / n
print(f"from the wall: {wall.max():.3f} at most, {np.abs(wall - truth).max():.3f} off at worst")
# The source is the wall's vertices: between them it is a little farther.
assert np.all(wall >= truth - 1e-6) and np.abs(wall - truth).max() < 0.1

# %% The vessel carries ten times as fast as tissue: edges cost a tenth of their length.
line = np.array([[0.5, 0.5, z] for z in np.linspace(0, 1, n + 1)])
vessel = plexway.Wireframe(line, [[k, k + 1] for k in range(n)])
both = plexway.Mixed([tissue, vessel])
inlet = tissue.vertex_count
reach = both.distance(inlet)
print(f"{both}: the farthest tissue is {reach[:inlet].max():.3f} away")
assert np.isfinite(reach).all()

# %% Where the distance is 0.2: a surface.
near = tissue.distance(plexway.Ball([0.5, 0.5, 0.5], 0.0))
shell = tissue.isosurfaces(near, 0.4)
radius = np.linalg.norm(shell.positions - 0.5, axis=1)
print(f"{len(shell.triangles)} triangles, {radius.mean():.3f} from the middle")
assert np.abs(radius - 0.4).max() < 0.02
