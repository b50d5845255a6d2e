"""The names that are visible in a file, and their look-up."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Set
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from skillc_compiler.program.labels import label_declaration
from skillc_compiler.program.unknown import LIBRARY, HeaderLine, UnknownKind, UnknownName
from skillc_compiler.resolve.homes import Homes
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.editions import NEWEST
from skillc_dsl.source import Span
from skillc_dsl.spelling import alike_names
from skillc_rdf.vocabulary.types import (
    THING,
    ClassTerm,
    FunctionTerm,
    PropertyTerm,
    RelationTerm,
    Vocabulary,
    local_name,
)

Kind: TypeAlias = Literal["class", "relation", "property"]
KINDS: tuple[Kind, ...] = ("class", "relation", "property")


@dataclass
class Names:
    """The names visible in one file, and the problems found when looking names up.

    `bare` gives the IRIs that a bare name may denote, `known` all IRIs that exist; `elsewhere` gives the file
    that declares a name which this file does not import.
    """

    bare: Mapping[Kind, Mapping[str, tuple[str, ...]]]
    known: Mapping[Kind, Set[str]]
    vocabulary: Vocabulary
    prefixes: Mapping[str, str]
    functions: Mapping[str, FunctionTerm]
    skills: Set[str]
    elsewhere: Homes
    problems: list[Diagnostic] = field(default_factory=list)
    unknown: list[UnknownName] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    terms: dict[str, Span] = field(default_factory=dict)
    """The terms that were looked up, with the first place of each."""

    def look_up_term(
        self, kind: Kind, name: s.Name, fits: Callable[[str], bool] = lambda _: True, also: Iterable[str] = ()
    ) -> str | None:
        """Return the IRI of a name, or report that it denotes no term or several.

        Suggestions are terms that satisfy `fits`, and the names in `also`.
        """
        found = self._find_term(kind, name, fits, also)
        if found is not None:
            self.terms.setdefault(found, name.span)
        return found

    def _find_term(self, kind: Kind, name: s.Name, fits: Callable[[str], bool], also: Iterable[str]) -> str | None:
        self.used.add(name.text)
        if ":" in name.text:
            return self._qualified_term(kind, name, fits)
        found = self.bare[kind].get(name.text, ())
        if len(found) > 1:
            self._ambiguous(name, found)
        elif not found:
            self._unknown(kind, name, fits, also)
        else:
            self._deprecated(kind, name, found[0])
        return found[0] if found else None

    def look_up_individual(self, name: s.Name) -> str | None:
        """Return the IRI of a qualified name; report an unknown prefix."""
        self.used.add(name.text)
        prefix, _, local = name.text.partition(":")
        if prefix in self.prefixes:
            return self.prefixes[prefix] + local
        span = name.span
        self.unknown.append(
            UnknownName(
                "prefix",
                s.Name(
                    prefix, span._replace(end_column=span.column + len(prefix)) if span.line == span.end_line else span
                ),
                f"the prefix `{prefix}` is not declared",
                tuple(self.prefixes),
                f"add `prefix {prefix}: <..>` at the top of the file",
                owner=LIBRARY,
            )
        )
        return None

    def look_up_function(self, name: s.Name) -> FunctionTerm | None:
        """Return the function of that name, or report that it is unknown."""
        self.used.add(name.text)
        if name.text not in self.functions:
            self._report_unknown("function", name, self.functions)
        return self.functions.get(name.text)

    def look_up_skill(self, name: s.Name) -> str | None:
        """Return the name if it is a visible skill's, or report that it is unknown."""
        self.used.add(name.text)
        if name.text in self.skills:
            return name.text
        self._report_unknown("skill", name, self.skills)
        return None

    def kind_of(self, iri: str) -> Kind | None:
        """Return the kind of term that an IRI denotes, None for an individual."""
        return next((kind for kind in KINDS if iri in self.known[kind]), None)

    def is_class(self, text: str) -> bool:
        """Whether a bare or qualified name denotes a class here."""
        return self.is_term("class", text)

    def is_term(self, kind: Kind, text: str) -> bool:
        """Whether a bare or qualified name denotes a term of this kind here."""
        prefix, _, local = text.rpartition(":")
        if not prefix:
            return text in self.bare[kind]
        iri = self.prefixes.get(prefix, "") + local
        return self.vocabulary.aliases.get(iri, iri) in self.known[kind]

    def shorten(self, iri: str) -> str:
        """Return an IRI as it can be written here, with the longest prefix that fits."""
        fitting = [(len(base), prefix) for prefix, base in self.prefixes.items() if iri.startswith(base)]
        if not fitting:
            return iri
        length, prefix = max(fitting)
        return f"{prefix}:{iri[length:]}"

    def _qualified_term(self, kind: Kind, name: s.Name, fits: Callable[[str], bool]) -> str | None:
        written = self.look_up_individual(name)
        if written is None:
            return None
        iri = self.vocabulary.aliases.get(written, written)
        if iri in self.known[kind]:
            self._deprecated(kind, name, written)
            return iri
        base = self.prefixes[name.text.partition(":")[0]]
        there = (i for i in self.known[kind] if i.startswith(base) and fits(i))
        candidates = [self.shorten(i) for i in there]
        self._report_unknown(kind, name, candidates)
        return None

    def _deprecated(self, kind: Kind, name: s.Name, iri: str) -> None:
        if iri not in self.vocabulary.deprecated:
            return
        other = self.vocabulary.deprecated[iri]
        bare = self.bare[kind].get(local_name(other)) == (other,) and ":" not in name.text
        text = local_name(other) if bare else self.shorten(other)
        self.problems.append(
            Diagnostic(
                "deprecated-term",
                name.span,
                f"the {kind} `{name.text}` is deprecated",
                help=f"use `{text}` instead" if other else "its vocabulary gives no replacement",
                severity="warning",
                labels=label_declaration(self._table(kind)[iri]) if iri in self._table(kind) else (),
                fix=Fix(name.span, text, f"write `{text}`") if other else None,
            )
        )

    def _table(self, kind: Kind) -> Mapping[str, ClassTerm | RelationTerm | PropertyTerm]:
        match kind:
            case "class":
                return self.vocabulary.classes
            case "relation":
                return self.vocabulary.relations
            case "property":
                return self.vocabulary.properties

    def _ambiguous(self, name: s.Name, found: tuple[str, ...]) -> None:
        ways = " and ".join(f"`{self.shorten(iri)}`" for iri in found)
        self.problems.append(
            Diagnostic(
                "ambiguous-name",
                name.span,
                f"`{name.text}` may mean {ways}",
                help=f"write the prefix, such as `{self.shorten(found[0])}`",
            )
        )

    def find_line(self, kind: Kind, text: str) -> HeaderLine | None:
        """Return the line at the top of the file that would make a name visible, None if there is no such line."""
        declaring = self.elsewhere.get(text)
        if declaring is not None:
            return HeaderLine("import", declaring)
        homes = (prefix for prefix, base in self.prefixes.items() if self._has(kind, base + text))
        home = min(homes, default=None)
        return HeaderLine("use", home) if home else None

    def _has(self, kind: Kind, iri: str) -> bool:
        return iri in self.known[kind] or iri in self.vocabulary.aliases

    def _unknown(self, kind: Kind, name: s.Name, fits: Callable[[str], bool], also: Iterable[str]) -> None:
        line = self.find_line(kind, name.text)
        if line is not None and line.keyword == "use":
            message = f"there is no {kind} `{name.text}` in the vocabularies this file uses"
            help_ = f"it is in `{line.name}`: write `use {line.name}` at the top, or `{line.name}:{name.text}` here"
            self.unknown.append(UnknownName(kind, name, message, (), help_, owner=LIBRARY, line=line))
            return
        candidates = (text for text, iris in self.bare[kind].items() if fits(iris[0]))
        self._report_unknown(kind, name, (*candidates, *also))

    def _report_unknown(self, what: UnknownKind, name: s.Name, candidates: Iterable[str]) -> None:
        near, home = tuple(candidates), self.elsewhere.get(name.text)
        help_, line = f"declare the {what}, or import the file that does", None
        if home and not alike_names(name.text, near):
            line = HeaderLine("import", home)
            help_ = f'it is declared in {home}: write `import "{home}"` at the top'
        message = f"there is no {what} `{name.text}`"
        self.unknown.append(UnknownName(what, name, message, near, help_, owner=LIBRARY, line=line))


