"""Explains why a condition does not hold: the facts that hold instead, in short names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import assert_never

from skillc_model.conditions import (
    Aggregate,
    And,
    Anything,
    Arithmetic,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    ListValue,
    Literal,
    Message,
    Not,
    Or,
    PropertyOf,
    Same,
    Term,
    Variable,
)
from skillc_model.format_condition import format_expression, format_relation
from skillc_rdf.vocabulary.types import ValueType, Vocabulary, local_name
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import Bindings, compile_expression, describe_missing_value, type_of
from skillc_runtime.world.state.properties import value_at
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.quantities import show_quantity
from skillc_runtime.world.state.world_state import WorldState

LISTED = 4


def explain(condition: Condition, state: WorldState, bindings: Bindings, vocabulary: Vocabulary) -> str:
    """Return what holds instead of a false condition: the facts found and what is needed."""
    return _Explainer(state, vocabulary).unmet(condition, bindings)


class _Explainer:
    def __init__(self, state: WorldState, vocabulary: Vocabulary) -> None:
        self._state = state
        self._short = vocabulary.short

    def unmet(self, condition: Condition, bindings: Bindings) -> str:
        """Return why a false condition is false."""
        match condition:
            case Holds(subject, relation, object_):
                return self._no_relation(subject, relation, object_, bindings)
            case Compare(left, sign, right):
                return self._comparison(left, sign, right, bindings)
            case Same(left, right):
                return f"{self._term(left, bindings)} is not {self._term(right, bindings)}"
            case HasProperty(subject, property_):
                return f"{self._term(subject, bindings)} has no {self._short(property_)}"
            case IsA(subject, cls):
                return f"{self._class_of(subject, bindings)}; needed: {self._short(cls)}"
            case Given(parameter):
                return f"`{parameter}` was not passed"
            case Not(body):
                return self.met(body, bindings)
            case And(parts):
                return "; ".join(self.unmet(part, bindings) for part in self._false(parts, bindings))
            case Or(parts):
                return " and ".join(self.unmet(part, bindings) for part in parts) or "there is no alternative"
            case Exists(variable, cls, body):
                return self._none(variable, cls, body, bindings)
            case Forall(variable, cls, body):
                breaking = self._those(variable, cls, Not(body), bindings)
                first = self.unmet(body, {**bindings, variable: breaking[0]})
                return f"not for every {self._short(cls)}: {first}{_more(breaking[1:])}"
            case _:
                assert_never(condition)

    def met(self, condition: Condition, bindings: Bindings) -> str:
        """Return the facts that make a condition true that should be false."""
        match condition:
            case Holds(subject, _, object_):
                wanted = "nothing" if Anything() in (subject, object_) else "that it does not hold"
                return f"{self._found(condition, bindings)}; needed: {wanted}"
            case Not(body):
                return self.unmet(body, bindings)
            case And(parts):
                return " and ".join(self._found(part, bindings) for part in parts) or "it always holds"
            case Or(parts):
                true = [part for part in parts if evaluate(part, self._state, bindings)]
                return "; ".join(self.met(part, bindings) for part in true)
            case Exists(variable, cls, body):
                found = self._those(variable, cls, body, bindings)
                return f"{self.met(body, {**bindings, variable: found[0]})}{_more(found[1:])}"
            case Compare(left, sign, right):
                shown = self._reading(right, bindings, self._common_type(left, right))
                wanted = shown if sign == "!=" else f"not {shown}" if sign == "==" else f"not {sign} {shown}"
                return f"{self._found(condition, bindings)}; needed: {wanted}"
            case IsA(subject, _):
                return self._class_of(subject, bindings)
            case Same(left, right):
                return f"{self._term(left, bindings)} is {self._term(right, bindings)}"
            case HasProperty(subject, property_):
                return f"{self._term(subject, bindings)} has a {self._short(property_)}"
            case Given(parameter):
                return f"`{parameter}` was passed"
            case Forall(_, cls, _):
                return f"it is so for every {self._short(cls)}"
            case _:
                assert_never(condition)

    def _found(self, condition: Condition, bindings: Bindings) -> str:
        """Return the facts that make a condition true, without what is needed instead."""
        match condition:
            case Holds(subject, relation, object_):
                return self._facts(sorted(self._pairs(subject, object_, relation, bindings)), relation)
            case Compare(left, _, right):
                return self._reading(left, bindings, self._common_type(left, right))
            case _:
                return self.met(condition, bindings)

    def _no_relation(self, subject: Term, relation: str, object_: Term, bindings: Bindings, anything: str = "_") -> str:
        """Name the facts that share the subject or, when there are none, the object."""
        start, end = (self._term(term, bindings, anything) for term in (subject, object_))
        needed = format_relation(start, relation, end)
        computed = self._state.axioms.computed.get(relation)
        pair = _iri(subject, bindings), _iri(object_, bindings)
        if computed is not None and pair[0] is not None and pair[1] is not None:
            return f"`{needed}` does not hold: {computed.obstacle(self._state, pair[0], pair[1])}"
        for fixed, other in ((subject, Anything()), (Anything(), object_)):
            facts = sorted(self._pairs(fixed, other, relation, bindings)) if fixed != other else []
            if facts:
                return f"{self._facts(facts, relation)}; needed: {needed}"
        if isinstance(subject, Anything):
            return f"`{needed}` does not hold: nothing has the relation {local_name(relation)} to {end}"
        return f"`{needed}` does not hold: {start} has the relation {local_name(relation)} to nothing"

    def _facts(self, pairs: list[tuple[str, str]], relation: str) -> str:
        return _list([format_relation(self._short(start), relation, self._short(end)) for start, end in pairs])

    def _pairs(self, subject: Term, object_: Term, relation: str, bindings: Bindings) -> Iterable[tuple[str, str]]:
        return self._state.pairs(relation, _iri(subject, bindings), _iri(object_, bindings))

    def _comparison(self, left: Expression, sign: str, right: Expression, bindings: Bindings) -> str:
        for side in (left, right):
            if compile_expression(side)(self._state, bindings) is None:
                return describe_missing_value(side, self._state, bindings)
        type_ = self._common_type(left, right)
        needed = self._shown(right, bindings, type_)
        if not (sign == "==" and isinstance(right, Literal)):
            needed = f"{sign} {needed}"
        origin = self._origin(right, bindings)
        which = f", which is {origin}" if origin else ""
        return f"{self._reading(left, bindings, type_)}; needed: {needed}{which}"

    def _common_type(self, left: Expression, right: Expression) -> ValueType | None:
        """Return the type of two values that are compared; None if neither is known."""
        return type_of(left, self._state.vocabulary) or type_of(right, self._state.vocabulary)

    def _reading(self, expression: Expression, bindings: Bindings, type_: ValueType | None) -> str:
        """Return an expression with its value, such as `lab:Arm-1.deviceState is "Fault"`."""
        origin, shown = self._origin(expression, bindings), self._shown(expression, bindings, type_)
        return f"{origin} is {shown}{self._judged_from(expression, bindings)}" if origin else shown

    def _judged_from(self, expression: Expression, bindings: Bindings) -> str:
        """Return the number from which a property was judged, beside its threshold: ` (coverage 0.98 of 1)`."""
        if not isinstance(expression, PropertyOf):
            return ""
        term = self._state.vocabulary.properties.get(expression.property)
        if term is None:
            return ""
        owner = str(compile_expression(expression.of)(self._state, bindings))
        measured, needed = (self._number(owner, each) for each in (term.measure, term.threshold))
        of = f" of {needed}" if needed else ""
        return f" ({local_name(term.measure)} {measured}{of})" if term.measure and measured else ""

    def _number(self, owner: str, property_: str | None) -> str:
        """Return a number of an individual with its unit; empty if there is none."""
        value = None if property_ is None else value_at(self._state, owner, property_)
        if property_ is None or value is None:
            return ""
        return show_quantity(value, self._state.vocabulary.properties[property_].type)

    def _origin(self, expression: Expression, bindings: Bindings) -> str:
        """Return what has the value of an expression, such as `lab:Arm-1.deviceState`; empty for a mere value."""
        match expression:
            case PropertyOf(of, property_):
                owner = compile_expression(of)(self._state, bindings)
                return f"{self._short(str(owner))}.{local_name(property_)}"
            case Variable(name):
                return name
            case Invoke(function, _):
                return f"{function}(..)"
            case Aggregate():
                return format_expression(expression, self._state.vocabulary)
            case Literal() | Individual() | Arithmetic() | ListValue() | Message():
                return ""
            case _:
                assert_never(expression)

    def _shown(self, expression: Expression, bindings: Bindings, type_: ValueType | None) -> str:
        value = compile_expression(expression)(self._state, bindings)
        if value is None:
            return "missing"
        known = isinstance(value, str) and value in self._state.individuals
        return self._short(str(value)) if known else show_quantity(value, type_)

    def _none(self, variable: str, cls: str, body: Condition, bindings: Bindings) -> str:
        members = sorted(self._state.instances(cls))
        if not members:
            return f"there is no {self._short(cls)}"
        if isinstance(body, Holds):
            subject, object_ = (Anything() if t == Variable(variable) else t for t in (body.subject, body.object))
            return self._no_relation(subject, body.relation, object_, bindings, f"a {self._short(cls)}")
        if len(members) == 1:
            return self.unmet(body, {**bindings, variable: members[0]})
        listed = _list([self._short(each) for each in members])
        return f"none of {len(members)} individuals of {self._short(cls)} fits: {listed}"

    def _those(self, variable: str, cls: str, body: Condition, bindings: Bindings) -> list[str]:
        members = sorted(self._state.instances(cls))
        return [each for each in members if evaluate(body, self._state, {**bindings, variable: each})]

    def _false(self, parts: tuple[Condition, ...], bindings: Bindings) -> Iterator[Condition]:
        """Yield the false parts up to the first that cannot be evaluated: earlier parts may guard later ones."""
        try:
            for part in parts:
                if not evaluate(part, self._state, bindings):
                    yield part
        except EvaluationError:
            return

    def _class_of(self, term: Term, bindings: Bindings) -> str:
        iri = _iri(term, bindings)
        types = sorted(map(self._short, self._state.types(iri or "")))
        return f"{self._term(term, bindings)} is {'a ' + ' and a '.join(types) if types else 'not in the world model'}"

    def _term(self, term: Term, bindings: Bindings, anything: str = "_") -> str:
        iri = _iri(term, bindings)
        return anything if iri is None else self._short(iri)


def _iri(term: Term, bindings: Bindings) -> str | None:
    match term:
        case Individual(iri):
            return iri
        case Variable(name):
            return str(bindings.get(name, name))
        case Anything():
            return None
        case _:
            assert_never(term)


def _list(shown: list[str]) -> str:
    return ", ".join(shown[:LISTED]) + _more(shown[LISTED:])


def _more(rest: list[str]) -> str:
    return f" (and {len(rest)} more)" if rest else ""
