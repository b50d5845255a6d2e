"""Values of parameters that a trial tries: a library with other defaults in its implementations."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from msgspec import structs

from skillc_model.conditions import Literal
from skillc_model.skills import Implementation, SkillLibrary


class Setting(msgspec.Struct, frozen=True):
    """The default of a parameter of an implementation, `Skill.name`; numbers in SI units."""

    implementation: str
    parameter: str
    value: float | int


def apply_settings(library: SkillLibrary, settings: Sequence[Setting]) -> SkillLibrary:
    """Return a library as it is with `refine parameter: Type = value` in the implementations that settings name.

    KeyError for an implementation or a parameter that is not there.
    """
    changed = dict(library.implementations)
    for setting in settings:
        changed[setting.implementation] = _apply(changed[setting.implementation], setting)
    return structs.replace(library, implementations=changed)


def _apply(implementation: Implementation, setting: Setting) -> Implementation:
    if all(each.name != setting.parameter for each in implementation.parameters):
        raise KeyError(setting.parameter)
    parameters = (
        structs.replace(each, default=Literal(setting.value)) if each.name == setting.parameter else each
        for each in implementation.parameters
    )
    return structs.replace(implementation, parameters=tuple(parameters))
