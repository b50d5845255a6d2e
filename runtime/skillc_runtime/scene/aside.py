"""Sets statements of a scene aside that nothing here understands: they are kept and listed, but are no facts.

Not understood are undeclared relations, properties and classes, unless the name of a declared one is probably meant;
individuals without a name, of undeclared classes alone, or of other vocabularies, such as units; values that are no
text where a property has no range; and empty names of frames.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import msgspec
import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_dsl.spelling import alike_names
from skillc_rdf.turtle.statements import Node, Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.closure import reachable
from skillc_rdf.vocabulary.types import LITERAL, Vocabulary, local_name, namespace_of
from skillc_runtime.scene.standard_terms import is_misspelt
from skillc_runtime.scene.statements import NAMED_INDIVIDUAL, FactFilter, iri_of, pairs
from skillc_runtime.store.literals import TEXTS
from skillc_runtime.world.state.terms import BASE_FRAME_ID, FRAME_ID

ASIDE = "not-understood"
UNKNOWN = "unknown-individual"
NAMELESS = "things without a name"
FRAMES = (FRAME_ID, BASE_FRAME_ID)
OWN = "https://w3id.org/skillc/"
"""What the namespaces of skillc and of libraries begin with: whoever names a term there means one that is declared."""
SHOWN = 5
"""The most kinds of statements that are named for a file."""


class Sorted(msgspec.Struct, frozen=True):
    """The statements that are understood, and the others in order, each with what is unknown in it."""

    understood: tuple[Statement, ...]
    aside: tuple[tuple[str, Statement], ...]


class Unfit(NamedTuple):
    """A statement that contradicts the ontology, and how."""

    statement: Statement
    message: str


def set_aside(said: Sequence[Statement], vocabulary: Vocabulary) -> Sorted:
    """Divide statements into those that are understood and others."""
    reasons = _Reasons(said, vocabulary)
    understood, aside = list[Statement](), list[tuple[str, Statement]]()
    for each in said:
        if (reason := reasons.of(each)) is None:
            understood.append(each)
        else:
            aside.append((reason, each))
    return Sorted(tuple(understood), tuple(aside))


def report_aside(aside: Iterable[tuple[str, Statement]], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield, once for each file, a warning that lists what is not understood."""
    files: dict[str, dict[str, list[Statement]]] = defaultdict(lambda: defaultdict(list))
    for reason, each in aside:
        files[each.lines.path][reason].append(each)
    for found in files.values():
        total = sum(map(len, found.values()))
        kinds = sorted(found, key=lambda reason: (-len(found[reason]), reason))
        names = [reason if reason == NAMELESS else f"`{vocabulary.short(reason)}`" for reason in kinds]
        listed = ", ".join(f"{name} ({len(found[kind])})" for name, kind in zip(names, kinds, strict=True))[:400]
        statements = "1 statement of this file is" if total == 1 else f"{total} statements of this file are"
        first, *others = sorted(_place(found[kind][0]) for kind in kinds)
        yield Diagnostic(
            ASIDE,
            first,
            f"{statements} not understood and kept as they are: {listed}",
            help="declare what skills need in a .skill file or an ontology, and name things",
            severity="warning",
            labels=tuple(Label(place, "also this") for place in others[:SHOWN]),
        )


def find_unfit(said: Iterable[Statement], problems: Iterable[Diagnostic], vocabulary: Vocabulary) -> list[Unfit]:
    """Return the statements of idle terms that are errors, or take part in one, each with the first error."""
    idle = frozenset(vocabulary.idle)
    if not idle:
        return []
    errors: dict[Span, str] = {}
    unknown: dict[Span, str] = {}
    for each in problems:
        if each.severity == "error":
            for place in (each.span, *(label.span for label in each.labels)):
                errors.setdefault(place, each.message)
            if each.name == UNKNOWN:
                unknown[each.span] = each.message
    written = (each for each in said if errors and each.predicate in idle)
    found = ((each, _error_of(each, errors) or unknown.get(each.subject_place)) for each in written)
    return [Unfit(each, message) for each, message in found if message is not None]


