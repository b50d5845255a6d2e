"""Calls that run in parallel and conflict: they write the same fact differently, or use the same device."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from skillc_compiler.analysis.binding import call_requirements
from skillc_compiler.analysis.findings import ParallelConflict
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.apply_effects import apply_write
from skillc_compiler.analysis.knowledge.axioms import CanonicalAxioms
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite, Write
from skillc_compiler.analysis.summaries import WriteSummaries
from skillc_compiler.program.typed import Call, Implementation, Program, Requirement, TypedNode
from skillc_compiler.program.walk import calls_in, nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Expression, Individual, Literal, Variable
from skillc_model.rewriting import substitute
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import local_name


def find_parallel_conflicts(
    program: Program, summaries: WriteSummaries, axioms: CanonicalAxioms, body: TypedNode
) -> Iterator[ParallelConflict]:
    """Yield the first two conflicting calls of each pair of children of a `par`."""
    for node in nodes_in(body):
        if isinstance(node.written, s.Block) and node.written.kind.startswith("par"):
            for one, other in combinations(node.children, 2):
                yield from _first_conflict(program, summaries, axioms, one, other)


def _first_conflict(
    program: Program, summaries: WriteSummaries, axioms: CanonicalAxioms, one: TypedNode, other: TypedNode
) -> Iterator[ParallelConflict]:
    for first in calls_in(one):
        for second in calls_in(other):
            devices = _devices(program, first) & _devices(program, second)
            written = _conflicts(axioms, summaries.writes_of_call(first), summaries.writes_of_call(second))
            if devices:
                yield ParallelConflict(
                    first, second, f"both use `{_short_name(min(devices, key=_short_name))}` exclusively"
                )
                return
            for fact in written:
                yield ParallelConflict(first, second, f"both write `{fact}` differently")
                return
            for holding, breaking in ((first, second), (second, first)):
                broken = _find_broken_hold(program, summaries, axioms, holding, breaking)
                if broken is not None:
                    what = f"ends `{broken.text}`, which has to hold as long as the other one runs"
                    yield ParallelConflict(holding, breaking, what)
                    return


def _find_broken_hold(
    program: Program, summaries: WriteSummaries, axioms: CanonicalAxioms, holding: Call, breaking: Call
) -> Requirement | None:
    """Return a hold of a call that another call makes false, as far as both name the same individuals."""
    types, values = AliasTypes(program.vocabulary, axioms), _passed_terms(holding)
    ended = [apply_write(types, State(), write) for write in summaries.writes_of_call(breaking)]
    for hold in call_requirements(program, holding, "hold"):
        condition = substitute(hold.condition.meaning, values)
        is_named = free_variables(hold.condition.meaning) <= values.keys()
        if is_named and any(evaluate(types, state, condition) is False for state in ended):
            return hold
    return None


def _passed_terms(call: Call) -> dict[str, Expression]:
    """Return the arguments of a call that are names, individuals or constants."""
    values = ((argument.name.text, argument.value.meaning) for argument in call.arguments)
    return {name: value for name, value in values if isinstance(value, Variable | Individual | Literal)}


def _devices(program: Program, call: Call, context: tuple[str, ...] = ()) -> frozenset[Variable | Individual]:
    """Return the devices that a call uses exclusively, as far as the caller has names for them."""
    if call.skill is None or call.skill.name in context:
        return frozenset()
    passed = {argument.name.text: argument.value.meaning for argument in call.arguments}
    names = {device.parameter.text for device in call.skill.devices if device.kind == "uses"}
    for implementation in program.candidates(call):
        names |= devices_inside(program, implementation, context)
    values = (passed.get(name) for name in names)
    return frozenset(value for value in values if isinstance(value, Variable | Individual))


def devices_inside(program: Program, of: Implementation, context: tuple[str, ...] = ()) -> frozenset[str]:
    """Return the names that the body of an implementation has for the devices that it uses exclusively.

    `context` names the skills whose bodies are being followed.
    """
    calls = calls_in(of.body) if isinstance(of.body, TypedNode) else ()
    found = (device for inner in calls for device in _devices(program, inner, (*context, of.skill.name)))
    return frozenset(device.name for device in found if isinstance(device, Variable))


def _conflicts(axioms: CanonicalAxioms, ours: frozenset[Write], theirs: frozenset[Write]) -> list[str]:
    return sorted({fact for one in ours for other in theirs for fact in _conflict(axioms, one, other)})


def _conflict(axioms: CanonicalAxioms, one: Write, other: Write) -> Iterator[str]:
    match one, other:
        case RelationWrite(), RelationWrite() if one.relation == other.relation:
            same = (_same(one.subject, other.subject), _same(one.object, other.object))
            opposite = {one.value, other.value} == {True, False} and all(same)
            single = one.value is True and other.value is True and same[0] and _are_distinct(one.object, other.object)
            if opposite or (
                single and axioms.canonical.get(one.relation) in {(r, False) for r in axioms.single_object}
            ):
                yield local_name(one.relation)
        case PropertyWrite(value=Literal() as ours), PropertyWrite(value=Literal() as theirs):
            if one.property == other.property and _same(one.subject, other.subject) and ours != theirs:
                yield local_name(one.property)


def _same(one: object, other: object) -> bool:
    return one == other and not (isinstance(one, Variable) and one.name.startswith("?"))


def _are_distinct(one: object, other: object) -> bool:
    return isinstance(one, Individual) and isinstance(other, Individual) and one != other


def _short_name(thing: Variable | Individual) -> str:
    return thing.name if isinstance(thing, Variable) else local_name(thing.iri)
