"""Passes what happens to those who listen; for who does not read, only the newest of each waits."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TypeAlias, assert_never

from skillc.contract.job import JobChanged
from skillc.contract.messages import Happened, StatusChanged

MAX_WAITING = 256
"""How many news may wait for one listener. They say how far an operation is: events are read from the journal."""

News: TypeAlias = Happened | StatusChanged | JobChanged


class Listener:
    """A queue of news, the newest of each operation, cell and job."""

    def __init__(self) -> None:
        self._latest: dict[str, News] = {}
        self._news = asyncio.Event()

    def put(self, news: News) -> None:
        """Add news in place of older ones about the same."""
        key = _name_subject(news)
        self._latest.pop(key, None)
        self._latest[key] = news
        while len(self._latest) > MAX_WAITING:
            del self._latest[next(iter(self._latest))]
        self._news.set()

    async def take(self) -> list[News]:
        """Wait for news, and return all that there are."""
        await self._news.wait()  # wait ends: with the client that listens, which cancels it
        self._news.clear()
        taken = list(self._latest.values())
        self._latest.clear()
        return taken


def _name_subject(news: News) -> str:
    match news:
        case Happened(operation=operation):
            return f"operation {operation.id}"
        case StatusChanged(status=status):
            return f"cell {status.name}"
        case JobChanged(job=job):
            return f"job {job.id}"
        case _:
            assert_never(news)


class EventHub:
    """Those who listen."""

    def __init__(self) -> None:
        self._listeners = set[Listener]()

    @property
    def count(self) -> int:
        """How many listen."""
        return len(self._listeners)

    def publish(self, news: News) -> None:
        """Pass news to all."""
        for each in self._listeners:
            each.put(news)

    @contextmanager
    def listening(self) -> Iterator[Listener]:
        """Listen in a `with` statement."""
        listener = Listener()
        self._listeners.add(listener)
        try:
            yield listener
        finally:
            self._listeners.discard(listener)
