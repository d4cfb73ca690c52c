"""Distances that can stand in a loss: lengths of shortest paths, with their derivatives.

For tensors of PyTorch; arrays of NumPy (without derivatives) and JAX do as well, since all that is
needed are an index, sums and powers. PyTorch is imported only for a tensor of its own.
"""

from __future__ import annotations

from typing import Any, Sequence, Tuple

import numpy as np

from ._make import domain


def distance(V: Any, simplices: Any, pairs: Sequence[Tuple[Any, Any]], **options: Any) -> Any:
    """The distance of each of several pairs of places, as a function of where the vertices are.

    Parameters
    ----------
    V : tensor, shape (n, 3)
    simplices : array_like of int, shape (m, corners)
        As in `plexway.domain`: edges, triangles or tetrahedra.
    pairs : sequence of (Place, Place)
        Places are held by the simplices that they are in.
    **options
        Of the domain.

    Returns
    -------
    tensor, shape (k,)
        The derivative is exact where there is a single shortest path.
    """
    held = V.detach().cpu().numpy() if hasattr(V, "detach") else np.asarray(V)
    made = domain(held, simplices, **options)
    lengths = [made.path(a, b).measure(V) for a, b in pairs]
    if hasattr(V, "detach"):
        import torch  # type: ignore

        return torch.stack(lengths)
    return sum(one * (np.arange(len(lengths)) == i) for i, one in enumerate(lengths))