def bare_terms(
    vocabulary: Vocabulary, used: Iterable[str], edition: int = NEWEST
) -> dict[Kind, dict[str, tuple[str, ...]]]:
    """Return the terms that bare names denote in a file that uses these vocabularies; `Thing` is always included.

    Of several terms of a name, those count that are not later than the edition of the file, if there are any.
    """
    tables: dict[Kind, Mapping[str, object]] = {
        "class": vocabulary.classes,
        "relation": vocabulary.relations,
        "property": vocabulary.properties,
    }
    bases = tuple(vocabulary.prefixes[prefix] for prefix in used if prefix in vocabulary.prefixes)
    found: dict[Kind, dict[str, tuple[str, ...]]] = {"class": {"Thing": (THING,)}, "relation": {}, "property": {}}
    for kind, table in tables.items():
        targets = {**{iri: iri for iri in table}, **{a: t for a, t in vocabulary.aliases.items() if t in table}}
        for iri, target in sorted(targets.items()):
            if bases and iri.startswith(bases) and target not in found[kind].get(local_name(iri), ()):
                found[kind][local_name(iri)] = tuple(sorted((*found[kind].get(local_name(iri), ()), target)))
    if later := vocabulary.later_than(edition):
        for table in found.values():
            for name, iris in table.items():
                table[name] = tuple(iri for iri in iris if iri not in later) or iris
    return found
