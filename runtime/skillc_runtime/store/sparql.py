"""A store on a SPARQL 1.1 server: facts in one graph, and in another the number of the last transaction and a log.

A write is one update that does nothing unless the number is still the one that the writer knows. So it is safe to send
it again when no answer came, and the log tells whether it was made.
"""

from __future__ import annotations

import secrets
import time
from collections.abc import Callable
from typing import TypeVar

import msgspec
import pyoxigraph as ox

from skillc_runtime.store import sparql_texts as texts
from skillc_runtime.store.change_json import decode_changes, encode_changes
from skillc_runtime.store.http import Endpoint, ServerUnreachable
from skillc_runtime.store.store import StoredWorld
from skillc_runtime.store.triples import triple_difference
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError, Transaction

ROWS, TRIPLES = "application/sparql-results+json", "application/n-triples"
PATIENCE_S = 10.0
"""How long a server that does not answer is asked again."""
FIRST_PAUSE_S = 0.1

T = TypeVar("T")
Row = dict[str, str]


class _Term(msgspec.Struct):
    value: str


class _Rows(msgspec.Struct):
    bindings: list[dict[str, _Term]]


class _Answer(msgspec.Struct):
    results: _Rows


class SparqlStore:
    """A world kept on a server that any number of processes use at the same time."""

    def __init__(self, endpoint: Endpoint, reset: bool = False, patience_s: float = PATIENCE_S) -> None:
        """Use a server and, with `reset`, forget what it holds of a world; StoreError when it cannot be used."""
        self._endpoint, self._patience_s, self._empty, self._behind = endpoint, patience_s, False, False
        self._patiently(lambda: endpoint.update(texts.CREATE))
        if reset:
            self._patiently(lambda: endpoint.update(texts.RESET))

    def __str__(self) -> str:
        return str(self._endpoint)

    def close(self) -> None:
        """Leave the store."""
        self._endpoint.close()

    def read(self) -> StoredWorld:
        """Return the facts as they are now, read again when somebody wrote meanwhile."""
        kept = self._patiently(self._read)
        self._empty = not kept.triples
        return kept

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Write an event as the transaction that follows `after`, or return False when there is another already."""
        change, mark = triple_difference(event), secrets.token_hex(8)
        about = {texts.MARK: mark, texts.ORIGIN: event.origin}
        about |= {} if self._empty else {texts.CHANGES: encode_changes(event.changes)}
        update = texts.write_update(change, after, about, event.origin if self._empty else None)
        self._empty = False
        made = self._patiently(lambda: self._sent(update, after, mark))
        self._behind = not made
        return made

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return the transactions after the one of that number, in order.

        Asks once, so that nobody who only looks is held up, but patiently for a write that has to follow others.
        """
        behind, self._behind = self._behind, False
        return self._patiently(lambda: self._logged(sequence)) if behind else self._logged(sequence)

    def _logged(self, sequence: int) -> tuple[Transaction, ...]:
        rows = sorted(self._rows(texts.log_query(sequence), "origin"), key=lambda row: int(row["n"]))
        if any(int(row["n"]) != n or "changes" not in row for n, row in enumerate(rows, sequence + 1)):
            raise StoreError(f"{self} was filled anew by somebody else; start again to go on with what it holds now")
        try:
            return tuple(Transaction(int(row["n"]), row["origin"], decode_changes(row["changes"])) for row in rows)
        except ValueError as error:
            raise StoreError(f"the log of {self} is damaged: {error}; fill the store anew with --reset") from error

    def _sent(self, update: str, after: int, mark: str) -> bool:
        """Send an update, which does nothing where it was made already, and return whether it was made."""
        self._endpoint.update(update)
        found = self._one(texts.head_query(after + 1))
        if int(found["n"]) == after:
            raise ServerUnreachable(f"{self} took an update and did not make it")
        return found.get("mark") == mark

    def _read(self) -> StoredWorld:
        while True:
            head = self._one(texts.beginning_query(), "beginning")
            triples = self._triples()
            if self._one(texts.beginning_query(), "beginning") == head:
                return StoredWorld(int(head["n"]), head["beginning"], triples)

    def _one(self, query: str, *names: str) -> Row:
        rows = self._rows(query, *names)
        if not rows:
            raise StoreError(f"{self} holds no world any more: somebody removed it")
        return rows[0]

    def _rows(self, query: str, *names: str) -> list[Row]:
        """Return the rows of an answer, each with a number `n` and with these names."""
        answer = self._endpoint.query(query, ROWS)
        try:
            bindings = msgspec.json.decode(answer, type=_Answer).results.bindings
        except (msgspec.DecodeError, UnicodeDecodeError) as error:
            raise ServerUnreachable(f"{self} answers a query with something that is no answer") from error
        rows = [{name: term.value for name, term in row.items()} for row in bindings]
        if not all(row.get("n", "").isdecimal() and row.keys() >= {*names} for row in rows):
            raise ServerUnreachable(f"{self} answers a query with something that is no answer")
        return rows

    def _triples(self) -> tuple[ox.Triple, ...]:
        answer = self._endpoint.query(texts.FACTS, TRIPLES)
        try:
            return tuple(quad.triple for quad in ox.parse(answer, format=ox.RdfFormat.N_TRIPLES))
        except (SyntaxError, ValueError) as error:
            raise ServerUnreachable(f"{self} answers a query with something that is no answer") from error

    def _patiently(self, ask: Callable[[], T]) -> T:
        """Ask again, with growing pauses, until there is an answer or patience ends; Unreachable then."""
        ends, pause_s = time.monotonic() + self._patience_s, FIRST_PAUSE_S
        while True:
            try:
                return ask()
            except ServerUnreachable:
                if time.monotonic() + pause_s > ends:
                    raise
            time.sleep(pause_s)
            pause_s *= 2
