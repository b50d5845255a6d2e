"""The signals that ask a program to end: what they are called, and who handles them."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

if sys.platform == "win32":
    ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGBREAK)
    FILE_TOO_LARGE: int | None = None
else:
    ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    FILE_TOO_LARGE = signal.SIGXFSZ
"""The signal that ends a program which writes more than it may; None where no signal does."""


@contextmanager
def handling(
    handle: Callable[[int, FrameType | None], None], stays: Callable[[], bool] = lambda: False
) -> Iterator[None]:
    """Handle the signals that are not ignored, as they are with `nohup`; nothing changes in other threads.

    The handlers of before are back at the end unless this one `stays`.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in ENDING}
    try:
        for number, former in before.items():
            if former is not signal.SIG_IGN:
                signal.signal(number, handle)
        yield
    finally:
        for number, former in () if stays() else before.items():
            signal.signal(number, former)
