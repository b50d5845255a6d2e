"""Effects on many individuals: what is proved of one of which nothing else is known holds of all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import Remedy
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.members import ANY_ONE
from skillc_compiler.analysis.paths import EndStates
from skillc_model.conditions import (
    Adjust,
    Assert,
    Condition,
    Effect,
    Exists,
    ForEach,
    Not,
    Retract,
    Same,
    SingleEffect,
    Term,
    Variable,
    single_effect,
    wanted_by,
)
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts

Explored: TypeAlias = tuple[Exploration, EndStates]
Assume: TypeAlias = Callable[[Remedy], Explored]
"""Explores a body again as if a remedy had been added to its skill."""


@dataclass(frozen=True)
class Universals:
    """Explores a body again with what an effect on many is on; `start` is the state at its start."""

    run: Exploration
    start: State
    assume: Assume

    def is_established(self, effect: ForEach) -> bool | None:
        """Whether each success has an effect on all that fulfilled its condition at the start; None if that is open."""
        if isinstance(effect.effect, Adjust):
            return None
        single, when = _of_one(effect)
        explored = self._explore(effect.cls, (when,))
        if explored is None:
            return True
        again, ends = explored
        known = [evaluate(again.types, state, wanted_by(single)) for state in ends.success]
        return None if None in known and False not in known else all(known)

    def may_last(self, effect: Effect, declared: Iterable[Effect], branches: Sequence[Condition]) -> bool:
        """Whether some success leaves an effect on something that no declared effect on many is on.

        `branches` are the conditions on which the call that has it is reached.
        """
        if isinstance(single_effect(effect), Adjust):
            return False
        if not isinstance(effect, ForEach):
            excluded = tuple(_exclude(declared, effect))
            return not excluded or self._lasts(effect, None, excluded)
        single, when = _of_one(effect)
        known = (when, *_exclude(declared, single))
        apart = tuple(Not(Same(Variable(ANY_ONE), each)) for each in map(Variable, sorted(self.run.stable)))
        reached = tuple(substitute(each, {effect.variable: Variable(ANY_ONE)}) for each in branches)
        tried = dict.fromkeys(((*known, *apart), known, (*known, *reached, *apart)))
        return any(self._lasts(single, effect.cls, each) for each in tried)

    def _lasts(self, single: SingleEffect, cls: str | None, known: tuple[Condition, ...]) -> bool:
        explored = self._explore(cls, known)
        if explored is None:
            return False
        again, ends = explored
        return any(evaluate(again.types, state, wanted_by(single)) for state in ends.success)

    def _explore(self, cls: str | None, known: tuple[Condition, ...]) -> Explored | None:
        """Explore the body with conditions that hold at its start; None if they cannot.

        What has to exist for them has a name of its own.
        """
        classes = {ANY_ONE: cls} if cls is not None else {}
        named = tuple(part for each in known for part in _name_witnesses(each, classes))
        self.run.types.classes.update(classes)
        state: State | None = self.start
        for condition in named:
            state = assume(self.run.types, state, condition) if state is not None else None
        if state is None:
            return None
        return self.assume(Remedy(parameters=tuple(classes.items()), before=named))


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
    if isinstance(own, ForEach):
        for thing in _ends(single):
            if isinstance(thing, Variable) and substitute(own.effect, {own.variable: thing}) == single:
                return substitute(own.when, {own.variable: thing})
        return None
    one = Variable(ANY_ONE)
    same = (each for each in _ends(own) if isinstance(each, Variable) and substitute(single, {ANY_ONE: each}) == own)
    return next((Same(one, each) for each in same if one in _ends(single)), None)


def _ends(effect: SingleEffect) -> tuple[Term, ...]:
    return (effect.subject, effect.object) if isinstance(effect, Assert | Retract) else (effect.subject,)
