"""A store on a SPARQL 1.1 server: facts in one graph, and in another the number of the last transaction and a log.

A write is one update that has no effect unless the number is still the one that the writer knows. So it can safely be
sent again when no answer arrives, and the log shows whether it was executed.
"""

from __future__ import annotations

import secrets
import time
from collections.abc import Callable
from hashlib import blake2b
from io import BytesIO
from pathlib import Path
from typing import NamedTuple, TypeVar

import msgspec
import pyoxigraph as ox

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.store import sparql_texts as texts
from skillc_runtime.store.change_json import decode_changes, encode_changes
from skillc_runtime.store.http import ROWS, ServerUnreachable, SparqlEndpoint
from skillc_runtime.store.store import StoredWorld
from skillc_runtime.store.triples import triple_difference
from skillc_runtime.store.world_index import IndexPlace
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError, Transaction

TRIPLES = "application/n-triples"
PATIENCE_S = 10.0
"""How long requests to a server that does not answer are repeated."""
FIRST_PAUSE_S = 0.1
MOST_DIGITS = 18
"""The most digits of the number of a transaction."""
MAX_READS = 20
"""How often a world is read until no other process writes in the meantime."""

T = TypeVar("T")
Row = dict[str, str]


class _Term(msgspec.Struct):
    value: str


class _Rows(msgspec.Struct):
    bindings: list[dict[str, _Term]]


class _Answer(msgspec.Struct):
    results: _Rows


class _Facts(NamedTuple):
    """The facts after the transaction number `sequence`, in N-Triples, and the scene with which it was filled."""

    sequence: int
    beginning: str
    content: bytes


