"""The devices that a skill locks while it runs: its own, and those of the skills its implementations call."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from skillc_model.conditions import Variable
from skillc_model.skills import Compound, Skill, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_model.tree import Call


def locked_parameters(library: SkillLibrary) -> dict[str, tuple[str, ...]]:
    """Return for each skill its parameters that are locked devices, in the order of its parameters.

    A device of a called skill is included if the caller passes one of its own parameters for it; a device that the
    called skill infers has no name in the caller.
    """
    locked = {name: frozenset(skill.uses) for name, skill in library.skills.items()}
    while True:
        extended = {
            name: locked[name] | set(_of_calls(skill, library, locked)) for name, skill in library.skills.items()
        }
        if extended == locked:
            return {name: _in_order(skill, locked[name]) for name, skill in library.skills.items()}
        locked = extended


def _of_calls(skill: Skill, library: SkillLibrary, locked: Mapping[str, frozenset[str]]) -> Iterator[str]:
    own = {each.name for each in skill.parameters}
    for call in _calls(skill, library):
        for device in locked.get(call.skill, frozenset()):
            match call.arguments.get(device):
                case Variable(name=name) if name in own:
                    yield name


def _calls(skill: Skill, library: SkillLibrary) -> Iterator[Call]:
    for each in library.implementations_of(skill.name):
        if isinstance(each.body, Compound):
            yield from find_calls(each.body.node)


def _in_order(skill: Skill, names: frozenset[str]) -> tuple[str, ...]:
    return tuple(each.name for each in skill.parameters if each.name in names)
