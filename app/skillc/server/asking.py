"""Lets workers answer questions about a cell, for what it knows at that moment, and about its runs."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from http import HTTPStatus
from typing import TypeVar

from skillc.contract.messages import TakeSnapshot
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import raise_refused
from skillc.server.problems import ApiRefusal
from skillc.workers.pool import TooMuchWork, WorkFailed, WorkTimedOut
from skillc.workers.questions import Work

T = TypeVar("T")

KNOWN_FACTS = TakeSnapshot()


async def ask_about(call: ApiCall, work: Work, kind: type[T], seconds: float, wanted: TakeSnapshot = KNOWN_FACTS) -> T:
    """Let a worker do something with what is `wanted` of the cell now; ApiRefusal if there is no answer.

    The worker is killed if the client goes.
    """
    return await ask_with(call, work, await take_snapshot(call, call.path["cell"], wanted), kind, seconds)


async def take_snapshot(call: ApiCall, cell: str, wanted: TakeSnapshot = KNOWN_FACTS) -> bytes:
    """Return what is `wanted` of a cell as it is now, encoded; ApiRefusal if there is no such cell, or it is off."""
    return raise_refused(await call.server.find_cell(cell).request(wanted))


async def ask_with(call: ApiCall, work: Work, snapshot: bytes, kind: type[T], seconds: float) -> T:
    """Let a worker do something with a snapshot of a cell; ApiRefusal if there is no answer."""
    return await _wait(call, call.server.workers.answer(work, snapshot, kind, seconds))


async def ask_about_run(call: ApiCall, work: Work, kind: type[T], seconds: float) -> T:
    """Let a worker answer a question about runs, of which the cell notices nothing; ApiRefusal if there is no answer.

    The worker is killed if the client goes.
    """
    return await _wait(call, call.server.run_readers.answer(work, b"", kind, seconds))


async def _wait(call: ApiCall, answer: Coroutine[None, None, T]) -> T:
    try:
        return await _unless_gone(call, answer)
    except WorkFailed as error:
        raise ApiRefusal(HTTPStatus.UNPROCESSABLE_ENTITY, str(error), diagnosis=error.diagnosis) from error
    except (WorkTimedOut, TooMuchWork) as error:
        raise ApiRefusal(HTTPStatus.SERVICE_UNAVAILABLE, str(error)) from error


async def _unless_gone(call: ApiCall, answer: Coroutine[None, None, T]) -> T:
    """Wait for an answer, and cancel it if the client goes before; ApiRefusal then."""
    answering, leaving = asyncio.ensure_future(answer), asyncio.ensure_future(call.leave())
    try:
        await asyncio.wait((answering, leaving), return_when=asyncio.FIRST_COMPLETED)
        if answering.done():
            return answering.result()
        raise ApiRefusal(HTTPStatus.REQUEST_TIMEOUT, "the client has gone")
    finally:
        answering.cancel()
        leaving.cancel()
