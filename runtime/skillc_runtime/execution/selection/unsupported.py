"""Finds individuals that fit the parameter of a skill but none of its implementations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillc_model.skills import Parameter, SkillLibrary
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class UnsupportedIndividual:
    """An individual, and the skills that do not support it, with the classes that their implementations accept."""

    individual: str
    skills: dict[str, tuple[str, ...]]


def unsupported_individuals(
    library: SkillLibrary, state: WorldState, individuals: frozenset[str]
) -> Iterator[UnsupportedIndividual]:
    """Yield the individuals, sorted by IRI, that all implementations of some skill reject by class."""
    narrow = [
        (skill.name, parameter, accepted)
        for skill in library.skills.values()
        for parameter in skill.parameters
        if (accepted := _accepted_classes(library, skill.name, parameter))
    ]
    for individual in sorted(individuals & state.individuals):
        skills = {
            skill: accepted
            for skill, parameter, accepted in narrow
            if _is_rejected(state, individual, parameter, accepted)
        }
        if skills:
            yield UnsupportedIndividual(individual, skills)


def _accepted_classes(library: SkillLibrary, skill: str, parameter: Parameter) -> tuple[str, ...]:
    """Return the classes that a skill's implementations refine a parameter to; none if one accepts all."""
    if not isinstance(parameter.type, ClassType):
        return ()
    refined = [
        each.type.iri
        for implementation in library.implementations_of(skill)
        for each in implementation.parameters
        if each.name == parameter.name and isinstance(each.type, ClassType)
    ]
    return () if parameter.type.iri in refined else tuple(sorted(set(refined)))


def _is_rejected(state: WorldState, individual: str, parameter: Parameter, accepted: tuple[str, ...]) -> bool:
    assert isinstance(parameter.type, ClassType)
    fits = any(state.is_a(individual, cls) for cls in accepted)
    return state.is_a(individual, parameter.type.iri) and not fits
