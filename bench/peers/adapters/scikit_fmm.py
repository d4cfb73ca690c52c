#!/usr/bin/env python3
"""Fast marching of second order on a grid (.npz: open points, their spacing), by scikit-fmm."""
import numpy as np
import skfmm

from common import arguments, write

domain, sources, out = arguments()
with np.load(domain) as grid:
    is_open, spacing = grid["open"], float(grid["spacing"])
place = np.argwhere(is_open)


def row(source):
    phi = np.ma.MaskedArray(np.ones(is_open.shape), ~is_open)
    phi[tuple(place[source])] = 0
    found = skfmm.distance(phi, dx=spacing, order=2)
    return np.ma.filled(found, np.inf)[is_open]


write(out, (row(source) for source in sources))
