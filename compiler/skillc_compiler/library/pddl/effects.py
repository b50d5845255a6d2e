"""Postconditions as changes of predicates, with what the axioms retract: the former value, the former holder."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import assert_never

from skillc_compiler.library.conditions import (
    Anything,
    Assert,
    Assign,
    Compare,
    Effect,
    HasProperty,
    Literal,
    PropertyOf,
    Retract,
    Term,
)
from skillc_compiler.library.pddl.formulas import Atom, Change, Formula, Typed, conjuncts
from skillc_compiler.library.pddl.names import variable
from skillc_compiler.library.pddl.relations import Reading, Relations
from skillc_compiler.library.pddl.translate import Scope, Translator, Untranslatable
from skillc_compiler.library.skills import Post


@dataclass(frozen=True)
class Unique:
    """A relation that follows from an asserted one and lets one thing stand on the other side of `side` only."""

    relation: str
    swapped: bool
    side: int

    def fixed(self, subject: str, object_: str) -> str:
        """Return the term on `side` when the asserted relation links these two."""
        return (subject, object_)[self.side != self.swapped]


def unique_sides(relation: str, relations: Relations) -> tuple[Unique, ...]:
    """Return what asserting the relation may retract."""
    found = []
    for each in relations.above(relation):
        term = relations.vocabulary.relations[each.relation]
        found += [Unique(each.relation, each.swapped, 0)] if term.functional else []
        found += [Unique(each.relation, each.swapped, 1)] if term.inverse_functional else []
    return tuple(found)


def changed_terms(posts: Sequence[Post], relations: Relations) -> frozenset[str]:
    """Return the canonical relations and the properties that posts change, by themselves or through axioms.

    A measured number counts too: no effect tells its value, yet nothing may take the old one for granted.
    """
    changed = {iri for post in posts for effect in post.effects for iri in _changed(effect, relations)}
    for condition in (post.condition for post in posts if not post.effects):
        match condition:
            case Compare(left=PropertyOf(property=measured)) | HasProperty(property=measured):
                changed.add(measured)
    return frozenset(changed)


def _changed(effect: Effect, relations: Relations) -> set[str]:
    match effect:
        case Assign(property=iri):
            return {iri}
        case Retract(relation=iri):
            return {each.relation for each in relations.below(iri)}
        case Assert(relation=iri):
            unique = unique_sides(iri, relations)
            lost = {each.relation for above in unique for each in relations.below(above.relation)}
            return {relations.canonical(iri).relation} | lost
        case _:
            assert_never(effect)


@dataclass(frozen=True)
class Effects:
    """Turns effects into changes; `known` is what the precondition guarantees, which spares searching for old facts."""

    translator: Translator
    scope: Scope
    known: Formula

    def changes(self, posts: Sequence[Post]) -> tuple[Change, ...]:
        """Return the changes of all posts, additions first; Untranslatable says what a planner cannot follow."""
        found: dict[Change, None] = {}
        for post in posts:
            for effect in post.effects:
                found.update(dict.fromkeys(self._effect(effect)))
        added = {change.atom for change in found if change.positive}
        kept = [change for change in found if change.positive or change.variables or change.atom not in added]
        return tuple(sorted(kept, key=lambda change: not change.positive))

    def _effect(self, effect: Effect) -> Iterator[Change]:
        match effect:
            case Assign():
                return self._assign(effect)
            case Retract(subject=subject, relation=relation, object=object_):
                return self._retract(relation, self._term(subject), self._term(object_))
            case Assert():
                return self._assert(effect)
            case _:
                assert_never(effect)

    def _assign(self, effect: Assign) -> Iterator[Change]:
        symbols = self.translator.symbols
        values, shown = symbols.values(effect.property), symbols.short(effect.property)
        if not values:
            raise Untranslatable(f"sets `{shown}`, which has no finite set of values")
        if not isinstance(effect.value, Literal) or effect.value.value not in values:
            raise Untranslatable(f"sets `{shown}` to a value that is known only at run time")
        subject = self.translator.term(effect.subject, self.scope)
        for value in values:
            yield Change(Atom(symbols.value(effect.property, value), (subject,)), value == effect.value.value)

    def _assert(self, effect: Assert) -> Iterator[Change]:
        relations = self.translator.symbols.relations
        subject = self.translator.term(effect.subject, self.scope)
        object_ = self.translator.term(effect.object, self.scope)
        yield Change(self._atom(relations.canonical(effect.relation), subject, object_), True)
        for unique in unique_sides(effect.relation, relations):
            fixed = unique.fixed(subject, object_)
            sides: list[str | None] = [None, None]
            sides[unique.side] = fixed
            sides[1 - unique.side] = self._known_partner(unique, fixed)
            yield from self._retract(unique.relation, *sides)

    def _known_partner(self, unique: Unique, fixed: str) -> str | None:
        """Return what the precondition says stands opposite to the fixed term."""
        relations = self.translator.symbols.relations
        for reading in relations.below(unique.relation):
            predicate = self.translator.symbols.relation(reading.relation)
            side = unique.side != reading.swapped
            for each in conjuncts(self.known):
                match each:
                    case Atom(predicate=name, terms=terms) if name == predicate and terms[side] == fixed:
                        return terms[not side]
        return None

    def _retract(self, relation: str, subject: str | None, object_: str | None) -> Iterator[Change]:
        """Delete every fact of which `relation` follows; None stands for whatever is there."""
        symbols = self.translator.symbols
        for reading in symbols.relations.below(relation):
            variables: list[Typed] = []
            terms: list[str] = []
            for side, term in enumerate((subject, object_)):
                if term is None:
                    stored_side = 1 - side if reading.swapped else side
                    variable = self._variable(reading.relation, stored_side, terms)
                    variables.append(variable)
                    term = variable.name
                terms.append(term)
            atom = self._atom(reading, *terms)
            yield Change(atom, False, tuple(variables), atom) if variables else Change(atom, False)

    def _variable(self, relation: str, side: int, beside: Sequence[str]) -> Typed:
        symbols = self.translator.symbols
        taken = {*beside, *(place.variable.name for place in self.scope.values())}
        return Typed(variable("former", taken), symbols.hierarchy.type_name(symbols.side_class(relation, side)))

    def _atom(self, reading: Reading, subject: str, object_: str) -> Atom:
        terms = (object_, subject) if reading.swapped else (subject, object_)
        return Atom(self.translator.symbols.relation(reading.relation), terms)

    def _term(self, term: Term) -> str | None:
        return None if isinstance(term, Anything) else self.translator.term(term, self.scope)