class SparqlStore:
    """A world on a server that any number of processes can use at the same time."""

    def __init__(
        self,
        endpoint: SparqlEndpoint,
        reset: bool = False,
        patience_s: float = PATIENCE_S,
        cancel: CancelToken | None = None,
        author: str = "",
        index: Path | None = None,
    ) -> None:
        """Use a server; with `reset`, delete its world. StoreError when it cannot be used.

        Requests are repeated for `patience_s`, or until `cancel` ends the wait. `author` is noted with each write.
        `index` is the file for the index of its world.
        """
        self._author, self._index = author, index
        self._unread: _Facts | None = None
        self._endpoint, self._patience_s, self._cancel = endpoint, patience_s, cancel or CancelToken()
        self._empty = self._was_preceded = False
        self._retry(lambda: endpoint.update(texts.CREATE))
        if reset:
            self._retry(lambda: endpoint.update(texts.RESET))

    def __str__(self) -> str:
        return str(self._endpoint)

    def close(self) -> None:
        """Close the connection."""
        self._endpoint.close()

    def require_writable(self) -> None:
        """Do nothing: everybody may write who has the password."""

    def read(self) -> StoredWorld:
        """Return the current facts; they are read again when another process writes in the meantime."""
        stored = self._retry(self._read)
        self._empty = not stored.triples
        return stored

    def find_index(self) -> IndexPlace | None:
        """Return where the index of the present facts is; None if there is no place for it, or there are no facts.

        The facts are fetched and compared as texts, for others than skillc may have changed them. They are not parsed,
        which would take ten times as long and several times their memory; the next `read` takes them.
        """
        if self._index is None:
            return None
        facts = self._unread = self._retry(self._fetch)
        self._empty = not facts.content
        if self._empty:
            return None
        return IndexPlace(self._index, digest_lines(facts.content), facts.sequence, facts.beginning)

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Write an event as the transaction after number `after`; return False when another one has that place."""
        self._unread = None
        change, mark = triple_difference(event), secrets.token_hex(8)
        about = {texts.MARK: mark, texts.ORIGIN: event.origin}
        about |= {} if self._empty else {texts.CHANGES: encode_changes(event.changes)}
        about |= {texts.AUTHOR: self._author} if self._author else {}
        update = texts.write_update(change, after, about, event.origin if self._empty else None)
        self._empty = False
        executed = self._retry(lambda: self._send(update, after, mark))
        self._was_preceded = not executed
        return executed

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return the transactions after number `sequence`, in order.

        The request is sent once, so that readers do not wait, but repeated after a write that another one preceded.
        """
        self._unread = None
        preceded, self._was_preceded = self._was_preceded, False
        return self._retry(lambda: self._read_log(sequence)) if preceded else self._read_log(sequence)

    def _read_log(self, sequence: int) -> tuple[Transaction, ...]:
        rows = sorted(self._query_rows(texts.log_query(sequence), "origin"), key=lambda row: int(row["n"]))
        if any(int(row["n"]) != n or "changes" not in row for n, row in enumerate(rows, sequence + 1)):
            raise StoreError(f"{self} was reset by another process; start again to continue with its current world")
        try:
            return tuple(
                Transaction(int(row["n"]), row["origin"], decode_changes(row["changes"]), row.get("author", ""))
                for row in rows
            )
        except ValueError as error:
            raise StoreError(f"the log of {self} is damaged: {error}; fill the store again with --reset") from error

    def _send(self, update: str, after: int, mark: str) -> bool:
        """Send an update, which has no effect if it was executed before; return whether it was executed."""
        self._endpoint.update(update)
        found = self._first_row(texts.head_query(after + 1))
        if int(found["n"]) == after:
            raise ServerUnreachable(f"{self} accepted an update and did not execute it")
        return found.get("mark") == mark

    def _read(self) -> StoredWorld:
        facts, self._unread = self._unread or self._fetch(), None
        try:
            quads = ox.parse(facts.content, format=ox.RdfFormat.N_TRIPLES)
            return StoredWorld(facts.sequence, facts.beginning, tuple(quad.triple for quad in quads))
        except (SyntaxError, ValueError) as error:
            raise ServerUnreachable(f"{self} answers a query with an invalid result") from error

    def _fetch(self) -> _Facts:
        for _ in range(MAX_READS):
            head = self._first_row(texts.beginning_query(), "beginning")
            content = self._endpoint.query(texts.FACTS, TRIPLES)
            if self._first_row(texts.beginning_query(), "beginning") == head:
                return _Facts(int(head["n"]), head["beginning"], content)
        raise StoreError(f"{self} cannot be read, because other processes write to it all the time")

    def _first_row(self, query: str, *names: str) -> Row:
        rows = self._query_rows(query, *names)
        if not rows:
            raise StoreError(f"{self} holds no world any more: it was removed")
        return rows[0]

    def _query_rows(self, query: str, *names: str) -> list[Row]:
        """Return the rows of an answer, each with a number `n` and values of these names."""
        answer = self._endpoint.query(query, ROWS)
        try:
            bindings = msgspec.json.decode(answer, type=_Answer).results.bindings
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
            raise ServerUnreachable(f"{self} answers a query with an invalid result") from error
        rows = [{name: term.value for name, term in row.items()} for row in bindings]
        if not all(_is_number(row.get("n", "")) and row.keys() >= {*names} for row in rows):
            raise ServerUnreachable(f"{self} answers a query with an invalid result")
        return rows

    def _retry(self, ask: Callable[[], T]) -> T:
        """Repeat a request, with growing pauses, until there is an answer; ServerUnreachable after the patience."""
        cancel, pause_s = self._cancel.limited(self._patience_s), FIRST_PAUSE_S
        while True:
            try:
                return ask()
            except ServerUnreachable:
                if pause_s > cancel.remaining_s:
                    raise
            time.sleep(pause_s)
            pause_s *= 2


def digest_lines(content: bytes) -> str:
    """Return a digest of the lines of a text in any order, of 64 bits, but for empty ones."""
    lines = (each.strip() for each in BytesIO(content))
    return f"{sum(int.from_bytes(blake2b(each, digest_size=8).digest(), 'big') for each in lines if each) % 2**64:016x}"


def _is_number(text: str) -> bool:
    """Whether a text is the number of a transaction."""
    return text.isascii() and text.isdecimal() and len(text) <= MOST_DIGITS
