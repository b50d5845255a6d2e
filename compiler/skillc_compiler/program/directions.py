"""Which parameters are certainly declared with the right direction, because something relies on it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, Skill, TypedNode
from skillc_compiler.program.walk import calls_in, conditions_in, nodes_in
from skillc_dsl.source import Span
from skillc_model.conditions import Given


def find_right_directions(program: Program) -> frozenset[Span]:
    """Return the places of these parameters.

    An optional one is left out of a call or asked for with `given`, an output is taken or assigned, another one is
    passed by most calls. An output to which no body gives a value may have another name there.
    """
    uses = Counter(use for call in program.calls if call.skill for use in _uses(call, call.skill))
    found = {span for span, is_right in uses if is_right and uses[span, True] > uses[span, False]}
    for skill in program.skills.values():
        asked = {name for each in skill.requirements for name in _asked(conditions_in(each.condition))}
        found |= {each.span for each in skill.parameters if each.direction == "opt" and each.name in asked}
    used = {span for each in program.implementations for span in _used_in(each)}
    bodies = (each.skill for each in program.implementations if isinstance(each.body, TypedNode))
    outputs = {each.span for skill in bodies for each in skill.parameters if each.direction == "out"}
    return frozenset((found - outputs) | used)


def _uses(call: Call, skill: Skill) -> Iterator[tuple[Span, bool]]:
    """Yield the parameters of a called skill, with whether the call takes them for what they are declared to be."""
    passed = {argument.name.text for argument in call.arguments}
    outputs = [each for each in skill.parameters if each.direction == "out"]
    takes_output = call.out is not None
    for parameter in skill.parameters:
        is_passed = parameter.name in passed
        match parameter.direction:
            case "in":
                yield parameter.span, is_passed
            case "opt" if not is_passed and (len(outputs) == 1 or not takes_output):
                yield parameter.span, True
            case "out" if takes_output and len(outputs) == 1:
                yield parameter.span, True
            case "infer" if is_passed:
                yield parameter.span, True


def _used_in(implementation: Implementation) -> Iterator[Span]:
    """Yield the optional parameters that an implementation asks for, and the outputs that it assigns."""
    asked = {name for each in implementation.requirements for name in _asked(conditions_in(each.condition))}
    taken = {each.name.text for each in implementation.outputs}
    if isinstance(implementation.body, TypedNode):
        for node in nodes_in(implementation.body):
            asked |= {name for whole in node.conditions for name in _asked(conditions_in(whole))}
        taken |= {call.out.text for call in calls_in(implementation.body) if call.out}
    used: Mapping[str, set[str]] = {"opt": asked, "out": taken}
    for parameter in (*implementation.skill.parameters, *implementation.parameters):
        if parameter.name in used.get(parameter.direction, ()):
            yield parameter.span


def _asked(conditions: Iterable[TypedCondition]) -> Iterator[str]:
    """Yield the names of the parameters after `given`."""
    return (each.meaning.parameter for each in conditions if isinstance(each.meaning, Given))
