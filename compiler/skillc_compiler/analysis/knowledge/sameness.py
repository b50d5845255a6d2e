"""Whether a proof of one declaration holds for another: they differ at most in what no proof reads of called skills."""

from __future__ import annotations

from msgspec import structs

from skillc_compiler.program.typed import Call, Implementation, Parameter, Skill, Task, TypedNode
from skillc_model.conditions import Given
from skillc_model.traversal import free_variables, walk


class Proved:
    """A declaration as its proof reads it; equal to another one for which the proof is the same."""

    __slots__ = ("of",)
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, of: Implementation | Task) -> None:
        self.of = of

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Proved) and (self.of is other.of or _are_same(self.of, other.of))


class CalledPrimitive(Proved):
    """An implementation in Python as the proofs of its callers read it."""

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CalledPrimitive):
            return False
        return self.of is other.of or _view_of_primitive(self.of) == _view_of_primitive(other.of)


def _view_of_primitive(of: Implementation | Task) -> tuple[object, ...]:
    assert isinstance(of, Implementation), "only these run Python"
    parameters = tuple(_parameter_view(each, named=False) for each in of.parameters)
    return of.key, of.requirements, parameters, _proof_view(of.skill)


def _are_same(one: Implementation | Task, other: Implementation | Task) -> bool:
    match one, other:
        case Implementation(), Implementation():
            return _are_skills_same(one.skill, other.skill) and _are_rest_same(one, other)
        case Task(), Task():
            return _are_rest_same(one, other)
    return False


def _are_rest_same(one: Implementation | Task, other: Implementation | Task) -> bool:
    """Whether all is the same but what is read of skills."""
    changes: dict[str, object] = {"body": None}
    if isinstance(one, Implementation):
        changes["skill"] = one.skill
    alike = structs.replace(one, **changes) == structs.replace(other, **changes)
    if isinstance(one.body, TypedNode) and isinstance(other.body, TypedNode):
        return alike and _are_nodes_same(one.body, other.body)
    return alike and one.body == other.body


def _are_nodes_same(one: TypedNode, other: TypedNode) -> bool:
    if one is other:
        return True
    inner, others = (*one.children, *one.orelse), (*other.children, *other.orelse)
    return (
        (len(one.children), len(inner)) == (len(other.children), len(others))
        and (one.written, one.values, one.conditions) == (other.written, other.values, other.conditions)
        and _are_calls_same(one.call, other.call)
        and all(map(_are_nodes_same, inner, others))
    )


def _are_calls_same(one: Call | None, other: Call | None) -> bool:
    if one is None or other is None:
        return one is other
    alike = structs.replace(one, skill=None) == structs.replace(other, skill=None)
    return alike and _are_skills_same(one.skill, other.skill)


def _are_skills_same(one: Skill | None, other: Skill | None) -> bool:
    return one is other or (one is not None and other is not None and _proof_view(one) == _proof_view(other))


def _proof_view(skill: Skill) -> tuple[object, ...]:
    """Return what proofs read of a called skill: the default of a parameter only if a condition names it."""
    conditions = [each.condition.meaning for each in skill.requirements]
    named = frozenset[str]().union(*map(free_variables, conditions))
    named |= {part.parameter for each in conditions for part in walk(each) if isinstance(part, Given)}
    plain = structs.replace(skill, doc="", duration=None, pause=None, parameters=())
    return plain, tuple(_parameter_view(each, named=each.name in named) for each in skill.parameters)


def _parameter_view(parameter: Parameter, *, named: bool) -> tuple[object, ...]:
    known = parameter.default.meaning if parameter.default is not None and named else None
    return structs.replace(parameter, default=None, low=None, high=None, doc=""), known
