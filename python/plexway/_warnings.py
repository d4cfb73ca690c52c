"""Warnings: nothing failed, but a result may be inaccurate or incomplete."""

from __future__ import annotations

import re
import sys
import warnings
from threading import Lock
from types import FrameType
from typing import Iterable, Optional, Set, Tuple
from weakref import WeakKeyDictionary


class AccuracyWarning(RuntimeWarning):
    """Distances may be wrong by more than their accuracy promises; the text says where, and what to
    do. `Domain.notes` and `Field.notes` have it as well."""


AccuracyWarning.__module__ = "plexway"


def _is_own(frame: FrameType) -> bool:
    name = str(frame.f_globals.get("__name__", ""))
    return name == "plexway" or name.startswith("plexway.")


# The warnings about fields of a domain that were given, by their text without figures and by line: a loop
# over sources warns once.
_said: "WeakKeyDictionary[object, Set[Tuple[str, str, int]]]" = WeakKeyDictionary()
_lock = Lock()


def warn(texts: Iterable[str], domain: Optional[object] = None) -> None:
    """Warns at the line that called the package; of fields of a domain there once, whatever the
    figures."""
    for text in texts:
        level = 1
        frame: Optional[FrameType] = sys._getframe()
        while frame is not None and _is_own(frame):
            level += 1
            frame = frame.f_back
        if domain is None or frame is None:
            warnings.warn(text, AccuracyWarning, stacklevel=level)
            continue
        kind = re.split("[0-9]", text)[-1]
        key = (kind, frame.f_code.co_filename, frame.f_lineno)
        with _lock:
            if key in _said.get(domain, ()):
                continue
        warnings.warn(text, AccuracyWarning, stacklevel=level)
        # Not where a filter makes it an error: that it is each time.
        with _lock:
            _said.setdefault(domain, set()).add(key)
