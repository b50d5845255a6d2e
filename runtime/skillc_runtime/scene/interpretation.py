"""Interprets a table of statements: facts about individuals, and the rows that the vocabulary does not allow."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Set
from typing import Literal, NamedTuple, TypeAlias

import msgspec

from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import PropertyTerm, Vocabulary
from skillc_runtime.scene.statements import NAMED_INDIVIDUAL, FactFilter
from skillc_runtime.scene.table import Literals, Named, StatementTable
from skillc_runtime.store.literals import LiteralError, read_literal
from skillc_runtime.world.state.bulk import FactTables
from skillc_runtime.world.state.values import Value, are_equal

MistakeKind: TypeAlias = Literal[
    "unknown class",
    "no class",
    "unknown predicate",
    "unknown subject",
    "unknown object",
    "literal of a relation",
    "thing of a property",
    "wrong literal",
    "second value",
    "no effect",
]
"""`no class`: the object is not a class; `unknown subject`: it has no class; `no effect`: see `checks.ineffective`."""


class Mistake(NamedTuple):
    """A row that is not allowed: its predicate, and its number among the rows with or without literals."""

    kind: MistakeKind
    predicate: str
    is_literal: bool
    row: int
    error: LiteralError | None = None


class Interpretation(msgspec.Struct, frozen=True):
    """The facts that the vocabulary allows, and all rows that it does not."""

    facts: FactTables
    mistakes: list[Mistake]


def interpret_table(table: StatementTable, vocabulary: Vocabulary) -> Interpretation:
    """Return the facts about individuals in a table, and the mistakes."""
    interpreter = _Interpreter(table, vocabulary)
    return Interpretation(interpreter.facts(), interpreter.mistakes)


class _Interpreter:
    def __init__(self, table: StatementTable, vocabulary: Vocabulary) -> None:
        self._table, self._vocabulary = table, vocabulary
        self._filter = FactFilter(vocabulary, table.named[RDF_TYPE])
        self._classes: dict[str, tuple[str, ...]] = {}
        self._declared: Set[str] = set()
        self.mistakes: list[Mistake] = []

    def facts(self) -> FactTables:
        self._read_classes()
        related: dict[str, Named] = {}
        valued: dict[str, dict[str, Value | None]] = {}
        for predicate in self._table.named.keys() | self._table.literal.keys():
            if predicate == RDF_TYPE or not self._filter.may_state_facts(predicate):
                continue
            terms = self._filter.terms
            named = [row for row in self._table.named.get(predicate, ()) if row[0] not in terms]
            literals = [row for row in self._table.literal.get(predicate, ()) if row[0] not in terms]
            if predicate in self._vocabulary.properties:
                valued[predicate] = self._values(predicate, literals)
                self._reject("thing of a property", predicate, False, named)
            elif predicate in self._vocabulary.relations:
                related[predicate] = self._pairs(predicate, named)
                self._reject("literal of a relation", predicate, True, literals)
            else:
                self._reject("unknown predicate", predicate, False, named)
                self._reject("unknown predicate", predicate, True, literals)
        return FactTables(self._classes, related, valued)

    def _read_classes(self) -> None:
        """Read the classes of individuals, and note which individuals have no known class."""
        known, terms, found, lost = self._vocabulary.ancestors, self._filter.terms, self._classes, set[str]()
        for number, (subject, cls) in enumerate(self._table.named[RDF_TYPE]):
            if subject in terms or cls == NAMED_INDIVIDUAL:
                continue
            if cls in known:
                found[subject] = (*found[subject], cls) if subject in found else (cls,)
            else:
                lost.add(subject)
                self._note("unknown class" if cls else "no class", RDF_TYPE, False, (number,))
        for number, (subject, _) in enumerate(self._table.literal.get(RDF_TYPE, ())):
            if subject not in terms:
                lost.add(subject)
                self._note("no class", RDF_TYPE, True, (number,))
        self._declared = found.keys() | lost if lost else found.keys()
        named = {subject for subject, cls in self._table.named[RDF_TYPE] if cls == NAMED_INDIVIDUAL} - terms
        if named - self._declared:
            self._note("no effect", RDF_TYPE, False, (0,))

    def _note_unknown_subjects(self, predicate: str, is_literal: bool, rows: Named | Literals) -> None:
        unknown = [number for number, (subject, _) in enumerate(rows) if subject not in self._declared]
        self._note("unknown subject", predicate, is_literal, unknown)

    def _reject(self, kind: MistakeKind, predicate: str, is_literal: bool, rows: Named | Literals) -> None:
        """Note that none of the rows is allowed."""
        self._note(kind, predicate, is_literal, range(len(rows)))
        self._note_unknown_subjects(predicate, is_literal, rows)

    def _pairs(self, predicate: str, rows: Named) -> Named:
        """Return the pairs of a relation between individuals with known classes."""
        ends = {end for pair in rows for end in pair}
        if ends <= self._classes.keys():
            return rows
        self._note_unknown_subjects(predicate, False, rows)
        for number, (_, object_) in enumerate(rows):
            if object_ not in self._declared:
                self._note("unknown object" if object_ else "no effect", predicate, False, (number,))
        return [(start, end) for start, end in rows if start in self._classes and end in self._classes]

    def _values(self, predicate: str, rows: Literals) -> dict[str, Value | None]:
        """Return the values of a property by individual, several as a tuple unless it is functional."""
        term = self._vocabulary.properties[predicate]
        found: dict[str, Value | None] = {}
        rivals: dict[str, list[Value]] = defaultdict(list)
        functional = term.functional
        for number, (individual, literal) in enumerate(rows):
            try:
                value = read_literal(literal, term)
            except LiteralError as error:
                self.mistakes.append(Mistake("wrong literal", predicate, True, number, error))
                continue
            if type(value) is str and literal.language is not None:
                self._note("no effect", predicate, True, (number,))
            before = found.get(individual)
            if before is None:
                found[individual] = value if functional else (value,)
            elif isinstance(before, tuple) and not functional:
                if not any(are_equal(value, each) for each in before):
                    found[individual] = (*before, value)
            elif not any(are_equal(value, each) for each in (before, *rivals[individual])):
                rivals[individual].append(value)
                self._note("second value", predicate, True, (number,))
        undecided = {one for one, others in rivals.items() if others and not _is_within(found[one], term)}
        if self.mistakes or not found.keys() <= self._classes.keys():
            self._note_unknown_subjects(predicate, True, rows)
            return {one: value for one, value in found.items() if one in self._classes and one not in undecided}
        return found

    def _note(self, kind: MistakeKind, predicate: str, is_literal: bool, numbers: Iterable[int]) -> None:
        self.mistakes += (Mistake(kind, predicate, is_literal, number) for number in numbers)


def _is_within(value: Value | None, term: PropertyTerm) -> bool:
    return term.bounds is None or not isinstance(value, int | float) or term.bounds.hold(value)
