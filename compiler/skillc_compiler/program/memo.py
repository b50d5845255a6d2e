"""Results that are reused while their inputs are the same objects; with it, an analysis is incremental."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Generic, Protocol, TypeVar

Value = TypeVar("Value")
Found = TypeVar("Found", covariant=True)
Result = TypeVar("Result")


class Memo(Generic[Result]):
    """The results of one function, by the identity of its inputs, which it keeps alive.

    What neither this analysis nor the one before it has used is dropped, so it does not grow with the edits.
    """

    def __init__(self) -> None:
        self._now: dict[Hashable, tuple[tuple[object, ...], Result]] = {}
        self._before = self._now

    def begin(self) -> None:
        """Begin the next analysis."""
        self._before, self._now = self._now, {}

    def recall(
        self,
        inputs: tuple[object, ...],
        compute: Callable[[], Result],
        is_valid: Callable[[Result], bool] = lambda _: True,
        name: Hashable = None,
    ) -> Result:
        """Return the result of that name for the inputs: computed if it is not known, or not valid any more."""
        key = (name, *map(id, inputs))
        found = self._now.get(key) or self._before.get(key)
        if found is None or not is_valid(found[1]):
            found = (inputs, compute())
        self._now[key] = found
        return found[1]


class Latest(Generic[Value]):
    """The latest value of each key; one that is equal to the value before stays the same object."""

    def __init__(self) -> None:
        self._now: dict[Hashable, Value] = {}
        self._before = self._now

    def begin(self) -> None:
        """Begin the next analysis."""
        self._before, self._now = self._now, {}

    def same(self, key: Hashable, value: Value) -> Value:
        """Return the value of the key in the analysis before if it is equal, else the value."""
        before = self._before.get(key)
        self._now[key] = before if before is not None and before == value else value
        return self._now[key]


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
