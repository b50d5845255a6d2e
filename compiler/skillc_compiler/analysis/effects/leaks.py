"""What a body writes, in the terms of its skill; on individuals without a name, on which ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from msgspec import structs

from skillc_compiler.analysis.caller_terms import hide_names
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.knowledge.alias_types import any_individual
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite, Write
from skillc_compiler.program.typed import Implementation, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Aggregate, Condition, Variable
from skillc_model.read_write import may_change, terms_read
from skillc_model.rewriting import substitute
from skillc_model.traversal import free_variables


def writes_from_start(run: Exploration, implementation: Implementation, body: TypedNode) -> Iterator[Write]:
    """Yield the relations and properties that a body may write.

    `when` of a write is only there if no step of the body changes for whom it holds before that is decided.
    """
    names = {each.name for each in implementation.parameters if each.direction != "out"}
    whole = run.summaries.writes_of_node(body, implementation)
    loops = dict(_loops_once(body))
    for write in whole:
        if not isinstance(write, RelationWrite | PropertyWrite):
            continue
        of_items = [name for name in loops if Variable(name) in (write.subject, getattr(write, "object", None))]
        items_of = {name: any_individual(loops[name][1].cls) for name in of_items}
        [hidden] = hide_names((_with_names(write, items_of),), names)
        assert isinstance(hidden, RelationWrite | PropertyWrite), "it stays a write of the same kind"
        if len(of_items) == 1:
            name = of_items[0]
            node, items = loops[name]
            is_settled = _is_settled(run, items.where, _writes_outside(run, implementation, body, node))
            where = substitute(items.where, {name: any_individual(items.cls)})
            known = where if is_settled and free_variables(items.where) <= names | {name} else None
            yield structs.replace(hidden, when=known)
        elif hidden.when is not None and not _is_settled(run, hidden.when, whole):
            yield structs.replace(hidden, when=None)
        else:
            yield hidden


def _with_names(write: RelationWrite | PropertyWrite, names: Mapping[str, Variable]) -> RelationWrite | PropertyWrite:
    ends = ("subject", "object") if isinstance(write, RelationWrite) else ("subject",)
    changed = {end: names[thing.name] for end in ends if (thing := getattr(write, end)) in map(Variable, names)}
    return structs.replace(write, **changed)


def _loops_once(node: TypedNode) -> Iterator[tuple[str, tuple[TypedNode, Aggregate]]]:
    """Yield the loops over individuals that start once, each with the name of its item, if no other has it."""
    every = [each.written.variable.text for each in nodes_in(node) if isinstance(each.written, s.For)]
    waiting = [node]
    while waiting:
        inner = waiting.pop()
        match inner.written:
            case s.For(variable=variable):
                items = inner.values[0].meaning
                if isinstance(items, Aggregate) and every.count(variable.text) == 1:
                    yield variable.text, (inner, items)
            case s.Block(kind="seq" | "sel") | s.If() | s.With() | s.OnFailure() | s.Finally():
                waiting += (*inner.children, *inner.orelse)


def _writes_outside(
    run: Exploration, implementation: Implementation, body: TypedNode, loop: TypedNode
) -> Iterator[Write]:
    """Yield what the steps of a body write that are not in a loop."""
    inside = {id(each) for each in nodes_in(loop)}
    for node in nodes_in(body):
        if id(node) not in inside and node.call is not None:
            yield from run.summaries.writes_of_call(node.call)
        if id(node) not in inside and isinstance(node.written, s.ApplyPosts):
            yield from run.summaries.writes_of_node(node, implementation)


def _is_settled(run: Exploration, condition: Condition, writes: Iterable[Write]) -> bool:
    """Whether writes change nothing that a condition reads."""
    vocabulary = run.types.vocabulary
    written = frozenset(
        each.relation if isinstance(each, RelationWrite) else each.property
        for each in writes
        if isinstance(each, RelationWrite | PropertyWrite)
    )
    read = terms_read(condition)
    return not any(vocabulary.is_computed(iri) or may_change(iri, written, vocabulary) for iri in read)
