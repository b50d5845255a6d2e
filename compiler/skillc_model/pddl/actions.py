"""Translates a skill into planning actions, with the choice of its implementation in the preconditions."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import groupby, product

import msgspec

from skillc_model.conditions import Effect, Expression, Individual
from skillc_model.pddl.consistency import Consistency
from skillc_model.pddl.costs import action_cost, find_duration
from skillc_model.pddl.domain import Action, CostFunction, Predicate
from skillc_model.pddl.effects import Effects
from skillc_model.pddl.formulas import FALSE, TRUE, Change, Formula, conjunction, conjuncts, disjunction
from skillc_model.pddl.guards import Guards
from skillc_model.pddl.kebab import to_kebab
from skillc_model.pddl.names import make_unique
from skillc_model.pddl.parameters import DefaultValues, bind_parameters, default_values
from skillc_model.pddl.symbols import Symbols
from skillc_model.pddl.translate import (
    Impossible,
    NamedIndividual,
    NeedsNumbers,
    Scope,
    Translator,
    Untranslatable,
    negate,
)
from skillc_model.rewriting import substitute
from skillc_model.skills import Implementation, Outcome, Parameter, Requirement, Skill
from skillc_model.traversal import free_variables_in_order
from skillc_rdf.vocabulary.types import ClassType


class PlannedSkill(msgspec.Struct, frozen=True):
    """The actions of a skill with the static predicates and functions that only they use."""

    actions: tuple[Action, ...]
    guards: tuple[Predicate, ...]
    costs: tuple[CostFunction, ...]

    @property
    def names(self) -> frozenset[str]:
        """The names of its actions, predicates and functions, which no other skill may use."""
        named: tuple[Action | Predicate | CostFunction, ...] = (*self.actions, *self.guards, *self.costs)
        return frozenset(each.name for each in named)


class _Case(msgspec.Struct, frozen=True):
    """Implementations of equal duration, adjacent in rank order, and the condition under which one of them runs."""

    first: str
    duration: Expression | None
    chosen: Formula


def make_actions(
    name: str,
    skill: Skill,
    implementations: Sequence[Implementation],
    symbols: Symbols,
    objects: Mapping[str, NamedIndividual],
    locks: Collection[str],
    taken: Collection[str],
) -> PlannedSkill:
    """Return the actions of a skill that locks the parameters `locks`; Untranslatable if a planner cannot handle it.

    At run time the first applicable implementation is chosen. So there is one action per duration, whose precondition
    requires that one of its implementations is applicable and no earlier one is; and one of these per outcome.
    `objects` are the individuals that it may name, by IRI; `taken` are names already in use.
    """
    guards = Guards(skill.name, symbols, taken)
    return _Builder(name, skill, tuple(implementations), symbols, objects, guards, taken, locks).planned()


class _Builder(msgspec.Struct, frozen=True):
    name: str
    skill: Skill
    implementations: tuple[Implementation, ...]
    symbols: Symbols
    objects: Mapping[str, NamedIndividual]
    guards: Guards
    taken: Collection[str]
    locks: Collection[str]

    def planned(self) -> PlannedSkill:
        scope = bind_parameters(self.skill.parameters, self.symbols.hierarchy)
        given = default_values(self.skill.parameters)
        hold = self._requirements(self.skill.hold, "hold condition", given, scope)
        described = conjunction(self._described(given, scope))
        actions: list[Action] = []
        costs: list[CostFunction] = []
        never = Impossible("it has no implementation")
        ends: tuple[Outcome | None, ...] = self.skill.outcomes or (None,)
        for case, end in product(self._cases(given, scope), ends):
            precondition = conjunction((described, case.chosen, self._possible(end, given, scope)))
            try:
                changes, consistent = self._effects(conjunction((precondition, hold)), hold, given, scope, end)
            except Impossible as reason:
                never = reason
                continue
            taken = {*self.taken, *(each.name for each in actions), *(each.name for each in costs)}
            cost, function = action_cost(self.skill.name, case.duration, scope, self.symbols, taken)
            action = Action(
                name=self._name(case, end, [each.name for each in actions], taken),
                skill=self.skill.name,
                parameters=tuple(place.variable for place in scope.values()),
                binds=tuple(scope),
                precondition=conjunction((precondition, consistent)),
                hold=hold,
                effects=changes,
                cost=cost,
                uses=tuple(scope[each].variable.name for each in self.locks if each in scope),
                doc=self.skill.doc,
                source=self.skill.source,
                outcome="" if end is None else end.label,
            )
            actions.append(action)
            costs += [function] if function else []
        if not actions:
            raise never
        return PlannedSkill(tuple(actions), tuple(self.guards.found.values()), tuple(costs))

    def _name(self, case: _Case, end: Outcome | None, before: Sequence[str], taken: Collection[str]) -> str:
        """Return the name of an action: of the skill, its outcome, and the implementation where it is needed."""
        name = self.name if end is None else f"{self.name}-{to_kebab(end.label)}"
        if end is None and not before:
            return name
        return make_unique(f"{name}-{to_kebab(case.first)}" if name in before else name, taken)

    def _possible(self, end: Outcome | None, given: DefaultValues, scope: Scope) -> Formula:
        """Return under which condition an outcome may come."""
        if end is None:
            return TRUE
        possible = end.find_possibility(self.skill.senses)
        return self._requirement(
            Requirement(label=end.label, condition=possible, text=end.text, source=end.source), "outcome", given, scope
        )

    def _described(self, given: DefaultValues, scope: Scope) -> Iterator[Formula]:
        translator = self._translator()
        yield from (translator.membership(place.cls, place) for place in scope.values())
        yield from self._defaults(self.skill.parameters, scope)
        yield self._requirements(self.skill.pre, "precondition", given, scope)

    def _cases(self, described: DefaultValues, scope: Scope) -> Iterator[_Case]:
        """Yield for each duration the condition that the first applicable implementation has it."""
        earlier: list[Formula] = []
        for duration, group in groupby(self.implementations, self._duration):
            members = tuple(group)
            fits = disjunction(self._alternative(each, described, scope) for each in members)
            yield _Case(members[0].name, duration, conjunction((fits, *map(negate, earlier))))
            earlier.append(fits)

    def _duration(self, implementation: Implementation) -> Expression | None:
        duration = find_duration(self.skill, implementation)
        return None if duration is None else substitute(duration, default_values(implementation.parameters).values)

    def _defaults(self, parameters: Iterable[Parameter], scope: Scope) -> Iterator[Formula]:
        """Yield the conditions that the default individuals of optional parameters are of the parameters' classes."""
        for each in parameters:
            if isinstance(each.default, Individual) and isinstance(each.type, ClassType):
                yield self._translator().is_a(each.default, each.type.iri, scope)

    def _alternative(self, implementation: Implementation, described: DefaultValues, scope: Scope) -> Formula:
        """Return what an implementation requires beyond the description: narrower types and its own conditions."""
        given = default_values(implementation.parameters)
        known = {described.applied(each.condition) for each in (*self.skill.pre, *self.skill.hold)}
        both = (*implementation.pre, *implementation.hold)
        own = [each for each in both if given.applied(each.condition) not in known]
        return conjunction(
            (
                *self._narrower(implementation, scope),
                *self._defaults(implementation.parameters, scope),
                self._requirements(own, f"implementation `{implementation.name}`, whose condition", given, scope),
            )
        )

    def _narrower(self, implementation: Implementation, scope: Scope) -> Iterator[Formula]:
        translator = self._translator()
        for parameter in implementation.parameters:
            place = scope.get(parameter.name)
            if place and isinstance(parameter.type, ClassType) and parameter.type.iri != place.cls:
                yield translator.membership(parameter.type.iri, place)

    def _requirements(
        self, requirements: Sequence[Requirement], kind: str, given: DefaultValues, scope: Scope
    ) -> Formula:
        return conjunction(self._requirement(each, kind, given, scope) for each in requirements)

    def _requirement(self, requirement: Requirement, kind: str, given: DefaultValues, scope: Scope) -> Formula:
        try:
            return self._translator(requirement.label, requirement.text).formula(
                given.applied(requirement.condition), scope
            )
        except Untranslatable as reason:
            error = NeedsNumbers if isinstance(reason, NeedsNumbers) else Untranslatable
            raise error(f"its {kind} `{requirement.text}` {reason}", requirement.text) from reason

    def _translator(self, label: str = "", text: str = "") -> Translator:
        return Translator(self.symbols, self.guards.labelled(label, text), self.objects)

    def _effects(
        self, known: Formula, hold: Formula, given: DefaultValues, scope: Scope, end: Outcome | None
    ) -> tuple[tuple[Change, ...], Formula]:
        """Return the changes of the action, and the precondition under which the world is consistent after it."""
        if known == FALSE:
            raise Impossible("its conditions can never hold")
        effects = self._stated(given, end)
        changes = Effects(self._translator(), scope, known).changes(effects)
        if not changes:
            raise Untranslatable("it changes nothing that a planner can see")
        for change in changes:
            if not change.positive and not change.variables and change.atom in conjuncts(hold):
                raise Untranslatable("its postconditions undo what its hold conditions keep")
        consistent = Consistency(self._translator(), scope, changes, known).required(effects)
        if consistent == FALSE:
            raise Impossible("its postconditions contradict each other or an axiom")
        return changes, consistent

    def _stated(self, given: DefaultValues, end: Outcome | None) -> tuple[Effect, ...]:
        """Return the effects with the defaults of optional parameters, which implementations cannot change."""
        results = (*self.skill.post, *(() if end is None else (end,)))
        effects = [effect for each in results for effect in each.effects]
        read = {name for effect in effects for name in free_variables_in_order(effect)} & given.given.keys()
        for implementation in self.implementations:
            own = default_values(implementation.parameters).values
            changed = sorted(name for name in read if own.get(name) != given.values.get(name))
            if changed:
                said = f"`{changed[0]}`, which its postconditions speak of"
                raise Untranslatable(f"its implementation `{implementation.name}` has another default for {said}")
        return tuple(substitute(effect, given.values) for effect in effects)
