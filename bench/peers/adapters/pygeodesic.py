#!/usr/bin/env python3
"""Exact distances (Mitchell, Mount, Papadimitriou) by pygeodesic, of PyPI."""
import sys

import numpy as np

sys.path.pop(0)  # this file has the module's name
import pygeodesic.geodesic as geodesic  # noqa: E402

sys.path.insert(0, __file__.rsplit("/", 1)[0])
from common import arguments, read_off, write  # noqa: E402

domain, sources, out = arguments()
points, triangles = read_off(domain)
solver = geodesic.PyGeodesicAlgorithmExact(points, triangles.astype(np.int32))


def row(source):
    found, _ = solver.geodesicDistances(np.array([source]), None)
    return np.where(found > 1e90, np.inf, found)


write(out, (row(source) for source in sources))
