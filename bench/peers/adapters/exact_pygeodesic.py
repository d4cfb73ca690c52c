#!/usr/bin/env python3
"""Exact distances (Mitchell, Mount, Papadimitriou) by pygeodesic, of PyPI."""
import numpy as np
import pygeodesic.geodesic as geodesic

from common import arguments, read_off, write

domain, sources, out = arguments()
points, triangles = read_off(domain)
solver = geodesic.PyGeodesicAlgorithmExact(points, triangles.astype(np.int32))


def row(source):
    found, _ = solver.geodesicDistances(np.array([source]), None)
    return np.where(found > 1e90, np.inf, found)


write(out, (row(source) for source in sources))
