"""What is told though nothing failed."""

from __future__ import annotations

import sys
import warnings
from types import FrameType
from typing import Iterable, Optional


class AccuracyWarning(RuntimeWarning):
    """Distances may be wrong by more than their accuracy promises; the text says where, and what to
    do. `Domain.remarks` and `Field.remarks` have it as well."""


AccuracyWarning.__module__ = "plexway"


def _is_own(frame: FrameType) -> bool:
    name = str(frame.f_globals.get("__name__", ""))
    return name == "plexway" or name.startswith("plexway.")


def warn(texts: Iterable[str]) -> None:
    """Warns at the line that called the package."""
    for text in texts:
        level = 1
        frame: Optional[FrameType] = sys._getframe()
        while frame is not None and _is_own(frame):
            level += 1
            frame = frame.f_back
        warnings.warn(text, AccuracyWarning, stacklevel=level)
