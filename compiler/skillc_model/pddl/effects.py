"""Translates the effects of postconditions into changes of predicates, including retractions that axioms require."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, assert_never

from msgspec import structs

from skillc_model.conditions import (
    Adjust,
    Anything,
    Assert,
    Assign,
    Effect,
    ForEach,
    Literal,
    Retract,
    SingleEffect,
    Term,
    Variable,
)
from skillc_model.pddl.formulas import (
    Atom,
    Change,
    Equal,
    Formula,
    Negation,
    Typed,
    Universal,
    conjunction,
    conjuncts,
    rename_terms,
)
from skillc_model.pddl.names import make_unique, make_variable
from skillc_model.pddl.translate import BoundVariable, NeedsNumbers, Scope, Translator, Untranslatable
from skillc_model.read_write import UniqueSide, unique_sides
from skillc_model.rewriting import substitute
from skillc_rdf.vocabulary.closure import Directed


class BoundEach(NamedTuple):
    """An effect on each individual that fulfils a condition: what it does to the one at a place of a scope."""

    place: BoundVariable
    condition: Formula
    scope: Scope
    effect: SingleEffect


def bind_each(each: ForEach, translator: Translator, scope: Scope) -> BoundEach:
    """Return an effect on each individual with its variable in the scope."""
    name = make_unique(each.variable, scope)
    place = translator.place(name, each.cls, scope)
    inner, named = {**scope, name: place}, {each.variable: Variable(name)}
    try:
        when = translator.formula(substitute(each.when, named), inner)
    except Untranslatable as reason:
        error = NeedsNumbers if isinstance(reason, NeedsNumbers) else Untranslatable
        raise error(f"its effect on each `{each.variable}` depends on a condition that {reason}") from reason
    condition = conjunction((translator.membership(each.cls, place), when))
    return BoundEach(place, condition, inner, substitute(each.effect, named))


@dataclass(frozen=True)
class Effects:
    """Translates effects into changes; `known` is the precondition, which may name the facts to delete."""

    translator: Translator
    scope: Scope
    known: Formula

    def changes(self, effects: Iterable[Effect]) -> tuple[Change, ...]:
        """Return the changes of all effects, additions first; Untranslatable if PDDL cannot express them."""
        found: dict[Change, None] = {}
        for effect in effects:
            found.update(dict.fromkeys(self._effect(effect)))
        added = {change.atom for change in found if change.positive}
        kept = [change for change in found if change.positive or change.variables or change.atom not in added]
        return tuple(sorted(kept, key=lambda change: not change.positive))

    def _effect(self, effect: Effect) -> Iterator[Change]:
        match effect:
            case ForEach():
                return self._for_each(effect)
            case Assign():
                return self._assign(effect)
            case Adjust(property=iri):
                raise NeedsNumbers(f"changes the number `{self.translator.symbols.short(iri)}`")
            case Retract(subject=subject, relation=relation, object=object_):
                return self._retract(relation, self._term(subject), self._term(object_))
            case Assert():
                return self._assert(effect)
            case _:
                assert_never(effect)

    def _for_each(self, effect: ForEach) -> Iterator[Change]:
        bound = bind_each(effect, self.translator, self.scope)
        for change in replace(self, scope=bound.scope)._effect(bound.effect):
            yield structs.replace(
                change,
                variables=(bound.place.variable, *change.variables),
                condition=conjunction((bound.condition, change.condition)),
            )

    def _assign(self, effect: Assign) -> Iterator[Change]:
        symbols = self.translator.symbols
        values, shown = symbols.values(effect.property), symbols.short(effect.property)
        if not values:
            raise NeedsNumbers(f"sets `{shown}`, which has no finite set of values")
        if not isinstance(effect.value, Literal) or effect.value.value not in values:
            raise NeedsNumbers(f"sets `{shown}` to a value that is known only at run time")
        subject = self.translator.term(effect.subject, self.scope).name
        for value in values:
            yield Change(Atom(symbols.value(effect.property, value), (subject,)), value == effect.value.value)

    def _assert(self, effect: Assert) -> Iterator[Change]:
        vocabulary = self.translator.symbols.vocabulary
        subject = self.translator.term(effect.subject, self.scope)
        object_ = self.translator.term(effect.object, self.scope)
        added = self._atom(vocabulary.closure.canonical(effect.relation), subject, object_)
        yield Change(added, True)
        for unique in unique_sides(effect.relation, vocabulary):
            fixed = (subject, object_)[unique.fixed]
            kept = object_ if fixed is subject else subject
            sides: list[Typed | None] = [None, None]
            sides[unique.side] = fixed
            sides[1 - unique.side] = self._known_partner(unique, fixed)
            for change in self._retract(unique.relation, *sides):
                if not self._is_excluded(change):
                    yield from self._of_others(change, fixed, kept, added)

    def _of_others(self, change: Change, fixed: Typed, kept: Typed, added: Atom) -> Iterator[Change]:
        """Yield the deletion of the former partners of `fixed` other than `kept`, its partner afterwards.

        No condition is needed where the atom of `kept` is the added one: an atom both deleted and added is true.
        """
        side = 1 if change.atom.terms[0] == fixed.name else 0
        former = change.atom.terms[side]
        types = {**self._typed, **{each.name: each for each in change.variables}}
        terms = list(change.atom.terms)
        terms[side] = kept.name
        apart = not self.translator.symbols.hierarchy.meet(types[former].type, kept.type)
        if apart or Atom(change.atom.predicate, tuple(terms)) == added:
            yield change
        elif former != kept.name:
            yield structs.replace(change, condition=conjunction((change.condition, Negation(Equal(former, kept.name)))))

    def _is_excluded(self, change: Change) -> bool:
        """Whether the precondition says that nothing is to be deleted: `not hand holds _`."""
        hierarchy = self.translator.symbols.hierarchy
        for each in conjuncts(self.known):
            match each, change.variables:
                case Universal(variable, body), (former,) if hierarchy.is_below(former.type, variable.type):
                    denied = Negation(rename_terms(change.atom, {former.name: variable.name}))  # type: ignore[arg-type]
                    if variable.name not in change.atom.terms and denied in conjuncts(body):
                        return True
        return False

    def _known_partner(self, unique: UniqueSide, fixed: Typed) -> Typed | None:
        """Return the partner of the fixed term that the precondition names, None if it names none."""
        symbols = self.translator.symbols
        for reading in symbols.vocabulary.closure.canonical_sources[unique.relation]:
            predicate = symbols.relation(reading.relation)
            side = unique.side != reading.flipped
            for each in conjuncts(self.known):
                match each:
                    case Atom(predicate=name, terms=terms) if name == predicate and terms[side] == fixed.name:
                        return self._typed[terms[not side]]
        return None

    def _retract(self, relation: str, subject: Typed | None, object_: Typed | None) -> Iterator[Change]:
        """Yield the deletion of every fact that implies `relation`; None matches any individual."""
        symbols = self.translator.symbols
        for reading in symbols.vocabulary.closure.canonical_sources[relation]:
            variables: list[Typed] = []
            terms: list[Typed] = []
            for side, term in enumerate((subject, object_)):
                if term is None:
                    stored_side = 1 - side if reading.flipped else side
                    term = self._variable(reading.relation, stored_side, [each.name for each in terms])
                    variables.append(term)
                terms.append(term)
            if symbols.takes(reading.relation, reading.ends(*terms)):
                atom = self._atom(reading, *terms)
                yield Change(atom, False, tuple(variables), atom) if variables else Change(atom, False)

    def _variable(self, relation: str, side: int, beside: Sequence[str]) -> Typed:
        symbols = self.translator.symbols
        taken = {*beside, *(place.variable.name for place in self.scope.values())}
        return Typed(make_variable("former", taken), symbols.hierarchy.type_name(symbols.side_class(relation, side)))

    def _atom(self, reading: Directed, subject: Typed, object_: Typed) -> Atom:
        return Atom(self.translator.symbols.relation(reading.relation), reading.ends(subject.name, object_.name))

    def _term(self, term: Term) -> Typed | None:
        return None if isinstance(term, Anything) else self.translator.term(term, self.scope)

    @cached_property
    def _typed(self) -> dict[str, Typed]:
        return self.translator.typed(self.scope)
