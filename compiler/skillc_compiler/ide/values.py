"""The names in types, values and conditions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import zip_longest
from typing import TypeAlias, assert_never

import msgspec

from skillc_compiler.ide.symbols import (
    AggregateSymbol,
    ChoiceSymbol,
    FailurePartSymbol,
    FunctionSymbol,
    IndividualSymbol,
    LocalSymbol,
    Occurrence,
    QuantitySymbol,
    Symbol,
    TermSymbol,
    TypeSymbol,
)
from skillc_compiler.ide.visible import VisibleNames
from skillc_compiler.program.typed import Skill
from skillc_compiler.resolve.names import Kind
from skillc_compiler.resolve.type_names import BUILT_IN, is_built_in
from skillc_dsl import syntax as s
from skillc_dsl.messages import read_message
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import value_name

Locals: TypeAlias = Mapping[str, Symbol]


class ValueOccurrences(msgspec.Struct, frozen=True):
    """Finds the occurrences in types, values and conditions of one file."""

    visible: VisibleNames
    skills: Mapping[str, Skill]
    labels: frozenset[tuple[str, str]]

    def term(self, kind: Kind, name: s.Name, declares: bool = False) -> Iterator[Occurrence]:
        """Yield the occurrence of a term; an unknown term has none."""
        iri = self.visible.term(kind, name.text)
        if iri is not None:
            yield Occurrence(name.span, TermSymbol(kind, iri), declares)

    def read(self, name: s.Name, declares: bool = False) -> Iterator[Occurrence]:
        """Yield the occurrence of a property, or of a functional relation whose value is read."""
        is_property = self.visible.term("property", name.text) is not None
        return self.term("property" if is_property else "relation", name, declares)

    def type(self, written: s.TypeName) -> Iterator[Occurrence]:
        """Yield the occurrences in a type."""
        match written:
            case s.ListOf(element=element):
                yield from self.type(element)
            case s.OfDimension(of=of, dimension=dimension):
                yield from self.type(of)
                yield from self.type(dimension)
            case s.Name(text=text, span=span) if is_built_in(text, self.visible.term("class", text) is not None):
                yield Occurrence(span, TypeSymbol(text))
            case s.Name():
                yield from self.term("class", written)
            case _:
                assert_never(written)

    def value(self, known: Locals, written: s.Value) -> Iterator[Occurrence]:
        """Yield the occurrences in a value; `known` are the symbols of the local names."""
        match written:
            case s.Number() | s.Text() | s.Boolean():
                return
            case s.Quantity(value=value, unit=unit, span=span):
                yield Occurrence(span, QuantitySymbol(value, unit))
            case s.NameReference(name=name):
                yield from self.reference(known, name)
            case s.Member(of=of, property=name):
                yield from self.value(known, of)
                if _is_failure(known, of):
                    yield Occurrence(name.span, FailurePartSymbol(name.text))
                else:
                    yield from self.read(name)
            case s.Invoke():
                yield from self._invoked(known, written)
            case s.ListValue(items=items):
                yield from (each for item in items for each in self.value(known, item))
            case s.Arithmetic(left=left, right=right):
                yield from self.value(known, left)
                yield from self.value(known, right)
            case s.Aggregate():
                yield from self._aggregate(known, written)
            case _:
                assert_never(written)

    def _invoked(self, known: Locals, written: s.Invoke) -> Iterator[Occurrence]:
        name = written.function
        if name.text in self.visible.functions:
            yield Occurrence(name.span, FunctionSymbol(name.text))
        function = self.visible.vocabulary.functions.get(name.text)
        for argument, kind in zip_longest(written.arguments, function.parameters if function else ()):
            if argument is not None:
                yield from self.passed(known, argument, kind is not None and kind[1] == BUILT_IN["Message"])

    def passed(self, known: Locals, written: s.Value, is_message: bool) -> Iterator[Occurrence]:
        """Yield the occurrences in an argument, with those of the values in a text that is read for them."""
        if is_message and isinstance(written, s.Text):
            yield from (each for part in read_message(written)[0].values for each in self.value(known, part))
        yield from self.value(known, written)

    def reference(self, known: Locals, name: s.Name) -> Iterator[Occurrence]:
        """Yield the occurrence of a name that is used as a value."""
        iri = self.visible.iri(name.text) if ":" in name.text else None
        if name.text in known:
            yield Occurrence(name.span, known[name.text])
        elif iri is not None and iri in self.visible.vocabulary.enumerated:
            yield Occurrence(name.span, ChoiceSymbol(value_name(iri), iri))
        elif iri is not None:
            yield Occurrence(name.span, IndividualSymbol(iri))
        elif name.text in self.visible.vocabulary.value_names:
            yield Occurrence(name.span, ChoiceSymbol(name.text))

    def condition(self, known: Locals, written: s.Condition) -> Iterator[Occurrence]:
        """Yield the occurrences in a condition."""
        match written:
            case s.Relation(subject=subject, relation=name, object=object_):
                yield from self._side(known, subject)
                yield from self.term("relation", name)
                yield from self._side(known, object_)
            case s.Compare() | s.Change():
                yield from self._comparison(known, written)
            case s.Has(subject=subject, property=name):
                yield from self.value(known, subject)
                yield from self.read(name)
            case s.Is(subject=subject, cls=name):
                yield from self.value(known, subject)
                yield from self.term("class", name)
            case s.Given(parameter=name):
                yield from self.reference(known, name)
            case s.Not(body=body):
                yield from self.condition(known, body)
            case s.And(parts=parts) | s.Or(parts=parts):
                for part in parts:
                    yield from self.condition(known, part)
            case s.Implies(if_=premise, then=then):
                yield from self.condition(known, premise)
                yield from self.condition(known, then)
            case s.Quantified():
                yield from self._quantified(known, written)
            case s.Bare(value=value):
                yield from self.value(known, value)
            case _:
                assert_never(written)

    def _quantified(self, known: Locals, written: s.Quantified) -> Iterator[Occurrence]:
        variable = written.variable
        yield from self.term("class", written.cls)
        yield from self.bound(known, variable, LocalSymbol("variable", written.span, variable.text))
        inner = {**known, variable.text: LocalSymbol("variable", written.span, variable.text)}
        yield from self.condition(inner, written.body)
        if written.when is not None:
            yield from self.condition(inner, written.when)

    def _aggregate(self, known: Locals, written: s.Aggregate) -> Iterator[Occurrence]:
        yield Occurrence(written.function.span, AggregateSymbol(written.function.text))
        symbol = LocalSymbol("variable", written.span, written.variable.text)
        yield from self.bound(known, written.variable, symbol)
        yield from self.members({**known, written.variable.text: symbol}, written.cls, written.where, written.value)

    def members(
        self, known: Locals, cls: s.Name, where: s.Condition | None, value: s.Value | None
    ) -> Iterator[Occurrence]:
        """Yield the occurrences in `Class where condition`, and in the value of each individual."""
        yield from self.term("class", cls)
        if where is not None:
            yield from self.condition(known, where)
        if value is not None:
            yield from self.value(known, value)

    def bound(self, known: Locals, name: s.Name, symbol: LocalSymbol) -> Iterator[Occurrence]:
        """Yield the occurrence of a name that is bound here; if it is already in `known`, it refers to that symbol."""
        yield Occurrence(name.span, known.get(name.text, symbol), declares=name.text not in known)

    def _side(self, known: Locals, written: s.Value | s.Anything | None) -> Iterator[Occurrence]:
        if written is not None and not isinstance(written, s.Anything):
            yield from self.value(known, written)

    def _comparison(self, known: Locals, written: s.Compare | s.Change) -> Iterator[Occurrence]:
        match written:
            case s.Compare(left=left, right=right):
                yield from self._compared(known, left)
                yield from self._compared(known, right)
            case s.Change(property=of, amount=amount, to=to):
                for each in (of, amount, to):
                    yield from self._side(known, each)
            case _:
                assert_never(written)

    def _compared(self, known: Locals, written: s.Value) -> Iterator[Occurrence]:
        """Yield the occurrences on one side of a comparison; a bare name that is not a local name is a choice."""
        match written:
            case s.NameReference(name=s.Name(text=text, span=Span() as span)) if text not in known and ":" not in text:
                yield Occurrence(span, ChoiceSymbol(text))
            case _:
                yield from self.value(known, written)


def _is_failure(known: Locals, written: s.Value) -> bool:
    symbol = known.get(written.name.text) if isinstance(written, s.NameReference) else None
    return isinstance(symbol, LocalSymbol) and symbol.origin == "failure"
