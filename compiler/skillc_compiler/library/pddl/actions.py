"""A skill's description as a planning action, with the choice among its implementations in the precondition."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from skillc_compiler.library.conditions import Expression
from skillc_compiler.library.pddl.costs import action_cost, duration_of
from skillc_compiler.library.pddl.domain import Action, Cost, CostFunction, Predicate
from skillc_compiler.library.pddl.effects import Effects
from skillc_compiler.library.pddl.formulas import FALSE, Change, Formula, conjunction, conjuncts, disjunction
from skillc_compiler.library.pddl.guards import Guards
from skillc_compiler.library.pddl.names import fresh, kebab
from skillc_compiler.library.pddl.parameters import Defaults, defaults, planned_parameters
from skillc_compiler.library.pddl.symbols import Symbols
from skillc_compiler.library.pddl.translate import Scope, Translator, Untranslatable, negated
from skillc_compiler.library.skills import Implementation, Requirement, Skill
from skillc_compiler.library.vocabulary import ClassType


@dataclass(frozen=True)
class Planned:
    """The actions of a skill with the static predicates and functions that they alone use."""

    actions: tuple[Action, ...]
    guards: tuple[Predicate, ...]
    costs: tuple[CostFunction, ...]

    @property
    def names(self) -> frozenset[str]:
        """The names that no other skill's actions, predicates and functions may have."""
        named: tuple[Action | Predicate | CostFunction, ...] = (*self.actions, *self.guards, *self.costs)
        return frozenset(each.name for each in named)


@dataclass(frozen=True)
class _Case:
    """Implementations that take equally long, one after the other in rank order, and when one of them is taken."""

    first: Implementation
    duration: Expression | None
    chosen: Formula


def planned_actions(
    name: str,
    skill: Skill,
    implementations: Sequence[Implementation],
    symbols: Symbols,
    locks: Collection[str],
    taken: Collection[str],
) -> Planned:
    """Return the actions of a skill that locks these parameters; Untranslatable says why a planner cannot reason so.

    The first implementation that fits is taken: for each duration there is an action, which demands that one of its
    implementations fits and none that comes before them does. `taken` are names that nothing else may have.
    """
    guards = Guards(skill.name, symbols, taken)
    return _Builder(name, skill, tuple(implementations), symbols, guards, taken, locks).planned()


@dataclass(frozen=True)
class _Builder:
    name: str
    skill: Skill
    implementations: tuple[Implementation, ...]
    symbols: Symbols
    guards: Guards
    taken: Collection[str]
    locks: Collection[str]

    def planned(self) -> Planned:
        if not self.implementations:
            raise Untranslatable("it has no implementation")
        scope = planned_parameters(self.skill.parameters, self.symbols.hierarchy)
        given = defaults(self.skill.parameters)
        hold = self._requirements(self.skill.hold, "hold condition", given, scope)
        described = conjunction(self._described(given, scope))
        actions: list[Action] = []
        costs: list[CostFunction] = []
        for case in self._cases(scope):
            precondition = conjunction((described, case.chosen))
            if conjunction((precondition, hold)) != FALSE:
                taken = {*self.taken, *(each.name for each in actions), *(each.name for each in costs)}
                name = fresh(f"{self.name}-{kebab(case.first.name)}", taken) if actions else self.name
                cost, function = action_cost(
                    self.skill.name, case.duration, defaults(case.first.parameters), scope, self.symbols, taken
                )
                actions.append(self._action(name, precondition, hold, cost, scope))
                costs += [function] if function else []
        if not actions:
            raise Untranslatable("its conditions can never hold")
        return Planned(tuple(actions), tuple(self.guards.found.values()), tuple(costs))

    def _action(self, name: str, precondition: Formula, hold: Formula, cost: Cost, scope: Scope) -> Action:
        effects = self._effects(conjunction((precondition, hold)), hold, scope)
        return Action(
            name=name,
            skill=self.skill.name,
            parameters=tuple(place.variable for place in scope.values()),
            binds=tuple(scope),
            precondition=precondition,
            hold=hold,
            effects=effects,
            cost=cost,
            uses=tuple(scope[each].variable.name for each in self.locks if each in scope),
            doc=self.skill.doc,
            source=self.skill.source,
        )

    def _described(self, given: Defaults, scope: Scope) -> Iterator[Formula]:
        translator = self._translator()
        yield from (translator.membership(place.cls, place) for place in scope.values())
        yield self._requirements(self.skill.pre, "precondition", given, scope)

    def _cases(self, scope: Scope) -> Iterator[_Case]:
        """Yield when an implementation of each duration is the first that fits."""
        earlier: list[Formula] = []
        for duration, group in groupby(self.implementations, lambda each: duration_of(self.skill, each)):
            members = tuple(group)
            fits = disjunction(self._alternative(each, scope) for each in members)
            yield _Case(members[0], duration, conjunction((fits, *map(negated, earlier))))
            earlier.append(fits)

    def _alternative(self, implementation: Implementation, scope: Scope) -> Formula:
        """Return what an implementation demands beyond the description: narrower types and conditions of its own."""
        given = defaults(implementation.parameters)
        own = [each for each in (*implementation.pre, *implementation.hold) if not self._is_described(each)]
        return conjunction(
            (
                *self._narrower(implementation, scope),
                self._requirements(own, f"implementation `{implementation.name}`, whose condition", given, scope),
            )
        )

    def _is_described(self, requirement: Requirement) -> bool:
        return any(requirement.condition == each.condition for each in (*self.skill.pre, *self.skill.hold))

    def _narrower(self, implementation: Implementation, scope: Scope) -> Iterator[Formula]:
        translator = self._translator()
        for parameter in implementation.parameters:
            place = scope.get(parameter.name)
            if place and isinstance(parameter.type, ClassType) and parameter.type.iri != place.cls:
                yield translator.membership(parameter.type.iri, place)

    def _requirements(self, requirements: Sequence[Requirement], kind: str, given: Defaults, scope: Scope) -> Formula:
        return conjunction(self._requirement(each, kind, given, scope) for each in requirements)

    def _requirement(self, requirement: Requirement, kind: str, given: Defaults, scope: Scope) -> Formula:
        try:
            return self._translator(requirement.label, requirement.text).formula(
                given.applied(requirement.condition), scope
            )
        except Untranslatable as reason:
            raise Untranslatable(f"its {kind} `{requirement.text}` {reason}") from reason

    def _translator(self, label: str = "", text: str = "") -> Translator:
        return Translator(self.symbols, self.guards.labelled(label, text), {})

    def _effects(self, known: Formula, hold: Formula, scope: Scope) -> tuple[Change, ...]:
        changes = Effects(self._translator(), scope, known).changes(self.skill.post)
        if not changes:
            raise Untranslatable("it changes nothing that a planner can see")
        for change in changes:
            if not change.positive and not change.variables and change.atom in conjuncts(hold):
                raise Untranslatable("its postconditions undo what its hold conditions keep")
        return changes
