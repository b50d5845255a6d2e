"""Effects on many individuals: what is proved of one of which nothing else is known holds of all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

from msgspec import structs

from skillc_compiler.analysis.effects.amounts import Amounts
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import Remedy
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import normalise_each
from skillc_compiler.analysis.members import ANY_ONE
from skillc_compiler.analysis.paths import EndStates
from skillc_compiler.logic.sums import Change, contains, effect_of
from skillc_compiler.program.typed import TypedNode
from skillc_model.conditions import (
    Adjust,
    Assert,
    Condition,
    Effect,
    Exists,
    ForEach,
    HasProperty,
    Not,
    Retract,
    Same,
    SingleEffect,
    Term,
    Variable,
    wanted_by,
)
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts

Assume: TypeAlias = Callable[[Remedy], tuple[Exploration, EndStates]]
"""Explores a body again as if a remedy had been added to its skill."""

MOST_STEPS = 400
"""The number of steps up to which a body is explored again for what some successes may leave."""


class Explored(NamedTuple):
    """A body that was explored, the states in which it ends, and what was known at its start."""

    run: Exploration
    ends: EndStates
    start: State

    def is_so(self, state: State, condition: Condition) -> bool | None:
        """Whether a condition holds in a state; None if that is open."""
        return evaluate(self.run.types, state, condition)

    def has_change(self, declared: Adjust) -> bool:
        """Whether a declared change of a number contains what the body does to it."""
        amounts = self._amounts(declared)
        found = self._found(amounts)
        if found is None:
            return True
        known = self.is_so(self.start, HasProperty(declared.subject, declared.property)) is True
        found = structs.replace(found, is_known=known or found.is_known)
        return contains(amounts.change(declared), found, amounts.values.bounds)

    def change_of(self, one: Adjust) -> Adjust | None:
        """Return what the body does to the number that an effect changes; None if nothing."""
        amounts = self._amounts(one)
        found = self._found(amounts)
        return None if found is None or found.is_nothing else effect_of(found, one.subject, one.property)

    def _amounts(self, one: Adjust) -> Amounts:
        assert self.run.implementation is not None, "only implementations declare changes"
        return Amounts(self.run, self.run.implementation, self.start, one.subject, one.property, {})

    def _found(self, amounts: Amounts) -> Change | None:
        body = amounts.implementation.body
        return amounts.ends(body).success if isinstance(body, TypedNode) else None


@dataclass(frozen=True)
class Universals:
    """Explores a body again with what an effect on many is on; `start` is the state at its start.

    `known` are the explorations that were made, by the class and the conditions.
    """

    run: Exploration
    start: State
    assume: Assume
    known: dict[tuple[str | None, tuple[Condition, ...]], Explored | None] = field(default_factory=dict)

    def is_established(self, effect: ForEach) -> bool | None:
        """Whether each success has an effect on all that fulfilled its condition at the start; None if that is open."""
        single, when = _of_one(effect)
        explored = self._explore(effect.cls, (when,))
        if explored is None:
            return True
        if isinstance(single, Adjust):
            return explored.has_change(single)
        known = [explored.is_so(state, wanted_by(single)) for state in explored.ends.success]
        return None if None in known and False not in known else all(known)

    def is_done(self, effect: ForEach) -> bool:
        """Whether each success has an effect on many, whatever it is on, as a call that promises it had it last."""
        _, ends = self.assume(Remedy(after=(effect,)))
        return bool(ends.success) and all(normalise_each(effect) in state.done for state in ends.success)

    def may_last(self, effect: Effect, declared: Iterable[Effect], branches: Sequence[Condition]) -> bool:
        """Whether some success leaves an effect on something that no declared effect is on.

        `branches` are the conditions on which the call that has it is reached.
        """
        if not isinstance(effect, ForEach):
            excluded = tuple(_exclude((each for each in declared if isinstance(each, ForEach)), effect))
            return not excluded or self._lasts(effect, None, excluded)
        single, when = _of_one(effect)
        known = (when, *_exclude(declared, single))
        apart = tuple(Not(Same(Variable(ANY_ONE), each)) for each in map(Variable, sorted(self.run.stable)))
        reached = tuple(substitute(each, {effect.variable: Variable(ANY_ONE)}) for each in branches)
        tried = dict.fromkeys(((*known, *apart), known, (*known, *reached, *apart)))
        return any(self._lasts(single, effect.cls, each) for each in tried)

    def may_be_left(self, effect: ForEach, declared: Iterable[Effect]) -> bool:
        """Whether some success may leave an effect on something, where no declared effect is like it.

        It is open of one on which the effect was not at the start, whatever may have become of it. Bodies with many
        steps are not explored for this: callers know of all that a body may write in any case.
        """
        single, when = _of_one(effect)
        if self.run.steps > MOST_STEPS or any(True for _ in _exclude(declared, single)):
            return False
        wanted = wanted_by(single)
        explored = self._explore(effect.cls, (when, Not(wanted)))
        return explored is not None and any(explored.is_so(each, wanted) is None for each in explored.ends.success)

    def change_of_each(self, effect: ForEach) -> ForEach | None:
        """Return what becomes of a number of all that fulfilled the condition of a change; None if that is open."""
        single, when = _of_one(effect)
        apart = (Not(Same(Variable(ANY_ONE), each)) for each in map(Variable, sorted(self.run.stable)))
        explored = self._explore(effect.cls, (when, *apart)) or self._explore(effect.cls, (when,))
        if explored is None or not isinstance(single, Adjust):
            return None
        found = explored.change_of(single)
        named = {ANY_ONE: Variable(effect.variable)}
        return structs.replace(effect, effect=substitute(found, named)) if found is not None else None

    @property
    def whole(self) -> Explored:
        """The body as it was explored, of whose ends nothing is asked."""
        return Explored(self.run, EndStates(), self.start)

    def _lasts(self, single: SingleEffect, cls: str | None, known: tuple[Condition, ...]) -> bool:
        explored = self._explore(cls, known)
        if explored is None:
            return False
        if isinstance(single, Adjust):
            return explored.change_of(single) is not None
        return any(explored.is_so(state, wanted_by(single)) for state in explored.ends.success)

    def _explore(self, cls: str | None, known: tuple[Condition, ...]) -> Explored | None:
        """Explore the body with conditions that hold at its start; None if they cannot.

        What has to exist for them has a name of its own.
        """
        key = cls, known
        if key not in self.known:
            self.known[key] = self._explore_once(cls, known)
        return self.known[key]

    def _explore_once(self, cls: str | None, known: tuple[Condition, ...]) -> Explored | None:
        classes = {ANY_ONE: cls} if cls is not None else {}
        named = tuple(part for each in known for part in _name_witnesses(each, classes))
        self.run.types.classes.update(classes)
        state: State | None = self.start
        for condition in named:
            state = assume(self.run.types, state, condition) if state is not None else None
        if state is None:
            return None
        return Explored(*self.assume(Remedy(parameters=tuple(classes.items()), before=named)), state)


def _name_witnesses(condition: Condition, classes: dict[str, str]) -> Iterator[Condition]:
    """Yield the parts of a condition, with names for what exists; `classes` gets their classes."""
    for part in conjuncts(condition):
        if isinstance(part, Exists):
            name = f"{ANY_ONE} {len(classes)}"
            classes[name] = part.cls
            yield from _name_witnesses(substitute(part.body, {part.variable: Variable(name)}), classes)
        else:
            yield part


def _of_one(effect: ForEach) -> tuple[SingleEffect, Condition]:
    """Return the effect on one individual, and the condition that it fulfils before."""
    one = {effect.variable: Variable(ANY_ONE)}
    return substitute(effect.effect, one), substitute(effect.when, one)


def _exclude(declared: Iterable[Effect], single: SingleEffect) -> Iterator[Condition]:
    """Yield that no declared effect is this one."""
    yield from (Not(when) for own in declared if (when := _when_it_is(own, single)) is not None)


def _when_it_is(own: Effect, single: SingleEffect) -> Condition | None:
    """Return under which condition a declared effect is this one; None if it never is."""
    single = _whatever_amount(single)
    if isinstance(own, ForEach):
        for thing in _ends(single):
            named = {own.variable: thing} if isinstance(thing, Variable) else {}
            if named and substitute(_whatever_amount(own.effect), named) == single:
                return substitute(own.when, named)
        return None
    one, own = Variable(ANY_ONE), _whatever_amount(own)
    same = (each for each in _ends(own) if isinstance(each, Variable) and substitute(single, {ANY_ONE: each}) == own)
    return next((Same(one, each) for each in same if one in _ends(single)), None)


def _whatever_amount(effect: SingleEffect) -> SingleEffect:
    """Return an effect; a change of a number without what it is, as any declares that there is one."""
    return Adjust(effect.subject, effect.property, None, None) if isinstance(effect, Adjust) else effect


def _ends(effect: SingleEffect) -> tuple[Term, ...]:
    return (effect.subject, effect.object) if isinstance(effect, Assert | Retract) else (effect.subject,)
