"""Single keys of the terminal, where a program can read them."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Protocol


class Keys(Protocol):
    """Keys that are typed while a program works."""

    def read(self, seconds: float) -> str:
        """Wait for up to `seconds` for keys; return them, empty if none."""
        ...


def is_operable() -> bool:
    """Whether a user can type keys and see what they do: on terminals, as standard input and stderr, not of Windows."""
    return sys.platform != "win32" and sys.stdin.isatty() and sys.stderr.isatty()


def open_keyboard(suspended: Callable[[], None], continued: Callable[[], None]) -> AbstractContextManager[Keys]:
    """Return the keyboard, if it `is_operable`, to be used in a `with` statement in the main thread.

    `suspended` is called before the program is suspended with Ctrl-Z, and `continued` when it goes on.
    """
    if sys.platform != "win32":
        from skillc_runtime.platforms.unix_keyboard import Keyboard

        return Keyboard(suspended, continued)
    raise RuntimeError("skillc reads no single keys on Windows")
