"""Preconditions which ensure that an action's effects break no axiom and that all its postconditions hold.

The world model rejects a write that breaks an axiom, and a skill fails if its postconditions do not hold at the end.
No step of a plan may do either, so conditions on the world after the action are regressed to the world before it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations, product
from typing import assert_never

from skillc_model.conditions import (
    Adjust,
    Anything,
    Assert,
    Assign,
    Effect,
    ForEach,
    Holds,
    Literal,
    Retract,
    SingleEffect,
    Term,
    Variable,
)
from skillc_model.pddl.effects import BoundEach, bind_each
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
    Atom,
    Change,
    Equal,
    Formula,
    Negation,
    Typed,
    conjunction,
    conjuncts,
    disjunction,
    existential,
)
from skillc_model.pddl.translate import Impossible, Scope, Translator, Untranslatable, negate
from skillc_model.traversal import conjuncts as condition_parts
from skillc_rdf.vocabulary.types import RelationTerm


@dataclass(frozen=True)
class Consistency:
    """Checks the effects of one action together; `changes` are these effects as PDDL, `known` is its precondition."""

    translator: Translator
    scope: Scope
    changes: tuple[Change, ...]
    known: Formula
    _apart: set[Formula] = field(default_factory=set)

    def required(self, effects: Sequence[Effect]) -> Formula:
        """Return the condition; FALSE if it can never hold, Untranslatable if a planner cannot predict it."""
        self._apart.update(each.body for each in conjuncts(self.known) if isinstance(each, Negation))
        several = [each for each in effects if isinstance(each, ForEach)]
        plain = [each for each in effects if not isinstance(each, ForEach)]
        asserted = [each for each in plain if isinstance(each, Assert)]
        irreflexive = [formula for each in asserted for formula in self._irreflexive(each)]
        self._apart.update(each.body for each in irreflexive if isinstance(each, Negation))
        alone = [formula for each in plain for formula in self._alone(each)]
        assigned = [each for each in plain if isinstance(each, Assign)]
        together = [*self._all_rivals(asserted)]
        together += [formula for pair in combinations(assigned, 2) for formula in self._together(*pair)]
        each_ = [self._of_each(one, (*several[number:], *plain)) for number, one in enumerate(several, 1)]
        return conjunction((*irreflexive, *alone, *together, *each_))

    def _of_each(self, each: ForEach, others: Sequence[Effect]) -> Formula:
        """Return what must hold of every individual that an effect is on, beside other effects."""
        bound = bind_each(each, self.translator, self.scope)
        inner, effect = replace(self, scope=bound.scope), bound.effect
        found: list[Formula] = [*inner._alone(effect)]
        if isinstance(effect, Assert):
            if not self._is_of_one(each):
                self._refuse_rivals(effect, bound)
            found += inner._irreflexive(effect)
        for other in others:
            if isinstance(other, ForEach):
                also = bind_each(other, self.translator, inner.scope)
                both = replace(inner, scope=also.scope)._together(effect, also.effect)
                found.append(_whenever(also, conjunction(both)))
            else:
                found += inner._together(effect, other)
        return _whenever(bound, conjunction(found))

    def _is_of_one(self, each: ForEach) -> bool:
        """Whether at most one individual fulfils the condition: it is what a functional relation leads to, or from."""
        relations, one = self.translator.symbols.vocabulary.relations, Variable(each.variable)
        links = [part for part in condition_parts(each.when) if isinstance(part, Holds) and part.relation in relations]
        return any(
            (relations[link.relation].functional and link.object == one != link.subject)
            or (relations[link.relation].inverse_functional and link.subject == one != link.object)
            for link in links
        )

    def _refuse_rivals(self, effect: Assert, bound: BoundEach) -> None:
        """Refuse what gives one individual several values of a relation of which it has one."""
        here = {name for name, place in bound.scope.items() if place is bound.place}
        for term, subject, object_ in self._implied(effect):
            ends = ((term.functional, subject, object_), (term.inverse_functional, object_, subject))
            for is_single, one, other in ends:
                if is_single and _is_in(other, here) and not _is_in(one, here):
                    shown = self.translator.symbols.short(term.iri)
                    raise Untranslatable(f"states `{shown}` of several individuals at once, and one has it only")

    def _alone(self, effect: SingleEffect) -> Iterator[Formula]:
        match effect:
            case Assert():
                yield from self._typed(effect)
                yield from self._asymmetric(effect)
            case Retract():
                yield from self._gone(effect)
            case Assign(subject, iri, _):
                term = self.translator.symbols.vocabulary.properties[iri]
                if term.computed_by is not None:
                    raise Impossible(f"sets `{self.translator.symbols.short(iri)}`, which is computed")
                owners = (self.translator.is_a(subject, each, self.scope) for each in term.domains)
                yield disjunction(owners) if term.domains else TRUE
            case Adjust():
                raise AssertionError("translating the effect has refused it before")
            case _:
                assert_never(effect)

    def _implied(self, effect: Assert) -> Iterator[tuple[RelationTerm, Term, Term]]:
        return self.translator.symbols.vocabulary.implied_links(effect.relation, effect.subject, effect.object)

    def _irreflexive(self, effect: Assert) -> Iterator[Formula]:
        """Yield the conditions that nothing gets a relation to itself that is irreflexive, as asymmetric ones are."""
        for term, subject, object_ in self._implied(effect):
            if term.irreflexive or term.asymmetric:
                yield negate(self._same(subject, object_))

    def _typed(self, effect: Assert) -> Iterator[Formula]:
        """Yield the conditions that the individuals are of the classes that the relation and all it implies take."""
        symbols, is_a = self.translator.symbols, self.translator.is_a
        if symbols.is_computed(effect.relation):
            raise Impossible(f"states `{symbols.short(effect.relation)}`, which is computed")
        for term, subject, object_ in self._implied(effect):
            fitting = [
                conjunction((is_a(subject, each.domain, self.scope), is_a(object_, each.range, self.scope)))
                for each in term.signatures
            ]
            yield disjunction(fitting) if fitting else TRUE

    def _asymmetric(self, effect: Assert) -> Iterator[Formula]:
        """Yield the conditions that asymmetric relations do not hold in the opposite direction afterwards."""
        symbols = self.translator.symbols
        for term, subject, object_ in self._implied(effect):
            if term.asymmetric and self._takes(term, object_, subject):
                if symbols.follows_over_steps(term.iri):
                    shown = symbols.short(term.iri)
                    raise Untranslatable(f"states `{shown}`, whose opposite may follow over any number of steps")
                opposite = self.translator.holds(term.iri, self._term(object_), self._term(subject))
                same = self._same(subject, object_)
                differing = replace(self, _apart={*self._apart, same})
                yield disjunction((same, negate(disjunction(map(differing._after, opposite)))))

    def _takes(self, term: RelationTerm, subject: Term, object_: Term) -> bool:
        """Whether the signatures of a relation allow these terms."""
        may_be = self.translator.may_be
        fitting = (
            may_be(subject, each.domain, self.scope) and may_be(object_, each.range, self.scope)
            for each in term.signatures
        )
        return not term.signatures or any(fitting)

    def _after(self, atom: Atom) -> Formula:
        """Return the regression of an atom: the condition before the action under which it is true afterwards."""
        added: list[Formula] = []
        deleted: list[Formula] = []
        for change in self.changes:
            if change.atom.predicate == atom.predicate and (change.positive or change.apart is not None):
                (added if change.positive else deleted).append(self._speaks_of(change, atom.terms))
        return disjunction((*added, conjunction((atom, negate(disjunction(deleted))))))

    def _speaks_of(self, change: Change, terms: Sequence[str | None]) -> Formula:
        """Return the condition under which a change affects the atom with these terms; None matches any object."""
        free = {each.name for each in change.variables}
        pairs = list(zip(terms, change.atom.terms, strict=True))
        values = {other: one for one, other in pairs if one is not None and other in free}
        same = [self._equal(one, other) for one, other in pairs if one is not None and other not in free]
        return conjunction((*same, *(self._differ(each, values) for each in conjuncts(change.apart or TRUE))))

    def _differ(self, formula: Formula, values: Mapping[str, str]) -> Formula:
        assert isinstance(formula, Negation) and isinstance(formula.body, Equal)
        left, right = (values.get(each, each) for each in (formula.body.left, formula.body.right))
        return negate(self._equal(left, right))

    def _gone(self, effect: Retract) -> Iterator[Formula]:
        """Yield the conditions that no asserted fact implies the retracted one."""
        symbols = self.translator.symbols
        sides = [None if isinstance(each, Anything) else self._term(each).name for each in _sides(effect)]
        if None not in sides and effect.relation in symbols.vocabulary.closure.chained:
            shown = symbols.short(effect.relation)
            raise Untranslatable(f"takes back `{shown}`, which may still follow over any number of steps")
        for reading in symbols.vocabulary.closure.canonical_sources[effect.relation]:
            predicate = symbols.relation(reading.relation)
            terms = reading.ends(*sides)
            for change in self.changes:
                if change.positive and change.atom.predicate == predicate:
                    yield negate(self._speaks_of(change, terms))

    def _together(self, one: Effect, other: Effect) -> Iterator[Formula]:
        """Yield the conditions that one effect does not overwrite what the other states."""
        match one, other:
            case Assert(), Assert():
                yield from self._rivals(one, other)
            case Assign(property=iri, value=Literal(value)), Assign(property=also, value=Literal(second)):
                if iri == also and (value != second or type(value) is not type(second)):
                    yield negate(self._same(one.subject, other.subject))

    def _all_rivals(self, asserted: Sequence[Assert]) -> Iterator[Formula]:
        """Yield the same for each two facts, in order; facts with the same value, of which there may be many, agree."""
        by_value: dict[tuple[str, bool, Term], list[int]] = defaultdict(list)
        for number, effect in enumerate(asserted):
            for key in self._single_values(effect):
                by_value[key].append(number)
        groups: dict[tuple[str, bool], list[list[int]]] = defaultdict(list)
        for (iri, forward, _), numbers in by_value.items():
            groups[iri, forward].append(numbers)
        pairs = {
            (min(one, two), max(one, two))
            for alike in groups.values()
            for some, others in combinations(alike, 2)
            for one, two in product(some, others)
            if one != two
        }
        for one, two in sorted(pairs):
            yield from self._rivals(asserted[one], asserted[two])

    def _single_values(self, effect: Assert) -> Iterator[tuple[str, bool, Term]]:
        """Yield the values of which a fact states the only one: of a relation, followed forward or backward."""
        for term, subject, object_ in self._implied(effect):
            if term.functional:
                yield term.iri, True, object_
            if term.inverse_functional:
                yield term.iri, False, subject

    def _rivals(self, one: Assert, other: Assert) -> Iterator[Formula]:
        for term, subject, object_ in self._implied(one):
            for also, holder, held in self._implied(other):
                if term.iri == also.iri and term.functional:
                    yield disjunction((negate(self._same(subject, holder)), self._same(object_, held)))
                if term.iri == also.iri and term.inverse_functional:
                    yield disjunction((negate(self._same(object_, held)), self._same(subject, holder)))

    def _same(self, one: Term, other: Term) -> Formula:
        return self._equal(self._term(one).name, self._term(other).name)

    def _equal(self, one: str, other: str) -> Formula:
        """Return the equality of two names; TRUE or FALSE if the names, their types or the precondition decide it."""
        if one == other:
            return TRUE
        first, second = sorted((one, other))
        types = [self._types[each].type for each in (first, second)]
        named = not one.startswith("?") and not other.startswith("?")
        if named or not self.translator.symbols.hierarchy.meet(*types):
            return FALSE
        equal = Equal(first, second)
        return FALSE if {equal, Equal(second, first)} & self._apart else equal

    def _term(self, term: Term) -> Typed:
        return self.translator.term(term, self.scope)

    @cached_property
    def _types(self) -> dict[str, Typed]:
        return self.translator.typed(self.scope)


def _whenever(bound: BoundEach, needed: Formula) -> Formula:
    """Return that something holds of all individuals that an effect is on."""
    if needed == TRUE:
        return TRUE
    return negate(existential(bound.place.variable, conjunction((bound.condition, negate(needed)))))


def _is_in(term: Term, names: Set[str]) -> bool:
    return isinstance(term, Variable) and term.name in names


def _sides(effect: Retract) -> tuple[Term, Term]:
    return effect.subject, effect.object
