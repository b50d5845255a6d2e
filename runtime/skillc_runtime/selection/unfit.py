"""Individuals that a skill could be about, and that none of its implementations takes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillc_compiler.library.skills import Parameter, SkillLibrary
from skillc_compiler.library.vocabulary import ClassType
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Unfit:
    """An individual, and the skills that do not work with it, each with the classes that its implementations take."""

    individual: str
    skills: dict[str, tuple[str, ...]]


def unfit(library: SkillLibrary, state: WorldState, individuals: frozenset[str]) -> Iterator[Unfit]:
    """Yield those of the individuals that all implementations of some skill reject by their classes, by IRI."""
    narrow = [
        (skill.name, parameter, accepted)
        for skill in library.skills.values()
        for parameter in skill.parameters
        if (accepted := _accepted(library, skill.name, parameter))
    ]
    for individual in sorted(individuals & state.individuals):
        skills = {
            skill: accepted
            for skill, parameter, accepted in narrow
            if _rejected(state, individual, parameter, accepted)
        }
        if skills:
            yield Unfit(individual, skills)


def _accepted(library: SkillLibrary, skill: str, parameter: Parameter) -> tuple[str, ...]:
    """Return the classes that the implementations of a skill refine a parameter to; none where one takes all."""
    if not isinstance(parameter.type, ClassType):
        return ()
    refined = [
        each.type.iri
        for implementation in library.implementations_of(skill)
        for each in implementation.parameters
        if each.name == parameter.name and isinstance(each.type, ClassType)
    ]
    return () if parameter.type.iri in refined else tuple(sorted(set(refined)))


def _rejected(state: WorldState, individual: str, parameter: Parameter, accepted: tuple[str, ...]) -> bool:
    assert isinstance(parameter.type, ClassType)
    fits = any(state.is_a(individual, cls) for cls in accepted)
    return state.is_a(individual, parameter.type.iri) and not fits
