"""What happens in a server, as it happens: a connection that breaks is made again, and nothing is missed or doubled."""

from __future__ import annotations

from collections.abc import AsyncGenerator
from contextlib import aclosing
from typing import TypeAlias, TypeVar

import msgspec
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidMessage

from skillc.client.connection import Connection, decode, decode_binary, describe_loss
from skillc.client.errors import RefusedError, UnavailableError
from skillc.client.retries import Retries
from skillc.contract.api.endpoint import Stream
from skillc.contract.api.endpoints import STREAM_EVENTS, STREAM_SAMPLES
from skillc.contract.cell import CellStatus
from skillc.contract.job import JobChanged
from skillc.contract.messages import Happened, StatusChanged
from skillc.contract.operation import OperationStatus
from skillc.contract.runs.history import EventsHello
from skillc.contract.sample import Sample, SampleHello
from skillc.errors import ServiceError
from skillc.events import Envelope

ENDED, REFUSED = 1000, 1008
FORBIDDEN = 403
MAX_BYTES = 2**26
"""The largest message; the events of a plan of thousands of steps are one."""

Status: TypeAlias = CellStatus | OperationStatus
T = TypeVar("T")


async def follow_operation(connection: Connection, operation: str, after: int) -> AsyncGenerator[Envelope, None]:
    """Yield the events of an operation numbered from `after` + 1 on, until it has ended.

    RefusedError if there is no such operation, UnavailableError if the server was away for too long.
    """
    retries = Retries()
    while True:
        try:
            hello = EventsHello(connection.address.token, operation, after)
            async with aclosing(_receive(connection, STREAM_EVENTS, hello, list[Envelope])) as batches:
                async for batch in batches:
                    retries.succeeded()
                    for each in batch:
                        if each.sequence != after + 1:
                            raise ServiceError(f"event {after + 1} of {operation} is missing in the server's journal")
                        after = each.sequence
                        yield each
            return
        except UnavailableError as error:
            await retries.wait(error)


async def follow_states(connection: Connection) -> AsyncGenerator[Status, None]:
    """Yield how cells and operations are, and then each that changes; after a break, all of them again.

    Of changes that follow each other quickly only the last one may come. Errors as of `follow_operation`.
    """
    retries, hello = Retries(), EventsHello(connection.address.token)
    while True:
        try:
            kind = list[Happened | StatusChanged | JobChanged]
            async with aclosing(_receive(connection, STREAM_EVENTS, hello, kind)) as batches:
                async for batch in batches:
                    retries.succeeded()
                    for each in batch:
                        if not isinstance(each, JobChanged):
                            yield each.status if isinstance(each, StatusChanged) else each.operation
            raise UnavailableError(f"the server at {connection.address.url} ends")
        except UnavailableError as error:
            await retries.wait(error)


async def follow_samples(connection: Connection, cell: str, rate_hz: float) -> AsyncGenerator[Sample, None]:
    """Yield what moves in a cell, `rate_hz` times a second at most; errors as of `follow_operation`."""
    retries = Retries()
    while True:
        try:
            hello = SampleHello(cell, connection.address.token, rate_hz)
            async with aclosing(_receive(connection, STREAM_SAMPLES, hello, Sample)) as samples:
                async for each in samples:
                    retries.succeeded()
                    yield each
            raise UnavailableError(f"the server at {connection.address.url} ends")
        except UnavailableError as error:
            await retries.wait(error)


async def _receive(
    connection: Connection, stream: Stream, hello: msgspec.Struct, kind: type[T]
) -> AsyncGenerator[T, None]:
    """Yield the messages of one connection to a stream until the server says that there are no more.

    UnavailableError if the connection breaks before.
    """
    address = connection.address
    url = f"ws{address.url.removeprefix('http')}{stream.path}"
    try:
        async with connect(
            url, ssl=connection.tls, proxy=None if address.is_local else True, max_size=MAX_BYTES
        ) as socket:
            await socket.send(msgspec.json.encode(hello).decode())
            while (message := await _read(socket)) is not None:
                yield decode(message, kind) if isinstance(message, str) else decode_binary(message, kind)
    except (OSError, TimeoutError, InvalidHandshake, InvalidMessage, ConnectionClosed) as error:
        raise UnavailableError(describe_loss(address, error)) from error


async def _read(socket: ClientConnection) -> str | bytes | None:
    """Return the next message; None if there are no more. RefusedError if the server refuses the request."""
    try:
        return await socket.recv()  # wait ends: with the connection, whose pings find a server that is gone
    except ConnectionClosed as closed:
        if closed.rcvd is not None and closed.rcvd.code == ENDED:
            return None
        if closed.rcvd is not None and closed.rcvd.code == REFUSED:
            raise RefusedError(closed.rcvd.reason, FORBIDDEN) from closed
        raise
