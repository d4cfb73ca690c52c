"""A scan: how far is it over the skin, which way, and samples of even density."""

# %% A knotted tube, as a scanner would leave it: triangles, some thin.
import numpy as np

import plexway

knot = plexway.read("data/knot.ply")
print(knot)
told = knot.info()
print(f"{told['components']} component, mean edge {told['mean_edge']:.4f}")

# %% Distances over the surface, beside those straight through the air.
distance = knot.distance(0)
air = np.linalg.norm(knot.vertices - knot.vertices[0], axis=1)
farthest = int(distance.argmax())
print(f"the farthest vertex is {farthest}: {distance[farthest]:.3f}, {air[farthest]:.3f} by air")
assert np.all(distance >= air * (1 - 1e-6))

# %% The way there. It is no longer than the distance says, and it stays on the surface.
path = knot.path(0, farthest)
print(f"the way there: {path.length:.3f} through {len(path)} points")
assert abs(path.length / distance[farthest] - 1) < 1e-2

# %% How sure is that?
distance, error = knot.estimate(0)
print(f"estimated error: {np.median(error):.1e} in the middle, {error.max():.1e} at worst")

# %% Points of even density, and cells around them.
disks = knot.poisson(count=60)
cells = knot.cvt(disks.points, iterations=10)
print(f"{len(disks.points)} points {disks.radius:.3f} apart; cells of {cells.content.mean():.3f}")
assert cells.energy[-1] <= cells.energy[0]