def _error_of(each: Statement, errors: Mapping[Span, str]) -> str | None:
    return errors.get(each.predicate_place) or errors.get(each.object_place)


def report_unfit(unfit: Iterable[Unfit], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield, once for each file, a warning that lists the statements that do not fit the terms in them."""
    files: dict[str, list[Unfit]] = defaultdict(list)
    for one in unfit:
        files[one.statement.lines.path].append(one)
    for found in files.values():
        counts = Counter(vocabulary.short(each.statement.predicate) for each in found)
        listed = ", ".join(f"`{name}` ({count})" for name, count in sorted(counts.items()))[:400]
        first, *others = sorted((_place(each.statement), each.message) for each in found)
        statements = "1 statement" if len(found) == 1 else f"{len(found)} statements"
        yield Diagnostic(
            ASIDE,
            first[0],
            f"{statements} of terms that no skill reads contradict the ontology, and are kept as they are: {listed}",
            help=f"correct them before a skill reads the terms: {first[1]}",
            severity="warning",
            labels=tuple(Label(place, message) for place, message in others[:SHOWN]),
        )


def _place(each: Statement) -> Span:
    return each.object_place if each.predicate == RDF_TYPE else each.predicate_place


class _Reasons:
    """Finds what is unknown in statements: the IRI of a term, or NAMELESS."""

    def __init__(self, said: Sequence[Statement], vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._filter = FactFilter(vocabulary, pairs(said, RDF_TYPE))
        self._odd_predicates = {each for each in {each.predicate for each in said} if self._is_undeclared(each)}
        types = [each for each in said if each.predicate == RDF_TYPE]
        self._odd_classes = {
            each for each in {iri_of(each.object) for each in types} if self._is_undeclared_class(each)
        }
        predicates = {each.predicate for each in said if self._is_unknown_predicate(each)}
        classes = {iri_of(each.object) for each in types if self._is_unknown_class(each)}
        meant = _Meant(predicates | classes, vocabulary)
        self._predicates = {iri for iri in predicates if not meant.is_meant(iri)}
        self._classes = {iri for iri in classes if not meant.is_meant(iri)}
        self._lost = self._find_lost(types if self._classes else ())
        self._elsewhere = self._find_elsewhere(said)
        self._nameless = self._find_nameless(said)

    def of(self, each: Statement) -> str | None:
        """Return what is unknown in a statement, None if it is understood."""
        if self._nameless and (each.subject in self._nameless or each.object in self._nameless):
            return NAMELESS
        subject, target = iri_of(each.subject), iri_of(each.object)
        lost = self._lost.get(subject) or self._lost.get(target)
        if lost is not None and (subject in self._lost or self._is_link(each)):
            return lost
        if target in self._elsewhere and self._relates(each):
            return target
        if each.predicate in self._predicates and self._is_unknown_predicate(each):
            return each.predicate
        if target in self._classes and self._is_unknown_class(each):
            return target
        return each.predicate if self._is_no_text(each) or _names_nothing(each) else None

    def _is_undeclared(self, predicate: str) -> bool:
        known = predicate in self._vocabulary.relations or predicate in self._vocabulary.properties
        return not known and predicate != RDF_TYPE and not is_misspelt(predicate)

    def _is_undeclared_class(self, cls: str) -> bool:
        return cls not in ("", NAMED_INDIVIDUAL) and cls not in self._vocabulary.ancestors and not is_misspelt(cls)

    def _is_unknown_predicate(self, each: Statement) -> bool:
        return each.predicate in self._odd_predicates and self._states_fact(each)

    def _is_unknown_class(self, each: Statement) -> bool:
        return each.predicate == RDF_TYPE and iri_of(each.object) in self._odd_classes and self._states_fact(each)

    def _states_fact(self, each: Statement) -> bool:
        return iri_of(each.subject) not in self._filter.terms and self._filter.may_state_facts(each.predicate)

    def _is_link(self, each: Statement) -> bool:
        return each.predicate in self._vocabulary.relations or self._is_unknown_predicate(each)

    def _is_no_text(self, each: Statement) -> bool:
        """Whether a property without a range has a value that is no text."""
        term = self._vocabulary.properties.get(each.predicate)
        if term is None or term.datatype != LITERAL or not isinstance(each.object, ox.Literal):
            return False
        return each.object.datatype.value not in TEXTS and iri_of(each.subject) not in self._filter.terms

    def _find_lost(self, types: Sequence[Statement]) -> dict[str, str]:
        """Return the individuals that are, as `types` say, of unknown classes alone, each with one of them."""
        unknown = {each for each in types if self._is_unknown_class(each) and iri_of(each.object) in self._classes}
        known = {each.subject for each in types if each not in unknown and iri_of(each.object) != NAMED_INDIVIDUAL}
        return {iri_of(each.subject): iri_of(each.object) for each in unknown if each.subject not in known}

    def _find_elsewhere(self, said: Sequence[Statement]) -> set[str]:
        """Return the objects of relations of which nothing is said, nor of anything else of their namespaces.

        They belong to another vocabulary, as units do, unless all used of the namespace is in one of the individuals.
        """
        homes, used = defaultdict[str, set[str]](set), defaultdict[str, set[str]](set)
        for iri in {iri_of(each.subject) for each in said} - {""}:
            homes[namespace_of(iri)].add(local_name(iri))
        objects = {iri_of(each.object) for each in said if self._relates(each)} - {""}
        for iri in (each for each in objects if namespace_of(each) not in homes):
            used[namespace_of(iri)].add(local_name(iri))
        wrong = {base for base, names in used.items() if any(names <= there for there in homes.values())}
        return {iri for iri in objects if namespace_of(iri) in used.keys() - wrong}

    def _relates(self, each: Statement) -> bool:
        return each.predicate in self._vocabulary.relations and iri_of(each.subject) not in self._filter.terms

    def _find_nameless(self, said: Sequence[Statement]) -> set[Node]:
        """Return the blank nodes that individuals would be, and those that only statements about them mention."""
        found: set[Node] = set()
        inside: dict[Node, list[Node]] = defaultdict(list)
        for each in said:
            if not isinstance(each.subject, ox.BlankNode) and not isinstance(each.object, ox.BlankNode):
                continue
            blank = [node for node in (each.subject, each.object) if isinstance(node, ox.BlankNode)]
            if len(blank) == 2:
                inside[each.subject].append(each.object)
            if self._is_about_individuals(each):
                found.update(blank)
        return reachable(found, lambda node: inside.get(node, ()))

    def _is_about_individuals(self, each: Statement) -> bool:
        if each.predicate == RDF_TYPE:
            return iri_of(each.object) in self._vocabulary.classes
        if each.predicate in self._vocabulary.relations or each.predicate in self._vocabulary.properties:
            return iri_of(each.subject) not in self._filter.terms or isinstance(each.subject, ox.BlankNode)
        return each.predicate in self._predicates and not isinstance(each.subject, ox.BlankNode)


def _names_nothing(each: Statement) -> bool:
    """Whether the name of a frame is empty, as SkiROS2 writes it for things without a pose."""
    return each.predicate in FRAMES and isinstance(each.object, ox.Literal) and not each.object.value


class _Meant:
    """Decides whether an unknown term is a misspelt known one; `unknown` are all unknown terms."""

    def __init__(self, unknown: Iterable[str], vocabulary: Vocabulary) -> None:
        self._there: dict[str, set[str]] = defaultdict(set)
        for iri in (*vocabulary.classes, *vocabulary.relations, *vocabulary.properties) if unknown else ():
            self._there[namespace_of(iri)].add(local_name(iri))
        self._used: dict[str, set[str]] = defaultdict(set)
        for iri in unknown:
            self._used[namespace_of(iri)].add(local_name(iri))

    def is_meant(self, iri: str) -> bool:
        """Whether the namespace is of skillc, a known term is alike, or another namespace has all used of it."""
        if iri.startswith(OWN):
            return True
        base, name = namespace_of(iri), local_name(iri)
        others = (names for namespace, names in self._there.items() if namespace != base)
        if base in self._there:
            return bool(alike_names(name, self._there[base])) or any(name in names for names in others)
        return any(self._used[base] <= names for names in others)
