"""Geodesic distance on surfaces, solids, wireframes, clouds and simplices of any dimension.

One line, from NumPy arrays:

>>> import numpy as np
>>> import plexway
>>> V = np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]])
>>> F = np.array([[0, 1, 2], [0, 2, 3]])
>>> plexway.distance(V, F, 0)
array([0., 4., 5., 3.], dtype=float32)

A domain that is used more than once is kept:

>>> sheet = plexway.Surface(V, F)
>>> sheet
plexway.Surface(4 vertices, 2 triangles)
>>> sheet.path(0, 2).length
5.0

Distances are in the unit of the positions; unreachable vertices are at ``inf``.
"""

try:
    import numpy as _numpy  # noqa: F401
except ImportError as error:
    raise ImportError(
        "plexway needs NumPy: install python3-numpy, or `pip install numpy`"
    ) from error

from ._plexway import (
    Cancelled,
    EndlessError,
    Error,
    InputError,
    NotBuilt,
    PrecisionError,
    UsageError,
    __version__,
)
from ._domain import Domain
from ._grid import Grid
from ._kinds import Cloud, Mixed, Simplicial, Solid, Surface, Wireframe
from ._make import distance, domain, read, read_labels, show
from ._metrics import EdgeLengths, SimplexSpeeds, SimplexTensors, VertexSpeeds, VertexTensors
from ._results import Cells, Disks, FarthestPoints, Field, Isosurfaces, Path, Picture, Points
from ._sources import (
    Ball,
    Boundary,
    OutOfRange,
    Point,
    Polyline,
    Segment,
    Source,
    Vertex,
    Vertices,
    WholeSimplex,
)
from ._warnings import AccuracyWarning

__all__ = [
    "AccuracyWarning",
    "Ball",
    "Boundary",
    "Cancelled",
    "Cells",
    "Cloud",
    "Disks",
    "Domain",
    "EdgeLengths",
    "EndlessError",
    "Error",
    "FarthestPoints",
    "Field",
    "Grid",
    "InputError",
    "Isosurfaces",
    "Mixed",
    "NotBuilt",
    "OutOfRange",
    "Path",
    "Picture",
    "Point",
    "Points",
    "Polyline",
    "PrecisionError",
    "Segment",
    "SimplexSpeeds",
    "SimplexTensors",
    "Simplicial",
    "Solid",
    "Source",
    "Surface",
    "UsageError",
    "Vertex",
    "VertexSpeeds",
    "VertexTensors",
    "Vertices",
    "WholeSimplex",
    "Wireframe",
    "__version__",
    "distance",
    "domain",
    "read",
    "read_labels",
    "show",
]
