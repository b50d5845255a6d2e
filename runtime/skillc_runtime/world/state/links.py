"""The pairs of one relation, indexed both ways."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass

from skillc_runtime.world.state.table import Table

NONE: frozenset[str] = frozenset()


def _no_entries() -> Table[str, frozenset[str]]:
    return Table(NONE)


@dataclass(frozen=True, slots=True)
class Links:
    """An immutable set of pairs (subject, object)."""

    forward: Table[str, frozenset[str]]
    backward: Table[str, frozenset[str]]

    @staticmethod
    def empty() -> Links:
        """Return no pairs."""
        return Links(_no_entries(), _no_entries())

    def pairs(self) -> Iterator[tuple[str, str]]:
        """Yield all pairs, in no particular order."""
        for subject, objects in self.forward.items():
            for object_ in objects:
                yield subject, object_


class LinksDraft:
    """Pairs on the way to the next version: only the entries that are written are copied."""

    def __init__(self, links: Links) -> None:
        self._links = links
        self._forward: dict[str, set[str]] = {}
        self._backward: dict[str, set[str]] = {}

    def objects(self, subject: str) -> Set[str]:
        """Return the objects of a subject as they are now."""
        return self._forward[subject] if subject in self._forward else self._links.forward.get(subject)

    def subjects(self, object_: str) -> Set[str]:
        """Return the subjects of an object as they are now."""
        return self._backward[object_] if object_ in self._backward else self._links.backward.get(object_)

    def add(self, subject: str, object_: str) -> None:
        """Put a pair in."""
        if object_ not in self.objects(subject):
            _writable(self._forward, self._links.forward, subject).add(object_)
            _writable(self._backward, self._links.backward, object_).add(subject)

    def discard(self, subject: str, object_: str) -> None:
        """Take a pair out, if it is there."""
        if object_ in self.objects(subject):
            _writable(self._forward, self._links.forward, subject).discard(object_)
            _writable(self._backward, self._links.backward, object_).discard(subject)

    def frozen(self) -> Links:
        """Return the version written, the former one where nothing was."""
        if not self._forward:
            return self._links
        return Links(
            self._links.forward.updated(_sets(self._forward)), self._links.backward.updated(_sets(self._backward))
        )


def _writable(written: dict[str, set[str]], table: Table[str, frozenset[str]], key: str) -> set[str]:
    if key not in written:
        written[key] = set(table.get(key))
    return written[key]


def _sets(written: dict[str, set[str]]) -> dict[str, frozenset[str]]:
    return {key: frozenset(members) if members else NONE for key, members in written.items()}
