"""A library whose skills act by what they declare, for cells without bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

import msgspec
from msgspec.structs import replace

from skillc_model.liveness import Names, find_live_names, find_live_parameters, is_plain
from skillc_model.properties import Measures
from skillc_model.rewriting import map_children
from skillc_model.skills import Compound, Declared, Implementation, Parameter, Primitive, Skill, SkillLibrary, Task
from skillc_model.tree import Call

UNIMPLEMENTED = "as_declared"
"""The name of the implementation of a skill that has none."""
S = TypeVar("S", bound=msgspec.Struct)
T = TypeVar("T", bound=Task)


def act_as_declared(library: SkillLibrary) -> SkillLibrary:
    """Return a library in which no implementation runs Python: each takes its duration and then what it declares is so.

    A skill without implementations gets one that does the same. Values that matter only to bodies, such as where to
    move and how hard to press, are not computed, and forces are not monitored. Scenes need not state what only bodies
    need. It has the hash of the library: its sources are the same.
    """
    if library.vocabulary.symbolic:
        return library
    whole = implement_all(library)
    whole = replace(whole, vocabulary=replace(library.vocabulary, symbolic=True))
    live = find_live_parameters(whole)
    return replace(
        whole,
        implementations={name: _without_body(each, live) for name, each in whole.implementations.items()},
        tasks={name: _with_live_arguments(each, live) for name, each in whole.tasks.items()},
        tests={name: _with_live_arguments(each, live) for name, each in whole.tests.items()},
    )


def implement_all(library: SkillLibrary) -> SkillLibrary:
    """Return a library in which each skill without implementations has one that does what it declares."""
    bare = {name: each for name, each in library.skills.items() if not each.implementations}
    added = {f"{name}.{UNIMPLEMENTED}": _implement(each) for name, each in bare.items()}
    skills = {name: replace(each, implementations=(UNIMPLEMENTED,)) for name, each in bare.items()}
    return replace(library, skills={**library.skills, **skills}, implementations={**library.implementations, **added})


def settle_outcomes(library: SkillLibrary, outcomes: Mapping[str, str]) -> SkillLibrary:
    """Return a library in which it is certain what comes of some skills: the label of an outcome, by skill."""
    settled = {
        name: replace(
            library.skills[name],
            outcomes=tuple(replace(each, likely=float(each.label == label)) for each in library.skills[name].outcomes),
        )
        for name, label in outcomes.items()
    }
    return replace(library, skills={**library.skills, **settled})


def _implement(skill: Skill) -> Implementation:
    return Implementation(
        name=UNIMPLEMENTED,
        skill=skill.name,
        doc=skill.doc,
        parameters=skill.parameters,
        pre=skill.pre,
        hold=skill.hold,
        post=skill.post,
        duration=skill.duration,
        body=Declared(),
        source=skill.source,
    )


def _without_body(implementation: Implementation, live: Mapping[str, Names]) -> Implementation:
    """Return an implementation that needs no body, and computes nothing that only a body needs."""
    body = Declared() if isinstance(implementation.body, Primitive) else implementation.body
    parameters = tuple(_unless_live(each, live[implementation.skill]) for each in implementation.parameters)
    if isinstance(body, Compound):
        body = _keep_live_arguments(body, live, frozenset(each.name for each in parameters))
    verified = tuple(each for each in implementation.verify if not isinstance(each.first, Measures))
    lean = replace(implementation, parameters=parameters, body=body, verify=verified)
    read = find_live_names(lean, live)
    return replace(lean, lets=tuple(each for each in lean.lets if each.name in read))


def _unless_live(parameter: Parameter, live: Names) -> Parameter:
    """Return a parameter that may stay unset if nothing depends on it."""
    if parameter.name in live or parameter.direction == "out":
        return parameter
    default = parameter.default if parameter.default is not None and is_plain(parameter.default, frozenset()) else None
    return replace(parameter, direction="opt", default=default)


def _with_live_arguments(task: T, live: Mapping[str, Names]) -> T:
    if task.body is None:
        return task
    return replace(task, body=_keep_live_arguments(task.body, live, frozenset(each.name for each in task.parameters)))


def _keep_live_arguments(item: S, live: Mapping[str, Names], parameters: Names) -> S:
    """Return a body without the arguments that are computed although nothing depends on them."""
    if isinstance(item, Call):
        kept = {
            name: value
            for name, value in item.arguments.items()
            if name in live[item.skill] or is_plain(value, parameters)
        }
        return replace(item, arguments=kept)
    return map_children(item, lambda part: _keep_live_arguments(part, live, parameters))
