"""What a path costs, where that is not its length."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Tuple, Union

import numpy as np

from . import _plexway
from ._arrays import Array

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False)
class SimplexSpeeds:
    """One speed > 0 a simplex: a path of length L in it costs L / speed.

    Parameters
    ----------
    speed : array_like of float, shape (m,)
    refract : bool
        Paths are refracted where speeds jump: on surfaces, and in solids of at most 64 speeds. False, and in solids of more (with a warning): an edge takes
        the mean of its simplices.
    """

    speed: ArrayLike
    refract: bool = True


@dataclass(frozen=True, eq=False)
class VertexSpeeds:
    """One speed > 0 a vertex; along an edge the square of its inverse is linear.

    Parameters
    ----------
    speed : array_like of float, shape (n,)
    """

    speed: ArrayLike


@dataclass(frozen=True, eq=False)
class SimplexTensors:
    """One symmetric matrix M a simplex: a short step d costs sqrt(d @ M @ d).

    Parameters
    ----------
    tensor : array_like of float, shape (m, 3, 3)
    refract : bool
        As in `SimplexSpeeds`.
    """

    tensor: ArrayLike
    refract: bool = True


@dataclass(frozen=True, eq=False)
class VertexTensors:
    """One symmetric matrix a vertex, linear along edges; see `SimplexTensors`.

    Parameters
    ----------
    tensor : array_like of float, shape (n, 3, 3)
    """

    tensor: ArrayLike


@dataclass(frozen=True, eq=False)
class EdgeLengths:
    """A length for every edge, in any order and direction.

    Parameters
    ----------
    edges : array_like of int, shape (e, 2)
    length : array_like of float, shape (e,)
    """

    edges: ArrayLike
    length: ArrayLike


def described(metric: Any) -> Optional[Tuple[Any, ...]]:
    """The metric as the library takes it."""
    if metric is None:
        return None
    if isinstance(metric, SimplexSpeeds):
        return "speeds", _speeds(metric), metric.refract
    if isinstance(metric, VertexSpeeds):
        return "vertex tensors", np.eye(3) / _speeds(metric)[:, None, None] ** 2
    if isinstance(metric, (SimplexTensors, VertexTensors)):
        tensors = np.asarray(metric.tensor)
        if tensors.ndim != 3 or tensors.shape[1:] != (3, 3):
            raise ValueError(
                f"{type(metric).__name__}: expected shape (k, 3, 3), got {tensors.shape}"
            )
        if isinstance(metric, SimplexTensors):
            return "simplex tensors", tensors, metric.refract
        return "vertex tensors", tensors
    if isinstance(metric, EdgeLengths):
        return "lengths", np.asarray(metric.edges), np.asarray(metric.length)
    if callable(metric):
        return "function", metric
    raise TypeError(
        "metric: expected SimplexSpeeds, VertexSpeeds, SimplexTensors, VertexTensors, EdgeLengths or "
        f"a function from a point to a 3 x 3 matrix, got {type(metric).__name__}"
    )


def _speeds(metric: Union[SimplexSpeeds, VertexSpeeds]) -> Array:
    speeds = np.asarray(metric.speed, float)
    if speeds.ndim != 1:
        raise ValueError(f"{type(metric).__name__}: expected one axis, got shape {speeds.shape}")
    if not (np.all(speeds > 0) and np.all(np.isfinite(speeds))):
        raise _plexway.InputError(f"{type(metric).__name__}: expected numbers > 0 as speeds")
    return speeds
