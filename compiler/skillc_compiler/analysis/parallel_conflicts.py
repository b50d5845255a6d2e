"""Calls that run in parallel and conflict: they write the same fact differently, or wait for each other for ever."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import BrokenHold, ParallelConflict
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.knowledge.alias_types import is_any_individual
from skillc_compiler.analysis.knowledge.apply_effects import apply_write, spare
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.axioms import CanonicalAxioms
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite, Write
from skillc_compiler.analysis.parallel_waits import find_endless_waits
from skillc_compiler.analysis.summaries import HoldInside
from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_compiler.program.walk import calls_in, nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Anything, Variable
from skillc_rdf.vocabulary.types import local_name


def find_parallel_conflicts(run: Exploration, body: TypedNode) -> Iterator[ParallelConflict | BrokenHold]:
    """Yield the first two conflicting calls of each pair of children of a `par`, and what breaks a hold around it."""
    for node in nodes_in(body):
        if isinstance(node.written, s.Block) and node.written.kind.startswith("par"):
            always = run.always.get(id(node), State())
            for one, other in combinations(node.children, 2):
                yield from _first_conflict(run, always, one, other)
            yield from find_endless_waits(run.summaries.uses, node, node.written.kind)
            if run.implementation is not None and len(node.children) > 1:
                yield from _broken_around(run, run.implementation, always, node)


def _first_conflict(run: Exploration, always: State, one: TypedNode, other: TypedNode) -> Iterator[ParallelConflict]:
    possible: ParallelConflict | None = None
    for first in calls_in(one):
        for second in calls_in(other):
            found = _conflict(run, always, first, second)
            if found is not None and found.certain:
                yield found
                return
            possible = possible or found
    if possible is not None:
        yield possible


def _conflict(run: Exploration, always: State, first: Call, second: Call) -> ParallelConflict | None:
    summaries = run.summaries
    written = _conflicts(run.types.axioms, summaries.writes_of_call(first), summaries.writes_of_call(second))
    if written:
        return ParallelConflict(first, second, f"both write `{written[0]}` differently")
    for holding, breaking in ((first, second), (second, first)):
        for certain in (True, False):
            broken = _find_broken_hold(run, always, holding, breaking, certain)
            if broken is not None:
                verb = "ends" if certain else "may end"
                what = f"{verb} `{broken.text}`, which has to hold as long as the other one runs"
                return ParallelConflict(holding, breaking, what, certain)
    return None


def _find_broken_hold(
    run: Exploration, always: State, holding: Call, breaking: Call, certain: bool
) -> HoldInside | None:
    """Return what has to hold while a call runs and another one makes false, certainly or possibly.

    What the other one only measures, or does to individuals without a name, is not reported.
    """
    writes = run.summaries.writes_of_call(breaking)
    ending = [write for write in writes if isinstance(write, RelationWrite | PropertyWrite) and _is_told(write)]
    for hold in sorted(run.summaries.holds_of_call(holding), key=lambda each: each.text):
        held = assume(run.types, always, hold.condition)
        if held is None:
            continue
        for write in ending:
            known = evaluate(run.types, _after(run, always, held, write), hold.condition)
            if known is False or (known is None and not certain):
                return hold
    return None


def _after(run: Exploration, always: State, held: State, write: Write) -> State:
    return apply_write(run.types, held, spare(run.types, always, write))


def _is_told(write: RelationWrite | PropertyWrite) -> bool:
    """Whether it is said what is written, and of what."""
    ends = (write.subject, write.object) if isinstance(write, RelationWrite) else (write.subject,)
    return write.when is not None or (write.value is not None and not any(map(is_any_individual, ends)))


def _broken_around(
    run: Exploration, implementation: Implementation, always: State, node: TypedNode
) -> Iterator[BrokenHold]:
    """Yield the nodes of a `par` that may break a hold of the implementation while their siblings run."""
    for hold in requirements_of(implementation, "hold"):
        held = assume(run.types, always, hold.condition.meaning)
        if held is None:
            continue
        for leaf in nodes_in(node):
            writes = run.writes(leaf) if not leaf.children else ()
            if not all(evaluate(run.types, _after(run, always, held, each), hold.condition.meaning) for each in writes):
                yield BrokenHold(hold, leaf.written.span, False, None)


def _conflicts(axioms: CanonicalAxioms, ours: frozenset[Write], theirs: frozenset[Write]) -> list[str]:
    return sorted({fact for one in ours for other in theirs for fact in _written_differently(axioms, one, other)})


def _written_differently(axioms: CanonicalAxioms, one: Write, other: Write) -> Iterator[str]:
    match one, other:
        case RelationWrite(), RelationWrite() if one.relation == other.relation:
            same = (_same(one.subject, other.subject), _same(one.object, other.object))
            opposite = {one.value, other.value} == {True, False} and all(same)
            single = one.value is True and other.value is True and same[0] and _are_distinct(one.object, other.object)
            if opposite or (
                single and axioms.canonical.get(one.relation) in {(r, False) for r in axioms.single_object}
            ):
                yield local_name(one.relation)
        case PropertyWrite(), PropertyWrite() if one.is_change or other.is_change:
            if one.property == other.property and _same(one.subject, other.subject):
                yield local_name(one.property)
        case PropertyWrite(value=ours), PropertyWrite(value=theirs) if None not in (ours, theirs):
            if one.property == other.property and _same(one.subject, other.subject) and ours != theirs:
                yield local_name(one.property)


def _same(one: object, other: object) -> bool:
    return one == other and not (isinstance(one, Variable) and one.name.startswith("?"))


def _are_distinct(one: object, other: object) -> bool:
    return one != other and not (_is_unnamed(one) or _is_unnamed(other))


def _is_unnamed(term: object) -> bool:
    return isinstance(term, Anything) or is_any_individual(term)
