"""Finds the names in a text in Turtle, TriG or N-Triples, whether or not the text has errors, and rewrites them."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

from skillc_rdf.turtle.terms import RDF_TYPE, TermError, iri_of, local_of
from skillc_rdf.turtle.tokens import Token, tokens

CACHED = 64
"""The number of texts whose names are kept."""
_BRACES = re.compile(r"[{}]+")


class NamePlace(NamedTuple):
    """A name in a text: its IRI, its token, and whether it is the subject of a statement about its class."""

    iri: str
    token: Token
    typed: bool = False

    @property
    def extent(self) -> tuple[int, int]:
        """The offsets of the token."""
        return self.token.start, self.token.end

    def end_of(self, name: str) -> tuple[int, int]:
        """Return the offsets of `name`, with which the IRI ends; those of the token if it is not written like that."""
        end = self.token.end - (self.token.kind == "iri")
        start = end - len(name)
        written = self.token.text[max(start - self.token.start, 0) : end - self.token.start]
        return (start, end) if written == name else self.extent

    def rewrite(self, old: str, new: str) -> tuple[int, int, str]:
        """Return the offsets and the text of the edit after which the IRI ends with `new` in place of `old`."""
        start, end = self.end_of(old)
        is_part = (start, end) != self.extent
        return start, end, new if is_part else f"<{self.iri.removesuffix(old)}{new}>"


@lru_cache(maxsize=CACHED)
def find_names(text: str, base: str = "") -> tuple[NamePlace, ...]:
    """Return the names in a text in order, but those that are declared as prefixes; `base` resolves relative IRIs.

    A name whose prefix is not declared has no IRI, and is left out.
    """
    reader = _Reader(base)
    for token in _tokens(text):
        reader.take(token)
    return tuple(reader.found)


@lru_cache(maxsize=CACHED)
def group_names(text: str, base: str = "") -> Mapping[str, tuple[NamePlace, ...]]:
    """Return the names in a text by their IRIs."""
    found: dict[str, list[NamePlace]] = defaultdict(list)
    for name in find_names(text, base):
        found[name.iri].append(name)
    return MappingProxyType({iri: tuple(names) for iri, names in found.items()})


def _tokens(text: str, start: int = 0) -> Iterator[Token]:
    """Yield the tokens of a text; the braces of graphs, which Turtle does not have, are tokens of their own."""
    for token in tokens(text):
        braces = _BRACES.match(token.text) if token.kind == "stray" else None
        place = token._replace(start=token.start + start, end=token.end + start)
        if braces is None:
            yield place
            continue
        yield place._replace(text=braces.group(), end=place.start + braces.end())
        inside = list(_tokens(token.text[braces.end() :], place.start + braces.end()))
        yield from inside[:-1]


@dataclass
class _Reader:
    """Takes the tokens of a text one by one.

    `subject` is the index of the name that the statement is about, None if it is no name; `declared` are the tokens
    of a declaration that has begun.
    """

    base: str
    found: list[NamePlace] = field(default_factory=list)
    _prefixes: dict[str, str] = field(default_factory=dict)
    _declared: list[Token] = field(default_factory=list)
    _subject: int | None = None
    _begins: bool = True
    _depth: int = 0

    def take(self, token: Token) -> None:
        if self._declared:
            self._declare(token)
        elif self._begins and token.text.lower() in ("@prefix", "@base", "prefix", "base"):
            self._declared = [token]
        elif token.is_mark(".") or (token.kind == "stray" and _BRACES.fullmatch(token.text)):
            self._subject, self._begins, self._depth = None, True, 0
        elif token.kind in ("name", "iri"):
            self._name(token)
        else:
            self._begins = False
            self._depth += token.is_mark("[(") - token.is_mark("])")
            if token.is_word("a"):
                self._state_class()

    def _declare(self, token: Token) -> None:
        """Take a token of a declaration, which ends with the IRI."""
        if token.kind == "name":
            self._declared.append(token)
            return
        iri = self._resolve(token) if token.kind == "iri" else None
        if iri is not None and len(self._declared) > 1:
            self._prefixes[local_of(self._declared[1])[0]] = iri
        elif iri is not None:
            self.base = iri
        self._declared = []

    def _name(self, token: Token) -> None:
        iri = self._resolve(token)
        if self._begins:
            self._subject = None if iri is None else len(self.found)
        self._begins = False
        if iri is not None:
            self.found.append(NamePlace(iri, token))
        if iri == RDF_TYPE:
            self._state_class()

    def _state_class(self) -> None:
        if self._subject is not None and not self._depth:
            self.found[self._subject] = self.found[self._subject]._replace(typed=True)

    def _resolve(self, token: Token) -> str | None:
        if token.kind == "name":
            prefix, local = local_of(token)
            return self._prefixes[prefix] + local if prefix in self._prefixes else None
        try:
            return iri_of(token, self.base)
        except TermError:
            return None
