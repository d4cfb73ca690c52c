#!/usr/bin/env python3
"""libigl's Python package, igl: exact distances, or the heat method where the first word is 'heat'."""
import igl
import numpy as np

from common import arguments, read_off, write

method, domain, sources, out = arguments(4)
points, triangles = read_off(domain)
targets = np.arange(len(points))
nothing = np.array([], dtype=np.int64)


def exact(source):
    found = igl.exact_geodesic(points, triangles, np.array([source]), nothing, targets, nothing)
    return np.where(np.asarray(found) > 1e90, np.inf, found)


def heat(source):
    return igl.heat_geodesic(points, triangles, 1.0, np.array([source]))


write(out, ((heat if method == "heat" else exact)(source) for source in sources))
