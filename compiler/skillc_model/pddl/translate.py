"""Translates conditions into formulas over predicates; conditions that no skill changes may be evaluated beforehand."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Protocol, TypeAlias, assert_never

import msgspec

from skillc_model.conditions import (
    Aggregate,
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Term,
    Variable,
)
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Typed,
    Universal,
    conjunction,
    disjunction,
    existential,
)
from skillc_model.pddl.names import make_variable
from skillc_model.pddl.scoping import narrow_scopes
from skillc_model.pddl.symbols import Symbols
from skillc_model.read_write import terms_read
from skillc_model.traversal import walk


class Untranslatable(Exception):
    """Something a classical planner cannot handle; the message completes a sentence about the skill.

    `requirement` is the text of the condition that contains it, if one does.
    """

    def __init__(self, message: str, requirement: str = "") -> None:
        super().__init__(message)
        self.requirement = requirement


class BoundVariable(msgspec.Struct, frozen=True):
    """The PDDL variable of a variable of the library, and its class."""

    variable: Typed
    cls: str


Scope: TypeAlias = Mapping[str, BoundVariable]


class NamedIndividual(msgspec.Struct, frozen=True):
    """An individual that formulas may name: its PDDL name and type, and its known classes."""

    object: Typed
    classes: frozenset[str]


class Impossible(Untranslatable):
    """Something that can never succeed: excluding the skill does not change any plan."""


class NeedsNumbers(Untranslatable):
    """Something that planners with numbers can translate."""


class StaticEvaluator(Protocol):
    """Evaluates conditions that no skill changes."""

    def __call__(self, condition: Condition, scope: Scope) -> Formula | None:
        """Return the condition as a formula; None to translate it like any other."""
        ...


class Translator(msgspec.Struct, frozen=True):
    """Translates conditions into formulas; `objects` are the individuals that may be named, by IRI."""

    symbols: Symbols
    evaluate_static: StaticEvaluator
    objects: Mapping[str, NamedIndividual]

    def formula(self, condition: Condition, scope: Scope) -> Formula:
        """Return the condition as a formula; Untranslatable if a planner cannot handle it."""
        match condition:
            case Not(body=body):
                return negate(self.formula(body, scope))
            case And(parts=parts):
                return conjunction(self.formula(part, scope) for part in parts)
            case Or(parts=parts):
                return disjunction(self.formula(part, scope) for part in parts)
            case Given(parameter=name):
                raise Untranslatable(f"reads whether `{name}` was given")
            case Holds() | Compare() | Same() | HasProperty() | IsA() | Exists() | Forall():
                return self._leaf(condition, scope)
            case _:
                assert_never(condition)

    def _leaf(self, condition: Holds | Compare | Same | HasProperty | IsA | Exists | Forall, scope: Scope) -> Formula:
        read = terms_read(condition)
        self._refuse_moving(read)
        if not any(self.symbols.affected(iri) for iri in read):
            settled = self.evaluate_static(condition, scope)
            if settled is not None:
                return settled
        match condition:
            case Holds():
                return self._holds(condition, scope)
            case Same(left=left, right=right):
                return Equal(self.term(left, scope).name, self.term(right, scope).name)
            case IsA(subject=subject, cls=cls):
                return self.is_a(subject, cls, scope)
            case HasProperty(subject=subject, property=iri):
                return self._one_of(iri, self.symbols.values(iri), self.term(subject, scope))
            case Compare():
                return self._compare(condition, scope)
            case Exists(variable=name, cls=cls, body=body):
                return self._exists(name, cls, body, scope)
            case Forall(variable=name, cls=cls, body=body):
                return negate(self._exists(name, cls, Not(body), scope))
            case _:
                assert_never(condition)

    def term(self, term: Term | Expression, scope: Scope) -> Typed:
        """Return the PDDL name and type of a term."""
        match term:
            case Variable(name=name) if name in scope:
                return scope[name].variable
            case Individual(iri=iri) if iri in self.objects:
                return self.objects[iri].object
            case Variable(name=name):
                raise Untranslatable(f"reads `{name}`, which a planner does not bind")
            case Individual(iri=iri):
                raise Untranslatable(f"names `{self.symbols.short(iri)}`, which is not in the scene")
            case _:
                raise Untranslatable("reads something a skill changes through another value")

    def typed(self, scope: Scope) -> dict[str, Typed]:
        """Return the variables and individuals that formulas in this scope may name, by their PDDL names."""
        known = (*(each.variable for each in scope.values()), *(each.object for each in self.objects.values()))
        return {each.name: each for each in known}

    def _holds(self, condition: Holds, scope: Scope) -> Formula:
        relation = condition.relation
        self._refuse_transitive(relation)
        subject, first = self._side(condition.subject, relation, 0, scope)
        object_, second = self._side(condition.object, relation, 1, {**scope, **first})
        formula = disjunction(self.holds(relation, subject, object_))
        for place in (*second.values(), *first.values()):
            formula = existential(place.variable, formula)
        return formula

    def holds(self, relation: str, subject: Typed, object_: Typed) -> Iterator[Atom]:
        """Yield the atoms any of which implies the relation, except those that these types rule out."""
        for each in self.symbols.readings(relation):
            sides = each.ends(subject, object_)
            if self.symbols.takes(each.relation, sides):
                yield Atom(self.symbols.relation(each.relation), tuple(side.name for side in sides))

    def _side(self, term: Term, relation: str, side: int, scope: Scope) -> tuple[Typed, dict[str, BoundVariable]]:
        if not isinstance(term, Anything):
            return self.term(term, scope), {}
        place = self.place("any", self.symbols.side_class(relation, side), scope)
        return place.variable, {place.variable.name: place}

    def _refuse_transitive(self, relation: str) -> None:
        if self.symbols.follows_over_steps(relation):
            raise NeedsNumbers(
                f"reads `{self.symbols.short(relation)}`, which follows over any number of steps, and skills change it"
            )

    def _refuse_moving(self, read: Iterable[str]) -> None:
        for iri in sorted(filter(self.symbols.is_computed, read)):
            moving = self.symbols.decided_by(iri)
            definition = self.symbols.vocabulary.definitions.get(iri)
            if moving and definition is not None and definition.group:
                raise Untranslatable(
                    f"reads `{self.symbols.short(iri)}` under `not`, which leads back to itself, "
                    f"and skills change `{self.symbols.short(moving[0])}`"
                )
            if moving:
                raise Untranslatable(
                    f"reads `{self.symbols.short(iri)}`, which is computed from `{self.symbols.short(moving[0])}`, "
                    "and skills change it"
                )

    def place(self, name: str, cls: str, scope: Scope) -> BoundVariable:
        """Return a fresh PDDL variable for a name."""
        taken = {place.variable.name for place in scope.values()}
        return BoundVariable(Typed(make_variable(name, taken), self.symbols.hierarchy.type_name(cls)), cls)

    def _exists(self, name: str, cls: str, body: Condition, scope: Scope) -> Formula:
        place = self.place(name, cls, scope)
        member = self.membership(cls, place)
        found = existential(place.variable, conjunction((member, self.formula(body, {**scope, name: place}))))
        return narrow_scopes(found) if isinstance(found, Existential) else found

    def membership(self, cls: str, place: BoundVariable) -> Formula:
        """Return the test that the variable is of the class; TRUE if its PDDL type implies it."""
        hierarchy = self.symbols.hierarchy
        exact = hierarchy.is_exact(cls) and hierarchy.type_name(cls) == place.variable.type
        return TRUE if exact else Atom(self.symbols.member(cls), (place.variable.name,))

    def is_a(self, subject: Term, cls: str, scope: Scope) -> Formula:
        """Return the test that a term is of a class; TRUE or FALSE if its known classes decide it."""
        term = self.term(subject, scope)
        if any(self.symbols.is_a(each, cls) for each in self._known_classes(subject, scope)):
            return TRUE
        if not self.may_be(subject, cls, scope):
            return FALSE
        if isinstance(subject, Variable):
            return self.membership(cls, scope[subject.name])
        return Atom(self.symbols.member(cls), (term.name,))

    def may_be(self, subject: Term, cls: str, scope: Scope) -> bool:
        """Whether a term may be of a class."""
        if self.symbols.settled and isinstance(subject, Individual):
            return any(self.symbols.is_a(each, cls) for each in self._known_classes(subject, scope))
        overlap = self.symbols.hierarchy.overlap
        return all(overlap(each, cls) for each in self._known_classes(subject, scope))

    def _known_classes(self, term: Term, scope: Scope) -> frozenset[str]:
        match term:
            case Variable(name=name):
                return frozenset({scope[name].cls})
            case Individual(iri=iri):
                return self.objects[iri].classes
            case Anything():
                return frozenset()
            case _:
                assert_never(term)

    def _compare(self, condition: Compare, scope: Scope) -> Formula:
        match condition:
            case Compare(left=PropertyOf() as read, operator="==" | "!=" as operator, right=Literal(value=value)):
                pass
            case Compare(left=Literal(value=value), operator="==" | "!=" as operator, right=PropertyOf() as read):
                pass
            case _:
                changed = sorted(filter(self.symbols.affected, terms_read(condition)))
                names = ", ".join(f"`{self.symbols.short(each)}`" for each in changed)
                computed = next((each.function for each in walk(condition) if isinstance(each, Aggregate)), None)
                if computed is not None:
                    raise Untranslatable(f"computes `{computed}` from {names}, which skills change")
                raise NeedsNumbers(f"compares {names}, which skills change, with something else than one value")
        values = self.symbols.values(read.property)
        equal = operator == "=="
        # bool is a subclass of int: compare the types too, so that 1 does not equal True
        wanted = [each for each in values if (each == value and type(each) is type(value)) == equal]
        return self._one_of(read.property, wanted, self.term(read.of, scope))

    def _one_of(self, iri: str, values: tuple[bool | str, ...] | list[bool | str], subject: Typed) -> Formula:
        if not self.symbols.values(iri):
            raise NeedsNumbers(f"reads `{self.symbols.short(iri)}`, which skills change and which has no finite values")
        if not self.symbols.may_have(iri, subject):
            return FALSE
        return disjunction(Atom(self.symbols.value(iri, value), (subject.name,)) for value in values)


def negate(formula: Formula) -> Formula:
    """Return the negation of a formula, pushed inwards to its atoms."""
    match formula:
        case Atom() | Equal():
            return Negation(formula)
        case Negation(body=body):
            return body
        case Conjunction(parts=parts):
            return disjunction(negate(part) for part in parts) if parts else FALSE
        case Disjunction(parts=parts):
            return conjunction(negate(part) for part in parts) if parts else TRUE
        case Existential(variable=variable, body=body):
            inner = negate(body)
            return TRUE if inner == TRUE else Universal(variable, inner)
        case Universal(variable=variable, body=body):
            return existential(variable, negate(body))
        case _:
            assert_never(formula)
