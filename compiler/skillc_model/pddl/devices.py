"""The devices that a skill locks while it runs: its own, and those of the skills its implementations call."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from skillc_model.conditions import Variable
from skillc_model.skills import Compound, Implementation, Skill, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_model.tree import Call


def locked_parameters(library: SkillLibrary) -> dict[str, tuple[str, ...]]:
    """Return for each skill its parameters that are locked devices, in the order of its parameters.

    A device of a called skill is included if the caller passes one of its own parameters for it; a device that the
    called skill infers has no name in the caller.
    """
    locked = {name: set(skill.uses) for name, skill in library.skills.items()}
    passed = {name: tuple(passed_on(skill, library.implementations_of(name))) for name, skill in library.skills.items()}
    changed = True
    while changed:
        changed = False
        for name, pairs in passed.items():
            more = {own for own, called, parameter in pairs if parameter in locked.get(called, ())} - locked[name]
            locked[name] |= more
            changed = changed or bool(more)
    return {name: _in_order(skill, locked[name]) for name, skill in library.skills.items()}


def passed_on(skill: Skill, implementations: Iterable[Implementation]) -> Iterator[tuple[str, str, str]]:
    """Yield the parameters that implementations pass on, each with the called skill and its parameter."""
    own = {each.name for each in skill.parameters}
    for call in _calls(implementations):
        for parameter, value in call.arguments.items():
            match value:
                case Variable(name=name) if name in own:
                    yield name, call.skill, parameter


def _calls(implementations: Iterable[Implementation]) -> Iterator[Call]:
    for each in implementations:
        if isinstance(each.body, Compound):
            yield from find_calls(each.body.node)


def _in_order(skill: Skill, names: Collection[str]) -> tuple[str, ...]:
    return tuple(each.name for each in skill.parameters if each.name in names)
