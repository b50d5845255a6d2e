"""An event loop in a thread of its own, so that programs without asyncio can use what needs one."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncGenerator, Coroutine, Iterator
from concurrent.futures import wait
from types import AsyncGeneratorType
from typing import Any, TypeVar

LOOK_S = 0.1
"""How often a waiting thread looks again, so that it takes interrupts, in s of wall time."""
TIDY_UP_S = 5.0
"""How long a coroutine that is cancelled may take to tidy up, in s."""
T = TypeVar("T")


class LoopThread:
    """A thread with an event loop; `run` and `iterate` may be called from any other thread."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="skillc client", daemon=True)
        self._thread.start()

    def run(self, coroutine: Coroutine[Any, Any, T]) -> T:
        """Return the value of a coroutine; an interrupt of the thread that waits cancels it, and lets it tidy up."""
        ended = threading.Event()

        async def carry_out() -> T:
            try:
                return await coroutine
            finally:
                ended.set()

        future = asyncio.run_coroutine_threadsafe(carry_out(), self._loop)
        try:
            while not future.done():
                wait((future,), LOOK_S)
            return future.result(0.0)
        finally:
            if future.cancel():
                ended.wait(TIDY_UP_S)

    def iterate(self, items: AsyncGenerator[T, None]) -> Iterator[T]:
        """Yield what an asynchronous generator yields, and close it at the end."""
        try:
            while True:
                yield self.run(_next(items))
        except StopAsyncIteration:
            return
        finally:
            if not self._loop.is_closed():
                self.run(_close(items))

    def close(self) -> None:
        """End the thread, and what goes on in it."""
        self.run(_end_tasks())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()  # wait ends: with the loop, which is stopped and has no tasks
        self._loop.close()


async def _next(items: AsyncGenerator[T, None]) -> T:
    return await anext(items)


async def _close(items: AsyncGenerator[Any, None]) -> None:
    """Close a generator, once it has stopped after an interrupt cancelled it."""
    assert isinstance(items, AsyncGeneratorType), "what `async def` with `yield` returns"
    while items.ag_running:  # wait ends: it was cancelled, and stops in the next round of the loop
        await asyncio.sleep(0.0)
    await items.aclose()


async def _end_tasks() -> None:
    """Cancel all other tasks, and close the generators that are open."""
    tasks = asyncio.all_tasks() - {asyncio.current_task()}
    for each in tasks:
        each.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    await asyncio.get_running_loop().shutdown_asyncgens()
