"""Results that are reused while their inputs are the same objects; with it, an analysis is incremental."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Generic, Protocol, TypeVar

Value = TypeVar("Value")
Found = TypeVar("Found", covariant=True)
Result = TypeVar("Result")


KEPT = 10
"""For how many analyses something is kept that none of them has used: a word half typed is soon whole again."""
RECENT = 4
"""How many different values of a key are kept."""


class Recent(Generic[Value]):
    """Values by key; those that the last analyses have not used are dropped, so it does not grow with the edits."""

    def __init__(self) -> None:
        self._known: dict[Hashable, Value] = {}
        self._used: dict[Hashable, int] = {}
        self._number = 0

    def begin(self) -> None:
        """Begin the next analysis."""
        self._number += 1
        if self._number % KEPT == 0:
            for key in [key for key, used in self._used.items() if used < self._number - KEPT]:
                del self._known[key], self._used[key]


class Memo(Recent[tuple[tuple[object, ...], Result]], Generic[Result]):
    """The results of one function, by the identity of its inputs, which it keeps alive."""

    def recall(
        self,
        inputs: tuple[object, ...],
        compute: Callable[[], Result],
        is_valid: Callable[[Result], bool] = lambda _: True,
        name: Hashable = None,
    ) -> Result:
        """Return the result of that name for the inputs: computed if it is not known, or not valid any more."""
        key = (name, *map(id, inputs))
        found = self._known.get(key)
        if found is None or not is_valid(found[1]):
            found = self._known[key] = (inputs, compute())
        self._used[key] = self._number
        return found[1]


class Latest(Recent[list[Value]], Generic[Value]):
    """The last values of each key, the latest one first; a value that is equal to one of them is the same object."""

    def same(self, key: Hashable, value: Value) -> Value:
        """Return the one of the last values of the key that is equal, else the value."""
        self._used[key] = self._number
        known = self._known.setdefault(key, [])
        for place, each in enumerate(known):
            if each == value:
                if place:
                    known.insert(0, known.pop(place))
                return each
        known.insert(0, value)
        del known[RECENT:]
        return value


class Memos:
    """The base of dataclasses whose fields all keep something from one analysis to the next."""

    def begin(self) -> None:
        """Begin the next analysis."""
        for each in vars(self).values():
            each.begin()


class NameTable(Protocol[Found]):
    """Something in which names are looked up, such as a mapping."""

    def get(self, name: str, /) -> Found | None:
        """Return the value of a name, None if it has none."""
        ...


class LookUps(Generic[Value]):
    """A table that records which names are looked up: `asked`, with what was found."""

    def __init__(self, of: NameTable[Value]) -> None:
        self._of = of
        self.asked: dict[str, Value | None] = {}

    def get(self, name: str, /) -> Value | None:
        """Return the value of a name, None if it has none."""
        self.asked[name] = self._of.get(name)
        return self.asked[name]
