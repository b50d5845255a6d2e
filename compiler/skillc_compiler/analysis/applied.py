"""What `apply` claims before anything has been done for it: as the first thing, or where the block has failed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.analysis.binding import definite_effects
from skillc_compiler.analysis.findings import EarlyApply
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.program.typed import Implementation, Requirement, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Assign, Effect, ForEach, Literal, Retract


def early_applies(implementation: Implementation, body: TypedNode) -> Iterator[EarlyApply]:
    """Yield each `apply` that runs first in a body, or in a `finally`, while something else may still fail, or has."""
    for node in _first(body):
        post = first_claim(implementation, node)
        if post is not None and any(map(_may_fail, nodes_in(body))):
            yield EarlyApply(node, post)
    for each in nodes_in(body):
        if isinstance(each.written, s.Finally) and any(map(_may_fail, nodes_in(each.children[0]))):
            for node in _first_of(each.orelse):
                post = first_claim(implementation, node)
                if post is not None:
                    yield EarlyApply(node, post, at_the_end=True)


def applied_posts(implementation: Implementation, node: TypedNode) -> tuple[Requirement, ...]:
    """Return the postconditions that an `apply` writes."""
    if not isinstance(node.written, s.ApplyPosts):
        return ()
    labels = {name.text for name in node.written.labels}
    posts = requirements_of(implementation, "post")
    return tuple(post for post in posts if post.label and post.label.text in labels)


def first_claim(implementation: Implementation, node: TypedNode) -> Requirement | None:
    """Return the first postcondition of an `apply` that says what has become so; None if it only says what ended."""
    for post, effect in definite_effects(applied_posts(implementation, node)):
        if claims(effect):
            return post
    return None


def claims(effect: Effect) -> bool:
    """Whether an effect says that something has become so, not that it no longer is."""
    single = effect.effect if isinstance(effect, ForEach) else effect
    return not isinstance(single, Retract) and not (isinstance(single, Assign) and single.value == Literal(False))


def _may_fail(node: TypedNode) -> bool:
    return isinstance(node.written, s.CallSkill | s.With | s.CheckNode | s.Fail)


def _first(node: TypedNode) -> Iterator[TypedNode]:
    """Yield the `apply` nodes before which nothing runs, is looked at or takes time."""
    match node.written:
        case s.ApplyPosts():
            yield node
        case s.Block(kind="seq" | "reactive seq") | s.Decorator():
            yield from _first_of(node.children)
        case s.Block(kind="sel" | "reactive sel") | s.OnFailure() | s.Finally():
            yield from _first_of(node.children[:1])
        case s.Block():
            for child in node.children:
                yield from _first(child)
        case _:
            return


def _first_of(children: Sequence[TypedNode]) -> Iterator[TypedNode]:
    """Yield those of children that run one after the other."""
    for child in children:
        yield from _first(child)
        if not isinstance(child.written, s.ApplyPosts):
            return
