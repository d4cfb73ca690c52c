"""A cortex: masks, all distances from parcels, a kernel of near ones, smoothing weights."""

# %% A folded sheet; the medial wall is left out by a mask.
import numpy as np

import plexway

n = 60
u, v = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing="ij")
V = np.stack([u, v, 0.15 * np.sin(6 * u) * np.cos(5 * v)], axis=-1).reshape(-1, 3)
a = np.arange(n * n).reshape(n, n)
a, b, c, d = (x.ravel() for x in (a[:-1, :-1], a[1:, :-1], a[:-1, 1:], a[1:, 1:]))
F = np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])
wall = np.linalg.norm(V[:, :2] - [0.2, -0.1], axis=1) < 0.25
cortex = plexway.Surface(V, F, mask=~wall)
print(cortex)

# %% What lies in the wall is not reached, and no way leads through it.
seeds = [0, n - 1, n * n - n, n * n - 1]
distance, parcel = cortex.nearest(seeds)
assert np.isinf(distance[wall]).sum() > 0 and np.all(np.isfinite(distance[~wall]))
print("vertices of each parcel:", np.bincount(parcel[parcel >= 0]).tolist())

# %% From every seed to everywhere, a thread a seed, a row each.
rows = cortex.distances(seeds)
reached = np.isfinite(distance)
apart = np.abs(rows.min(axis=0)[reached] - distance[reached]) / np.maximum(distance[reached], 1e-9)
print(f"nearest of the rows, and all at once: {apart.mean():.1e} apart, {apart.max():.1e} at worst")
assert apart.mean() < 2e-3

# %% Only near ones, sparse, and of them the weights of a smoothing kernel.
try:
    near = cortex.near(np.flatnonzero(~wall)[:200], radius=0.15, accuracy="fast")
except plexway.NotBuilt as missing:
    print(missing)
else:
    weights = near.copy()
    weights.data = np.exp(-0.5 * (near.data / 0.05) ** 2)
    print(f"{near.nnz} distances below 0.15 of {near.shape[0]} vertices, none above")
    assert near.data.max() <= 0.15
