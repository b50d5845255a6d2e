"""A skill's description as a planning action, with the choice among its implementations in the precondition."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from skillc_compiler.library.pddl.costs import action_cost
from skillc_compiler.library.pddl.domain import Action, CostFunction, Predicate
from skillc_compiler.library.pddl.effects import Effects
from skillc_compiler.library.pddl.formulas import FALSE, Change, Formula, conjunction, conjuncts, disjunction
from skillc_compiler.library.pddl.guards import Guards
from skillc_compiler.library.pddl.parameters import Defaults, defaults, planned_parameters
from skillc_compiler.library.pddl.symbols import Symbols
from skillc_compiler.library.pddl.translate import Scope, Translator, Untranslatable
from skillc_compiler.library.skills import Implementation, Requirement, Skill
from skillc_compiler.library.vocabulary import ClassType


@dataclass(frozen=True)
class Planned:
    """An action with the static predicates and functions that it alone uses."""

    action: Action
    guards: tuple[Predicate, ...]
    cost: CostFunction | None


def planned_action(
    name: str, skill: Skill, implementations: Sequence[Implementation], symbols: Symbols, locks: Collection[str]
) -> Planned:
    """Return the action of a skill that locks these parameters; Untranslatable says why a planner cannot reason so."""
    taken = symbols.names.keys()
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
        scope = planned_parameters(self.skill.parameters, self.symbols.hierarchy)
        given = defaults(self.skill.parameters)
        hold = self._requirements(self.skill.hold, "hold condition", given, scope)
        precondition = conjunction(self._preconditions(given, scope))
        effects = self._effects(conjunction((precondition, hold)), hold, scope)
        cost, function = action_cost(self.skill, given, scope, self.taken)
        action = Action(
            name=self.name,
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
        return Planned(action, tuple(self.guards.found.values()), function)

    def _preconditions(self, given: Defaults, scope: Scope) -> Iterator[Formula]:
        translator = self._translator()
        yield from (translator.membership(place.cls, place) for place in scope.values())
        yield self._requirements(self.skill.pre, "precondition", given, scope)
        yield disjunction(self._alternative(each, scope) for each in self.implementations)

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
        if not self.implementations:
            raise Untranslatable("it has no implementation")
        if known == FALSE:
            raise Untranslatable("its conditions can never hold")
        changes = Effects(self._translator(), scope, known).changes(self.skill.post)
        if not changes:
            raise Untranslatable("it changes nothing that a planner can see")
        for change in changes:
            if not change.positive and not change.variables and change.atom in conjuncts(hold):
                raise Untranslatable("its postconditions undo what its hold conditions keep")
        return changes
