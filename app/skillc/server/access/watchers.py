"""Bounds how many watch: each token, all together, and those that have not yet said who they are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http import HTTPStatus

from skillc.server.problems import ApiRefusal

MAX_UNKNOWN, MAX_OF_TOKEN, MAX_WATCHERS = 200, 200, 1000


@dataclass(slots=True)
class Watchers:
    """Those who watch; `unknown` is the number of those that have not yet sent a valid token.

    There are at most `total` of `what`, `of_client` of them of one client.
    """

    what: str = "WebSockets"
    of_client: int = MAX_OF_TOKEN
    total: int = MAX_WATCHERS
    unknown: int = 0
    _known: Counter[str] = field(default_factory=Counter)

    @contextmanager
    def introducing(self) -> Iterator[None]:
        """Count one that has not yet sent its token, in a `with` statement; ApiRefusal (429) for too many."""
        _refuse_from(self.unknown, MAX_UNKNOWN, "WebSockets without a token")
        self.unknown += 1
        try:
            yield
        finally:
            self.unknown -= 1

    @contextmanager
    def watching(self, name: str) -> Iterator[None]:
        """Count one of the client with this name, in a `with` statement; ApiRefusal (429) for too many."""
        _refuse_from(self._known[name], self.of_client, f"{self.what} of `{name}`")
        _refuse_from(self._known.total(), self.total, self.what)
        self._known[name] += 1
        try:
            yield
        finally:
            self._known[name] -= 1


def _refuse_from(count: int, limit: int, what: str) -> None:
    if count >= limit:
        raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"there are {limit} {what}, and no more are taken")
