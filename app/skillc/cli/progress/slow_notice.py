"""Says on stderr what a command is doing once it takes long, and again as long as it goes on."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from skillc.cli.console import print_talk
from skillc.cli.settings import output_settings

FIRST_AFTER_S, AGAIN_AFTER_S = 2.0, 10.0


@contextmanager
def notice_if_slow(text: str, describe: Callable[[], str] = lambda: "") -> Iterator[None]:
    """Print `text` after FIRST_AFTER_S, and every AGAIN_AFTER_S what `describe` then returns, or else for how long."""
    ended, began = threading.Event(), time.monotonic()

    def notice() -> None:
        if not ended.wait(FIRST_AFTER_S):
            print_talk(text)
        while not ended.wait(AGAIN_AFTER_S):
            print_talk(describe() or f"{text} {time.monotonic() - began:.0f} s so far")

    if output_settings().quiet:
        yield
        return
    thread = threading.Thread(target=notice, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join(AGAIN_AFTER_S)
