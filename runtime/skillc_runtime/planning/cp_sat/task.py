"""What the program `worker` is given and answers: activities over numbered facts, as JSON.

A literal is the number of a fact, from 1, negative if the fact shall be false.
"""

from __future__ import annotations

from typing import TypeAlias

import msgspec

TASK, ANSWER = "task.json", "answer.json"
"""The files, in the folder in which the program runs."""


class AllOf(msgspec.Struct, frozen=True, tag="all"):
    """All parts hold; true when empty."""

    parts: tuple[Need, ...]


class AnyOf(msgspec.Struct, frozen=True, tag="any"):
    """Some part holds; false when empty."""

    parts: tuple[Need, ...]


Need: TypeAlias = int | AllOf | AnyOf


class Activity(msgspec.Struct, frozen=True):
    """What takes `units` of time, and may be done up to `copies` times.

    While it runs, `need` holds, it alone changes the facts of its effects, and nothing else uses its devices (numbers).
    """

    units: int
    need: Need
    effects: tuple[int, ...]
    devices: tuple[int, ...]
    copies: int = 1


class ScheduleTask(msgspec.Struct, frozen=True):
    """Activities that lead from the facts that are `true` to `goal` within `horizon` units.

    Of each of the `groups` of facts exactly one holds; an activity that changes a group needs the one that it ends.

    The search goes on from the schedule `first`: activities (by index) with their starts. Of a `relaxed` task only a
    lower bound of the makespan is asked for: with no effect ever undone. `seconds` and `workers` limit the search.
    """

    activities: tuple[Activity, ...]
    true: tuple[int, ...]
    goal: Need
    groups: tuple[tuple[int, ...], ...]
    horizon: int
    first: tuple[tuple[int, int], ...]
    relaxed: bool
    seconds: float
    workers: int


class ScheduleAnswer(msgspec.Struct, frozen=True):
    """The best schedule so far, None if there is none: activities (by index) with their starts.

    No schedule of the task takes less than `at_least` units; `ended` if the search is complete.
    """

    starts: tuple[tuple[int, int], ...] | None
    at_least: int
    ended: bool


def list_literals(need: Need) -> tuple[int, ...]:
    """Return all literals of a need, in any order, maybe some twice."""
    if isinstance(need, int):
        return (need,)
    return tuple(literal for part in need.parts for literal in list_literals(part))


def list_conjuncts(need: Need) -> tuple[int, ...]:
    """Return the literals that a need asks for in any case."""
    match need:
        case int():
            return (need,)
        case AllOf(parts):
            return tuple(literal for part in parts for literal in list_conjuncts(part))
        case _:
            return ()
