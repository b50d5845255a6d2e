"""Keeps a planner from steps that have failed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from skillc_model.pddl.domain import Action, PlanningDomain
from skillc_model.pddl.formulas import Equal, Negation, Typed, conjunction, disjunction
from skillc_runtime.planning.plan import Step


def exclude_steps(
    steps: Sequence[Step], domain: PlanningDomain, names: Mapping[str, str], types: Mapping[str, str]
) -> PlanningDomain:
    """Return the domain in which no action is one of the steps; `names` and `types` are those of objects, by IRI.

    An action gets the precondition that one of its parameters is another object than in the step.
    """
    if not steps:
        return domain
    known = [step for step in steps if names.keys() >= set(step.arguments.values())]
    spoken_of = sorted({iri for step in known for iri in step.arguments.values()})
    constants = {*domain.constants, *(Typed(names[iri], types[iri]) for iri in spoken_of)}
    actions = tuple(_without(known, each, names) for each in domain.actions)
    return replace(domain, actions=actions, constants=tuple(sorted(constants, key=lambda each: each.name)))


def _without(steps: Sequence[Step], action: Action, names: Mapping[str, str]) -> Action:
    others = [
        disjunction(
            Negation(Equal(parameter.name, names[step.arguments[bound]]))
            for parameter, bound in zip(action.parameters, action.binds, strict=True)
        )
        for step in steps
        if step.skill == action.skill
    ]
    return replace(action, precondition=conjunction((action.precondition, *others))) if others else action
