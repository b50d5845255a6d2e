"""Turns statements with positions into changes of the world, and mistakes into diagnostics."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from typing import TypeAlias, assert_never

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Span
from skillc_rdf.turtle.statements import SOMETHING, Node, Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import THING, Vocabulary
from skillc_runtime.scene.foreign_terms import (
    TermUse,
    group_foreign_terms,
    group_repeated_terms,
    report_foreign_terms,
    say_where_else,
)
from skillc_runtime.scene.interpretation import Interpretation, Mistake, interpret_table
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.suggestions import Suggestion, suggest
from skillc_runtime.scene.table import tabulate
from skillc_runtime.store.literals import read_literal
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.values import show

MOST_SUGGESTED = 50
"""For so many mistakes of a scene the names that may be meant are looked for, among all that it has."""
LocatedChange: TypeAlias = tuple[Change, Statement]
"""A change with the statement that states it."""


class LocatedFacts:
    """The interpretation of statements about individuals, with the position of each fact and mistake."""

    def __init__(self, said: Sequence[Statement], vocabulary: Vocabulary) -> None:
        self._said, self._vocabulary = said, vocabulary
        self._rows: dict[tuple[str, bool], list[int]] = defaultdict(list)
        for position, each in enumerate(said):
            self._rows[each.predicate, isinstance(each.object, ox.Literal)].append(position)
        self._meaning: Interpretation = interpret_table(tabulate(said), vocabulary)
        self._classes = self._meaning.facts.types
        self._declared = {iri_of(each.subject): each for each in reversed(said) if each.predicate == RDF_TYPE}
        wrong = (each for each in self._meaning.mistakes if each.kind == "wrong literal")
        self._unreadable = set(map(self._position, wrong))
        self._suggested = 0
        self._first: dict[str, dict[Node, Statement]] = {}

    def changes(self) -> list[LocatedChange]:
        """Return the changes of the statements: individuals first, then relations in order, then values."""
        facts = self._meaning.facts
        pairs = {relation: set(found) for relation, found in facts.related.items()}
        individuals, relations = list[LocatedChange](), list[LocatedChange]()
        stated: dict[tuple[str, str], Statement] = {}
        for position, each in enumerate(self._said):
            subject, predicate, object_ = iri_of(each.subject), each.predicate, iri_of(each.object)
            if predicate == RDF_TYPE and object_ in facts.types.get(subject, ()):
                individuals.append((AddIndividual(subject, (object_,)), each))
            elif (subject, object_) in pairs.get(predicate, ()):
                relations.append((AddRelation(subject, predicate, object_), each))
            elif isinstance(each.object, ox.Literal) and position not in self._unreadable:
                stated.setdefault((subject, predicate), each)
        valued = ((facts.valued.get(predicate, {}).get(subject), each) for (subject, predicate), each in stated.items())
        values = (
            (SetProperty(iri_of(each.subject), each.predicate, value), each)
            for value, each in valued
            if value is not None
        )
        return [*individuals, *relations, *values]

    def problems(self, doubtful: Collection[str]) -> Iterator[Diagnostic]:
        """Yield the problem of each mistake; a missing class of a `doubtful` individual is not reported.

        Terms of a namespace of which nothing is known are one problem, and so is a term that is used many times.
        """
        subjects, objects = dict[str, Statement](), defaultdict[str, list[Statement]](list)
        wrong = [
            (each, self._said[self._position(each)]) for each in sorted(self._meaning.mistakes, key=self._position)
        ]
        unknown = [use for mistake, each in wrong if (use := _unknown_term(mistake, each))]
        again = {each.iri: each.others for each in group_repeated_terms(unknown)}
        foreign = group_foreign_terms(unknown, self._vocabulary)
        yield from (report_foreign_terms(namespace, uses, self._vocabulary) for namespace, uses in foreign.items())
        reported = {use for uses in foreign.values() for use in uses}
        for mistake, each in wrong:
            use = _unknown_term(mistake, each)
            if use in reported:
                continue
            if use is not None and use.iri in again:
                reported.update(again[use.iri])
                yield from (say_where_else(one, again[use.iri]) for one in self._problems_of(mistake, each))
            elif mistake.kind == "unknown subject":
                subjects.setdefault(iri_of(each.subject), each)
            elif mistake.kind == "unknown object":
                objects[iri_of(each.object)].append(each)
            else:
                yield from self._problems_of(mistake, each)
        yield from (self._without_class(iri, each) for iri, each in subjects.items() if iri not in doubtful)
        if SOMETHING not in doubtful:
            yield from (self._unknown_individual(iri, uses) for iri, uses in objects.items() if iri not in doubtful)

    def _problems_of(self, mistake: Mistake, each: Statement) -> Iterator[Diagnostic]:
        """Yield the problem of a single statement."""
        match mistake.kind:
            case "unknown class":
                yield self._unknown("class", iri_of(each.object), each.object_place, self._vocabulary.classes)
            case "no class":
                yield _problem("unknown-class", each, f"{_text(each.object)} is not a class", "name a class")
            case "unknown predicate":
                yield self._unknown_predicate(each, iri_of(each.subject))
            case "literal of a relation":
                message = f"{self._short(each.predicate)} is a relation: it leads to an individual, and this is "
                yield _problem("relation-range", each, message + _text(each.object), "name an individual")
            case "thing of a property":
                name = self._short(each.predicate)
                message = f"{name} is a property: it has a value, and this is {self._shown(each.object)}"
                yield _problem("wrong-data-type", each, message, "write a number or a text in quotes")
            case "wrong literal":
                yield self._wrong_literal(mistake, each)
            case "second value":
                yield from self._second_value(each, iri_of(each.subject))
            case "unknown subject" | "unknown object" | "no effect":
                return
            case _:
                assert_never(mistake.kind)

    def _position(self, mistake: Mistake) -> int:
        return self._rows[mistake.predicate, mistake.is_literal][mistake.row]

    def _wrong_literal(self, mistake: Mistake, each: Statement) -> Diagnostic:
        error = mistake.error
        assert error is not None
        edit = (
            Fix(each.object_place, error.instead, f"write {error.instead}", safe=False)
            if error.instead is not None
            else None
        )
        return _problem("wrong-data-type", each, f"{self._short(each.predicate)}: {error}", error.help, edit)

    def _second_value(self, second: Statement, subject: str) -> Iterator[Diagnostic]:
        """Yield the problem of a second value of a functional property, if the class of the individual is known."""
        if subject not in self._classes:
            return
        term = self._vocabulary.properties[second.predicate]
        first = self._first_values(second.predicate)[second.subject]
        values = [read_literal(each.object, term) for each in (first, second) if isinstance(each.object, ox.Literal)]
        both = " and ".join(map(show, values))
        message = f"{self._short(subject)} has two values of {self._short(term.iri)}: {both}"
        notes = (Label(first.object_place, "the other one"),)
        point = _decimal(first, second)
        help_ = f"write `{point.text}`: decimals take a point" if point else "keep one of them"
        yield Diagnostic("functional-property", second.object_place, message, help_, labels=notes, fix=point)

    def _first_values(self, predicate: str) -> dict[Node, Statement]:
        """Return the first statement about each subject with a readable value of a property."""
        if predicate not in self._first:
            rows = self._rows[predicate, True]
            readable = (self._said[position] for position in reversed(rows) if position not in self._unreadable)
            self._first[predicate] = {each.subject: each for each in readable}
        return self._first[predicate]

    def _without_class(self, subject: str, each: Statement) -> Diagnostic:
        place = each.subject_place
        near = self._suggest(lambda: suggest(subject, place, self._vocabulary, self._declared))
        help_ = near.help if near.fix else "say what it is: `a CLASS ;`"
        return Diagnostic("unknown-individual", place, f"{self._short(subject)} has no class", help_, fix=near.fix)

    def _unknown_predicate(self, each: Statement, subject: str) -> Diagnostic:
        literal = isinstance(each.object, ox.Literal)
        known: Iterable[str] = self._vocabulary.properties if literal else self._vocabulary.relations
        fitting = [iri for iri in known if self._may_have(subject, iri)]
        return self._unknown(
            "property" if literal else "relation", each.predicate, each.predicate_place, known, fitting
        )

    def _may_have(self, subject: str, predicate: str) -> bool:
        """Whether a class of an individual is in the domain of a relation or property."""
        relation = self._vocabulary.relations.get(predicate)
        if relation is not None:
            domains = tuple(each.domain for each in relation.signatures)
        else:
            domains = self._vocabulary.properties[predicate].domains
        classes = self._classes.get(subject, (THING,))
        return any(self._vocabulary.is_a(cls, domain) for cls in classes for domain in domains)

    def _unknown_individual(self, iri: str, uses: list[Statement]) -> Diagnostic:
        """Return the problem of an undeclared individual at its first use; labels mark the others."""
        first = uses[0]
        ranges = {each.range for use in uses for each in self._vocabulary.relations[use.predicate].signatures}
        near = self._suggest(lambda: self._suggest_individual(iri, first.object_place, ranges))
        notes = [Label(use.object_place, "and here") for use in uses[1:]]
        if near.fix is not None:
            meant = next((s for one, s in self._declared.items() if self._short(one) == near.fix.text), None)
            notes += [Label(meant.subject_place, "this one exists")] if meant is not None else []
        message = f"there is no individual {self._short(iri)}"
        edit = near.fix if len(uses) == 1 else None
        return Diagnostic("unknown-individual", first.object_place, message, near.help, labels=tuple(notes), fix=edit)

    def _suggest_individual(self, wrong: str, place: Span, classes: Collection[str]) -> Suggestion:
        """Return the individual that may be meant, of one of these classes if there are any."""
        is_a = self._vocabulary.is_a
        fitting = [one for one, own in self._classes.items() if any(is_a(cls, each) for cls in own for each in classes)]
        return suggest(wrong, place, self._vocabulary, fitting or self._declared, fitting)

    def _suggest(self, search: Callable[[], Suggestion]) -> Suggestion:
        """Return what may be meant; nothing if that was looked for too often in this scene."""
        self._suggested += 1
        return search() if self._suggested <= MOST_SUGGESTED else Suggestion("")

    def _unknown(
        self, kind: str, iri: str, place: Span, known: Iterable[str], fitting: Sequence[str] = ()
    ) -> Diagnostic:
        some = fitting if len(fitting) < len(list(known)) else ()
        near = self._suggest(lambda: suggest(iri, place, self._vocabulary, known, some))
        help_ = near.help or f"declare the {kind} in a .skill file or in an ontology"
        return Diagnostic(f"unknown-{kind}", place, f"there is no {kind} {self._short(iri)}", help_, fix=near.fix)

    def _short(self, iri: str) -> str:
        return self._vocabulary.short(iri)

    def _shown(self, node: object) -> str:
        return self._short(node.value) if isinstance(node, ox.NamedNode) else _text(node)


def _unknown_term(mistake: Mistake, each: Statement) -> TermUse | None:
    """Return the class or predicate that is unknown; None for other mistakes."""
    match mistake.kind:
        case "unknown class":
            return TermUse(iri_of(each.object), each.object_place)
        case "unknown predicate":
            return TermUse(each.predicate, each.predicate_place)
    return None


def _problem(name: str, each: Statement, message: str, help_: str, edit: Fix | None = None) -> Diagnostic:
    return Diagnostic(name, each.object_place, message, help_, fix=edit)


def _text(node: object) -> str:
    return "something without a name" if isinstance(node, ox.BlankNode) else str(node)


def _decimal(first: Statement, second: Statement) -> Fix | None:
    """Return the fix that makes a decimal of two whole numbers with a comma between them."""
    whole, digits = (each.object.value if isinstance(each.object, ox.Literal) else "" for each in (first, second))
    if first.object_at.end + 1 != second.object_at.start or not (whole.lstrip("+-").isdigit() and digits.isdigit()):
        return None
    start, end = first.object_place, second.object_place
    place = Span(start.path, start.line, start.column, end.end_line, end.end_column)
    return Fix(place, f"{whole}.{digits}", "write a decimal point", safe=False)
