"""Ends work that takes too long or is no longer wanted: one token is passed down to all that works on a request."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from math import inf


class Cancelled(Exception):
    """The work was cancelled or ran out of time; the message is the reason."""


class CancelToken:
    """Says when work has to end: when its time is up, or when somebody calls `cancel`.

    Any thread and any signal handler may cancel it. A pickled copy keeps the deadline; cancelling one of the two then
    does not cancel the other.
    """

    def __init__(self, seconds: float = inf, whole: CancelToken | None = None) -> None:
        """Allow `seconds` of wall-clock time from now on; cancelling `whole` cancels it, too."""
        self._end = time.monotonic() + seconds
        self._why: str | None = None
        self._whole = whole

    def limited(self, seconds: float) -> CancelToken:
        """Return the token of a part of the work: it ends after `seconds`, and not later than this one."""
        return CancelToken(min(seconds, self.remaining_s), self)

    def share(self, fraction: float) -> CancelToken:
        """Return the token of a part of the work that may take a fraction of the time that is left."""
        return self.limited(fraction * self.remaining_s)

    def cancel(self, why: str) -> None:
        """End the work; `why` is a clause such as "it was stopped by the operator", and the first one counts."""
        if self._why is None:
            self._why = why

    @property
    def cancelled_because(self) -> str | None:
        """The reason that `cancel` was called with; None if it was not called."""
        return self._why if self._why is not None or self._whole is None else self._whole.cancelled_because

    @property
    def remaining_s(self) -> float:
        """The time that is left in s: 0 after the deadline and after `cancel`, infinite without a deadline."""
        return 0.0 if self.cancelled_because is not None else max(self._end - time.monotonic(), 0.0)

    @property
    def reason(self) -> str | None:
        """Why the work has to end now; None while it may go on."""
        why = self.cancelled_because
        return why if why is not None or time.monotonic() < self._end else "it ran out of time"

    def check(self) -> None:
        """Raise Cancelled if the work has to end now."""
        if (reason := self.reason) is not None:
            raise Cancelled(reason)


_current: ContextVar[CancelToken | None] = ContextVar("current", default=None)


@contextmanager
def cancelling(token: CancelToken) -> Iterator[None]:
    """End what is computed inside with Cancelled when the token says so, where it calls `check_current`.

    For pure functions that are called in many places, such as the evaluation of conditions.
    """
    former = _current.set(token)
    try:
        yield
    finally:
        _current.reset(former)


def check_current() -> None:
    """Raise Cancelled if the work around it has to end."""
    token = _current.get()
    if token is not None:
        token.check()


def limit_current(seconds: float) -> CancelToken:
    """Return a token that ends after `seconds`, and not later than the work around it."""
    token = _current.get()
    return CancelToken(seconds) if token is None else token.limited(seconds)
