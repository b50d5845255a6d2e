"""Describes the library of a cell for people and programs that choose what it is to do."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import msgspec

from skillc_model import conditions
from skillc_model.format_type import format_type
from skillc_model.skills import Implementation, Parameter, Requirement, Skill, SkillLibrary, Task
from skillc_rdf.vocabulary.types import Vocabulary


class ParameterDescription(msgspec.Struct, frozen=True):
    """A parameter: a caller gives it (`in`), may give it (`opt`), or it is found (`infer`) or returned (`out`).

    `type` is as in the language.
    """

    name: str
    direction: Literal["in", "opt", "infer", "out"]
    type: str
    doc: str


class ImplementationDescription(msgspec.Struct, frozen=True):
    """An implementation of a skill; `pre` are the conditions that it adds."""

    name: str
    doc: str
    pre: tuple[str, ...]


class SkillDescription(msgspec.Struct, frozen=True):
    """A skill: its conditions as they are written, and its implementations in the order in which they are tried.

    `duration_s` is the duration that it declares; None if it declares none, or one that depends on its parameters.
    """

    name: str
    doc: str
    parameters: tuple[ParameterDescription, ...]
    pre: tuple[str, ...]
    post: tuple[str, ...]
    implementations: tuple[ImplementationDescription, ...]
    duration_s: float | None = None


class TaskDescription(msgspec.Struct, frozen=True):
    """A task; `goal` is empty for one with a body."""

    name: str
    doc: str
    parameters: tuple[ParameterDescription, ...]
    goal: str


class LibraryDescription(msgspec.Struct, frozen=True):
    """A compiled library; `hash` identifies its content."""

    name: str
    hash: str
    skills: tuple[SkillDescription, ...]
    tasks: tuple[TaskDescription, ...]


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
