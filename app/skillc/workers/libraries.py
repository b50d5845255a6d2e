"""Describes the library of a cell for people and programs that choose what it is to do."""

from __future__ import annotations

from collections.abc import Iterable

from skillc.contract.library import (
    ImplementationDescription,
    LibraryDescription,
    ParameterDescription,
    SkillDescription,
    TaskDescription,
)
from skillc_model import conditions
from skillc_model.format_type import format_type
from skillc_model.skills import Implementation, Parameter, Requirement, Skill, SkillLibrary, Task
from skillc_rdf.vocabulary.types import Vocabulary


def describe_library(library: SkillLibrary) -> LibraryDescription:
    """Return the description of a library; skills and tasks are in the order of their names."""
    skills = tuple(_describe_skill(each, library) for _, each in sorted(library.skills.items()))
    tasks = tuple(_describe_task(each, library.vocabulary) for _, each in sorted(library.tasks.items()))
    return LibraryDescription(library.name, library.hash, skills, tasks)


def _describe_skill(skill: Skill, library: SkillLibrary) -> SkillDescription:
    return SkillDescription(
        skill.name,
        skill.doc,
        _describe_parameters(skill.parameters, library.vocabulary),
        _texts(skill.pre),
        tuple(each.text for each in skill.post),
        tuple(_describe_implementation(each, skill) for each in library.implementations_of(skill.name)),
        float(skill.duration.value) if isinstance(skill.duration, conditions.Literal) else None,
    )


def _describe_implementation(implementation: Implementation, skill: Skill) -> ImplementationDescription:
    own = tuple(each for each in _texts(implementation.pre) if each not in _texts(skill.pre))
    return ImplementationDescription(implementation.name, implementation.doc, own)


def _describe_task(task: Task, vocabulary: Vocabulary) -> TaskDescription:
    return TaskDescription(task.name, task.doc, _describe_parameters(task.parameters, vocabulary), task.goal_text)


def _describe_parameters(parameters: Iterable[Parameter], known: Vocabulary) -> tuple[ParameterDescription, ...]:
    return tuple(
        ParameterDescription(each.name, each.direction, format_type(each.type, known), each.doc) for each in parameters
    )


def _texts(requirements: Iterable[Requirement]) -> tuple[str, ...]:
    return tuple(each.text for each in requirements)
