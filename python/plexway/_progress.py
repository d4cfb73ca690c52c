"""How much is done, reported while it is done."""

from __future__ import annotations

import sys
from types import TracebackType
from typing import Any, Callable, Optional, Type, Union

ProgressLike = Union[None, bool, Callable[[float], Any]]


class Progress:
    """What ``progress=`` means: True draws a bar (by tqdm where that is installed, else a line on
    the standard error output), a function is called with the share that is done, 0 to 1; where it
    returns False the work ends with `Cancelled`.

    A context: ``with Progress(progress, "solving") as report``; `report` is a function, or None.
    """

    def __init__(self, progress: ProgressLike, what: str) -> None:
        self._progress = progress
        self._what = what
        self._bar: Any = None
        self._line = False

    def __enter__(self) -> Optional[Callable[[float], Any]]:
        if self._progress is None or self._progress is False:
            return None
        if callable(self._progress):
            return self._progress
        if self._progress is not True:
            raise TypeError("progress: expected True, False, None or a function of a share")
        try:
            from tqdm.auto import tqdm  # type: ignore
        except ImportError:
            self._line = True
            return self._write
        self._bar = tqdm(total=100, desc=self._what, unit="%", leave=False)
        return self._update

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None:
        if self._bar is not None:
            self._bar.close()
        if self._line:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()

    def _update(self, share: float) -> None:
        self._bar.update(round(100 * share, 1) - self._bar.n)

    def _write(self, share: float) -> None:
        sys.stderr.write(f"\r{self._what}: {100 * share:.0f} %")
        sys.stderr.flush()
