#!/usr/bin/env python3
"""geometry-central by way of potpourri3d, of PyPI: the heat method, or fast marching where the first word is 'march'."""
import numpy as np
import potpourri3d

from common import arguments, read_off, write

method, domain, sources, out = arguments(4)
points, triangles = read_off(domain)
if method == "march":
    solver = potpourri3d.MeshFastMarchingDistanceSolver(points, triangles)
    write(out, (solver.compute_distance([[(int(source), [])]]) for source in sources))
else:
    solver = potpourri3d.MeshHeatMethodDistanceSolver(points, triangles)
    write(out, (np.asarray(solver.compute_distance(int(source))) for source in sources))
