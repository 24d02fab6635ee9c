"""How far a run is: a bar on stderr, or a function of the caller's."""

from __future__ import annotations

import contextlib
import math
import os
import sys
import time
from typing import Any, Callable, Iterator, Optional

import numpy as np

Report = Callable[..., Any]

_WIDTH = 20  # characters of the bar
_OFTEN, _SELDOM = 0.1, 10.0  # seconds between two looks at a screen, and two lines of a file


class Bar:
    """One line, drawn over itself where there is a terminal or a notebook; in a file now and then a whole one in words."""

    def __init__(self) -> None:
        self._file = sys.stderr
        is_terminal = self._file.isatty() and os.environ.get("TERM") != "dumb"
        self._is_screen = is_terminal or "ipykernel" in sys.modules
        self._begin = time.monotonic()
        self._next = self._begin + (_OFTEN if self._is_screen else _SELDOM)
        self._first: float | None = None
        self._covered = 0

    def run(self, t: float, t_end: float, steps: int) -> None:
        if self._first is None:
            self._first = t  # of a run that goes on from there
        whole = t_end - self._first
        share = min(1.0, max(0.0, (t - self._first) / whole)) if whole > 0 else 1.0
        seconds = time.monotonic() - self._begin
        left = _clock(seconds * (1 - share) / share) if share > 0 else "?"
        self.show(f"{self._done(share)} t = {t:<10.6g} {steps / seconds:.3g} steps/s, {left} left")

    def part(self, share: float) -> None:
        self.show(f"{self._done(share)} drawing")

    def _done(self, share: float) -> str:
        bar = f" {'━' * round(_WIDTH * share):<{_WIDTH}}" if self._is_screen else ""
        return f"{100 * share:3.0f} %{bar}"

    def search(self, tried: int, chi2: float) -> None:
        self.show(f"{tried} sets of parameters tried, χ² = {chi2:.6g}")

    def show(self, text: str) -> None:
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + (_OFTEN if self._is_screen else _SELDOM)
        self._write(f"\r{text:<{self._covered}}" if self._is_screen else f"{text}\n")
        self._covered = max(self._covered, len(text))

    def wipe(self) -> None:
        if self._covered and self._is_screen:
            self._write("\r" + " " * self._covered + "\r")

    def _write(self, text: str) -> None:
        with contextlib.suppress(OSError, UnicodeEncodeError):  # a terminal that went away does not end the run
            self._file.write(text)
            self._file.flush()


def _clock(seconds: float) -> str:
    whole = round(min(seconds, 1e9)) if math.isfinite(seconds) else 0
    hours, minutes = divmod(whole // 60, 60)
    return f"{hours}:{minutes:02}:{whole % 60:02}" if hours else f"{minutes}:{whole % 60:02}"


@contextlib.contextmanager
def showing(progress: bool | Report, of: str = "(t, t_end, steps)", draw: Any = Bar.run) -> Iterator[Optional[Any]]:
    """What is to be called with how far a run is: the bar, the caller's function, or None. The bar is gone afterwards."""
    if callable(progress):
        yield progress
    elif progress is None or isinstance(progress, (bool, np.bool_)) and not (progress and sys.stderr):
        yield None  # where Python has no stderr, as without a console, there is no place for a bar
    elif isinstance(progress, (bool, np.bool_)):
        bar = Bar()
        try:
            yield lambda *where: draw(bar, *where)
        finally:
            bar.wipe()
    else:
        raise ValueError(f"progress = {progress!r} must be True, False, or a function of {of}")
