"""The prefixes of a Turtle text: their namespaces, and diagnostics of undeclared and misspelt ones."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import SequenceMatcher, get_close_matches

import msgspec

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.source import Span
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.tokens import Token

ALIKE = 0.85
"""The similarity (0 to 1) from which a namespace counts as a misspelling of another."""
MOST_SEARCHES, LONGEST = 100, 64
"""How often a text is searched for a similar prefix, and the longest prefix for which it is."""


class _Declared(msgspec.Struct, frozen=True):
    iri: str
    written: str
    name: Token
    value: Token


class Prefixes:
    """The prefixes declared and used in a text; `known` are those of the vocabularies."""

    def __init__(self, known: Mapping[str, str], lines: Lines) -> None:
        self._known = known
        self._lines = lines
        self._declared: dict[str, _Declared] = {}
        self._used: set[str] = set()
        self._lost: set[str] = set()
        self._missing: dict[str, list[Token]] = {}
        self._searched: dict[tuple[str, int], str | None] = {}

    def declare(self, name: Token, value: Token, iri: str) -> None:
        """Add a declaration; a namespace that is a misspelling of the known one is replaced by it."""
        self._declared[name.text.removesuffix(":")] = _Declared(self._meant(name, iri), iri, name, value)

    def give_up(self, prefix: str) -> None:
        """Note that the declaration of a prefix could not be parsed."""
        self._lost.add(prefix)

    def base_of(self, prefix: str, token: Token) -> str | None:
        """Return the namespace of a prefix at a use; None if it is not declared, which `problems` reports."""
        if prefix in self._declared:
            self._used.add(prefix)
            return self._declared[prefix].iri
        if prefix in self._lost:
            return self._known.get(prefix)
        self._missing.setdefault(prefix, []).append(token)
        near = self._near(prefix)
        return self._known.get(prefix) or (self._declared[near].iri if near else None)

    def all(self) -> dict[str, str]:
        """Return the namespaces of the declared prefixes."""
        return {prefix: declared.iri for prefix, declared in self._declared.items()}

    def problems(self) -> list[Diagnostic]:
        """Return the diagnostics, at most one per prefix."""
        misspelt = [
            self._misspelt_namespace(prefix, declared)
            for prefix, declared in self._declared.items()
            if declared.iri != declared.written
        ]
        return [*misspelt, *(self._undeclared(prefix, uses) for prefix, uses in self._missing.items())]

    def _meant(self, name: Token, iri: str) -> str:
        known = self._known.get(name.text.removesuffix(":"))
        if known is None or iri in self._known.values() or len(iri) > 2 * len(known):
            return iri
        return known if SequenceMatcher(None, known, iri).ratio() >= ALIKE else iri

    def _misspelt_namespace(self, prefix: str, declared: _Declared) -> Diagnostic:
        message = f"no vocabulary is called <{declared.written}>"
        place = self._place(declared.value)
        edit = Fix(place, f"<{declared.iri}>", f"write <{declared.iri}>", safe=False)
        return Diagnostic("unknown-vocabulary", place, message, f"`{prefix}:` is <{declared.iri}>", fix=edit)

    def _undeclared(self, prefix: str, uses: list[Token]) -> Diagnostic:
        """Report a prefix at its first use, or at the declaration of an unused one with a similar name."""
        near = self._near(prefix)
        first = uses[0]
        if near is not None and near not in self._used and self._known.get(near) != self._declared[near].iri:
            place = self._place(self._declared[near].name)
            message = f"`{prefix}:` is used but not declared, and `{near}:` is declared but not used"
            edit = Fix(place, f"{prefix}:", f"write `{prefix}:`", safe=False)
            return Diagnostic("unknown-prefix", place, message, f"did you mean `{prefix}:`?", fix=edit)
        place = self._lines.place(first.start, first.start + len(prefix) + 1)
        message = f"the prefix `{prefix}:` is not declared"
        if near is not None:
            edit = Fix(place, f"{near}:", f"write `{near}:`", safe=False)
            return Diagnostic("unknown-prefix", place, message, f"did you mean `{near}:`?", fix=edit)
        if prefix in self._known:
            line = f"@prefix {prefix}: <{self._known[prefix]}> ."
            edit = Fix(Span(place.path, 1, 1, 1, 1), f"{line}\n", "declare it", safe=False)
            return Diagnostic("unknown-prefix", place, message, f"begin the file with `{line}`", fix=edit)
        return Diagnostic("unknown-prefix", place, message, f"begin the file with `@prefix {prefix}: <IRI> .`")

    def _near(self, prefix: str) -> str | None:
        """Return the declared prefix that is similar, None if there is none or too many were searched for."""
        search = prefix, len(self._declared)
        if search not in self._searched:
            allowed = len(self._searched) < MOST_SEARCHES and len(prefix) <= LONGEST
            self._searched[search] = self._find_near(prefix) if allowed else None
        return self._searched[search]

    def _find_near(self, prefix: str) -> str | None:
        if prefix in self._known and not any(self._known[prefix] == each.iri for each in self._declared.values()):
            return None
        near = get_close_matches(prefix, self._declared, n=1, cutoff=0.7)
        return near[0] if near else None

    def _place(self, token: Token) -> Span:
        return self._lines.place(token.start, token.end)
