"""Calls that stand beside each other and get into each other's way: the same fact, or the same device."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from skillc_compiler.analysis.axioms import Axioms
from skillc_compiler.analysis.binding import candidates
from skillc_compiler.analysis.findings import Clash
from skillc_compiler.analysis.summaries import Summaries, calls_in
from skillc_compiler.analysis.writes import Related, Valued, Write
from skillc_compiler.program.typed import Call, Program, TypedNode
from skillc_compiler.program.walk import within
from skillc_dsl import syntax as s
from skillc_model.conditions import Individual, Literal, Variable
from skillc_rdf.vocabulary.types import local_name


def clashes(program: Program, summaries: Summaries, axioms: Axioms, body: TypedNode) -> Iterator[Clash]:
    """Yield for each two children of a `par` the first calls that clash."""
    for step in within(body):
        if isinstance(step.written, s.Block) and step.written.kind.startswith("par"):
            for one, other in combinations(step.children, 2):
                yield from _first(program, summaries, axioms, one, other)


def _first(program: Program, summaries: Summaries, axioms: Axioms, one: TypedNode, other: TypedNode) -> Iterator[Clash]:
    for first in calls_in(one):
        for second in calls_in(other):
            devices = _devices(program, first) & _devices(program, second)
            written = _conflicts(axioms, summaries.of_call(first), summaries.of_call(second))
            if devices:
                yield Clash(first, second, f"both have `{_name(min(devices, key=_name))}` for themselves")
                return
            for fact in written:
                yield Clash(first, second, f"both write `{fact}`, each in its own way")
                return


def _devices(program: Program, call: Call, around: tuple[str, ...] = ()) -> frozenset[Variable | Individual]:
    """Return the devices that a call has for itself, as far as the caller has names for them."""
    if call.skill is None or call.skill.name in around:
        return frozenset()
    passed = {argument.name.text: argument.value.meaning for argument in call.arguments}
    names = {device.parameter.text for device in call.skill.devices if device.kind == "uses"}
    for implementation in candidates(program, call):
        if isinstance(implementation.body, TypedNode):
            for inner in calls_in(implementation.body):
                found = _devices(program, inner, (*around, call.skill.name))
                names |= {device.name for device in found if isinstance(device, Variable)}
    values = (passed.get(name) for name in names)
    return frozenset(value for value in values if isinstance(value, Variable | Individual))


def _conflicts(axioms: Axioms, ours: frozenset[Write], theirs: frozenset[Write]) -> list[str]:
    return sorted({fact for one in ours for other in theirs for fact in _conflict(axioms, one, other)})


def _conflict(axioms: Axioms, one: Write, other: Write) -> Iterator[str]:
    match one, other:
        case Related(), Related() if one.relation == other.relation:
            same = (_same(one.subject, other.subject), _same(one.object, other.object))
            opposite = {one.value, other.value} == {True, False} and all(same)
            single = one.value is True and other.value is True and same[0] and _apart(one.object, other.object)
            if opposite or (single and axioms.name.get(one.relation) in {(r, False) for r in axioms.single_object}):
                yield local_name(one.relation)
        case Valued(value=Literal() as ours), Valued(value=Literal() as theirs):
            if one.property == other.property and _same(one.subject, other.subject) and ours != theirs:
                yield local_name(one.property)


def _same(one: object, other: object) -> bool:
    return one == other and not (isinstance(one, Variable) and one.name.startswith("?"))


def _apart(one: object, other: object) -> bool:
    return isinstance(one, Individual) and isinstance(other, Individual) and one != other


def _name(thing: Variable | Individual) -> str:
    return thing.name if isinstance(thing, Variable) else local_name(thing.iri)
