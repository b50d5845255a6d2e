"""Libraries: what a cell can do, and their texts."""

from __future__ import annotations

from typing import Literal

import msgspec


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


class LibraryStatus(msgspec.Struct, frozen=True):
    """A library, and the cells whose next operations run it.

    `problem` is why that is not the one on disk; empty if it is. `pending` if its files have changed, and were not
    checked yet.
    """

    name: str
    hash: str
    problem: str
    cells: tuple[str, ...]
    pending: bool = False
