"""The prefixes of a Turtle text: what each stands for, and what is wrong with those that stand for nothing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import SequenceMatcher, get_close_matches

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.source import Span
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.tokens import Token

ALIKE = 0.85
"""How alike (0 to 1) two namespaces are when one is the other misspelt."""


@dataclass(frozen=True, slots=True)
class _Declared:
    iri: str
    written: str
    name: Token
    value: Token


class Prefixes:
    """Collects the prefixes declared and used in a text; `known` are those that vocabularies are known by."""

    def __init__(self, known: Mapping[str, str], lines: Lines) -> None:
        self._known = known
        self._lines = lines
        self._declared: dict[str, _Declared] = {}
        self._used: set[str] = set()
        self._lost: set[str] = set()
        self._missing: dict[str, list[Token]] = {}

    def declare(self, name: Token, value: Token, iri: str) -> None:
        """Take in a declaration; a namespace that is nearly that of the vocabulary so called is taken for it."""
        self._declared[name.text.removesuffix(":")] = _Declared(self._meant(name, iri), iri, name, value)

    def give_up(self, prefix: str) -> None:
        """Take in that a prefix is declared and nobody understands how."""
        self._lost.add(prefix)

    def base_of(self, prefix: str, token: Token) -> str | None:
        """Return what a prefix stands for where it is used; None if it was not declared, which is told in the end."""
        if prefix in self._declared:
            self._used.add(prefix)
            return self._declared[prefix].iri
        if prefix in self._lost:
            return self._known.get(prefix)
        self._missing.setdefault(prefix, []).append(token)
        near = self._near(prefix)
        return self._known.get(prefix) or (self._declared[near].iri if near else None)

    def all(self) -> dict[str, str]:
        """Return what each declared prefix stands for."""
        return {prefix: declared.iri for prefix, declared in self._declared.items()}

    def problems(self) -> list[Diagnostic]:
        """Return what is wrong, once for each prefix."""
        misspelt = [
            self._misspelt_namespace(prefix, declared)
            for prefix, declared in self._declared.items()
            if declared.iri != declared.written
        ]
        return [*misspelt, *(self._undeclared(prefix, uses) for prefix, uses in self._missing.items())]

    def _meant(self, name: Token, iri: str) -> str:
        known = self._known.get(name.text.removesuffix(":"))
        if known is None or iri in self._known.values():
            return iri
        return known if SequenceMatcher(None, known, iri).ratio() >= ALIKE else iri

    def _misspelt_namespace(self, prefix: str, declared: _Declared) -> Diagnostic:
        message = f"no vocabulary is called <{declared.written}>"
        place = self._place(declared.value)
        edit = Fix(place, f"<{declared.iri}>", f"write <{declared.iri}>", safe=False)
        return Diagnostic("unknown-vocabulary", place, message, f"`{prefix}:` is <{declared.iri}>", fix=edit)

    def _undeclared(self, prefix: str, uses: list[Token]) -> Diagnostic:
        """Tell of a prefix where it is used first, or where one that nothing uses was declared under a name like it."""
        near = self._near(prefix)
        first = uses[0]
        if near is not None and near not in self._used and self._known.get(near) != self._declared[near].iri:
            place = self._place(self._declared[near].name)
            message = f"`{prefix}:` is used and not declared, `{near}:` is declared and not used"
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
        if prefix in self._known and not any(self._known[prefix] == each.iri for each in self._declared.values()):
            return None
        near = get_close_matches(prefix, self._declared, n=1, cutoff=0.7)
        return near[0] if near else None

    def _place(self, token: Token) -> Span:
        return self._lines.place(token.start, token.end)
