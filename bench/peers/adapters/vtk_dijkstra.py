#!/usr/bin/env python3
"""vtkDijkstraGraphGeodesicPath: Dijkstra along the edges of a surface (.off)."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkDijkstraGraphGeodesicPath

from common import arguments, read_off, write

domain, sources, out = arguments()
points, triangles = read_off(domain)
at = vtkPoints()
at.SetData(numpy_to_vtk(points, deep=True))
cells = vtkCellArray()
rows = np.hstack([np.full((len(triangles), 1), 3), triangles]).astype(np.int64).ravel()
cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(rows, deep=True))
surface = vtkPolyData()
surface.SetPoints(at)
surface.SetPolys(cells)
search = vtkDijkstraGraphGeodesicPath()
search.SetInputData(surface)
search.StopWhenEndReachedOff()


def row(source):
    search.SetStartVertex(source)
    search.SetEndVertex(source)
    search.Update()
    found = vtkDoubleArray()
    search.GetCumulativeWeights(found)
    distance = vtk_to_numpy(found).copy()
    distance[(distance < 0) | (distance > 1e90)] = np.inf  # as VTK says that no path leads there
    distance[source] = 0
    return distance


write(out, (row(source) for source in sources))
