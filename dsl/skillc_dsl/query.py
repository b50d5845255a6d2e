"""The memo of what is known of texts, libraries and scenes: a question is answered again only if it has to be.

A query is a pure function of values and of named tables. Values are the same if they are the same objects; what is
looked up in a table is recorded, also by the queries that a query asks. An answer holds as long as both are the same.
An answer that equals one of the last about the same thing is that object again, so what was made of it holds, too.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Generic, Protocol, TypeVar, cast

Value = TypeVar("Value")
Found = TypeVar("Found", covariant=True)

KEPT = 10
"""After how many rounds that ask a query an unused answer is dropped: a word half typed is soon whole again."""
RECENT = 4
"""How many different values about the same thing are known."""


class QueryCycle(RuntimeError):
    """A query asks for its own answer."""


class NameTable(Protocol[Found]):
    """Something in which names are looked up, such as a mapping."""

    def get(self, name: str, /) -> Found | None:
        """Return the value of a name, None if it has none."""
        ...


class Store(Protocol):
    """Keeps answers longer than this process lives."""

    def load(self, query: str, inputs: Iterable[str | bytes]) -> object | None:
        """Return the answer for these inputs, None if there is none or it is damaged."""
        ...

    def save(self, query: str, inputs: Iterable[str | bytes], answer: object) -> None:
        """Keep an answer; that it cannot be kept only costs time."""
        ...


@dataclass(slots=True)
class _Answer:
    """An answer with its inputs, which it keeps alive, what was read of tables, and when it was used last."""

    inputs: tuple[object, ...]
    value: object
    reads: dict[tuple[str, str], object]
    used: int = 0


@dataclass(slots=True)
class _Query:
    """The answers of one query and the last values by what they are about; `clock` counts the rounds that ask it."""

    clock: int = 0
    asked: bool = False
    answers: dict[Hashable, _Answer] = field(default_factory=dict)
    values: dict[Hashable, _Answer] = field(default_factory=dict)

    def drop_old(self) -> None:
        """Forget what the last rounds have not used."""
        for known in (self.answers, self.values):
            for key in [key for key, each in known.items() if each.used < self.clock - KEPT]:
                del known[key]


class Table(Generic[Value]):
    """A table as queries see it: what is looked up is recorded."""

    def __init__(self, name: str, of: NameTable[Value], record: Callable[[tuple[str, str], object], None]) -> None:
        self._name, self._of, self._record = name, of, record

    def get(self, name: str, /) -> Value | None:
        """Return the value of a name, None if it has none."""
        found = self._of.get(name)
        self._record((self._name, name), found)
        return found


class Memo:
    """The answers of queries. An analysis with it finds what one without it finds, whatever was asked before.

    In `store`, if there is one, are answers of earlier processes; `around` is the digest of what their inputs do not
    name. An error in a query, or its cancellation by an exception, leaves nothing behind.
    """

    def __init__(self, store: Store | None = None, around: str = "") -> None:
        self.store, self.around = store, around
        self._queries: defaultdict[str, _Query] = defaultdict(_Query)
        self._tables: dict[str, NameTable[object]] = {}
        self._running: dict[Hashable, dict[tuple[str, str], object]] = {}
        self._rounds = 0

    def begin(self) -> None:
        """Begin the next round; a query that is not asked in a round does not age."""
        self._rounds += 1
        for each in self._queries.values():
            each.clock += each.asked
            each.asked = False
            if self._rounds % KEPT == 0:
                each.drop_old()

    def table(self, name: str, of: NameTable[Value]) -> Table[Value]:
        """Return a table for queries to look things up in; it replaces the last one of that name."""
        self._tables[name] = of
        return Table(name, of, self._record)

    def ask(
        self,
        query: str,
        inputs: tuple[object, ...],
        compute: Callable[[], Value],
        name: Hashable = None,
        saved: Callable[[], Iterable[str | bytes]] | None = None,
    ) -> Value:
        """Return what `compute` returns: a function of the inputs, of `name` and of what it looks up in tables.

        `saved` gives everything that the answer depends on, for the store; without it the answer is not stored.
        """
        known, key = self._queries[query], (name, *map(id, inputs))
        answer = known.answers.get(key)
        if answer is None or not self._is_same(answer.reads):
            with self._run((query, key)) as reads:
                value = compute() if saved is None else self.recall(query, saved(), compute)
            answer = known.answers[key] = _Answer(inputs, value, reads)
        for place, read in answer.reads.items():
            self._record(place, read)
        known.asked, answer.used = True, known.clock
        return cast(Value, answer.value)

    def same(self, query: str, about: Hashable, value: Value) -> Value:
        """Return the one of the last values about something that is equal, else the value."""
        query_ = self._queries[query]
        known = query_.values.setdefault(about, _Answer((), [], {}))
        query_.asked, known.used = True, query_.clock
        values = cast("list[Value]", known.value)
        for place, each in enumerate(values):
            if each is value or each == value:
                if place:
                    values.insert(0, values.pop(place))
                return each
        values.insert(0, value)
        del values[RECENT:]
        return value

    def recent(self, query: str, about: Hashable) -> Sequence[Any]:
        """Return the last values about something, the latest one first."""
        known = self._queries[query].values.get(about)
        return () if known is None else tuple(cast("list[Any]", known.value))

    @contextmanager
    def _run(self, running: Hashable) -> Iterator[dict[tuple[str, str], object]]:
        if running in self._running:
            raise QueryCycle(f"{running} asks for its own answer")
        self._running[running] = {}
        try:
            yield self._running[running]
        finally:
            del self._running[running]

    def recall(self, query: str, inputs: Iterable[str | bytes], compute: Callable[[], Value]) -> Value:
        """Return the answer in the store; else what `compute` returns, a function of the inputs, and store it."""
        if self.store is None:
            return compute()
        inputs = tuple(inputs)
        found = self.store.load(query, inputs)
        if found is None:
            found = compute()
            self.store.save(query, inputs, found)
        return cast(Value, found)

    def _record(self, place: tuple[str, str], value: object) -> None:
        if self._running:
            next(reversed(self._running.values()))[place] = value

    def _is_same(self, reads: dict[tuple[str, str], object]) -> bool:
        found = ((self._tables[table].get(name), value) for (table, name), value in reads.items())
        return all(one is other or one == other for one, other in found)
