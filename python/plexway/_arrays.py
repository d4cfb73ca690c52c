"""What arrays are called in annotations, and what numbers must be."""

import math
import operator
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._plexway import NotBuilt

Array = NDArray[Any]


def whole(value: Any, name: str, least: Optional[int] = None) -> int:
    """An integer of any type; TypeError and ValueError name what it is of."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: expected an integer, got {value!r:.40}") from None
    if least is not None and number < least:
        raise ValueError(f"{name}: expected {least} or more, got {number}")
    return number


def real(value: Any, name: str) -> float:
    """A number of any type, or infinity; not a text, nor NaN."""
    try:
        if isinstance(value, (str, bytes, bool, np.bool_)):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: expected a number, got {value!r:.40}") from None
    if math.isnan(number):
        raise ValueError(f"{name}: nan is no number")
    return number


def plain(value: Any, name: str) -> Array:
    """As an array. A masked one is refused where something is masked: no place would know of it."""
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise ValueError(
            f"{name}: a masked array; leave simplices out by `mask=`, or fill what is masked"
        )
    return np.asarray(value)


def scipy_sparse() -> Any:
    """The module scipy.sparse."""
    try:
        import scipy.sparse  # type: ignore
    except ImportError as error:
        raise NotBuilt("sparse matrices need SciPy: install python3-scipy") from error
    return scipy.sparse
